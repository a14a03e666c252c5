#include <signoton/drivers/mesh_change.h>

namespace Signoton
{
  template <int dim>
  MeshChange<dim>::MeshChange(Model<dim>                            &model,
                              const std::vector<const VectorType *> &fields)
    : model(model)
    , old_fields(fields.size(), model.space->make_relevant_vector())
    , of_fields(model.space->dof_handler)
  {
    std::vector<const VectorType *> ghosted;
    for (std::size_t i = 0; i < fields.size(); ++i)
      {
        old_fields[i].copy_locally_owned_data_from(*fields[i]);
        model.space->mesh_constraints.distribute(old_fields[i]);
        old_fields[i].update_ghost_values();
        ghosted.push_back(&old_fields[i]);
      }
    model.space->mesh.prepare_coarsening_and_refinement();
    of_fields.prepare_for_coarsening_and_refinement(ghosted);
    if (const auto *points = model.history_space())
      {
        old_history = points->make_relevant_vector();
        model.mechanics->save_history(*points, old_history);
        old_history.update_ghost_values();
        of_history = std::make_unique<Transfer>(points->dof_handler);
        of_history->prepare_for_coarsening_and_refinement(old_history);
      }
  }

  template <int dim>
  void
  MeshChange<dim>::execute()
  {
    model.space->mesh.execute_coarsening_and_refinement();
  }

  template <int dim>
  void
  MeshChange<dim>::finish(const std::vector<VectorType *> &fields)
  {
    for (VectorType *field : fields)
      model.mechanics->initialize_vector(*field);
    std::vector<VectorType *> moved(fields);
    of_fields.interpolate(moved);
    if (const auto *points = model.history_space())
      {
        VectorType history = points->make_relevant_vector();
        of_history->interpolate(history);
        model.mechanics->load_history(*points, history);
      }
  }

  template class MeshChange<2>;
  template class MeshChange<3>;
} // namespace Signoton
