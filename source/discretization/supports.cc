#include <signoton/discretization/supports.h>

#include <map>

namespace Signoton
{
  namespace
  {
    /** How the components of a node follow the free ones. */
    template <int dim>
    Tensor<2, dim>
    follow_of(const std::array<types::global_dof_index, dim> &dofs,
              const AffineConstraints<double>                &constraints)
    {
      Tensor<2, dim> follow;
      for (unsigned int free = 0; free < dim; ++free)
        {
          if (constraints.is_constrained(dofs[free]))
            continue;
          follow[free][free] = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            if (const auto *entries =
                  constraints.get_constraint_entries(dofs[d]))
              for (const auto &[dof, factor] : *entries)
                if (dof == dofs[free])
                  follow[d][free] = factor;
        }
      return follow;
    }

    /** What projects onto the columns of a matrix. */
    template <int dim>
    Tensor<2, dim>
    projector_of(const Tensor<2, dim> &follow)
    {
      Tensor<2, dim>              projector;
      std::vector<Tensor<1, dim>> basis;
      for (unsigned int free = 0; free < dim; ++free)
        {
          if (!(follow[free][free] > 0.))
            continue;
          Tensor<1, dim> motion = transpose(follow)[free];
          for (const auto &other : basis)
            motion -= (motion * other) * other;
          basis.push_back(motion / motion.norm());
          projector += outer_product(basis.back(), basis.back());
        }
      return projector;
    }
  } // namespace

  template <int dim>
  std::vector<std::array<unsigned int, dim>>
  nodes_of_cell(const FiniteElement<dim> &fe)
  {
    std::vector<std::array<unsigned int, dim>> nodes(fe.n_dofs_per_cell() /
                                                     dim);
    for (unsigned int n = 0; n < nodes.size(); ++n)
      for (unsigned int d = 0; d < dim; ++d)
        nodes[n][d] = fe.component_to_system_index(d, n);
    return nodes;
  }

  template <int dim>
  void
  Supports<dim>::reinit(const Space<dim>              &space,
                        const BoundaryConditions<dim> &conditions)
  {
    supported.clear();
    motions.clear();
    const IndexSet &owned = space.dof_handler.locally_owned_dofs();
    const auto      nodes = nodes_of_cell<dim>(space.fe);
    const auto     &unit  = space.fe.get_unit_support_points();
    // a node is of many cells, and where boundaries meet the first condition in
    // the file holds
    std::map<unsigned int, Node>         node_of;
    std::map<unsigned int, Motion>       motion_of;
    std::map<unsigned int, std::size_t>  condition_of;
    std::vector<types::global_dof_index> dofs(space.fe.n_dofs_per_cell());
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        cell->get_dof_indices(dofs);
        for (const auto &node : nodes)
          {
            std::array<types::global_dof_index, dim> global;
            bool                                     constrained = false;
            for (unsigned int d = 0; d < dim; ++d)
              {
                global[d] = dofs[node[d]];
                constrained |= space.constraints.is_constrained(global[d]);
              }
            // hanging nodes go with those that move them
            if (!constrained || !owned.is_element(global[0]) ||
                space.mesh_constraints.is_constrained(global[0]))
              continue;
            Node found;
            for (unsigned int d = 0; d < dim; ++d)
              found.index[d] = owned.index_within_set(global[d]);
            found.follow    = follow_of<dim>(global, space.constraints);
            found.projector = projector_of<dim>(found.follow);
            node_of.emplace(found.index[0], found);
          }
        for (const auto f : cell->face_indices())
          {
            if (!cell->face(f)->at_boundary())
              continue;
            for (std::size_t c = 0; c < conditions.size(); ++c)
              {
                const auto &condition = conditions[c];
                if (condition.id != cell->face(f)->boundary_id())
                  continue;
                for (unsigned int i = 0; i < dofs.size(); ++i)
                  {
                    const unsigned int d =
                      space.fe.system_to_component_index(i).first;
                    SpaceTimeFunction<dim> *function =
                      condition.velocity[d] ? condition.velocity[d].get() :
                                              condition.displacement[d].get();
                    if (function == nullptr ||
                        !space.fe.has_support_on_face(i, f) ||
                        !owned.is_element(dofs[i]) ||
                        space.mesh_constraints.is_constrained(dofs[i]))
                      continue;
                    const unsigned int index = owned.index_within_set(dofs[i]);
                    const auto [where, is_new] = condition_of.emplace(index, c);
                    if (!is_new && where->second <= c)
                      continue;
                    where->second    = c;
                    motion_of[index] = {
                      index,
                      space.mapping.transform_unit_to_real_cell(cell, unit[i]),
                      function,
                      condition.velocity[d] != nullptr};
                  }
              }
          }
      }
    for (const auto &entry : node_of)
      supported.push_back(entry.second);
    for (const auto &entry : motion_of)
      motions.push_back(entry.second);
  }

  template <int dim>
  void
  Supports<dim>::project(VectorType &acceleration) const
  {
    for (const Node &node : supported)
      {
        Tensor<1, dim> a;
        for (unsigned int d = 0; d < dim; ++d)
          a[d] = acceleration.local_element(node.index[d]);
        a = node.projector * a;
        for (unsigned int d = 0; d < dim; ++d)
          acceleration.local_element(node.index[d]) = a[d];
      }
  }

  template <int dim>
  void
  Supports<dim>::condense(VectorType &force) const
  {
    for (const Node &node : supported)
      {
        Tensor<1, dim> f;
        for (unsigned int d = 0; d < dim; ++d)
          f[d] = force.local_element(node.index[d]);
        f = f * node.follow;
        for (unsigned int d = 0; d < dim; ++d)
          force.local_element(node.index[d]) = f[d];
      }
  }

  template <int dim>
  void
  Supports<dim>::move(const VectorType &displacement,
                      const double      time,
                      const double      time_step,
                      VectorType       &velocity)
  {
    for (const Motion &motion : motions)
      {
        double &v = velocity.local_element(motion.index);
        if (motion.is_velocity)
          {
            motion.function->set_time(time + 0.5 * time_step);
            v = motion.function->value(motion.point);
          }
        else
          {
            motion.function->set_time(time + time_step);
            v = (motion.function->value(motion.point) -
                 displacement.local_element(motion.index)) /
                time_step;
          }
      }
  }

  template <int dim>
  void
  Supports<dim>::place(VectorType &displacement, const double time) const
  {
    for (const Motion &motion : motions)
      if (!motion.is_velocity)
        {
          motion.function->set_time(time);
          displacement.local_element(motion.index) =
            motion.function->value(motion.point);
        }
  }

  template <int dim>
  std::vector<unsigned int>
  Supports<dim>::moved() const
  {
    std::vector<unsigned int> result;
    for (const Motion &motion : motions)
      result.push_back(motion.index);
    return result;
  }

  template class Supports<2>;
  template class Supports<3>;
  template std::vector<std::array<unsigned int, 2>>
  nodes_of_cell<2>(const FiniteElement<2> &);
  template std::vector<std::array<unsigned int, 3>>
  nodes_of_cell<3>(const FiniteElement<3> &);
} // namespace Signoton
