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
    surface_load.reinit(*model.space, model.conditions);
    point_forces.reinit(*model.space,
                        model.point_forces,
                        model.force_points.get());
  }

  template <int dim>
  bool
  Loads<dim>::vary() const
  {
    return model.gravity_varies ||
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
    if (model.gravity && kind == load_kind(model.gravity_varies))
      add_body_force(*model.space, model.materials, *model.gravity, force);
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
