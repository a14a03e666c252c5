#include <signoton/discretization/rigid_motions.h>
#include <signoton/drivers/equilibrium_problem.h>
#include <signoton/drivers/run_checks.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>
#include <limits>

namespace Signoton
{
  template <int dim>
  EquilibriumProblem<dim>::EquilibriumProblem(
    Model<dim>                           &model,
    const Supports<dim>                  &supports,
    const std::vector<EnergyTerm<dim> *> &others)
    : model(model)
    , supports(supports)
    , others(others)
    , linear_solver(model.linear_solver, model.ledger)
  {}

  template <int dim>
  void
  EquilibriumProblem<dim>::reinit()
  {
    const auto  timer = model.ledger.time("setup");
    const auto &space = *model.space;
    const auto &owned = space.dof_handler.locally_owned_dofs();
    for (VectorType *vector : {&load, &force})
      model.mechanics->initialize_vector(*vector);
    free_load = 0.;

    // The pattern has the rows and columns of boundary conditions, too: they
    // may eliminate one unknown of a node only, and multigrid aggregates whole
    // nodes.
    TrilinosWrappers::SparsityPattern sparsity(owned,
                                               owned,
                                               space.relevant_dofs,
                                               space.communicator);
    DoFTools::make_sparsity_pattern(space.dof_handler,
                                    sparsity,
                                    space.mesh_constraints,
                                    false,
                                    Utilities::MPI::this_mpi_process(
                                      space.communicator));
    sparsity.compress();
    linear_solver.clear(); // it refers to the old matrix until its end
    matrix.clear();
    matrix.reinit(sparsity);
    assembled.reset();

    near_null_space = rigid_motions(space.mapping,
                                    space.dof_handler,
                                    owned,
                                    space.axisymmetric);
    for (unsigned int i = 0; i < owned.n_elements(); ++i)
      if (space.constraints.is_constrained(owned.nth_index_in_set(i)))
        for (auto &mode : near_null_space)
          mode[i] = 0.;
    model.ledger.bytes("matrix", matrix.memory_consumption());
  }

  template <int dim>
  void
  EquilibriumProblem<dim>::update_loads(const Loads<dim> &loads)
  {
    const auto timer = model.ledger.time("external force");
    auto      &space = *model.space;
    space.update_constraints(model.conditions);
    load = 0.;
    loads.add_all(load);
    VectorType condensed(load);
    supports.condense(condensed);
    free_load = condensed.l2_norm();

    double sum = load.l1_norm();
    for (const auto &line : space.constraints.get_lines())
      sum += std::abs(line.inhomogeneity);
    if (std::isfinite(Utilities::MPI::sum(sum, model.communicator)))
      return;
    refuse_trouble_of_loads(model);
    throw UserError(model.file.where({"Boundaries"}),
                    "a load or displacement that is not a finite number",
                    "expressions that are finite on the whole boundary at "
                    "all times of the run",
                    "look for divisions by zero and roots of negative "
                    "numbers; the accepted steps are complete");
  }

  template <int dim>
  VectorType
  EquilibriumProblem<dim>::support_forces() const
  {
    VectorType result(force);
    result -= load;
    return result;
  }

