#include <signoton/discretization/face_conditions.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/manifold.h>

#include <boost/container/flat_map.hpp>

namespace Signoton
{
  namespace
  {
    template <int dim>
    using Face = typename DoFHandler<dim>::face_iterator;

    /** Without round-off in components that are zero, so that planes along an
     *  axis do not couple components. */
    template <int dim>
    Tensor<1, dim>
    clean(Tensor<1, dim> normal)
    {
      normal /= normal.norm();
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(normal[d]) < 1e-12)
          normal[d] = 0.;
      return normal / normal.norm();
    }

    /** The normal of the curved surface behind a face.
     *  @param facet the normal of the mesh there */
    template <int dim>
    Tensor<1, dim>
    surface_normal(const Face<dim>      &face,
                   const Point<dim>     &p,
                   const Tensor<1, dim> &facet)
    {
      try
        {
          const typename Triangulation<dim>::face_iterator of_mesh = face;
          Tensor<1, dim>                                   normal =
            face->get_manifold().normal_vector(of_mesh, p);
          normal /= normal.norm();
          // it has no sign; where a chart is singular it means nothing
          if (std::abs(normal * facet) > 0.3)
            return clean<dim>(normal * facet > 0. ? normal : -normal);
        }
      catch (const ExceptionBase &)
        {}
      return facet;
    }

    /** The node that a hanging or periodic one is, if it is one: that at the
     *  same place which is not constrained by the mesh. */
    template <int dim>
    bool
    hand_on(const AffineConstraints<double>          &mesh_constraints,
            std::array<types::global_dof_index, dim> &dofs)
    {
      for (auto &dof : dofs)
        if (mesh_constraints.is_constrained(dof))
          {
            const auto *entries = mesh_constraints.get_constraint_entries(dof);
            if (entries->size() != 1 ||
                std::abs((*entries)[0].second - 1.) > 1e-10)
              return false;
            dof = (*entries)[0].first;
          }
      return true;
    }

    /** Walks over the boundary, and enters what it finds. */
    template <int dim>
    class Collector
    {
    public:
      Collector(const Space<dim>              &space,
                const BoundaryConditions<dim> &conditions,
                const FacetNormals<dim>       &facets)
        : space(space)
        , conditions(conditions)
        , facets(facets)
        , nodes(nodes_of_cell<dim>(space.fe))
        , owned(space.dof_handler.locally_owned_dofs())
        , values(space.mapping,
                 space.fe.base_element(0),
                 Quadrature<dim>(
                   space.fe.base_element(0).get_unit_support_points()),
                 update_inverse_jacobians | update_quadrature_points)
        , dofs(space.fe.n_dofs_per_cell())
      {
        for (unsigned int i = 0; i < conditions.size(); ++i)
          if (conditions[i].constrains())
            section_of[conditions[i].id] = i;
      }

      std::map<types::global_dof_index, NodeConditions<dim>>
      collect()
      {
        for (const auto &cell : space.dof_handler.active_cell_iterators())
          {
            if (cell->is_artificial() || !cell->at_boundary())
              continue;
            bool is_ready = false; // the values are those of this cell
            for (const auto f : cell->face_indices())
              if (cell->face(f)->at_boundary())
                {
                  const auto found =
                    section_of.find(cell->face(f)->boundary_id());
                  if (found == section_of.end())
                    continue;
                  prepare(cell, is_ready);
                  enter_face(cell, f, found->second);
                }
            if (space.axisymmetric)
              enter_axis(cell, is_ready);
          }
        return std::move(result);
      }

    private:
      using Cell = typename DoFHandler<dim>::active_cell_iterator;

      void
      prepare(const Cell &cell, bool &is_ready)
      {
        if (is_ready)
          return;
        values.reinit(
          static_cast<typename Triangulation<dim>::cell_iterator>(cell));
        cell->get_dof_indices(dofs);
        is_ready = true;
      }

      void
      enter_face(const Cell        &cell,
                 const unsigned int f,
                 const unsigned int section)
      {
        const Face<dim> face      = cell->face(f);
        const auto     &condition = conditions[section];
        const auto     &unit      = space.fe.base_element(0);
        for (unsigned int n = 0; n < nodes.size(); ++n)
          {
            if (!unit.has_support_on_face(n, f))
              continue;
            for (unsigned int d = 0; d < dim; ++d)
              if (condition.displacement[d] || condition.velocity[d])
                {
                  Tensor<1, dim> axis;
                  axis[d] = 1.;
                  enter(n, {axis, section, d});
                }
            if (!condition.symmetry)
              continue;
            const auto facet =
              facets.normal(cell, f, unit.unit_support_point(n));
            enter(n,
                  {facet ? clean<dim>(*facet) : curved_normal(face, f, n),
                   section,
                   dim});
          }
      }

