#include <signoton/discretization/rigid_motions.h>
#include <signoton/drivers/run_checks.h>
#include <signoton/drivers/static_problem.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>
#include <limits>

namespace Signoton
{
  template <int dim>
  StaticProblem<dim>::StaticProblem(Model<dim> &model)
    : model(model)
    , linear_solver(model.linear_solver, model.ledger)
  {}

  template <int dim>
  void
  StaticProblem<dim>::reinit()
  {
    const auto  timer = model.ledger.time("setup");
    const auto &space = *model.space;
    const auto &owned = space.dof_handler.locally_owned_dofs();
    model.mechanics->initialize_vector(load);
    model.mechanics->initialize_mesh_vector(load_of_mesh);

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
  StaticProblem<dim>::update_loads(const Loads<dim> &loads)
  {
    const auto timer = model.ledger.time("external force");
    auto      &space = *model.space;
    space.update_constraints(model.conditions);
    load = 0.;
    loads.add_all(space.constraints, load);
    load_of_mesh = loads_of_mesh(loads);

    double sum = load_of_mesh.l1_norm();
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
  StaticProblem<dim>::loads_of_mesh(const Loads<dim> &loads) const
  {
    VectorType force;
    model.mechanics->initialize_mesh_vector(force);
    loads.add_all(model.space->mesh_constraints, force);
    return force;
  }

  template <int dim>
  double
  StaticProblem<dim>::evaluate(const VectorType &u,
                               VectorType       &gradient,
                               const bool        linearize)
  {
    const auto timer = model.ledger.time("constitutive update");
    if (linearize)
      assembled.reset();
    const double potential =
      model.mechanics->internal_force(u, gradient, linearize);
    gradient -= load;
    return potential - load * u;
  }

  template <int dim>
  VectorType
  StaticProblem<dim>::internal_force_of_mesh(const VectorType &u)
  {
    VectorType force;
    model.mechanics->initialize_vector(force);
    model.mechanics->reactions(u, force);
    return force;
  }

  template <int dim>
  VectorType
  StaticProblem<dim>::support_forces(const VectorType &u)
  {
    VectorType force = internal_force_of_mesh(u);
    force -= load_of_mesh;
    return force;
  }

  template <int dim>
  double
  StaticProblem<dim>::force_scale(const VectorType &u)
  {
    const auto       timer   = model.ledger.time("constitutive update");
    const VectorType support = support_forces(u);
    double           sum     = 0.;
    for (const auto dof : support.locally_owned_elements())
      if (model.space->constraints.is_constrained(dof))
        sum += support[dof] * support[dof];
    return not_vanishing(
      std::sqrt(Utilities::MPI::sum(sum, model.communicator)) + load.l2_norm(),
      u);
  }

  template <int dim>
  double
  StaticProblem<dim>::not_vanishing(const double scale, const VectorType &u)
  {
    constexpr double part = 1e-3;
    if (!(largest_scale > 0. && scale > part * largest_scale))
      largest_scale =
        std::max(largest_scale, model.mechanics->element_forces(u).conditional);
    largest_scale = std::max(largest_scale, scale);
    return std::max(scale, part * largest_scale);
  }

  template <int dim>
  double
  StaticProblem<dim>::round_off(const VectorType &u)
  {
    // of some operations for each of the numbers
    return 16. * std::numeric_limits<double>::epsilon() *
           (model.mechanics->element_forces(u).with_rigid_motion +
            load.l2_norm());
  }

  template <int dim>
  bool
  StaticProblem<dim>::follows_supports(const VectorType &u) const
  {
    double prescribed = 0.;
    for (const auto &line : model.space->constraints.get_lines())
      prescribed = std::max(prescribed, std::abs(line.inhomogeneity));
    return u.linfty_norm() <=
           2. * Utilities::MPI::max(prescribed, model.communicator);
  }

  template <int dim>
  bool
  StaticProblem<dim>::flows(const VectorType &u)
  {
    double weakest = 1.;
    for (const auto &material : model.materials)
      weakest = std::min(weakest, material.binder_ratio());
    return model.mechanics->strain_by_stress(u) * weakest > 1e3;
  }

  template <int dim>
  bool
  StaticProblem<dim>::is_linear() const
  {
    return !(model.is_dynamic && model.time_integration.shock_viscosity) &&
           std::all_of(model.materials.begin(),
                       model.materials.end(),
                       [](const auto &m) { return m.is_elastic(); });
  }

  template <int dim>
  void
  StaticProblem<dim>::prepare(const double regularization)
  {
    if (assembled && *assembled == regularization)
      return;
    {
      const auto timer = model.ledger.time("assembly");
      model.mechanics->assemble(matrix, regularization);
      complete(matrix);
    }
    linear_solver.initialize(
      matrix, near_null_space, dim, model.space->degree, has_potential());
    assembled = regularization;
  }

  template <int dim>
  LinearResult
  StaticProblem<dim>::solve(const VectorType &rhs,
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
  StaticProblem<dim>::has_potential() const
  {
    return std::all_of(model.materials.begin(),
                       model.materials.end(),
                       [](const auto &m) { return m.has_potential(); });
  }

  template <int dim>
  bool
  StaticProblem<dim>::predict(VectorType       &u,
                              const VectorType &lift,
                              const double      regularization)
  {
    VectorType gradient(u), du(u);
    if (!(lift.linfty_norm() > 1e-14 * u.linfty_norm()))
      return true;
    evaluate(u, gradient, true);
    model.mechanics->apply_tangent(lift, du);
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

  template class StaticProblem<2>;
  template class StaticProblem<3>;
} // namespace Signoton
