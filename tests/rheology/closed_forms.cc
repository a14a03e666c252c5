// Homogeneous states with a closed form, reached by driving a law at a point
// under mixed control of strain and stress. The numbers are those of the
// formulas beside them.

#include "common.h"

using namespace Signoton;
using namespace Signoton::Testing;

namespace
{
  using ContactMS = SpringAndProjection<MisesSchleicherCone, Memory::none>;
  using ContactCM = SpringAndProjection<PrincipalSet, Memory::none>;
  using CutMS     = SpringAndProjection<MisesSchleicherCone, Memory::cylinder>;

  const double sqrt3  = std::sqrt(3.);
  const Moduli spring = {1., .6};
  const Moduli none   = {0., 0.};

  bool all_passed = true;

  /** One row: `value` is what the law gives, `expected` the closed form. */
  void
  compare(const std::string &what,
          const double       value,
          const double       expected,
          const double       tolerance = 1e-8)
  {
    Worst worst(tolerance);
    worst.add(std::abs(value - expected) / std::max(1e-3, std::abs(expected)));
    std::cout << "  " << std::left << std::setw(50) << what << std::right
              << std::fixed << std::setprecision(8) << std::setw(14) << expected
              << "  " << worst.verdict() << std::endl;
    all_passed &= worst.passed();
  }

  void
  title(const std::string &text)
  {
    std::cout << text << std::endl;
  }

  /** A stress $\sigma:d$ that is prescribed in place of the strain in the
   *  direction $d$. */
  struct Control
  {
    Tensor2<> direction;
    double    stress;
  };

  Control
  axial(const unsigned int axis, const double stress)
  {
    Tensor2<> direction;
    direction[axis][axis] = 1.;
    return {direction, stress};
  }

  /** Axisymmetric, so that one unknown drives both axes. */
  Control
  lateral(const double stress)
  {
    return {diagonal(0., 1., 1.), 2. * stress};
  }

  /** A law at a point: strain is prescribed but for a control, which is
   *  met by Newton's method with backtracking. */
  template <typename Law>
  class Point
  {
  public:
    explicit Point(const Law &law)
      : law(law)
      , history(virgin<Law>())
    {}

    void
    equilibrate(const Control &control)
    {
      const auto residual = [&]() {
        return stress() * control.direction - control.stress;
      };
      for (unsigned int iteration = 0; iteration < 200; ++iteration)
        {
          const double before = residual();
          if (std::abs(before) < 1e-15 * stress().norm())
            return;
          const double stiffness =
            control.direction * (response().tangent * control.direction);
          const Tensor2<> start  = strain;
          double          length = 1.;
          do
            {
              strain = start - length * before / stiffness * control.direction;
              length /= 2.;
          } while (
            !(std::abs(residual()) < (1. - .1 * length) * std::abs(before)) &&
            length > 1e-4);
          if (length <= 1e-4) // no descent: round-off, or a failed row below
            {
              strain = start;
              return;
            }
        }
      AssertThrow(false, ExcMessage("no equilibrium at the point"));
    }

    void
    accept()
    {
      history = Step<Law>(law, strain, history).history;
    }

    Response<double>
    response() const
    {
      return Step<Law>(law, strain, history).response;
    }

    Tensor2<>
    stress() const
    {
      return response().stress;
    }

    Tensor2<> strain;

  private:
    const Law           &law;
    History<Law, double> history;
  };

  /** Axial over lateral stress of a sample under unit lateral pressure, driven
   *  far beyond its limit in growing steps, upwards for extension. */
  template <typename Law>
  double
  limit_ratio(const Law   &law,
              const bool   extension,
              const bool   plane_strain,
              const double last_step = 1e3)
  {
    const Control control = plane_strain ? axial(1, -1.) : lateral(-1.);
    Point<Law>    point(law);
    point.strain =
      diagonal(-1., -1., plane_strain ? 0. : -1.) / (3. * spring.bulk);
    point.equilibrate(control);
    Tensor2<> change;
    for (double step = .05; step < last_step; step *= 1.5)
      {
        const Tensor2<> before = point.strain;
        // go on in the direction of the last step, so as not to fall off the
        // cone, where the stiffness is zero
        point.strain += 1.5 * change;
        point.strain[0][0] = before[0][0] + (extension ? step : -step);
        point.equilibrate(control);
        change = point.strain - before;
      }
    return point.stress()[0][0] / point.stress()[1][1];
  }

