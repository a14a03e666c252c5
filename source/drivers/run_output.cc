#include <signoton/drivers/run_output.h>

#include <deal.II/numerics/vector_tools_integrate_difference.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace Signoton
{
  namespace
  {
    std::string
    duration(const double seconds)
    {
      std::ostringstream text;
      if (seconds < 60.)
        text << std::fixed << std::setprecision(1) << seconds << " s";
      else if (seconds < 3600.)
        text << static_cast<int>(seconds / 60.) << " min";
      else
        text << std::fixed << std::setprecision(1) << seconds / 3600. << " h";
      return text.str();
    }
  } // namespace

  std::string
  short_number(const double value, const int digits)
  {
    std::ostringstream text;
    text << std::setprecision(digits) << value;
    return text.str();
  }

  template <int dim>
  RunOutput<dim>::RunOutput(Model<dim> &model)
    : screen(std::cout,
             Utilities::MPI::this_mpi_process(model.communicator) == 0)
    , model(model)
    , directory(model.communicator, model.output.directory)
    , statistics(model.communicator, directory.path + "/statistics.csv")
    , fields(model, directory)
    , probes(model, directory)
  {}

  template <int dim>
  void
  RunOutput<dim>::lock()
  {
    directory.lock();
  }

  template <int dim>
  std::string
  RunOutput<dim>::checkpoint_directory()
  {
    std::vector<std::string> names;
    for (const std::string ending : {"", ".unfinished", ".old"})
      {
        names.push_back("checkpoint" + ending);
        for (const std::string &file : Checkpoint<dim>::files)
          names.push_back("checkpoint" + ending + "/" + file);
      }
    directory.enter(names);
    return directory.path + "/checkpoint";
  }

  template <int dim>
  void
  RunOutput<dim>::start(const double from, const double to)
  {
    start_time = from;
    end_time   = to;
    if (!resumed)
      directory.begin(
        "resolved\\.prm|statistics\\.csv|ledger\\.json|fields\\.pvd|"
        "fields-[0-9]+(\\.[0-9]+)?\\.p?vtu|checkpoint(\\.old|\\.unfinished)?" +
        probes.file_names());
    write_file(model.communicator,
               directory.path_of("resolved.prm"),
               model.resolved_scene);
    directory.enter({"statistics.csv", "ledger.json"});
    watch.emplace();
    screen << "Writing to " << directory.path << "\n\n";
  }

  template <int dim>
  std::pair<double, double>
  RunOutput<dim>::reference_error(const VectorType           &field,
                                  const Function<dim>        &reference,
                                  const VectorTools::NormType norm)
  {
    VectorType u = model.space->make_relevant_vector();
    u.copy_locally_owned_data_from(field);
    u.update_ghost_values();
    const QGauss<dim>              quadrature(model.space->degree + 3);
    Constants                      constants;
    const std::vector<std::string> around(dim,
                                          model.space->axisymmetric ? "x" :
                                                                      "1");
    FunctionParser<dim>            weight(dim);
    weight.initialize(dim == 2 ? "x,y" : "x,y,z", around, constants, false);
    const auto norm_of = [&](const VectorType    &v,
                             const Function<dim> &function) {
      Vector<float> cells(model.space->mesh.n_active_cells());
      VectorTools::integrate_difference(model.space->mapping,
                                        model.space->dof_handler,
                                        v,
                                        function,
                                        cells,
                                        quadrature,
                                        norm,
                                        &weight);
      return VectorTools::compute_global_error(model.space->mesh, cells, norm);
    };
    const double error = norm_of(u, reference);
    u                  = 0.;
    u.update_ghost_values();
    return {error, error / norm_of(u, reference)};
  }

  template <int dim>
  void
  RunOutput<dim>::add_common(CSVTable::Row                  &row,
                             const State                    &state,
                             const std::vector<std::string> &phases)
  {
    probes.add_columns(row, state);
    if (model.reference)
      {
        const auto error = reference_error(state.displacement(),
                                           *model.reference,
                                           VectorTools::L2_norm);
        row.emplace_back("L2 error", error.first);
        row.emplace_back("relative L2 error", error.second);
      }
    if (model.reference_velocity)
      {
        // the norm in which fronts converge
        const auto error = reference_error(*state.find("velocity"),
                                           *model.reference_velocity,
                                           VectorTools::L1_norm);
        row.emplace_back("L1 error of velocity", error.first);
        row.emplace_back("relative L1 error of velocity", error.second);
      }
    row.emplace_back("seconds", model.ledger.total_seconds());
    for (const std::string &phase : phases)
      row.emplace_back("seconds of " + phase, model.ledger.seconds(phase));
    row.emplace_back("peak memory in MB", model.ledger.peak_memory() / 1e6);
  }

  template <int dim>
  void
  RunOutput<dim>::append(const CSVTable::Row &row)
  {
    screen << statistics.append(row);
  }

  template <int dim>
  void
  RunOutput<dim>::write_fields(const State &state)
  {
    fields.write(state);
  }

  template <int dim>
  void
  RunOutput<dim>::write_transects(const State &state)
  {
    if (probes.has_transects())
      screen << probes.write_transects(state);
  }

  template <int dim>
  std::string
  RunOutput<dim>::time_left(const double time) const
  {
    const double done = (time - start_time) / (end_time - start_time);
    return duration(model.ledger.total_seconds() * (1. - done) / done);
  }

  template <int dim>
  void
  RunOutput<dim>::finish(const unsigned int n_steps)
  {
    const auto memory = model.mechanics->memory();
    model.ledger.bytes("history", memory.history);
    model.ledger.bytes("tangents", memory.tangent);
    model.ledger.bytes("initial state", memory.initial_state);
    model.ledger.bytes("shock viscosity", memory.shock_viscosity);
    model.ledger.bytes("mesh data", memory.mesh_data);
    model.ledger.count("accepted steps", n_steps);
    model.ledger.write(directory.path_of("ledger.json"));
    const std::string summary = model.ledger.summary();
    screen << "\nWhere the time went:\n" << summary;
    if (!fields.snapshots().empty())
      screen << "Fields for ParaView: " << directory.path << "/fields.pvd\n";
    if (probes.has_transects())
      screen << (probes.draw_transects() ?
                   "Lines over time:     " :
                   "Lines over time (gnuplot could not draw them): ")
             << directory.path << "/line-*\n";
    screen << "Statistics by step:  " << directory.path << "/statistics.csv\n";
  }

  template <int dim>
  ExitStatus
  RunOutput<dim>::interrupt(const unsigned int n_steps, const double time)
  {
    screen << "\n"
           << SignalWatch::name(Utilities::MPI::max(SignalWatch::received(),
                                                    model.communicator))
           << " ends the run at t = " << short_number(time, 8)
           << ", after a checkpoint. To go on:\n  signoton --resume "
           << directory.path << std::endl;
    finish(n_steps);
    return interrupted;
  }

  template <int dim>
  ExitStatus
  RunOutput<dim>::nothing_left(const double time, const std::string &section)
  {
    screen << "\nThe run is finished: its end, t = "
           << model.file.value({section}, "End time", "1")
           << ", is not beyond what it has reached, t = "
           << short_number(time, 8)
           << ". To go on from there:\n  signoton --resume " << directory.path
           << " --set '" << section << "/End time=...'" << std::endl;
    return ExitStatus::completed;
  }

  template <int dim>
  void
  RunOutput<dim>::save(Checkpoint<dim> &checkpoint) const
  {
    for (const auto &[time, file] : fields.snapshots())
      checkpoint.set("snapshot " + file, time);
    probes.save(checkpoint);
  }

  template <int dim>
  void
  RunOutput<dim>::resume(const Checkpoint<dim> &checkpoint,
                         const unsigned int     n_rows)
  {
    resumed                                = true;
    const std::string               prefix = "snapshot ";
    typename FieldOutput<dim>::List snapshots;
    for (const auto &name : checkpoint.names(prefix))
      snapshots.emplace_back(checkpoint.number(name),
                             name.substr(prefix.size()));
    std::sort(snapshots.begin(), snapshots.end()); // by time
    fields.resume(snapshots);
    probes.resume(checkpoint);

    statistics.resume(n_rows, true);
  }

  template class RunOutput<2>;
  template class RunOutput<3>;
} // namespace Signoton
