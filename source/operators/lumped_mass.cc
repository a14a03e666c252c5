#include <signoton/operators/lumped_mass.h>

namespace Signoton
{
  template <int dim>
  CellMass<dim>::CellMass(const Space<dim>                      &space,
                          const std::vector<Rheology::Material> &materials)
    : space(space)
    , values(space.mapping,
             space.fe,
             space.axisymmetric ?
               static_cast<Quadrature<dim>>(space.quadrature) :
               QGaussLobatto<dim>(space.degree + 1),
             update_quadrature_points | update_JxW_values | update_values)
    , mass(space.fe.n_dofs_per_cell())
    , squares(mass.size())
  {
    for (const auto &material : materials)
      density[material.id] = material.density;
  }

  template <int dim>
  const Vector<double> &
  CellMass<dim>::operator()(const typename DoFHandler<dim>::cell_iterator &cell)
  {
    values.reinit(
      static_cast<typename Triangulation<dim>::cell_iterator>(cell));
    mass         = 0.;
    squares      = 0.;
    double total = 0.;
    for (const unsigned int q : values.quadrature_point_indices())
      {
        const double m = density[cell->material_id()] * values.JxW(q) *
                         space.weight(values.quadrature_point(q));
        total += m;
        for (unsigned int i = 0; i < mass.size(); ++i)
          {
            const double shape = values.shape_value(i, q);
            mass[i] += m * shape;
            squares[i] += m * shape * shape;
          }
      }
    // On an axis of rotation quadratic shape functions have none: they get a
    // share by the squares.
    const double share = dim * total / squares.l1_norm();
    for (unsigned int i = 0; i < mass.size(); ++i)
      if (mass[i] < 0.25 * share * squares[i])
        mass[i] = share * squares[i];
    mass *= dim * total / mass.l1_norm();
    return mass;
  }

  template <int dim>
  VectorType
  lumped_mass(const Space<dim>                      &space,
              const std::vector<Rheology::Material> &materials)
  {
    CellMass<dim>                        cell_mass(space, materials);
    VectorType                           mass = space.make_relevant_vector();
    std::vector<types::global_dof_index> dofs(space.fe.n_dofs_per_cell());
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(dofs);
          space.mesh_constraints.distribute_local_to_global(cell_mass(cell),
                                                            dofs,
                                                            mass);
        }
    mass.compress(VectorOperation::add);
    return mass;
  }

  template class CellMass<2>;
  template class CellMass<3>;
  template VectorType
  lumped_mass<2>(const Space<2> &, const std::vector<Rheology::Material> &);
  template VectorType
  lumped_mass<3>(const Space<3> &, const std::vector<Rheology::Material> &);
} // namespace Signoton
