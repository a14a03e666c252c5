// What the sweep of an explicit step costs by material, as a ratio to linear
// elasticity on the same mesh in the same run: the best of several turns, taken
// in turns. Points are active if the contact or the hinge gives way.

#include <signoton/base/mpi_session.h>
#include <signoton/scene/scene.h>

#include <deal.II/numerics/vector_tools_interpolate.h>

#include <chrono>
#include <cstdio>
#include <iostream>
#include <limits>

using namespace Signoton;

namespace
{
  struct Case
  {
    std::string name, rheology;
    double      active; ///< part of the body
  };

  const std::vector<Case> cases = {
    {"elastic", "elastic", 0.},
    {"granular", "elastic granular", 0.},
    {"granular", "elastic granular", 0.08},
    {"granular", "elastic granular", 1.},
    {"elastic plastic granular", "elastic plastic granular", 0.},
    {"elastic plastic granular", "elastic plastic granular", 0.08},
    {"elastic plastic granular", "elastic plastic granular", 1.}};

  template <int dim>
  struct Problem
  {
    Problem(const Case &one, const unsigned int degree, const unsigned int n)
      : scene(MPI_COMM_SELF, file(one, degree, n))
    {
      scene.build();
      auto &model = scene.model;
      model.mechanics->reinit();
      model.mechanics->initialize_vector(force);
      // compression, and beyond the cone in a layer: points next to each other
      // are active, as in waves; forth and back, for hinges to flow each time
      for (const std::string sign : {"+", "-"})
        {
          model.mechanics->initialize_vector(displacement[sign == "-"]);
          interpolate(one, sign, displacement[sign == "-"]);
        }
    }

    void
    interpolate(const Case &one, const std::string &sign, VectorType &result)
    {
      auto             &model = scene.model;
      Constants         constants;
      const std::string shear =
        sign + "0.05*y*(x < " + std::to_string(one.active) + ")";
      const auto motion =
        make_function<dim>(split_components("-0.01*x" + shear +
                                              (dim == 2 ? "; -0.01*y" :
                                                          "; -0.01*y; -0.01*z"),
                                            dim,
                                            "motion"),
                           constants,
                           "motion");
      VectorType u = model.space->make_relevant_vector();
      VectorTools::interpolate(model.space->mapping,
                               model.space->dof_handler,
                               *motion,
                               u);
      result.copy_locally_owned_data_from(u);
    }

    static SceneFile
    file(const Case &one, const unsigned int degree, const unsigned int n)
    {
      SceneFile         result;
      const std::string cells = std::to_string(n);
      result.set({}, "Dimension", std::to_string(dim));
      result.set({}, "Analysis", "dynamics");
      result.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
      result.set({"Geometry"},
                 "Arguments",
                 dim == 2 ? cells + ", " + cells + " : 0, 0 : 1, 1 : true" :
                            cells + ", " + cells + ", " + cells +
                              " : 0, 0, 0 : 1, 1, 1 : true");
      result.set({"Discretization"}, "Degree", std::to_string(degree));
      const SceneFile::Path sand = {"Materials", "sand"};
      result.set(sand, "Rheology", one.rheology);
      result.set(sand, "Bulk modulus", "1");
      result.set(sand, "Shear modulus", "0.6");
      result.set(sand, "Density", "1");
      if (one.rheology != "elastic")
        {
          result.set(sand, "Friction parameter", "0.6");
          result.set(sand, "Binder", "proportional");
          result.set(sand, "Binder ratio", "0.01");
          if (one.rheology != "elastic granular")
            result.set(sand, "Shear strength", "0.01");
          else
            result.set(sand, "Admissible set", "mises schleicher");
        }
      return result;
    }

    double
    seconds(const unsigned int n_sweeps)
    {
      const auto start = std::chrono::steady_clock::now();
      for (unsigned int i = 0; i < n_sweeps; ++i)
        scene.model.mechanics->dynamic_force(displacement[i % 2],
                                             force,
                                             false,
                                             -1.);
      return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                           start)
               .count() /
             n_sweeps;
    }

    double
    active() const
    {
      const auto balance =
        scene.model.mechanics->energy_balance(displacement[0]);
      return 1. - balance.region_share[0];
    }

    Scene<dim>                scene;
    std::array<VectorType, 2> displacement;
    VectorType                force;
  };

  template <int dim>
  void
  compare(const unsigned int degree, const unsigned int n)
  {
    std::vector<std::unique_ptr<Problem<dim>>> problems;
    for (const Case &one : cases)
      problems.push_back(std::make_unique<Problem<dim>>(one, degree, n));
    const double        n_dofs = problems[0]->force.size();
    std::vector<double> best(cases.size(), std::numeric_limits<double>::max());
    for (unsigned int turn = 0; turn < 60; ++turn)
      for (unsigned int i = 0; i < cases.size(); ++i)
        best[i] = std::min(best[i], problems[i]->seconds(2));
    for (unsigned int i = 0; i < cases.size(); ++i)
      std::printf("| %dD, degree %u | %s | %.0f %% | %.1f | %.2f |\n",
                  dim,
                  degree,
                  cases[i].name.c_str(),
                  100. * problems[i]->active(),
                  1e-6 * n_dofs / best[i],
                  best[i] / best[0]);
  }
} // namespace

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  std::printf(
    "| mesh | material | active | million unknowns a second | time of "
    "elastic |\n|---|---|--:|--:|--:|\n");
  compare<2>(1, 150);
  compare<2>(2, 80);
  compare<3>(1, 26);
  compare<3>(2, 14);
}
