// Homogeneous states of Mises-Schleicher sand with k = 1, mu = 0.6,
// kappa = 0.5, as one cell and as a distorted mesh, in 2D and 3D, for both
// degrees: triaxial compression, simple shear under constant normal stress,
// uniaxial strain. Every discretization has them to round-off.

#include "box_scene.h"

using namespace Verification;

namespace
{
  constexpr double tolerance = 1e-9;

  /** Call for all discretizations; the largest error. */
  double
  worst(const std::function<double(int, unsigned int, unsigned int)> &error)
  {
    double result = 0.;
    for (const int dim : {2, 3})
      for (const unsigned int n : {1U, 3U})
        for (const unsigned int p : {1U, 2U})
          result = std::max(result, std::abs(error(dim, n, p)));
    return result;
  }

  struct Sand
  {
    double k, mu, kappa, lambda;

    double
    D() const
    {
      return mu + kappa * kappa * k;
    }

    /** Principal stresses of a state (axial, lateral, lateral). */
    std::pair<double, double>
    axisymmetric_stress(const double axial, const double lateral) const
    {
      const double theta = axial + 2. * lateral;
      const double p = -k * theta, tau = mu * gamma(axial, lateral);
      const double sign  = axial < lateral ? -1. : 1.;
      double       new_p = p, new_tau = tau;
      if (tau > kappa * p)
        {
          new_p   = std::max(0., (mu * p + kappa * k * tau) / D());
          new_tau = kappa * new_p;
        }
      // deviator: 2/sqrt(3) tau (sign) axial, half the opposite lateral
      const auto mix = [&](const double a, const double b) {
        return lambda * a + (1. - lambda) * b;
      };
      const double pressure = mix(p, new_p), shear = sign * mix(tau, new_tau);
      return {-pressure + 2. / std::sqrt(3.) * shear,
              -pressure - 1. / std::sqrt(3.) * shear};
    }

    static double
    gamma(const double axial, const double lateral)
    {
      return 2. / std::sqrt(3.) * std::abs(axial - lateral);
    }
  };

  /** Compression to an axial strain under constant lateral pressure. In 2D an
   *  axisymmetric cylinder. */
  double
  triaxial(const int          dim,
           const unsigned int n,
           const unsigned int p,
           const Sand        &sand,
           const double       pressure,
           const double       axial,
           double            &lateral)
  {
    SceneFile file = box_scene(dim, n, p);
    add_sand(file, sand.k, sand.mu, sand.kappa, sand.lambda);
    file.set({"Boundaries", "left"}, "Symmetry", "true");
    file.set({"Boundaries", "right"}, "Pressure", text(pressure));
    file.set({"Boundaries", "bottom"}, "Symmetry", "true");
    const std::string up = dim == 2 ? "y" : "z";
    file.set({"Boundaries", "top"}, "Displacement " + up, text(axial));
    if (dim == 2)
      file.set({}, "Embedding", "axisymmetric");
    else
      {
        file.set({"Boundaries", "front"}, "Symmetry", "true");
        file.set({"Boundaries", "back"}, "Pressure", text(pressure));
      }
    file.set({"Output"}, "Probe points", dim == 2 ? "1, 1" : "1, 1, 1");
    const auto line    = run(file).back();
    lateral            = value(line, "displacement x at probe 1");
    const double exact = root(
      [&](const double e) {
        return sand.axisymmetric_stress(axial, e).second + pressure;
      },
      -1e-2,
      2e-2);
    const double area   = dim == 2 ? numbers::PI : 1.;
    const double stress = value(line, "reaction top " + up) / area;
    return std::max(
      std::abs(lateral / exact - 1.),
      std::abs(stress / sand.axisymmetric_stress(axial, exact).first - 1.));
  }

  void
  triaxial_compression(Report &report)
  {
    report.out << "triaxial compression under a lateral pressure of 1e-3"
               << std::endl;
    const double q = 1e-3;
    // without a binder, strains beyond the limit stress are unique only while
    // they are homogeneous: in one cell
    const double states[][3] = {{0., -1.14498817e-3, -1.30419624e-4},
                                {0., -6e-3, 5.25253167e-3},
                                {0.01, -6e-3, 0.}};
    for (const auto &state : states)
      {
        const double lambda = state[0], axial = state[1], table = state[2];
        const Sand   sand{1., 0.6, 0.5, lambda};
        double       lateral = 0.;
        const double error =
          worst([&](const int dim, const unsigned int n, const unsigned int p) {
            if (n > 1 && lambda == 0. && axial < -2e-3)
              return 0.;
            return triaxial(dim, n, p, sand, q, axial, lateral);
          });
        const std::string name = "triaxial, lambda " + std::to_string(lambda);
        report.out << "  lambda " << std::fixed << std::setprecision(2)
                   << lambda << ", axial strain " << std::setprecision(8)
                   << 1e3 * axial << "e-3: lateral strain " << 1e3 * lateral
                   << "e-3 " << report.round_off(name, error, tolerance)
                   << std::endl;
        if (lambda == 0.)
          report.require(name + " against the table",
                         lateral / table - 1.,
                         1e-8);
      }
  }

