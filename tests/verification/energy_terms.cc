// The terms of an implicit step: the gradient against differences of the energy,
// the tangent against differences of the gradient, and the matrix against the
// tangent; with hanging nodes, supports and dashpots on slopes.

#include "box_scene.h"

#include <signoton/drivers/equilibrium_problem.h>
#include <signoton/operators/inertia.h>
#include <signoton/operators/lumped_mass.h>

#include <deal.II/grid/grid_tools.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

using namespace Verification;
using namespace Signoton;

namespace
{
  /** Smooth, and the same on any number of ranks. */
  template <int dim>
  class Waves : public Function<dim>
  {
  public:
    explicit Waves(const double phase)
      : Function<dim>(dim)
      , phase(phase)
    {}

    double
    value(const Point<dim> &p, const unsigned int component) const override
    {
      double argument = phase + component;
      for (unsigned int d = 0; d < dim; ++d)
        argument += (2. + d) * p[d];
      return std::sin(argument);
    }

  private:
    const double phase;
  };

  template <int dim>
  SceneFile
  scene_of(const unsigned int degree)
  {
    SceneFile file = box_scene(dim, dim == 2 ? 4 : 2, degree);
    add_sand(file, 1., 0.6, 0.5, 0.1);
    file.set({}, "Analysis", "dynamics");
    file.set({"Time integration"}, "Scheme", "implicit");
    file.set({"Materials", "sand"}, "Density", "1");
    file.set({"Boundaries", "left"}, "Symmetry", "true");
    file.set({"Boundaries", "top"}, "Displacement x", "0.1*t^2");
    file.set({"Boundaries", "bottom"}, "Absorbing", "closed");
    file.set({"Boundaries", "right"}, "Absorbing", "loosened");
    return file;
  }

  /** A part of the body that has no answer beyond a displacement. */
  class Brittle : public EnergyTerm<2>
  {
  public:
    double limit = 0.;

    double
    evaluate(const VectorType &u, VectorType &, const bool) override
    {
      is_broken = u.linfty_norm() > limit;
      return 0.;
    }

    Failure<2>
    failure() const override
    {
      return {is_broken ? 0.5 : 0., Point<2>(1., 2.)};
    }

    void
    apply_tangent(const VectorType &, VectorType &) const override
    {}

    void
    assemble(TrilinosWrappers::SparseMatrix &, const double) override
    {}

    double
    size_of_differences(const VectorType &) override
    {
      return 0.;
    }

  private:
    bool is_broken = false;
  };

  /** Newton's method does not step to where a law has no answer, and says what
   *  stops it. */
  void
  failing_law(Report &report)
  {
    SceneFile file = box_scene(2, 2, 1);
    add_sand(file, 1., 0.6, 0.5, 0.1);
    file.set({"Boundaries", "left"}, "Symmetry", "true");
    file.set({"Boundaries", "bottom"}, "Symmetry", "true");
    file.set({"Boundaries", "top"}, "Pressure", "0.01");
    Scene<2> scene(MPI_COMM_WORLD, file);
    scene.build();
    auto &model = scene.model;
    model.set_time(1.);
    model.mechanics->reinit();
    Supports<2> supports;
    supports.reinit(*model.space, model.conditions);
    Loads<2> loads(model);
    loads.reinit();
    Brittle               brittle;
    EquilibriumProblem<2> problem(model, supports, {&brittle});
    problem.reinit();
    problem.update_loads(loads);
    VectorType start;
    model.mechanics->initialize_vector(start);
    const auto solve = [&](const double limit) {
      brittle.limit = limit;
      VectorType         u(start);
      const NewtonResult result = Newton(model.newton).solve(problem, u);
      return std::make_pair(result, u.linfty_norm());
    };
    const auto [whole, size] = solve(1.);
    report.require("an answer", whole.converged ? 0. : 1., 0.);
    const auto [beyond, largest] = solve(0.5 * size);
    report.require("an answer beyond the limit",
                   beyond.converged || largest > 0.5 * size ? 1. : 0.,
                   0.);
    start.add(2. * size);
    model.space->increment_constraints.distribute(start);
    const auto [broken, unused] = solve(size);
    report.require("a start beyond the limit",
                   !broken.converged && unused > size &&
                       broken.reason.find("no answer in the cell at (1 2)") !=
                         std::string::npos ?
                     0. :
                     1.,
                   0.);
  }

