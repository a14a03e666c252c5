#include <signoton/discretization/supports.h>

namespace Signoton
{
  template <int dim>
  void
  Supports<dim>::reinit(const Space<dim>              &space,
                        const BoundaryConditions<dim> &new_conditions)
  {
    conditions = &new_conditions;
    supported.clear();
    moved.clear();
    moved_by.clear();
    const IndexSet &owned = space.dof_handler.locally_owned_dofs();
    for (const auto &held : space.held.nodes())
      {
        if (!owned.is_element(held.dofs[0]))
          continue;
        Node node;
        for (unsigned int d = 0; d < dim; ++d)
          node.index[d] = owned.index_within_set(held.dofs[d]);
        node.projector = held.projector;
        node.follow    = held.follow;
        supported.push_back(node);
        for (const auto &condition : held.held)
          if (condition.component < dim)
            {
              moved.push_back(node);
              moved_by.push_back(&held);
              break;
            }
      }
  }

  template <int dim>
  void
  Supports<dim>::project(VectorType &acceleration) const
  {
    for (const Node &node : supported)
      node.write(node.projector * node.read(acceleration), acceleration);
  }

  template <int dim>
  void
  Supports<dim>::stop(VectorType &velocity) const
  {
    std::vector<Tensor<1, dim>> kept;
    for (const Node &node : moved)
      kept.push_back(node.read(velocity));
    project(velocity);
    for (std::size_t i = 0; i < moved.size(); ++i)
      moved[i].write(kept[i], velocity);
  }

  template <int dim>
  void
  Supports<dim>::condense(VectorType &force) const
  {
    for (const Node &node : supported)
      node.write(node.read(force) * node.follow, force);
  }

  template <int dim>
  void
  Supports<dim>::move(const VectorType &displacement,
                      const double      time,
                      const double      time_step,
                      VectorType       &velocity) const
  {
    for (const auto &condition : *conditions)
      for (unsigned int d = 0; d < dim; ++d)
        {
          if (condition.velocity[d])
            condition.velocity[d]->set_time(time + 0.5 * time_step);
          if (condition.displacement[d])
            condition.displacement[d]->set_time(time + time_step);
        }
    for (std::size_t i = 0; i < moved.size(); ++i)
      {
        const Tensor<1, dim> u      = moved[i].read(displacement);
        const auto           wanted = [&](const HeldDirection<dim> &condition) {
          const Point<dim> &p = moved_by[i]->point;
          if (const auto *velocity = condition.velocity(*conditions))
            return velocity->value(p);
          const auto  *function = condition.displacement(*conditions);
          const double end = function != nullptr ? function->value(p) : 0.;
          return (end - condition.direction * u) / time_step;
        };
        moved[i].set_held_part(moved_by[i]->motion(wanted), velocity);
      }
  }

  template <int dim>
  void
  Supports<dim>::place(VectorType &displacement, const double time) const
  {
    for (const auto &condition : *conditions)
      for (unsigned int d = 0; d < dim; ++d)
        if (condition.displacement[d])
          condition.displacement[d]->set_time(time);
    for (std::size_t i = 0; i < moved.size(); ++i)
      {
        const Tensor<1, dim> u      = moved[i].read(displacement);
        const auto           wanted = [&](const HeldDirection<dim> &condition) {
          if (condition.velocity(*conditions) != nullptr)
            return condition.direction * u;
          const auto *function = condition.displacement(*conditions);
          return function != nullptr ? function->value(moved_by[i]->point) : 0.;
        };
        moved[i].set_held_part(moved_by[i]->motion(wanted), displacement);
      }
  }

  template class Supports<2>;
  template class Supports<3>;
} // namespace Signoton