  void
  triaxial_compression()
  {
    title("Triaxial compression under lateral pressure q, MS cone, kap = .5");
    const ContactMS law(spring, none, MisesSchleicherCone(.5, 0.));
    const double    q = 1e-3;

    Point<ContactMS> point(law);
    point.strain = -q / 3. * unit_symmetric_tensor<3>();
    // a hair inside: the stress is elastic up to the onset
    point.strain[0][0] = -1.14498816e-3;
    point.equilibrate(lateral(-q));
    compare("lateral strain at onset / q",
            point.strain[1][1] / q,
            -1.30419624e-1,
            1e-7);
    compare("axial stress at onset / q", point.stress()[0][0] / q, -2.21748226);
    compare("region at onset", point.response().region, 0.);
    point.strain[0][0] = -6e-3;
    point.equilibrate(lateral(-q));
    compare("lateral strain / q at axial strain -6 q",
            point.strain[1][1] / q,
            5.25253167);
    compare("dilation / q", trace(point.strain) / q, 4.505063, 1e-7);
    compare("axial stress / q", point.stress()[0][0] / q, -2.21748226);
    compare("region", point.response().region, 1.);
    compare("the same, kap = .3",
            limit_ratio(ContactMS(spring, none, MisesSchleicherCone(.3, 0.)),
                        false,
                        false),
            1.62846932);
  }

  void
  simple_shear()
  {
    title("Simple shear under constant normal stress N, MS cone, kap = .5");
    const double    kap = .5, k = spring.bulk, mu = spring.shear;
    const double    D = mu + kap * kap * k;
    const ContactMS law(spring, none, MisesSchleicherCone(kap, 0.));
    for (const double degrees : {60., 80., 120.})
      {
        const double c      = std::cos(degrees * numbers::PI / 180.),
                     s      = std::sin(degrees * numbers::PI / 180.);
        const double factor = 1. + 2. * kap / sqrt3 * c;
        const double R      = 1.;
        const double N      = mu * k * R * (kap + sqrt3 / 2. * c) * factor / D;

        Point<ContactMS> point(law);
        point.strain[0][1] = .5 * R * s;
        point.strain[1][1] = -1.;
        point.equilibrate(axial(1, -N));
        const std::string psi = "psi = " + std::to_string(int(degrees)) + ": ";
        compare(psi + "normal strain", point.strain[1][1], -sqrt3 / 2. * R * c);
        compare(psi + "|s12|/N", point.stress()[0][1] / N, kap * s / factor);
      }
    // the limit state: dilation over shear and s12/N both reach tan phi_ps
    const double     tangent = sqrt3 * kap / std::sqrt(3. - 4. * kap * kap);
    Point<ContactMS> point(law);
    point.strain[1][1] = -1.;
    for (double shear = 1.; shear < 2e5; shear *= 2.)
      {
        point.strain[0][1] = shear;
        point.equilibrate(axial(1, -1.));
      }
    compare("limit of s12/N, tan(phi_ps)", point.stress()[0][1], tangent, 1e-4);
    compare("limit of dilation over shear",
            point.strain[1][1] / (2. * point.strain[0][1]),
            tangent,
            1e-4);
  }

  template <typename Law>
  void
  compare_uniaxial(const std::string &what,
                   const Law         &law,
                   const double       compression,
                   const double       extension)
  {
    Point<Law> point(law);
    point.strain = diagonal(-1., 0., 0.);
    compare(what + ", E_-", -point.stress()[0][0], compression);
    point.strain = diagonal(1., 0., 0.);
    compare(what + ", E_+", point.stress()[0][0], extension);
  }

