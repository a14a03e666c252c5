#include <signoton/drivers/results.h>


#include <iomanip>

namespace Signoton
{

  template <int dim>
  Results<dim>::Results(Model<dim> &model, const StaticAnalysis<dim> &analysis)
    : model(model)
    , analysis(analysis)
    , output(model)
  {}

  template <int dim>
  void
  Results<dim>::start(const double time)
  {
    output.start(time, analysis.load_steps.end);
    output.screen
      << "  step        t  unknowns  Newton  linear  residual   interior"
      << "    seconds  left\n";
  }

  template <int dim>
  void
  Results<dim>::print_newton_history(const NewtonResult &newton)
  {
    if (!analysis.newton_history)
      return;
    for (unsigned int i = 0; i < newton.history.size(); ++i)
      {
        const auto &entry = newton.history[i];
        output.screen << "           " << std::setw(3) << i << "  residual "
                      << std::scientific << std::setprecision(2)
                      << entry.residual << std::defaultfloat << "  linear "
                      << std::setw(3) << entry.linear_iterations << " in "
                      << entry.linear_solves << "  step length "
                      << short_number(entry.step_length) << "  regularization "
                      << short_number(entry.regularization) << "\n";
      }
  }

  template <int dim>
  void
  Results<dim>::cycle_line(const unsigned int cycle, const StepRecord &record)
  {
    const NewtonResult &newton = record.solves.back();
    output.screen << "         refined, cycle " << cycle << ": " << std::setw(8)
                  << model.space->dof_handler.n_dofs()
                  << " unknowns; before, Newton " << newton.iterations()
                  << ", linear " << newton.most_linear_iterations()
                  << ", estimated error "
                  << short_number(record.estimated_error) << "\n";
    print_newton_history(newton);
  }

  template <int dim>
  void
  Results<dim>::failed_line(const double time, const NewtonResult &newton)
  {
    output.screen << "         t = " << short_number(time, 6)
                  << " failed: " << newton.reason << " (residual "
                  << short_number(newton.history.back().residual)
                  << "); the step is cut\n";
    print_newton_history(newton);
  }

  template <int dim>
  void
  Results<dim>::no_equilibrium(const double        time,
                               const double        step_size,
                               const NewtonResult &newton)
  {
    output.screen
      << "\nNo equilibrium found beyond t = " << short_number(time, 8) << ".\n"
      << "  where:    the load step of size " << short_number(2. * step_size)
      << " that starts there\n"
      << "  found:    " << newton.reason << ", residual "
      << short_number(newton.history.back().residual) << " of the forces\n"
      << "  expected: " << short_number(model.newton.tolerance)
      << "; the body may be at its limit load\n"
      << "  try:      a prescribed displacement instead of a force, a "
         "stronger binder, or a smaller 'Load steps / Minimum step size'\n"
      << "All accepted steps are in " << model.output.directory << ".\n";
  }

  template <int dim>
  void
  Results<dim>::binders(const CSVTable::Row &shares)
  {
    for (const auto &[section, share] : shares)
      output.screen << "  binders bear " << short_number(100. * share, 3)
                    << " % of the reaction of '" << section << "'\n";
    if (!shares.empty())
      output.screen << "  if 'Binder ratio' is there to help the solver, a "
                       "smaller one tells how much it adds\n";
  }

