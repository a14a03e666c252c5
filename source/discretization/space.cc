#include <signoton/discretization/space.h>

#include <deal.II/dofs/dof_tools.h>

namespace Signoton
{
  namespace
  {
    template <int dim>
    VectorType
    relevant_vector(const DoFHandler<dim> &dof_handler)
    {
      IndexSet relevant;
      DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
      return VectorType(dof_handler.locally_owned_dofs(),
                        relevant,
                        dof_handler.get_communicator());
    }
  } // namespace

  template <int dim>
  Space<dim>::Space(const MPI_Comm    &communicator,
                    const unsigned int degree,
                    const bool         axisymmetric)
    : degree(degree)
    , axisymmetric(axisymmetric)
    , communicator(communicator)
    , mesh(communicator)
    , fe(FE_Q<dim>(degree), dim)
    , mapping(degree)
    , quadrature(degree + 1)
    , dof_handler(mesh)
  {}

  template <int dim>
  void
  Space<dim>::distribute_dofs()
  {
    dof_handler.distribute_dofs(fe);
    held.clear();
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant_dofs);
    mesh_constraints.reinit(relevant_dofs);
    DoFTools::make_hanging_node_constraints(dof_handler, mesh_constraints);
    for (const auto &pair : boundary.periodic)
      DoFTools::make_periodicity_constraints(
        dof_handler, pair.first, pair.second, pair.direction, mesh_constraints);
    mesh_constraints.close();
  }

  template <int dim>
  void
  Space<dim>::update_constraints(const BoundaryConditions<dim> &conditions)
  {
    constraints.reinit(relevant_dofs);
    if (!held.is_current())
      held.reinit(*this, conditions);
    held.constrain(conditions, constraints);
    constraints.merge(mesh_constraints,
                      AffineConstraints<double>::left_object_wins,
                      true);
    constraints.close();
    increment_constraints.copy_from(constraints);
    for (const auto &line : constraints.get_lines())
      increment_constraints.set_inhomogeneity(line.index, 0.);
  }

  template <int dim>
  VectorType
  Space<dim>::make_relevant_vector() const
  {
    return relevant_vector(dof_handler);
  }

  template <int dim>
  PointSpace<dim>::PointSpace(const Space<dim>  &space,
                              const unsigned int n_components)
    : n_components(n_components)
    , fe(FE_DGQArbitraryNodes<dim>(QGauss<1>(space.degree + 1)), n_components)
    , dof_handler(space.mesh)
    , mesh_changes(
        space.mesh.signals.any_change.connect([this] { is_current = false; }))
  {
    update();
  }

  template <int dim>
  void
  PointSpace<dim>::update()
  {
    if (!is_current)
      dof_handler.distribute_dofs(fe);
    is_current = true;
  }

  template <int dim>
  VectorType
  PointSpace<dim>::make_relevant_vector() const
  {
    return relevant_vector(dof_handler);
  }

  template class Space<2>;
  template class Space<3>;
  template class PointSpace<2>;
  template class PointSpace<3>;
} // namespace Signoton