  void
  uniaxial_strain()
  {
    title("Uniaxial strain, k = 2, mu = .6");
    const Moduli stiff{2., .6};
    const double M = stiff.bulk + 4. / 3. * stiff.shear;
    for (const double kap : {.3, .7, 1.2})
      {
        const double D  = stiff.shear + kap * kap * stiff.bulk;
        const double in = 1. + 2. * kap / sqrt3, out = 2. * kap / sqrt3 - 1.;
        compare_uniaxial("MS kap = " + std::to_string(kap).substr(0, 3),
                         ContactMS(stiff, none, MisesSchleicherCone(kap, 0.)),
                         kap >= 2. * stiff.shear / (sqrt3 * stiff.bulk) ?
                           M :
                           stiff.bulk * stiff.shear * in * in / D,
                         out <= 0. ? 0. :
                                     stiff.bulk * stiff.shear * out * out / D);
      }
    const ContactMS  steep(stiff, none, MisesSchleicherCone(1.2, 0.));
    Point<ContactMS> point(steep);
    point.strain = diagonal(1., 0., 0.);
    compare("the same, digits of E_+ (steep cone)",
            point.stress()[0][0],
            .051282,
            1e-5);

    // lateral stress at rest K0 = nu/(1-nu) is admissible from K0 N = 1 on
    for (const double degrees : {10., 30.})
      {
        const double s = std::sin(degrees * numbers::PI / 180.);
        const double N = (1. + s) / (1. - s);
        const double E =
          9. * stiff.bulk * stiff.shear / (3. * stiff.bulk + stiff.shear);
        const double nu = E / (2. * stiff.shear) - 1.;
        compare_uniaxial(
          "Coulomb phi = " + std::to_string(int(degrees)),
          ContactCM(stiff,
                    none,
                    PrincipalSet::coulomb_mohr(degrees * numbers::PI / 180.,
                                               0.)),
          nu / (1. - nu) * N >= 1. ?
            M :
            E / (1. + 2. / (N * N) - 2. * nu * (2. / N + 1. / (N * N))),
          0.);
      }
  }

  void
  coulomb_matching()
  {
    title("Match of the MS cone to the Coulomb angle 30 degrees, N = 3");
    const double phi = numbers::PI / 6., s = std::sin(phi);
    const auto   cone = [](const double kap) {
      return ContactMS(spring, none, MisesSchleicherCone(kap, 0.));
    };
    const double compression  = 2. * sqrt3 * s / (3. - s),
                 extension    = 2. * sqrt3 * s / (3. + s),
                 plane_strain = sqrt3 * s / std::sqrt(3. + s * s);
    compare("kap of triaxial compression", compression, .69282, 1e-5);
    compare("kap of triaxial extension", extension, .49487, 1e-5);
    compare("kap of plane strain", plane_strain, .48038, 1e-5);
    const ContactCM coulomb(spring, none, PrincipalSet::coulomb_mohr(phi, 0.));
    // axial over lateral stress; plane strain approaches its limit with 1/e
    compare("MS, compression",
            limit_ratio(cone(compression), false, false),
            3.);
    compare("Coulomb, compression", limit_ratio(coulomb, false, false), 3.);
    compare("MS, extension",
            limit_ratio(cone(extension), true, false),
            1. / 3.);
    compare("Coulomb, extension", limit_ratio(coulomb, true, false), 1. / 3.);
    compare("MS, plane strain",
            limit_ratio(cone(plane_strain), false, true, 1e6),
            3.,
            1e-5);
    compare("Coulomb, plane strain", limit_ratio(coulomb, false, true), 3.);
    compare("MS kap = .5, plane strain",
            limit_ratio(cone(.5), false, true, 1e6),
            3.18614066,
            1e-5);
  }

  void
  loosened_shear()
  {
    title("Elastic-plastic granular path: loosen 3, shear +2, -1, compress -4");
    const Moduli stiff{1.5, .7};
    const CutMS  law(stiff, none, MisesSchleicherCone(.5, 0., .4));
    Point<CutMS> point(law);
    const auto   walk = [&](const Tensor2<> &change) {
      for (unsigned int n = 0; n < 100; ++n)
        {
          point.strain += change / 100.;
          point.accept();
        }
    };
    Tensor2<> shear;
    shear[0][1] = .5; // gamma = 1
    walk(unit_symmetric_tensor<3>());
    compare("s12 when loosened", point.stress().norm(), 0.);
    walk(2. * shear);
    walk(-1. * shear);
    compare("s12 after loosened shear", point.stress().norm(), 0.);
    walk(-4. / 3. * unit_symmetric_tensor<3>());
    compare("s12 at the end (contact in series: +0.40)",
            point.stress()[0][1],
            .4);
    compare("pressure at the end", pressure(point.stress()), 1.5);
  }

