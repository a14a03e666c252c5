#include <signoton/operators/boundary_integrals.h>

#include <deal.II/fe/fe_values.h>

namespace Signoton
{
  namespace
  {
    /** Call @p action with the values of each face of the own boundary. */
    template <int dim, typename Action>
    void
    for_each_face(const Space<dim> &space, const Action &action)
    {
      FEFaceValues<dim> values(space.mapping,
                               space.fe.base_element(0),
                               QGauss<dim - 1>(space.degree + 2),
                               update_quadrature_points | update_JxW_values |
                                 update_normal_vectors);
      for (const auto &cell : space.mesh.active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary())
          for (const auto f : cell->face_indices())
            if (cell->face(f)->at_boundary())
              {
                values.reinit(cell, f);
                action(cell->face(f)->boundary_id(), values);
              }
    }
  } // namespace

  template <int dim>
  std::map<types::boundary_id, double>
  boundary_sizes(const Space<dim> &space)
  {
    std::map<types::boundary_id, double> sizes;
    for (const auto &entry : space.boundary.names)
      sizes[entry.second] = 0.;
    for_each_face(space, [&](const types::boundary_id id, const auto &values) {
      double &size = sizes.at(id); // all parts have names
      for (const unsigned int q : values.quadrature_point_indices())
        size += values.JxW(q) * space.weight(values.quadrature_point(q));
    });
    for (auto &entry : sizes)
      entry.second = Utilities::MPI::sum(entry.second, space.communicator);
    return sizes;
  }

  template <int dim>
  LoadOnSupport
  load_on_support(const Space<dim>             &space,
                  const BoundaryCondition<dim> &condition)
  {
    LoadOnSupport load{0., 0.};
    for_each_face(space, [&](const types::boundary_id id, const auto &values) {
      if (id != condition.id)
        return;
      for (const unsigned int q : values.quadrature_point_indices())
        {
          const Point<dim>    &p      = values.quadrature_point(q);
          const Tensor<1, dim> normal = values.normal_vector(q);
          const double         area   = values.JxW(q) * space.weight(p);
          Tensor<1, dim>       t, held;
          for (unsigned int d = 0; d < dim && condition.traction; ++d)
            t[d] = condition.traction->value(p, d);
          if (condition.pressure)
            t -= condition.pressure->value(p) * normal;
          if (condition.symmetry)
            held = (t * normal) * normal;
          for (unsigned int d = 0; d < dim; ++d)
            if (condition.displacement[d] || condition.velocity[d])
              held[d] = t[d];
          load.all += area * t.norm();
          load.held += area * held.norm();
        }
    });
    load.all  = Utilities::MPI::sum(load.all, space.communicator);
    load.held = Utilities::MPI::sum(load.held, space.communicator);
    return load;
  }

#define INSTANTIATE(dim)                                             \
  template std::map<types::boundary_id, double> boundary_sizes<dim>( \
    const Space<dim> &);                                             \
  template LoadOnSupport load_on_support<dim>(const Space<dim> &,    \
                                              const BoundaryCondition<dim> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