      /** The normal at a node of the curved surface behind a face. */
      Tensor<1, dim>
      curved_normal(const Face<dim>   &face,
                    const unsigned int f,
                    const unsigned int n) const
      {
        const Tensor<1, dim> of_cell = values.inverse_jacobian(n)[f / 2];
        return surface_normal<dim>(face,
                                   values.quadrature_point(n),
                                   clean<dim>(f % 2 == 1 ? of_cell : -of_cell));
      }

      /** Points of the axis of revolution stay on it. */
      void
      enter_axis(const Cell &cell, bool &is_ready)
      {
        const double near = 1e-9 * cell->diameter();
        for (const auto v : cell->vertex_indices())
          if (std::abs(cell->vertex(v)[0]) < near)
            prepare(cell, is_ready);
        if (!is_ready)
          return;
        Tensor<1, dim> radial;
        radial[0] = 1.;
        for (unsigned int n = 0; n < nodes.size(); ++n)
          if (std::abs(values.quadrature_point(n)[0]) < near)
            enter(n, {radial, no_section, dim});
      }

      void
      enter(const unsigned int n, const HeldDirection<dim> &condition)
      {
        std::array<types::global_dof_index, dim> global;
        for (unsigned int d = 0; d < dim; ++d)
          global[d] = dofs[nodes[n][d]];
        const auto first = global[0];
        if (!hand_on<dim>(space.mesh_constraints, global) ||
            !owned.is_element(global[0]))
          return;
        NodeConditions<dim> &node = result[global[0]];
        if (node.faces.empty() || global[0] == first)
          {
            node.dofs  = global;
            node.point = values.quadrature_point(n);
          }
        node.faces.push_back(condition);
      }

      const Space<dim>                                            &space;
      const BoundaryConditions<dim>                               &conditions;
      const FacetNormals<dim>                                     &facets;
      const std::vector<std::array<unsigned int, dim>>             nodes;
      const IndexSet                                              &owned;
      FEValues<dim>                                                values;
      std::vector<types::global_dof_index>                         dofs;
      boost::container::flat_map<types::boundary_id, unsigned int> section_of;
      std::map<types::global_dof_index, NodeConditions<dim>>       result;
    };
  } // namespace

  template <int dim>
  std::vector<HeldDirection<dim>>
  NodeConditions<dim>::directions(
    const BoundaryConditions<dim> &conditions) const
  {
    // by section and component; normals come as one list a section
    std::map<std::pair<unsigned int, unsigned int>, std::vector<Tensor<1, dim>>>
      sorted;
    for (const auto &face : faces)
      sorted[{face.section, face.component}].push_back(face.direction);
    std::vector<HeldDirection<dim>> result;
    for (const auto &[key, list] : sorted)
      {
        const auto [section, component] = key;
        if (component < dim || section == no_section)
          {
            result.push_back({list[0], section, component});
            continue;
          }
        const auto surface =
          smooth_surfaces(list, conditions[section].kink_angle);
        for (unsigned int s = 0; s < list.size(); ++s)
          {
            Tensor<1, dim> normal;
            for (unsigned int i = 0; i < list.size(); ++i)
              if (surface[i] == s)
                normal += list[i];
            if (normal.norm() > 0.)
              result.push_back({clean<dim>(normal), section, dim});
          }
      }
    return result;
  }

  template <int dim>
  std::map<types::global_dof_index, NodeConditions<dim>>
  collect_face_conditions(const Space<dim>              &space,
                          const BoundaryConditions<dim> &conditions,
                          const FacetNormals<dim>       &facets)
  {
    return Collector<dim>(space, conditions, facets).collect();
  }

#define INSTANTIATE(dim)                                          \
  template struct NodeConditions<dim>;                            \
  template std::map<types::global_dof_index, NodeConditions<dim>> \
  collect_face_conditions<dim>(const Space<dim> &,                \
                               const BoundaryConditions<dim> &,   \
                               const FacetNormals<dim> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