  void
  binder_limits()
  {
    title("Binder: series moduli when loosened, spring alone when compact");
    const Moduli     binder{.2, .5};
    const ContactMS  law(spring, binder, MisesSchleicherCone(.5, 0.));
    Point<ContactMS> point(law);
    const auto       series = [](const double a, const double b) {
      return a * b / (a + b);
    };
    for (const bool loosened : {true, false})
      {
        const double sign       = loosened ? 1. : -1.;
        point.strain            = sign * unit_symmetric_tensor<3>();
        point.strain[0][1]      = .1;
        const std::string state = loosened ? "loosened: " : "compact: ";
        compare(state + "pressure / volume strain",
                -sign * pressure(point.stress()) / 3.,
                loosened ? series(spring.bulk, binder.bulk) : spring.bulk);
        compare(state + "shear modulus",
                point.stress()[0][1] / .2,
                loosened ? series(spring.shear, binder.shear) : spring.shear);
      }

    title("Trap: the tensile modulus of a bar with binder is not lam E");
    const double lam = .01, l = spring.bulk - 2. / 3. * spring.shear;
    const double E =
      9. * spring.bulk * spring.shear / (3. * spring.bulk + spring.shear);
    const double     nu    = E / (2. * spring.shear) - 1.;
    const double     ratio = lam / (1. - lam);
    const ContactCM  bar(spring,
                        {ratio * spring.bulk, ratio * spring.shear},
                        PrincipalSet::no_tension(0.));
    Point<ContactCM> tension(bar);
    tension.strain = diagonal(1., -.01, -.01);
    tension.equilibrate(lateral(0.));
    // the contact carries the lateral contraction -x as a plane stress state
    const double x =
      lam * l / ((1. - lam) * E / (1. - nu) + 2. * lam * (l + spring.shear));
    compare("lateral contraction", -tension.strain[1][1], x);
    compare("tensile modulus / lam",
            tension.stress()[0][0] / lam,
            l * (1. - 2. * x) + 2. * spring.shear);
    compare("its limit k + 4 mu/3 for lam -> 0, to order lam",
            tension.stress()[0][0] / lam,
            spring.bulk + 4. / 3. * spring.shear,
            2. * lam);
  }

  void
  no_tension()
  {
    title("Trap: no tension is not a clipping of principal stresses");
    const double E =
      9. * spring.bulk * spring.shear / (3. * spring.bulk + spring.shear);
    const double nu = E / (2. * spring.shear) - 1.;

    const ContactCM  law(spring, none, PrincipalSet::no_tension(0.));
    Point<ContactCM> point(law);
    point.strain          = diagonal(1., -.5, 0.);
    const Tensor2<> trial = spring.stress(point.strain);
    // an open crack across the first axis leaves a state of plane stress
    const double s2 = -.5 * E / (1. - nu * nu);
    compare("stress across the open crack", point.stress()[0][0], 0.);
    compare("stress along the crack", point.stress()[1][1], s2);
    compare("out-of-plane stress", point.stress()[2][2], nu * s2);
    const bool differs = std::abs(std::min(trial[1][1], 0.) - s2) > .1 &&
                         std::abs(std::min(trial[2][2], 0.) - nu * s2) > .1;
    compare("clipping would give other stresses (1 = yes)", differs, 1.);
    const Tensor2<> opening = point.response().contact_strain;
    compare("crack strain", opening[0][0], 1. + nu / E * (1. + nu) * s2);
    compare("crack strain along the crack", opening[1][1], 0.);
  }

  void
  conventions()
  {
    title("Trap: out-of-plane stress, tensor shear");
    // in plane strain the cone is that of all three principal stresses
    const double     kap = .3;
    const ContactMS  law(spring, none, MisesSchleicherCone(kap, 0.));
    Point<ContactMS> point(law);
    point.strain           = diagonal(-1., .4, 0.);
    const Tensor2<> stress = point.stress();
    compare("tau / (kap p) of the 3D stress",
            shear_intensity(deviatoric_part(stress)) / (kap * pressure(stress)),
            1.);
    const double theta = trace(point.strain), s33 = -theta / 3.;
    const double gamma = std::sqrt(2.) * deviatoric_part(point.strain).norm();
    const double P     = spring.bulk * spring.shear * (kap * gamma - theta) /
                     (spring.shear + kap * kap * spring.bulk);
    compare("out-of-plane stress",
            stress[2][2],
            -P + kap * P * s33 / (.5 * gamma));
    point.strain       = -1. * unit_symmetric_tensor<3>();
    point.strain[0][1] = .1;
    compare("s12 = 2 mu e12 with the tensor component",
            point.stress()[0][1],
            2. * spring.shear * .1);
  }
} // namespace

int
main()
{
  triaxial_compression();
  simple_shear();
  uniaxial_strain();
  coulomb_matching();
  loosened_shear();
  binder_limits();
  no_tension();
  conventions();
  return all_passed ? 0 : 1;
}
