#include <signoton/operators/external_force.h>

#include <deal.II/fe/fe_values.h>

#include <boost/container/flat_map.hpp>

namespace Signoton
{
  namespace
  {
    /** Add $\int f\cdot v$ for force densities at the quadrature points. */
    template <int dim>
    void
    integrate(const Space<dim>                  &space,
              const FEValuesBase<dim>           &values,
              const std::vector<Tensor<1, dim>> &density,
              Vector<double>                    &cell_force)
    {
      for (unsigned int i = 0; i < values.dofs_per_cell; ++i)
        {
          const unsigned int c = space.fe.system_to_component_index(i).first;
          for (const unsigned int q : values.quadrature_point_indices())
            cell_force[i] += density[q][c] * values.shape_value(i, q) *
                             space.weight(values.quadrature_point(q)) *
                             values.JxW(q);
        }
    }

    template <int dim>
    Tensor<1, dim>
    vector_value(const Function<dim> &function, const dealii::Point<dim> &p)
    {
      Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = function.value(p, d);
      return result;
    }
  } // namespace

  template <int dim>
  void
  external_force(const Space<dim>                      &space,
                 const BoundaryConditions<dim>         &conditions,
                 const std::vector<Rheology::Material> &materials,
                 const Function<dim>                   *gravity,
                 const AffineConstraints<double>       &constraints,
                 VectorType                            &force)
  {
    const auto flags =
      update_values | update_quadrature_points | update_JxW_values;
    FEValues<dim> cell_values(space.mapping, space.fe, space.quadrature, flags);
    FEFaceValues<dim> face_values(space.mapping,
                                  space.fe,
                                  QGauss<dim - 1>(space.degree + 2),
                                  flags | update_normal_vectors);
    boost::container::flat_map<types::boundary_id,
                               const BoundaryCondition<dim> *>
      loaded;
    for (const auto &condition : conditions)
      if (condition.traction || condition.pressure)
        loaded[condition.id] = &condition;
    boost::container::flat_map<types::material_id, double> density;
    for (const auto &material : materials)
      density[material.id] = material.density;

    force = 0.;
    Vector<double>              cell_force(space.fe.n_dofs_per_cell());
    std::vector<Tensor<1, dim>> cell_density(space.quadrature.size());
    std::vector<Tensor<1, dim>> face_density(face_values.n_quadrature_points);
    std::vector<types::global_dof_index> dofs(cell_force.size());
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          bool any   = false;
          cell_force = 0.;
          if (gravity && density[cell->material_id()] > 0.)
            {
              cell_values.reinit(cell);
              for (const unsigned int q :
                   cell_values.quadrature_point_indices())
                cell_density[q] =
                  density[cell->material_id()] *
                  vector_value(*gravity, cell_values.quadrature_point(q));
              integrate(space, cell_values, cell_density, cell_force);
              any = true;
            }
          for (const auto f : cell->face_indices())
            if (cell->face(f)->at_boundary() && !loaded.empty())
              if (const auto found = loaded.find(cell->face(f)->boundary_id());
                  found != loaded.end())
                {
                  face_values.reinit(cell, f);
                  for (const unsigned int q :
                       face_values.quadrature_point_indices())
                    {
                      const auto &p   = face_values.quadrature_point(q);
                      face_density[q] = Tensor<1, dim>();
                      if (found->second->traction)
                        face_density[q] +=
                          vector_value(*found->second->traction, p);
                      if (found->second->pressure)
                        face_density[q] -= found->second->pressure->value(p) *
                                           face_values.normal_vector(q);
                    }
                  integrate(space, face_values, face_density, cell_force);
                  any = true;
                }
          if (any)
            {
              cell->get_dof_indices(dofs);
              constraints.distribute_local_to_global(cell_force, dofs, force);
            }
        }
    force.compress(VectorOperation::add);
  }

#define INSTANTIATE(dim)                                                     \
  template void external_force<dim>(const Space<dim> &,                      \
                                    const BoundaryConditions<dim> &,         \
                                    const std::vector<Rheology::Material> &, \
                                    const Function<dim> *,                   \
                                    const AffineConstraints<double> &,       \
                                    VectorType &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