  template <int dim>
  double
  EquilibriumProblem<dim>::evaluate(const VectorType &u,
                                    VectorType       &gradient,
                                    const bool        linearize)
  {
    if (linearize)
      assembled.reset();
    force      = 0.;
    double own = 0.;
    {
      const auto timer = model.ledger.time("constitutive update");
      own              = model.mechanics->evaluate(u, force, linearize);
    }
    if (!others.empty())
      {
        const auto timer = model.ledger.time("time integration");
        for (auto *term : others)
          own += term->evaluate(u, force, linearize);
      }
    gradient = force;
    gradient -= load;
    supports.condense(gradient);
    // what nearly never happens costs no message of its own
    Failure<dim> failure = model.mechanics->failure();
    for (const auto *term : others)
      if (term->failure().residual > failure.residual)
        failure = term->failure();
    std::array<double, 2> sums{{own, failure.residual > 0. ? 1. : 0.}};
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        model.communicator,
                        ArrayView<double>(sums.data(), sums.size()));
    trouble = sums[1] > 0. ? in_words(failure, model.communicator) : "";
    return sums[0] - load * u;
  }

  template <int dim>
  double
  EquilibriumProblem<dim>::force_scale(const VectorType &u)
  {
    double own = 0.;
    for (const auto &node : supports.nodes())
      {
        const Tensor<1, dim> f = node.read(force) - node.read(load);
        own += (f - node.projector * f).norm_square();
      }
    double scale =
      std::sqrt(Utilities::MPI::sum(own, model.communicator)) + free_load;
    for (const auto *term : others)
      scale += term->outer_force();

    // not to vanish
    constexpr double part = 1e-3;
    if (!(largest_scale > 0. && scale > part * largest_scale))
      largest_scale =
        std::max(largest_scale, model.mechanics->element_forces(u).conditional);
    largest_scale = std::max(largest_scale, scale);
    return std::max(scale, part * largest_scale);
  }

  template <int dim>
  double
  EquilibriumProblem<dim>::round_off(const VectorType &u)
  {
    double size = model.mechanics->size_of_differences(u) + free_load;
    for (auto *term : others)
      size += term->size_of_differences(u);
    // of some operations for each of the numbers
    return 16. * std::numeric_limits<double>::epsilon() * size;
  }

  template <int dim>
  bool
  EquilibriumProblem<dim>::follows_supports(const VectorType &u) const
  {
    double prescribed = 0.;
    for (const auto &line : model.space->constraints.get_lines())
      prescribed = std::max(prescribed, std::abs(line.inhomogeneity));
    return u.linfty_norm() <=
           2. * Utilities::MPI::max(prescribed, model.communicator);
  }

  template <int dim>
  bool
  EquilibriumProblem<dim>::flows(const VectorType &u)
  {
    double weakest = 1.;
    for (const auto &material : model.materials)
      weakest = std::min(weakest, material.binder_ratio);
    return model.mechanics->strain_by_stress(u) * weakest > 1e3;
  }

  template <int dim>
  bool
  EquilibriumProblem<dim>::is_linear() const
  {
    return model.mechanics->is_linear() &&
           std::all_of(others.begin(), others.end(), [](const auto *term) {
             return term->is_linear();
           });
  }

  template <int dim>
  void
  EquilibriumProblem<dim>::prepare(const double regularization)
  {
    if (assembled && *assembled == regularization)
      return;
    {
      const auto timer = model.ledger.time("assembly");
      matrix           = 0.;
      model.mechanics->assemble(matrix, regularization);
      for (auto *term : others)
        term->assemble(matrix, regularization);
      matrix.compress(VectorOperation::add);
    }
    linear_solver.initialize(
      matrix, near_null_space, dim, model.space->degree, has_potential());
    assembled = regularization;
  }

  template <int dim>
  LinearResult
  EquilibriumProblem<dim>::solve(const VectorType &rhs,
                                 VectorType       &du,
                                 const double      tolerance,
                                 const double      regularization)
  {
    prepare(regularization);
    const LinearResult result = linear_solver.solve(du, rhs, tolerance);
    model.space->increment_constraints.distribute(du);
    model.ledger.count("linear iterations", result.iterations);
    model.ledger.count("linear solves");
    return result;
  }

  template <int dim>
  bool
  EquilibriumProblem<dim>::has_potential() const
  {
    return model.mechanics->has_potential() &&
           std::all_of(others.begin(), others.end(), [](const auto *term) {
             return term->has_potential();
           });
  }

  template <int dim>
  bool
  EquilibriumProblem<dim>::predict(VectorType       &u,
                                   const VectorType &lift,
                                   const double      regularization)
  {
    VectorType gradient(u), du(u);
    if (!(lift.linfty_norm() > 1e-14 * u.linfty_norm()))
      return true;
    evaluate(u, gradient, true);
    du = 0.;
    model.mechanics->apply_tangent(lift, du);
    for (const auto *term : others)
      term->apply_tangent(lift, du);
    supports.condense(du);
    gradient += du;
    gradient *= -1.;
    du = 0.;
    const LinearResult result =
      solve(gradient,
            du,
            is_linear() ? 0.01 * model.newton.tolerance : 1e-6,
            regularization);
    u += lift;
    if (result.converged)
      u += du;
    return result.converged;
  }

  template class EquilibriumProblem<2>;
  template class EquilibriumProblem<3>;
} // namespace Signoton
