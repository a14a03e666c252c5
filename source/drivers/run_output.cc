#include <signoton/base/output_file.h>
#include <signoton/drivers/run_output.h>

#include <deal.II/numerics/vector_tools_integrate_difference.h>

#include <filesystem>
#include <fstream>
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

    /** Remove what an earlier run has left: a later --resume must not mix two
     *  runs. */
    void
    remove_results(const std::string &directory)
    {
      namespace fs = std::filesystem;
      std::error_code       error;
      std::vector<fs::path> old;
      for (const auto &entry : fs::directory_iterator(directory, error))
        {
          const std::string name = entry.path().filename().string();
          if (name == "statistics.csv" || name == "ledger.json" ||
              name == "checkpoint" || name.rfind("checkpoint.", 0) == 0 ||
              name == "fields.pvd" || name.rfind("fields-", 0) == 0 ||
              name.rfind("line-", 0) == 0)
            old.push_back(entry.path());
        }
      for (const auto &path : old)
        fs::remove_all(path, error);
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
    , fields(model)
    , probes(model)
  {}

  template <int dim>
  std::string
  RunOutput<dim>::checkpoint_directory() const
  {
    return model.output.directory + "/checkpoint";
  }

  template <int dim>
  void
  RunOutput<dim>::start(const double from, const double to)
  {
    start_time                   = from;
    end_time                     = to;
    const std::string &directory = model.output.directory;
    unsigned int       problem   = 0;
    if (Utilities::MPI::this_mpi_process(model.communicator) == 0)
      {
        std::error_code error;
        std::filesystem::create_directories(directory, error);
        std::ofstream resolved(directory + "/resolved.prm");
        resolved << model.resolved_scene << std::flush;
        problem = resolved ? 0 : 1;
        if (!resumed)
          remove_results(directory);
      }
    if (Utilities::MPI::max(problem, model.communicator) > 0)
      throw UserError("output directory '" + directory + "'",
                      "it cannot be created or written to",
                      "a directory with permission to write",
                      "set 'Output / Directory', or --output DIRECTORY",
                      ExitStatus::output_failed);
    screen << "Writing to " << directory << "\n\n";
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
  RunOutput<dim>::add_common(Line                           &line,
                             const VectorType               &displacement,
                             const VectorType               *velocity,
                             const std::vector<std::string> &phases)
  {
    probes.add_columns(line, displacement, velocity);
    if (model.reference)
      {
        const auto error =
          reference_error(displacement, *model.reference, VectorTools::L2_norm);
        line.emplace_back("L2 error", error.first);
        line.emplace_back("relative L2 error", error.second);
      }
    if (model.reference_velocity)
      {
        // the norm in which fronts converge
        const auto error = reference_error(*velocity,
                                           *model.reference_velocity,
                                           VectorTools::L1_norm);
        line.emplace_back("L1 error of velocity", error.first);
        line.emplace_back("relative L1 error of velocity", error.second);
      }
    line.emplace_back("seconds", model.ledger.total_seconds());
    for (const std::string &phase : phases)
      line.emplace_back("seconds of " + phase, model.ledger.seconds(phase));
    line.emplace_back("peak memory in MB", model.ledger.peak_memory() / 1e6);
  }

  template <int dim>
  void
  RunOutput<dim>::append(const Line &line)
  {
    const std::string  file_name = model.output.directory + "/statistics.csv";
    std::ostringstream text;
    text.precision(12);
    const bool is_new = !std::filesystem::exists(file_name);
    for (std::size_t i = 0; is_new && i < line.size(); ++i)
      text << (i > 0 ? "," : "") << '"' << line[i].first << '"';
    text << (is_new ? "\n" : "");
    for (std::size_t i = 0; i < line.size(); ++i)
      text << (i > 0 ? "," : "") << line[i].second;
    text << '\n';
    write_file(model.communicator, file_name, text.str(), WriteMode::append);
  }

  template <int dim>
  void
  RunOutput<dim>::write_fields(const VectorType  &displacement,
                               const VectorType  *velocity,
                               const double       time,
                               const unsigned int step)
  {
    fields.write(displacement, velocity, time, step);
  }

  template <int dim>
  void
  RunOutput<dim>::write_lines(const VectorType &displacement,
                              const VectorType *velocity,
                              const double      time)
  {
    if (probes.has_lines())
      probes.write_lines(time, displacement, velocity);
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
    model.ledger.write(model.output.directory + "/ledger.json");
    const std::string summary = model.ledger.summary();
    screen << "\nWhere the time went:\n" << summary;
    if (!fields.snapshots().empty())
      screen << "Fields for ParaView: " << model.output.directory
             << "/fields.pvd\n";
    if (probes.has_lines())
      screen << (probes.draw_lines() ?
                   "Lines over time:     " :
                   "Lines over time (gnuplot could not draw them): ")
             << model.output.directory << "/line-*\n";
    screen << "Statistics by step:  " << model.output.directory
           << "/statistics.csv\n";
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
                         const unsigned int     n_lines)
  {
    resumed                                = true;
    const std::string               prefix = "snapshot ";
    typename FieldOutput<dim>::List snapshots;
    for (const auto &name : checkpoint.names(prefix))
      snapshots.emplace_back(checkpoint.number(name),
                             name.substr(prefix.size()));
    fields.resume(snapshots);
    probes.resume(checkpoint);

    // drop lines of steps that are taken again
    const std::string file_name = model.output.directory + "/statistics.csv";
    if (Utilities::MPI::this_mpi_process(model.communicator) == 0)
      {
        std::ifstream      old(file_name);
        std::ostringstream kept;
        std::string        line;
        for (unsigned int i = 0; i <= n_lines && std::getline(old, line); ++i)
          kept << line << '\n';
        old.close();
        if (!kept.str().empty())
          std::ofstream(file_name) << kept.str();
      }
  }

  template class RunOutput<2>;
  template class RunOutput<3>;
} // namespace Signoton