  template <int dim>
  void
  differences(Report &report, const unsigned int degree)
  {
    Scene<dim> scene(MPI_COMM_WORLD, scene_of<dim>(degree));
    scene.build();
    auto &model = scene.model;
    auto &space = *model.space;
    // so that nothing is along an axis
    GridTools::transform(
      [](const Point<dim> &p) {
        Point<dim> q(p);
        q[0] = 0.8 * p[0] - 0.6 * p[1];
        q[1] = 0.6 * p[0] + 0.8 * p[1];
        return q;
      },
      space.mesh);
    for (const auto &cell : space.mesh.active_cell_iterators())
      if (cell->is_locally_owned() && cell->center()[1] > 0.7)
        cell->set_refine_flag();
    space.mesh.execute_coarsening_and_refinement();
    space.distribute_dofs();
    space.update_constraints(model.conditions);
    model.mechanics->reinit();
    Supports<dim> supports;
    supports.reinit(space, model.conditions);
    AbsorbingBoundary<dim> absorbing;
    absorbing.reinit(space, model.materials, model.conditions, supports);

    const auto field = [&](const double phase, const double size) {
      VectorType relevant = space.make_relevant_vector(), v;
      VectorTools::interpolate(space.mapping,
                               space.dof_handler,
                               Waves<dim>(phase),
                               relevant);
      model.mechanics->initialize_vector(v);
      v.copy_locally_owned_data_from(relevant);
      v *= size;
      space.increment_constraints.distribute(v);
      return v;
    };
    VectorType mass, pull;
    for (VectorType *vector : {&mass, &pull})
      model.mechanics->initialize_vector(*vector);
    mass.copy_locally_owned_data_from(lumped_mass(space, model.materials));
    const VectorType        predicted = field(1., 0.01);
    Inertia<dim>            inertia(space, mass, predicted, pull);
    Dashpots<dim>           dashpots(space, absorbing, predicted);
    EquilibriumProblem<dim> problem(model, supports, {&inertia, &dashpots});
    problem.reinit();

    // the material alone needs a little mass: the body is free to slide
    for (const auto &[m, c] :
         {std::make_pair(0.1, 0.), {30., 0.}, {0.1, 3.}, {30., 3.}})
      {
        inertia.set_coefficient(m);
        dashpots.set_coefficient(c);
        pull = field(3., 0.1 * m);
        pull.scale(mass);
        const VectorType u = field(2., 0.02), d = field(4., 1.);
        VectorType       gradient(u), tangent(u), moved(u), change(u);
        const double     h         = 1e-6;
        double           by_energy = 0.;
        change                     = 0.;
        for (const double sign : {-1., 1.})
          {
            moved = u;
            moved.add(sign * h, d);
            by_energy +=
              sign / (2. * h) * problem.evaluate(moved, gradient, false);
            change.add(sign / (2. * h), gradient);
          }
        problem.evaluate(u, gradient, true);
        tangent = 0.;
        model.mechanics->apply_tangent(d, tangent);
        for (const EnergyTerm<dim> *term :
             std::initializer_list<const EnergyTerm<dim> *>{&inertia,
                                                            &dashpots})
          term->apply_tangent(d, tangent);
        supports.condense(tangent);
        VectorType solution(u);
        solution = 0.;
        problem.solve(tangent, solution, 1e-13, 0.);
        solution -= d;
        change -= tangent;

        std::ostringstream name;
        name << dim << "D, degree " << degree << ", m = " << m << ", c = " << c;
        report.require(name.str() + ", gradient",
                       by_energy / (gradient * d) - 1.,
                       1e-7);
        report.require(name.str() + ", tangent",
                       change.l2_norm() / tangent.l2_norm(),
                       1e-6);
        report.require(name.str() + ", matrix",
                       solution.l2_norm() / d.l2_norm(),
                       1e-7);
      }
    report.require("some nodes with dashpots",
                   Utilities::MPI::sum(absorbing.damped_nodes().size(),
                                       MPI_COMM_WORLD) > 4 ?
                     0. :
                     1.,
                   0.);
  }
} // namespace

int
main(int argc, char **argv)
{
  return Verification::main(argc, argv, [](Report &report) {
    failing_law(report);
    for (const unsigned int degree : {1U, 2U})
      {
        differences<2>(report, degree);
        differences<3>(report, degree);
      }
  });
}
