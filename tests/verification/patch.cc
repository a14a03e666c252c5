// Patch test: a linear displacement prescribed on the whole boundary of a
// distorted mesh with hanging nodes is reproduced, and the stress is
// homogeneous, whatever the law. Twice: through a scene that refines itself in
// a first step with another displacement, and on a mesh refined by hand, where
// the stress of every cell is compared with the law.

#include "box_scene.h"

#include <signoton/drivers/equilibrium_problem.h>

#include <deal.II/numerics/vector_tools_integrate_difference.h>

using namespace Verification;
using namespace Signoton;

namespace
{
  constexpr double tolerance = 1e-10;

  struct Case
  {
    std::string                                      name;
    std::vector<std::pair<std::string, std::string>> material;
    /** Displacement gradient: @p spherical I + @p general H. */
    double spherical, general;
    /** The region that all points are in. */
    Rheology::Region region;
    bool             in_2d = true;
  };

  const std::vector<std::pair<std::string, std::string>> elastic =
    {{"Rheology", "elastic"}, {"Bulk modulus", "1"}, {"Shear modulus", "0.6"}};

  std::vector<std::pair<std::string, std::string>>
  granular(const std::string &set,
           const std::string &key,
           const std::string &number)
  {
    return {{"Rheology", "elastic granular"},
            {"Admissible set", set},
            {key, number},
            {"Bulk modulus", "1"},
            {"Shear modulus", "0.6"},
            {"Binder", "proportional"},
            {"Binder ratio", "0.01"}};
  }

  const auto sand = granular("mises schleicher", "Friction parameter", "0.5");
  // not 30 degrees: with k = 1 and mu = 0.6, the ratio of stresses in uniaxial
  // strain would be that of the cone, and plane strain states lie on its edges
  const auto sharp_sand = granular("coulomb mohr", "Friction angle", "35");

  const std::vector<Case> cases = {
    {"elastic", elastic, -1e-3, 1e-2, Rheology::Region::interior},
    {"Mises-Schleicher", sand, -1e-2, 1e-3, Rheology::Region::interior},
    {"Mises-Schleicher", sand, -1e-3, 1e-2, Rheology::Region::face},
    {"Mises-Schleicher", sand, 2e-2, 1e-3, Rheology::Region::vertex},
    {"Coulomb-Mohr", sharp_sand, -3e-3, 1e-2, Rheology::Region::face},
    {"Coulomb-Mohr",
     sharp_sand,
     2e-3,
     1e-2,
     Rheology::Region::compression_edge,
     false},
    {"Coulomb-Mohr", sharp_sand, 2e-2, 1e-3, Rheology::Region::vertex}};

  double
  gradient(const Case &c, const unsigned int i, const unsigned int j)
  {
    const double H[3][3] = {{1., 0.6, 0.3},
                            {-0.2, -0.4, 0.5},
                            {0.1, 0.7, -0.8}};
    return c.general * H[i][j] + (i == j ? c.spherical : 0.);
  }

  /** The scene; until t = 1 another displacement is added. */
  template <int dim>
  SceneFile
  scene(const Case &c, const unsigned int degree)
  {
    const std::string axes = "xyz";
    SceneFile         file = box_scene(dim, dim == 2 ? 3 : 2, degree);
    for (const auto &[key, value] : c.material)
      file.set({"Materials", "stuff"}, key, value);
    std::string exact;
    for (unsigned int i = 0; i < dim; ++i)
      {
        std::string u;
        for (unsigned int j = 0; j < dim; ++j)
          u += (j > 0 ? " + " : "") + text(gradient(c, i, j)) + "*" + axes[j];
        exact += (i > 0 ? "; " : "") + u;
        for (const std::string side :
             {"left", "right", "front", "back", "bottom", "top"})
          if (dim == 3 || (side != "front" && side != "back"))
            file.set({"Boundaries", side},
                     std::string("Displacement ") + axes[i],
                     u + " + (1 - t)*1e-3*sin(5*x + 3*y)");
      }
    file.set({"Reference solution"}, "Displacement", exact);
    file.set({"Load steps"}, "Step size", "0.5");
    file.set({"Refinement"}, "Cycles in first step", dim == 2 ? "2" : "1");
    return file;
  }

