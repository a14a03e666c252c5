#include <signoton/drivers/loads.h>

namespace Signoton
{
  template <int dim>
  Loads<dim>::Loads(const Model<dim> &model)
    : model(model)
  {}

  template <int dim>
  void
  Loads<dim>::reinit()
  {
    body_force.reinit(*model.space, model.materials, model.gravity.get());
    surface_load.reinit(*model.space, model.conditions);
    point_forces.reinit(*model.space,
                        model.point_forces,
                        model.force_points.get());
  }

  template <int dim>
  bool
  Loads<dim>::vary() const
  {
    return (model.gravity && model.gravity->varies()) ||
           std::any_of(model.point_forces.begin(),
                       model.point_forces.end(),
                       [](const auto &p) { return p.varies; }) ||
           std::any_of(model.conditions.begin(),
                       model.conditions.end(),
                       [](const auto &c) { return c.varies(); });
  }

  template <int dim>
  void
  Loads<dim>::add(const LoadKind kind, VectorType &force) const
  {
    body_force.add(kind, force);
    surface_load.add(kind, force);
    point_forces.add(kind, force);
    force.compress(VectorOperation::add);
  }

  template <int dim>
  void
  Loads<dim>::add_all(VectorType &force) const
  {
    for (const LoadKind kind : {LoadKind::steady, LoadKind::varying})
      add(kind, force);
  }

  template class Loads<2>;
  template class Loads<3>;
} // namespace Signoton