  void
  simple_shear(Report &report)
  {
    const Sand   sand{1., 0.6, 0.5, 0.};
    const double w = 2. * sand.kappa / std::sqrt(3.);
    report.out << "simple shear under constant normal stress" << std::endl;
    for (const double degrees : {40., 100., 120.})
      {
        const double psi = degrees * numbers::PI / 180., R = 1e-3;
        const double gamma    = R * std::sin(psi);
        const double dilation = -std::sqrt(3.) / 2. * R * std::cos(psi);
        const double normal =
          sand.mu * sand.k * R *
          (sand.kappa + std::sqrt(3.) / 2. * std::cos(psi)) *
          (1. + w * std::cos(psi)) / sand.D();
        const double ratio =
          sand.kappa * std::sin(psi) / (1. + w * std::cos(psi));
        double       measured = 0.;
        const double error =
          worst([&](const int dim, const unsigned int n, const unsigned int p) {
            SceneFile file = box_scene(dim, n, p);
            add_sand(file, sand.k, sand.mu, sand.kappa, sand.lambda);
            file.set({"Geometry"}, "Periodic boundaries", "left: right");
            file.set({"Boundaries", "bottom"}, "Displacement x", "0");
            const std::string up = dim == 2 ? "y" : "z";
            file.set({"Boundaries", "bottom"}, "Displacement " + up, "0");
            if (dim == 3)
              for (const std::string side : {"front", "back"})
                file.set({"Boundaries", side}, "Symmetry", "true");
            file.set({"Boundaries", "top"}, "Displacement x", text(gamma));
            file.set({"Boundaries", "top"}, "Pressure", text(normal));
            file.set({"Output"},
                     "Probe points",
                     dim == 2 ? "0.5, 1" : "0.5, 0.5, 1");
            const auto   line = run(file).back();
            const double u = value(line, "displacement " + up + " at probe 1");
            measured       = value(line, "reaction top x") / normal;
            return std::max(std::abs((u - dilation) / R),
                            std::abs(measured / ratio - 1.));
          });
        report.out << "  psi " << std::fixed << std::setprecision(0) << degrees
                   << ": shear stress over normal stress "
                   << std::setprecision(8) << measured << " "
                   << report.round_off("simple shear", error, tolerance)
                   << std::endl;
      }
  }

  void
  uniaxial_strain(Report &report)
  {
    report.out << "uniaxial strain with k = 2" << std::endl;
    const double s = 2. / std::sqrt(3.);
    // kappa, sign of the strain, lambda, number of the theory
    const double states[][4] = {{0.3, -1., 0., 2.788954},
                                {0.7, -1., 0., 2.8},
                                {1.2, -1., 0., 2.8},
                                {1.2, 1., 0., 0.051282},
                                {0.3, 1., 0.01, 0.028}};
    for (const auto &state : states)
      {
        const double kappa = state[0], sign = state[1], lambda = state[2],
                     table = state[3];
        const Sand   sand{2., 0.6, kappa, lambda};
        const double strain = 1e-3 * sign;
        const double modulus =
          sand.axisymmetric_stress(strain, 0.).first / strain;
        // the formulas once more, as they stand in the theory
        const double elastic = sand.k + 4. * sand.mu / 3.;
        const double x       = kappa * s - sign;
        const double cone    = sand.k * sand.mu * x * x / sand.D();
        const double formula =
          sign < 0. ? (kappa >= s * sand.mu / sand.k ? elastic : cone) :
                      (kappa <= 1. / s ? lambda * elastic : cone);
        report.require("modulus by the formula", modulus / formula - 1., 1e-12);
        report.require("modulus in the table", formula - table, 1e-6);
        double       measured = 0.;
        const double error =
          worst([&](const int dim, const unsigned int n, const unsigned int p) {
            SceneFile file = box_scene(dim, n, p);
            add_sand(file, sand.k, sand.mu, kappa, lambda);
            for (const std::string side : {"left", "right", "front", "back"})
              if (dim == 3 || side == "left" || side == "right")
                file.set({"Boundaries", side}, "Symmetry", "true");
            file.set({"Boundaries", "bottom"}, "Symmetry", "true");
            const std::string up = dim == 2 ? "y" : "z";
            file.set({"Boundaries", "top"}, "Displacement " + up, text(strain));
            measured = value(run(file).back(), "reaction top " + up) / strain;
            return measured / modulus - 1.;
          });
        report.out << "  kappa " << std::fixed << std::setprecision(1) << kappa
                   << (sign < 0. ? ", compression" : ", extension")
                   << std::setprecision(2) << ", lambda " << lambda
                   << ": modulus " << std::setprecision(8) << measured << " "
                   << report.round_off("uniaxial strain", error, tolerance)
                   << std::endl;
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  return Verification::main(argc, argv, [](Report &report) {
    triaxial_compression(report);
    simple_shear(report);
    uniaxial_strain(report);
  });
}