  template <int dim>
  CSVTable::Row
  Results<dim>::statistics_row(const State &state, const StepRecord &record)
  {
    const NewtonResult newton =
      record.solves.empty() ? NewtonResult() : record.solves.back();
    const auto residual = [&](const unsigned int before) {
      return newton.history.size() > before ?
               newton.history[newton.history.size() - 1 - before].residual :
               0.;
    };
    unsigned int newton_iterations = 0, most_newton = 0;
    unsigned int linear_iterations = 0, most_linear = 0;
    for (const auto &solve : record.solves)
      {
        newton_iterations += solve.iterations();
        most_newton = std::max(most_newton, solve.iterations());
        linear_iterations += solve.linear_iterations();
        most_linear = std::max(most_linear, solve.most_linear_iterations());
      }
    CSVTable::Row row = {{"step", accepted_steps},
                         {"time", record.time},
                         {"step size", record.step_size},
                         {"cells", model.space->mesh.n_global_active_cells()},
                         {"unknowns", model.space->dof_handler.n_dofs()},
                         {"newton iterations", newton.iterations()},
                         {"newton iterations of all solves", newton_iterations},
                         {"most newton iterations of a solve", most_newton},
                         {"linear iterations of all solves", linear_iterations},
                         {"most linear iterations", most_linear},
                         {"residual", residual(0)},
                         {"residual one iteration before",
                          residual(newton.iterations() > 0 ? 1 : 0)},
                         {"tangent regularization", newton.regularization},
                         {"stored energy", record.balance.stored},
                         {"dissipated energy", dissipation},
                         {"external work", external_work},
                         {"energy gap", energy_gap(record)},
                         {"transfer drift", record.transfer_drift},
                         {"estimated error", record.estimated_error}};
    for (unsigned int r = 0; r < Rheology::n_regions; ++r)
      row.emplace_back(std::string("share of ") + Rheology::region_names[r],
                       record.balance.region_share[r]);
    row.insert(row.end(), record.reactions.begin(), record.reactions.end());
    output.add_common(row,
                      state,
                      {"constitutive update",
                       "assembly",
                       "preconditioner",
                       "linear solve",
                       "mesh and transfer",
                       "error estimate",
                       "output"});
    return row;
  }

  template <int dim>
  double
  Results<dim>::energy_gap(const StepRecord &record) const
  {
    const double stored  = record.balance.stored,
                 missing = stored - initial_energy - drift + dissipation -
                           external_work,
                 largest = std::max({stored,
                                     initial_energy,
                                     dissipation,
                                     std::abs(external_work)});
    return largest > 0. ? missing / largest : 0.;
  }

  template <int dim>
  State
  Results<dim>::state_of(const VectorType &displacement,
                         const StepRecord &record) const
  {
    return {record.time,
            accepted_steps,
            {{"displacement", "m", &displacement}}};
  }

  template <int dim>
  void
  Results<dim>::at_rest(const VectorType &displacement,
                        const StepRecord &record)
  {
    initial_energy    = record.balance.stored;
    const auto  timer = model.ledger.time("output");
    const State state = state_of(displacement, record);
    output.append(statistics_row(state, record));
    if (analysis.fields_every > 0)
      output.write_fields(state);
    output.write_transects(state);
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
    drift += record.transfer_drift;
    {
      const auto  timer = model.ledger.time("output");
      const State state = state_of(displacement, record);
      output.append(statistics_row(state, record));
      const unsigned int every = analysis.fields_every;
      if (every > 0 && (is_last || accepted_steps % every == 0))
        output.write_fields(state);
      output.write_transects(state);
    }
    output.screen << std::setw(6) << accepted_steps << std::setw(9)
                  << short_number(record.time, 5) << std::setw(10)
                  << model.space->dof_handler.n_dofs() << std::setw(8)
                  << newton.iterations() << std::setw(8)
                  << newton.most_linear_iterations() << "  " << std::scientific
                  << std::setprecision(1) << newton.history.back().residual
                  << std::fixed << std::setw(9)
                  << 100. * record.balance.region_share[0] << " %"
                  << std::setw(11) << model.ledger.total_seconds() << "  "
                  << (is_last ? "-" : output.time_left(record.time))
                  << std::defaultfloat << std::setprecision(6) << std::endl;
    if (newton.at_round_off)
      output.screen << "         the residual is at round-off: forces of "
                       "elements are that much larger than the loads\n";
    print_newton_history(newton);
  }

  template <int dim>
  void
  Results<dim>::finish()
  {
    output.finish(accepted_steps);
  }

  template <int dim>
  void
  Results<dim>::save(Checkpoint<dim> &checkpoint) const
  {
    checkpoint.set("accepted steps", accepted_steps);
    checkpoint.set("external work", external_work);
    checkpoint.set("dissipated energy", dissipation);
    checkpoint.set("transfer drift", drift);
    checkpoint.set("initial energy", initial_energy);
    output.save(checkpoint);
  }

  template <int dim>
  void
  Results<dim>::resume(const Checkpoint<dim> &checkpoint)
  {
    accepted_steps = checkpoint.number("accepted steps");
    external_work  = checkpoint.number("external work");
    dissipation    = checkpoint.number("dissipated energy");
    drift          = checkpoint.number("transfer drift");
    initial_energy = checkpoint.number("initial energy");
    output.resume(checkpoint, accepted_steps + 1);
  }

  template class Results<2>;
  template class Results<3>;
} // namespace Signoton
