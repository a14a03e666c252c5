#include <signoton/drivers/results.h>

#include <deal.II/numerics/data_out.h>
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

    void
    check_written(std::ostream      &stream,
                  const std::string &file_name,
                  const MPI_Comm    &communicator)
    {
      stream.flush();
      if (Utilities::MPI::max(stream ? 0U : 1U, communicator) > 0)
        throw UserError("file '" + file_name + "'",
                        "it cannot be written, the disk is full or protected",
                        "space and permission to write",
                        "free space or choose another 'Output / Directory'; "
                        "what was written before is complete",
                        ExitStatus::output_failed);
    }

    /** Write a file on the ranks that want to; fail on all or none. */
    void
    write_file(const std::string &file_name,
               const std::string &text,
               const bool         i_write,
               const MPI_Comm    &communicator)
    {
      std::ofstream file;
      if (i_write)
        {
          file.open(file_name);
          file << text;
        }
      check_written(file, file_name, communicator);
    }

    const std::array<const char *, 6> tensor_names = {
      {"xx", "yy", "zz", "xy", "xz", "yz"}};
  } // namespace

  template <int dim>
  Results<dim>::Results(Model<dim> &model)
    : model(model)
    , screen(std::cout,
             Utilities::MPI::this_mpi_process(model.communicator) == 0)
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
          std::filesystem::remove(directory + "/statistics.csv", error);
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
      screen << "           " << std::setw(3) << i << "  residual "
             << std::scientific << std::setprecision(2)
             << newton.history[i].residual << std::defaultfloat << "  linear "
             << std::setw(3) << newton.history[i].linear_iterations
             << "  step length " << newton.history[i].step_length << "\n";
  }

  template <int dim>
  void
  Results<dim>::cycle_line(const unsigned int  cycle,
                           const NewtonResult &newton,
                           const StepRecord   &record)
  {
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
  Results<dim>::statistics_line(const VectorType   &displacement,
                                const StepRecord   &record,
                                const NewtonResult &newton)
  {
    const std::array<std::string, 3>            axes = {{"x", "y", "z"}};
    std::vector<std::pair<std::string, double>> line = {
      {"step", accepted_steps},
      {"time", record.time},
      {"step size", record.step_size},
      {"cells", model.space->mesh.n_global_active_cells()},
      {"unknowns", model.space->dof_handler.n_dofs()},
      {"newton iterations", newton.iterations()},
      {"newton iterations of all tries", record.newton_iterations},
      {"linear iterations", newton.linear_iterations()},
      {"most linear iterations", newton.most_linear_iterations()},
      {"residual", newton.history.back().residual},
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
    const std::string file_name = model.output.directory + "/statistics.csv";
    std::ofstream     file;
    if (Utilities::MPI::this_mpi_process(model.communicator) == 0)
      {
        const bool is_new = !std::filesystem::exists(file_name);
        file.open(file_name, std::ios::app);
        file.precision(12);
        if (is_new)
          {
            for (std::size_t i = 0; i < line.size(); ++i)
              file << (i > 0 ? "," : "") << '"' << line[i].first << '"';
            file << '\n';
          }
        for (std::size_t i = 0; i < line.size(); ++i)
          file << (i > 0 ? "," : "") << line[i].second;
        file << '\n';
      }
    check_written(file, file_name, model.communicator);
  }

  template <int dim>
  void
  Results<dim>::step(const VectorType   &displacement,
                     const StepRecord   &record,
                     const NewtonResult &newton,
                     const bool          is_last)
  {
    ++accepted_steps;
    external_work += record.external_work;
    dissipation += record.balance.dissipation;
    {
      const auto timer = model.ledger.time("output");
      append_statistics(statistics_line(displacement, record, newton));
      const unsigned int every = model.output.fields_every;
      if (every > 0 && (is_last || accepted_steps % every == 0))
        write_fields(displacement, record.time);
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
  Results<dim>::write_fields(const VectorType &displacement, const double time)
  {
    VectorType u = model.space->make_relevant_vector();
    u.copy_locally_owned_data_from(displacement);
    u.update_ghost_values();
    DataOut<dim> output;
    output.attach_dof_handler(model.space->dof_handler);
    output.add_data_vector(
      u,
      std::vector<std::string>(dim, "displacement"),
      DataOut<dim>::type_dof_data,
      std::vector<DataComponentInterpretation::DataComponentInterpretation>(
        dim, DataComponentInterpretation::component_is_part_of_vector));

    const auto averages = model.mechanics->cell_averages(displacement);
    std::vector<std::pair<std::string, Vector<float>>> cell_data;
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
                  [](const auto &material) { return !material.is_elastic(); });
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
    for (const auto &[name, values] : cell_data)
      output.add_data_vector(values, name, DataOut<dim>::type_cell_data);
    output.build_patches(model.space->mapping,
                         model.space->degree,
                         DataOut<dim>::curved_boundary);

    const std::string base =
      "fields-" + Utilities::int_to_string(accepted_steps, 4);
    const unsigned int rank =
      Utilities::MPI::this_mpi_process(model.communicator);
    const unsigned int n_ranks =
      Utilities::MPI::n_mpi_processes(model.communicator);
    const auto piece = [&](const unsigned int r) {
      return n_ranks == 1 ?
               base + ".vtu" :
               base + "." + Utilities::int_to_string(r, 4) + ".vtu";
    };
    const std::string     directory = model.output.directory + "/";
    DataOutBase::VtkFlags flags;
    flags.time  = time;
    flags.cycle = accepted_steps;
    output.set_flags(flags);
    // Through memory: deal.II's writers answer a full disk with an exception on
    // the rank that meets it, while the others would wait.
    std::ostringstream text, record, collection;
    output.write_vtu(text);
    write_file(directory + piece(rank), text.str(), true, model.communicator);

    snapshots.emplace_back(time, n_ranks == 1 ? piece(0) : base + ".pvtu");
    std::vector<std::string> pieces;
    for (unsigned int r = 0; r < n_ranks; ++r)
      pieces.push_back(piece(r));
    output.write_pvtu_record(record, pieces);
    write_file(directory + base + ".pvtu",
               record.str(),
               rank == 0 && n_ranks > 1,
               model.communicator);
    DataOutBase::write_pvd_record(collection, snapshots);
    write_file(directory + "fields.pvd",
               collection.str(),
               rank == 0,
               model.communicator);
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
    if (!snapshots.empty())
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
    for (const auto &[time, file] : snapshots)
      checkpoint.set("snapshot " + file, time);
  }

  template <int dim>
  void
  Results<dim>::resume(const Checkpoint<dim> &checkpoint)
  {
    resumed                  = true;
    accepted_steps           = checkpoint.number("accepted steps");
    external_work            = checkpoint.number("external work");
    dissipation              = checkpoint.number("dissipated energy");
    const std::string prefix = "snapshot ";
    for (const auto &name : checkpoint.names(prefix))
      snapshots.emplace_back(checkpoint.number(name),
                             name.substr(prefix.size()));

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
