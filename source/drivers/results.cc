#include <signoton/base/output_file.h>
#include <signoton/drivers/results.h>

#include <deal.II/numerics/vector_tools_evaluate.h>
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
    number(const double value, const int digits = 3)
    {
      std::ostringstream text;
      text << std::setprecision(digits) << value;
      return text.str();
    }

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
              name == "fields.pvd" || name.rfind("fields-", 0) == 0)
            old.push_back(entry.path());
        }
      for (const auto &path : old)
        fs::remove_all(path, error);
    }
  } // namespace

  template <int dim>
  Results<dim>::Results(Model<dim> &model)
    : model(model)
    , screen(std::cout,
             Utilities::MPI::this_mpi_process(model.communicator) == 0)
    , fields(model)
  {}

  template <int dim>
  std::string
  Results<dim>::checkpoint_directory() const
  {
    return model.output.directory + "/checkpoint";
  }

  template <int dim>
  void
  Results<dim>::open_directory()
  {
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
  }

  template <int dim>
  void
  Results<dim>::start(const double time)
  {
    open_directory();
    start_time = time;
    screen << "Writing to " << model.output.directory << "\n\n"
           << "  step        t  unknowns  Newton  linear  residual   interior"
           << "    seconds  left\n";
  }

  template <int dim>
  void
  Results<dim>::print_newton_history(const NewtonResult &newton)
  {
    if (!model.output.newton_history)
      return;
    for (unsigned int i = 0; i < newton.history.size(); ++i)
      {
        const auto &entry = newton.history[i];
        screen << "           " << std::setw(3) << i << "  residual "
               << std::scientific << std::setprecision(2) << entry.residual
               << std::defaultfloat << "  linear " << std::setw(3)
               << entry.linear_iterations << " in " << entry.linear_solves
               << "  step length " << number(entry.step_length)
               << "  regularization " << number(entry.regularization) << "\n";
      }
  }

  template <int dim>
  void
  Results<dim>::cycle_line(const unsigned int cycle, const StepRecord &record)
  {
    const NewtonResult &newton = record.solves.back();
    screen << "         refined, cycle " << cycle << ": " << std::setw(8)
           << model.space->dof_handler.n_dofs() << " unknowns; before, Newton "
           << newton.iterations() << ", linear "
           << newton.most_linear_iterations() << ", estimated error "
           << number(record.estimated_error) << "\n";
    print_newton_history(newton);
  }

  template <int dim>
  void
  Results<dim>::failed_line(const double time, const NewtonResult &newton)
  {
    screen << "         t = " << number(time, 6) << " failed: " << newton.reason
           << " (residual " << number(newton.history.back().residual)
           << "); the step is cut\n";
    print_newton_history(newton);
  }

  template <int dim>
  void
  Results<dim>::no_equilibrium(const double        time,
                               const double        step_size,
                               const NewtonResult &newton)
  {
    screen << "\nNo equilibrium found beyond t = " << number(time, 8) << ".\n"
           << "  where:    the load step of size " << number(2. * step_size)
           << " that starts there\n"
           << "  found:    " << newton.reason << ", residual "
           << number(newton.history.back().residual) << " of the forces\n"
           << "  expected: " << number(model.newton.tolerance)
           << "; the body may be at its limit load\n"
           << "  try:      a prescribed displacement instead of a force, a "
              "stronger binder, or a smaller 'Load steps / Minimum step size'\n"
           << "All accepted steps are in " << model.output.directory << ".\n";
  }

  template <int dim>
  std::pair<double, double>
  Results<dim>::reference_error(const VectorType &displacement)
  {
    VectorType u = model.space->make_relevant_vector();
    u.copy_locally_owned_data_from(displacement);
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
                                        VectorTools::L2_norm,
                                        &weight);
      return VectorTools::compute_global_error(model.space->mesh,
                                               cells,
                                               VectorTools::L2_norm);
    };
    const double error = norm_of(u, *model.reference);
    u                  = 0.;
    u.update_ghost_values();
    return {error, error / norm_of(u, *model.reference)};
  }

  template <int dim>
  std::vector<double>
  Results<dim>::probe_values(const VectorType &displacement)
  {
    std::vector<double> result;
    if (model.probes.empty())
      return result;
    VectorType u = model.space->make_relevant_vector();
    u.copy_locally_owned_data_from(displacement);
    u.update_ghost_values();
    Utilities::MPI::RemotePointEvaluation<dim> cache;
    for (const auto &value :
         VectorTools::point_values<dim>(model.space->mapping,
                                        model.space->dof_handler,
                                        u,
                                        model.probes,
                                        cache))
      for (unsigned int d = 0; d < dim; ++d)
        result.push_back(value[d]);
    return result;
  }

  template <int dim>
  std::vector<std::pair<std::string, double>>
  Results<dim>::statistics_line(const VectorType &displacement,
                                const StepRecord &record)
  {
    const NewtonResult &newton            = record.solves.back();
    unsigned int        newton_iterations = 0, most_newton = 0;
    unsigned int        linear_iterations = 0, most_linear = 0;
    for (const auto &solve : record.solves)
      {
        newton_iterations += solve.iterations();
        most_newton = std::max(most_newton, solve.iterations());
        linear_iterations += solve.linear_iterations();
        most_linear = std::max(most_linear, solve.most_linear_iterations());
      }
    const std::array<std::string, 3>            axes = {{"x", "y", "z"}};
    std::vector<std::pair<std::string, double>> line = {
      {"step", accepted_steps},
      {"time", record.time},
      {"step size", record.step_size},
      {"cells", model.space->mesh.n_global_active_cells()},
      {"unknowns", model.space->dof_handler.n_dofs()},
      {"newton iterations", newton.iterations()},
      {"newton iterations of all solves", newton_iterations},
      {"most newton iterations of a solve", most_newton},
      {"linear iterations of all solves", linear_iterations},
      {"most linear iterations", most_linear},
      {"residual", newton.history.back().residual},
      {"residual one iteration before",
       newton.history[newton.iterations() > 0 ? newton.iterations() - 1 : 0]
         .residual},
      {"tangent regularization", newton.regularization},
      {"stored energy", record.balance.stored},
      {"dissipated energy", dissipation},
      {"external work", external_work},
      {"transfer drift", record.transfer_drift},
      {"estimated error", record.estimated_error}};
    for (unsigned int r = 0; r < Rheology::n_regions; ++r)
      line.emplace_back(std::string("share of ") + Rheology::region_names[r],
                        record.balance.region_share[r]);
    for (unsigned int i = 0; i < model.conditions.size(); ++i)
      if (model.conditions[i].constrains())
        for (unsigned int d = 0; d < dim; ++d)
          line.emplace_back("reaction " + model.conditions[i].name + " " +
                              axes[d],
                            record.reactions[dim * i + d]);
    const auto probes = probe_values(displacement);
    for (unsigned int i = 0; i < probes.size(); ++i)
      line.emplace_back("displacement " + axes[i % dim] + " at probe " +
                          std::to_string(i / dim + 1),
                        probes[i]);
    if (model.reference)
      {
        const auto error = reference_error(displacement);
        line.emplace_back("L2 error", error.first);
        line.emplace_back("relative L2 error", error.second);
      }
    line.emplace_back("seconds", model.ledger.total_seconds());
    for (const char *phase : {"constitutive update",
                              "assembly",
                              "preconditioner",
                              "linear solve",
                              "mesh and transfer",
                              "error estimate",
                              "output"})
      line.emplace_back(std::string("seconds of ") + phase,
                        model.ledger.seconds(phase));
    line.emplace_back("peak memory in MB", model.ledger.peak_memory() / 1e6);
    return line;
  }

  template <int dim>
  void
  Results<dim>::append_statistics(
    const std::vector<std::pair<std::string, double>> &line)
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
  Results<dim>::step(const VectorType &displacement,
                     const StepRecord &record,
                     const bool        is_last)
  {
    const NewtonResult &newton = record.solves.back();
    ++accepted_steps;
    external_work += record.external_work;
    dissipation += record.balance.dissipation;
    {
      const auto timer = model.ledger.time("output");
      append_statistics(statistics_line(displacement, record));
      const unsigned int every = model.output.fields_every;
      if (every > 0 && (is_last || accepted_steps % every == 0))
        fields.write(displacement, record.time, accepted_steps);
    }
    const double elapsed = model.ledger.total_seconds();
    const double done =
      (record.time - start_time) / (model.load_steps.end - start_time);
    screen << std::setw(6) << accepted_steps << std::setw(9)
           << number(record.time, 5) << std::setw(10)
           << model.space->dof_handler.n_dofs() << std::setw(8)
           << newton.iterations() << std::setw(8)
           << newton.most_linear_iterations() << "  " << std::scientific
           << std::setprecision(1) << newton.history.back().residual
           << std::fixed << std::setw(9)
           << 100. * record.balance.region_share[0] << " %" << std::setw(11)
           << elapsed << "  "
           << (is_last ? "-" : duration(elapsed * (1. - done) / done))
           << std::defaultfloat << std::setprecision(6) << std::endl;
    print_newton_history(newton);
  }

  template <int dim>
  void
  Results<dim>::finish()
  {
    const auto memory = model.mechanics->memory();
    model.ledger.bytes("history", memory.history);
    model.ledger.bytes("tangents", memory.tangent);
    model.ledger.bytes("mesh data", memory.mesh_data);
    model.ledger.count("accepted steps", accepted_steps);
    model.ledger.write(model.output.directory + "/ledger.json");
    const std::string summary = model.ledger.summary();
    screen << "\nWhere the time went:\n" << summary;
    if (!fields.snapshots().empty())
      screen << "Fields for ParaView: " << model.output.directory
             << "/fields.pvd\n";
    screen << "Statistics by step:  " << model.output.directory
           << "/statistics.csv\n";
  }

  template <int dim>
  void
  Results<dim>::save(Checkpoint<dim> &checkpoint) const
  {
    checkpoint.set("accepted steps", accepted_steps);
    checkpoint.set("external work", external_work);
    checkpoint.set("dissipated energy", dissipation);
    for (const auto &[time, file] : fields.snapshots())
      checkpoint.set("snapshot " + file, time);
  }

  template <int dim>
  void
  Results<dim>::resume(const Checkpoint<dim> &checkpoint)
  {
    resumed        = true;
    accepted_steps = checkpoint.number("accepted steps");
    external_work  = checkpoint.number("external work");
    dissipation    = checkpoint.number("dissipated energy");
    const std::string               prefix = "snapshot ";
    typename FieldOutput<dim>::List snapshots;
    for (const auto &name : checkpoint.names(prefix))
      snapshots.emplace_back(checkpoint.number(name),
                             name.substr(prefix.size()));
    fields.resume(snapshots);

    // drop lines of steps that are taken again
    const std::string file_name = model.output.directory + "/statistics.csv";
    if (Utilities::MPI::this_mpi_process(model.communicator) == 0)
      {
        std::ifstream      old(file_name);
        std::ostringstream kept;
        std::string        line;
        for (unsigned int i = 0; i <= accepted_steps && std::getline(old, line);
             ++i)
          kept << line << '\n';
        old.close();
        if (!kept.str().empty())
          std::ofstream(file_name) << kept.str();
      }
  }

  template class Results<2>;
  template class Results<3>;
} // namespace Signoton
