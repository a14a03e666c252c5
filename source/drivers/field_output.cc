#include <signoton/base/output_file.h>
#include <signoton/drivers/field_output.h>
#include <signoton/drivers/nodal_fields.h>

#include <optional>
#include <sstream>

namespace Signoton
{
  namespace
  {
    constexpr std::array<const char *, 6> tensor_names = {
      {"xx", "yy", "zz", "xy", "xz", "yz"}};
  } // namespace

  template <int dim>
  FieldOutput<dim>::FieldOutput(Model<dim> &model, OutputDirectory &directory)
    : model(model)
    , directory(directory)
  {}

  template <int dim>
  auto
  FieldOutput<dim>::cell_fields(const VectorType &displacement) -> CellFields
  {
    const auto averages = model.mechanics->cell_averages(displacement);
    CellFields cell_data;
    const auto add = [&](const std::string &name, const auto &value) {
      cell_data.emplace_back(name, Vector<float>(averages.size()));
      for (std::size_t i = 0; i < averages.size(); ++i)
        cell_data.back().second[i] = value(averages[i]);
    };
    const auto tensor = [](const std::array<double, 6> &entries) {
      Tensor2<> result;
      for (unsigned int c = 0; c < 6; ++c)
        result.access_raw_entry(c) = entries[c];
      return result;
    };
    const bool any_inelastic =
      std::any_of(model.materials.begin(),
                  model.materials.end(),
                  [](const auto &material) { return !material.is_elastic; });
    const bool any_history = model.mechanics->history_width() > 0;
    for (unsigned int c = 0; c < (dim == 2 ? 4 : 6); ++c)
      {
        const std::string entry = tensor_names[c];
        add("stress_" + entry, [c](const auto &a) { return a.stress[c]; });
        if (any_inelastic)
          add("contact_strain_" + entry,
              [c](const auto &a) { return a.contact_strain[c]; });
        if (any_history)
          add("plastic_strain_" + entry,
              [c](const auto &a) { return a.plastic_strain[c]; });
      }
    add("pressure", [&](const auto &a) { return pressure(tensor(a.stress)); });
    add("shear_intensity", [&](const auto &a) {
      return shear_intensity(dealii::deviator(tensor(a.stress)));
    });
    add("energy_density", [](const auto &a) { return a.energy_density; });
    add("region", [](const auto &a) { return a.region; });
    if (any_inelastic)
      {
        add("contact_dilatation",
            [&](const auto &a) { return trace(tensor(a.contact_strain)); });
        add("contact_shear", [&](const auto &a) {
          return 2. *
                 shear_intensity(dealii::deviator(tensor(a.contact_strain)));
        });
      }
    if (any_history)
      add("plastic_shear", [&](const auto &a) {
        return 2. * shear_intensity(dealii::deviator(tensor(a.plastic_strain)));
      });
    if (model.materials.size() > 1)
      {
        cell_data.emplace_back("material_id", Vector<float>(averages.size()));
        for (const auto &cell : model.space->mesh.active_cell_iterators())
          cell_data.back().second[cell->active_cell_index()] =
            cell->material_id();
      }
    return cell_data;
  }

  template <int dim>
  void
  FieldOutput<dim>::write(const State &state)
  {
    DataOut<dim> output;
    output.attach_dof_handler(model.space->dof_handler);
    std::vector<VectorType> nodal; // in use until the end
    nodal.reserve(state.fields.size());
    for (const State::Field &field : state.fields)
      {
        nodal.push_back(model.space->make_relevant_vector());
        nodal.back().copy_locally_owned_data_from(*field.values);
        nodal.back().update_ghost_values();
        output.add_data_vector(
          nodal.back(),
          std::vector<std::string>(dim, field.name),
          DataOut<dim>::type_dof_data,
          std::vector<DataComponentInterpretation::DataComponentInterpretation>(
            dim, DataComponentInterpretation::component_is_part_of_vector));
      }
    const auto cell_data = cell_fields(state.displacement());
    for (const auto &[name, values] : cell_data)
      output.add_data_vector(values, name, DataOut<dim>::type_cell_data);
    std::optional<NodalFields<dim>> nodes; // in use until the end
    if (model.output.nodal_stress)
      {
        nodes.emplace(model, state.displacement());
        for (unsigned int i = 0; i < nodes->fields.size(); ++i)
          output.add_data_vector(nodes->dof_handler,
                                 nodes->fields[i],
                                 nodes->names[i]);
      }
    output.build_patches(model.space->mapping,
                         model.space->degree,
                         DataOut<dim>::curved_boundary);
    DataOutBase::VtkFlags flags;
    flags.time  = state.time;
    flags.cycle = state.step;
    // the best compression takes longer than some steps
    flags.compression_level = DataOutBase::VtkFlags::best_speed;
    output.set_flags(flags);

    list.emplace_back(state.time, write_pieces(output, state.step));
    std::ostringstream collection;
    DataOutBase::write_pvd_record(collection, list);
    write_file(model.communicator,
               directory.path_of("fields.pvd"),
               collection.str());
  }

  template <int dim>
  std::string
  FieldOutput<dim>::write_pieces(const DataOut<dim> &output,
                                 const unsigned int  step)
  {
    const std::string  base = "fields-" + Utilities::int_to_string(step, 4);
    const unsigned int n_ranks =
      Utilities::MPI::n_mpi_processes(model.communicator);
    std::vector<std::string> pieces;
    for (unsigned int r = 0; r < n_ranks; ++r)
      pieces.push_back(
        base + (n_ranks == 1 ? "" : "." + Utilities::int_to_string(r, 4)) +
        ".vtu");
    // Through memory: deal.II's writers answer a full disk with an exception on
    // the rank that meets it, while the others would wait.
    std::ostringstream text, record;
    output.write_vtu(text);
    directory.enter(pieces);
    write_file(model.communicator,
               directory.path + "/" +
                 pieces[Utilities::MPI::this_mpi_process(model.communicator)],
               text.str(),
               true);
    if (n_ranks == 1)
      return pieces[0];
    output.write_pvtu_record(record, pieces);
    write_file(model.communicator,
               directory.path_of(base + ".pvtu"),
               record.str());
    return base + ".pvtu";
  }

  template class FieldOutput<2>;
  template class FieldOutput<3>;
} // namespace Signoton
