#include <signoton/operators/inertia.h>

namespace Signoton
{
  template <int dim>
  Inertia<dim>::Inertia(const Space<dim> &space,
                        const VectorType &mass,
                        const VectorType &predicted,
                        const VectorType &pull)
    : space(space)
    , mass(mass)
    , predicted(predicted)
    , pull(pull)
  {}

  template <int dim>
  double
  Inertia<dim>::evaluate(const VectorType &u, VectorType &force, const bool)
  {
    double energy = 0.;
    own_square    = 0.;
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      {
        const double m = mass.local_element(i), p = pull.local_element(i);
        // hanging nodes have no mass, and their forces act on others
        const double w =
          m > 0. ? u.local_element(i) - predicted.local_element(i) : 0.;
        const double f = coefficient * m * w;
        force.local_element(i) += f - p;
        energy += (0.5 * f - p) * w;
        own_square += f * f;
      }
    return energy;
  }

  template <int dim>
  void
  Inertia<dim>::apply_tangent(const VectorType &increment,
                              VectorType       &force) const
  {
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      force.local_element(i) +=
        coefficient * mass.local_element(i) * increment.local_element(i);
  }

  template <int dim>
  void
  Inertia<dim>::assemble(TrilinosWrappers::SparseMatrix &matrix, const double)
  {
    const IndexSet    &owned = space.dof_handler.locally_owned_dofs();
    FullMatrix<double> entry(1, 1);
    std::vector<types::global_dof_index> dof(1);
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      if (mass.local_element(i) > 0.)
        {
          entry(0, 0) = coefficient * mass.local_element(i);
          dof[0]      = owned.nth_index_in_set(i);
          space.constraints.distribute_local_to_global(entry, dof, matrix);
        }
  }

  template <int dim>
  double
  Inertia<dim>::size_of_differences(const VectorType &u)
  {
    VectorType force(u);
    force.scale(mass);
    return coefficient * force.l2_norm() + pull.l2_norm();
  }

  template <int dim>
  double
  Inertia<dim>::outer_force() const
  {
    return std::sqrt(Utilities::MPI::sum(own_square, space.communicator)) +
           pull.l2_norm();
  }

  template <int dim>
  Dashpots<dim>::Dashpots(const Space<dim>             &space,
                          const AbsorbingBoundary<dim> &absorbing,
                          const VectorType             &predicted)
    : space(space)
    , absorbing(absorbing)
    , predicted(predicted)
  {}

  template <int dim>
  double
  Dashpots<dim>::evaluate(const VectorType &u, VectorType &force, const bool)
  {
    double energy = 0.;
    for (const auto &node : absorbing.damped_nodes())
      {
        const Tensor<1, dim> way = node.read(u) - node.read(predicted),
                             f   = coefficient * node.damping * way;
        node.write(node.read(force) + f, force);
        energy += 0.5 * (f * way);
      }
    return energy;
  }

  template <int dim>
  void
  Dashpots<dim>::apply_tangent(const VectorType &increment,
                               VectorType       &force) const
  {
    for (const auto &node : absorbing.damped_nodes())
      node.write(node.read(force) +
                   coefficient * node.damping * node.read(increment),
                 force);
  }

  template <int dim>
  void
  Dashpots<dim>::assemble(TrilinosWrappers::SparseMatrix &matrix, const double)
  {
    const IndexSet    &owned = space.dof_handler.locally_owned_dofs();
    FullMatrix<double> block(dim, dim);
    std::vector<types::global_dof_index> dofs(dim);
    for (const auto &node : absorbing.damped_nodes())
      {
        for (unsigned int a = 0; a < dim; ++a)
          {
            dofs[a] = owned.nth_index_in_set(node.index[a]);
            for (unsigned int b = 0; b < dim; ++b)
              block(a, b) = coefficient * node.damping[a][b];
          }
        space.constraints.distribute_local_to_global(block, dofs, matrix);
      }
  }

  template class Inertia<2>;
  template class Inertia<3>;
  template class Dashpots<2>;
  template class Dashpots<3>;
} // namespace Signoton
