#include <signoton/operators/external_force.h>

#include <deal.II/fe/fe_values.h>

#include <boost/container/flat_map.hpp>

namespace Signoton
{
  template <int dim>
  void
  BodyForce<dim>::reinit(const Space<dim>                      &new_space,
                         const std::vector<Rheology::Material> &new_materials,
                         const SpaceTimeFunction<dim>          *new_gravity)
  {
    space     = &new_space;
    materials = &new_materials;
    gravity   = new_gravity;
    of_unit.clear();
    if (gravity == nullptr || !gravity->varies() || !gravity->is_uniform())
      return;
    for (unsigned int d = 0; d < dim; ++d)
      {
        of_unit.push_back(space->make_relevant_vector());
        integrate([d](
                    const Point<dim> &) { return Point<dim>::unit_vector(d); },
                  of_unit.back());
        of_unit.back().compress(VectorOperation::add);
      }
  }

  template <int dim>
  void
  BodyForce<dim>::add(const LoadKind kind, VectorType &force) const
  {
    if (gravity == nullptr || kind != load_kind(gravity->varies()))
      return;
    const auto acceleration = [&](const Point<dim> &p) {
      Tensor<1, dim> g;
      for (unsigned int d = 0; d < dim; ++d)
        g[d] = gravity->value(p, d);
      return g;
    };
    if (of_unit.empty())
      return integrate(acceleration, force);
    const Tensor<1, dim> g = acceleration(Point<dim>());
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int i = 0; i < force.locally_owned_size(); ++i)
        force.local_element(i) += g[d] * of_unit[d].local_element(i);
  }

  template <int dim>
  template <typename Acceleration>
  void
  BodyForce<dim>::integrate(const Acceleration &acceleration,
                            VectorType         &force) const
  {
    boost::container::flat_map<types::material_id, double> density;
    for (const auto &material : *materials)
      density[material.id] = material.density;
    FEValues<dim>  values(space->mapping,
                         space->fe,
                         space->quadrature,
                         update_values | update_quadrature_points |
                           update_JxW_values);
    Vector<double> cell_force(space->fe.n_dofs_per_cell());
    std::vector<types::global_dof_index> dofs(cell_force.size());
    for (const auto &cell : space->dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned() || !(density[cell->material_id()] > 0.))
          continue;
        values.reinit(cell);
        cell_force = 0.;
        for (const unsigned int q : values.quadrature_point_indices())
          {
            const auto  &p = values.quadrature_point(q);
            const double mass =
              density[cell->material_id()] * space->weight(p) * values.JxW(q);
            const Tensor<1, dim> g = acceleration(p);
            for (unsigned int i = 0; i < cell_force.size(); ++i)
              cell_force[i] += mass * values.shape_value(i, q) *
                               g[space->fe.system_to_component_index(i).first];
          }
        cell->get_dof_indices(dofs);
        space->mesh_constraints.distribute_local_to_global(cell_force,
                                                           dofs,
                                                           force);
      }
  }

  template <int dim>
  void
  SurfaceLoad<dim>::reinit(const Space<dim>              &space,
                           const BoundaryConditions<dim> &conditions)
  {
    mesh_constraints = &space.mesh_constraints;
    faces.clear();
    boost::container::flat_map<types::boundary_id,
                               const BoundaryCondition<dim> *>
      loaded;
    for (const auto &condition : conditions)
      if (condition.traction || condition.pressure)
        loaded[condition.id] = &condition;
    if (loaded.empty())
      return;
    FEFaceValues<dim>                    values(space.mapping,
                             space.fe,
                             QGauss<dim - 1>(space.degree + 2),
                             update_values | update_quadrature_points |
                               update_JxW_values | update_normal_vectors);
    std::vector<types::global_dof_index> dofs(space.fe.n_dofs_per_cell());
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned() || !cell->at_boundary())
          continue;
        for (const auto f : cell->face_indices())
          {
            if (!cell->face(f)->at_boundary())
              continue;
            const auto found = loaded.find(cell->face(f)->boundary_id());
            if (found == loaded.end())
              continue;
            values.reinit(cell, f);
            cell->get_dof_indices(dofs);
            Face face;
            face.condition = found->second;
            face.kind      = load_kind(found->second->varies());
            face.points    = values.get_quadrature_points();
            face.normals   = values.get_normal_vectors();
            std::vector<unsigned int> on_face;
            for (unsigned int i = 0; i < dofs.size(); ++i)
              if (space.fe.has_support_on_face(i, f))
                {
                  on_face.push_back(i);
                  face.dofs.push_back(dofs[i]);
                  face.component.push_back(
                    space.fe.system_to_component_index(i).first);
                }
            face.weights.reinit(on_face.size(), face.points.size());
            for (unsigned int i = 0; i < on_face.size(); ++i)
              for (const unsigned int q : values.quadrature_point_indices())
                face.weights(i, q) = values.shape_value(on_face[i], q) *
                                     space.weight(face.points[q]) *
                                     values.JxW(q);
            faces.push_back(std::move(face));
          }
      }
  }

  template <int dim>
  void
  SurfaceLoad<dim>::add(const LoadKind kind, VectorType &force) const
  {
    Vector<double> face_force;
    for (const Face &face : faces)
      {
        if (face.kind != kind)
          continue;
        face_force.reinit(face.dofs.size());
        for (unsigned int q = 0; q < face.points.size(); ++q)
          {
            Tensor<1, dim> density;
            if (face.condition->traction)
              for (unsigned int d = 0; d < dim; ++d)
                density[d] = face.condition->traction->value(face.points[q], d);
            if (face.condition->pressure)
              density -= face.condition->pressure->value(face.points[q]) *
                         face.normals[q];
            for (unsigned int i = 0; i < face.dofs.size(); ++i)
              face_force[i] += face.weights(i, q) * density[face.component[i]];
          }
        mesh_constraints->distribute_local_to_global(face_force,
                                                     face.dofs,
                                                     force);
      }
  }

  template class BodyForce<2>;
  template class BodyForce<3>;
  template class SurfaceLoad<2>;
  template class SurfaceLoad<3>;
} // namespace Signoton