  /** What the law answers to the strain of a case. */
  template <int dim>
  Rheology::Response<double>
  exact_response(const Case &c, const Rheology::Material &material)
  {
    Tensor2<> strain;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        strain[i][j] = 0.5 * (gradient(c, i, j) + gradient(c, j, i));
    Rheology::Response<double> response;
    std::visit(
      [&](const auto &law) {
        using Law = std::decay_t<decltype(law)>;
        Rheology::History<Law, double> accepted{}, trial{};
        law.template update<Rheology::energies>(strain,
                                                accepted,
                                                trial,
                                                response);
      },
      Rheology::make_law(material));
    return response;
  }

  /** Displacement and energy of the scene as a user runs it. */
  template <int dim>
  double
  error_of_run(Report &report, const Case &c, const unsigned int degree)
  {
    const SceneFile file = scene<dim>(c, degree);
    const auto      line = Verification::run(file).back();
    // with hanging nodes there are fewer or more unknowns than in a uniform
    // mesh of as many cells
    const double edge    = std::pow(value(line, "cells"), 1. / dim);
    const double uniform = dim * std::pow(edge * degree + 1., dim);
    report.require("a mesh without hanging nodes",
                   std::abs(value(line, "unknowns") - uniform) < 0.5 ? 1. : 0.,
                   0.);
    const auto region = Rheology::region_names[static_cast<int>(c.region)];
    report.require(std::string("volume outside region ") + region,
                   value(line, std::string("share of ") + region) - 1.,
                   1e-12);
    Scene<dim> model(MPI_COMM_WORLD, file);
    const auto exact = exact_response<dim>(c, model.model.materials[0]);
    return std::max(value(line, "relative L2 error"),
                    std::abs(
                      value(line, "stored energy") / exact.stored_energy - 1.));
  }

  /** The largest difference of a stress, on a mesh with every third cell
   *  refined, relative to the stress. */
  template <int dim>
  double
  error_of_stress(Report &report, const Case &c, const unsigned int degree)
  {
    Scene<dim> scene(MPI_COMM_WORLD, ::scene<dim>(c, degree));
    scene.build();
    auto        &model = scene.model;
    auto        &space = *model.space;
    unsigned int n     = 0;
    for (const auto &cell : space.mesh.active_cell_iterators())
      if (n++ % 3 == 0)
        cell->set_refine_flag();
    space.mesh.execute_coarsening_and_refinement();
    model.set_time(1.);
    space.distribute_dofs();
    space.update_constraints(model.conditions);
    model.mechanics->reinit();

    Loads<dim> loads(model);
    loads.reinit();
    Supports<dim> supports;
    supports.reinit(space, model.conditions);
    EquilibriumProblem<dim> problem(model, supports);
    problem.reinit();
    problem.update_loads(loads);
    VectorType u, lift;
    model.mechanics->initialize_vector(u);
    model.mechanics->initialize_vector(lift);
    space.constraints.distribute(lift);
    problem.predict(u, lift, 0.);
    const bool converged = Newton(model.newton).solve(problem, u).converged;
    report.require("Newton's method has failed", converged ? 0. : 1., 0.);

    const auto exact = exact_response<dim>(c, model.materials[0]).stress;
    double     error = 0.;
    for (const auto &average : model.mechanics->cell_averages(u))
      for (unsigned int i = 0; i < 6; ++i)
        error =
          std::max(error,
                   std::abs(average.stress[i] - exact.access_raw_entry(i)));
    return error / exact.norm();
  }

  template <int dim>
  void
  patch_test(Report &report)
  {
    report.out << "dimension " << dim << std::endl;
    for (const Case &c : cases)
      if (dim == 3 || c.in_2d)
        {
          const std::string name =
            c.name + ", " + Rheology::region_names[static_cast<int>(c.region)];
          report.out << "  " << name << ":";
          for (const unsigned int degree : {1U, 2U})
            report.out << "  degree " << degree << " displacement and energy "
                       << report.round_off(name,
                                           error_of_run<dim>(report, c, degree),
                                           tolerance)
                       << ", stress "
                       << report.round_off(name + ", stress",
                                           error_of_stress<dim>(report,
                                                                c,
                                                                degree),
                                           tolerance);
          report.out << std::endl;
        }
  }
} // namespace

int
main(int argc, char **argv)
{
  return Verification::main(argc, argv, [](Report &report) {
    patch_test<2>(report);
    patch_test<3>(report);
  });
}
