#include <signoton/operators/lumped_mass.h>

#include <deal.II/fe/fe_values.h>

#include <boost/container/flat_map.hpp>

namespace Signoton
{
  template <int dim>
  VectorType
  lumped_mass(const Space<dim>                      &space,
              const std::vector<Rheology::Material> &materials)
  {
    boost::container::flat_map<types::material_id, double> density;
    for (const auto &material : materials)
      density[material.id] = material.density;

    const QGaussLobatto<dim> nodes(space.degree + 1);
    const Quadrature<dim>   &rule =
      space.axisymmetric ?
          static_cast<const Quadrature<dim> &>(space.quadrature) :
          nodes;
    FEValues<dim> values(space.mapping,
                         space.fe,
                         rule,
                         update_quadrature_points | update_JxW_values |
                           update_values);

    VectorType                           mass = space.make_relevant_vector();
    Vector<double>                       cell_mass(space.fe.n_dofs_per_cell());
    std::vector<types::global_dof_index> dofs(cell_mass.size());
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          cell_mass    = 0.;
          double total = 0.;
          for (const unsigned int q : values.quadrature_point_indices())
            {
              const double m = density[cell->material_id()] * values.JxW(q) *
                               space.weight(values.quadrature_point(q));
              total += m;
              for (unsigned int i = 0; i < cell_mass.size(); ++i)
                cell_mass[i] +=
                  m * values.shape_value(i, q) * values.shape_value(i, q);
            }
          cell_mass *= dim * total / cell_mass.l1_norm();
          cell->get_dof_indices(dofs);
          space.mesh_constraints.distribute_local_to_global(cell_mass,
                                                            dofs,
                                                            mass);
        }
    mass.compress(VectorOperation::add);
    return mass;
  }

  template VectorType
  lumped_mass<2>(const Space<2> &, const std::vector<Rheology::Material> &);
  template VectorType
  lumped_mass<3>(const Space<3> &, const std::vector<Rheology::Material> &);
} // namespace Signoton
