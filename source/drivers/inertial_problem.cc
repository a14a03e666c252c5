#include <signoton/drivers/inertial_problem.h>

#include <limits>

namespace Signoton
{
  template <int dim>
  InertialProblem<dim>::InertialProblem(Model<dim>                   &model,
                                        const Supports<dim>          &supports,
                                        const AbsorbingBoundary<dim> &absorbing,
                                        const VectorType             &mass)
    : StaticProblem<dim>(model)
    , supports(supports)
    , absorbing(absorbing)
    , mass(mass)
  {}

  template <int dim>
  void
  InertialProblem<dim>::set_step(const double      new_inertia,
                                 const double      new_damping,
                                 const VectorType &new_predicted,
                                 const VectorType &new_pull)
  {
    inertia   = new_inertia;
    damping   = new_damping;
    predicted = new_predicted;
    pull      = new_pull;
    way.reinit(predicted, true);
    force.reinit(predicted, true);
  }

  template <int dim>
  double
  InertialProblem<dim>::evaluate(const VectorType &u,
                                 VectorType       &gradient,
                                 const bool        linearize)
  {
    double energy = StaticProblem<dim>::evaluate(u, gradient, linearize);

    const auto timer = this->model.ledger.time("time integration");
    double     own   = 0.;
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      {
        const double m = mass.local_element(i);
        double      &w = way.local_element(i);
        // hanging nodes have no mass, and their forces act on others
        w = m > 0. ? u.local_element(i) - predicted.local_element(i) : 0.;
        force.local_element(i) = inertia * m * w;
        own += 0.5 * inertia * m * w * w - pull.local_element(i) * w;
      }
    if (!absorbing.empty())
      {
        VectorType dashpots;
        dashpots.reinit(force);
        absorbing.add_force(way, dashpots);
        force.add(damping, dashpots);
        for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
          own +=
            0.5 * damping * way.local_element(i) * dashpots.local_element(i);
      }
    energy += Utilities::MPI::sum(own, this->model.communicator);
    VectorType condensed(force);
    condensed -= pull;
    supports.condense(condensed);
    gradient += condensed;
    return energy;
  }

  template <int dim>
  double
  InertialProblem<dim>::force_scale(const VectorType &u)
  {
    return this->not_vanishing(pull.l2_norm() + force.l2_norm(), u);
  }

  template <int dim>
  double
  InertialProblem<dim>::round_off(const VectorType &u)
  {
    VectorType inertial_force(u);
    inertial_force.scale(mass);
    return StaticProblem<dim>::round_off(u) +
           16. * std::numeric_limits<double>::epsilon() *
             (inertia * inertial_force.l2_norm() + pull.l2_norm());
  }

  template <int dim>
  void
  InertialProblem<dim>::complete(TrilinosWrappers::SparseMatrix &matrix)
  {
    const IndexSet &owned = this->model.space->dof_handler.locally_owned_dofs();
    const auto      add   = [&](const typename Supports<dim>::Node &node,
                         const Tensor<2, dim>               &block) {
      const Tensor<2, dim> condensed =
        transpose(node.follow) * block * node.follow;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          if (std::abs(condensed[a][b]) > 0.)
            matrix.add(owned.nth_index_in_set(node.index[a]),
                       owned.nth_index_in_set(node.index[b]),
                       condensed[a][b]);
    };
    const Tensor<2, dim> identity = unit_symmetric_tensor<dim>();
    VectorType           diagonal(mass);
    for (const auto &node : supports.nodes())
      {
        add(node, inertia * mass.local_element(node.index[0]) * identity);
        for (const unsigned int i : node.index)
          diagonal.local_element(i) = 0.;
      }
    for (const auto &node : absorbing.damped_nodes())
      add(node, damping * node.damping);
    for (unsigned int i = 0; i < diagonal.locally_owned_size(); ++i)
      if (diagonal.local_element(i) > 0.)
        matrix.add(owned.nth_index_in_set(i),
                   owned.nth_index_in_set(i),
                   inertia * diagonal.local_element(i));
    matrix.compress(VectorOperation::add);
  }

  template class InertialProblem<2>;
  template class InertialProblem<3>;
} // namespace Signoton
