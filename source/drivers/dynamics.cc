#include <signoton/base/number.h>
#include <signoton/drivers/dynamics.h>
#include <signoton/drivers/reactions.h>
#include <signoton/drivers/run_checks.h>
#include <signoton/operators/lumped_mass.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <iomanip>

namespace Signoton
{
  template <int dim>
  Dynamics<dim>::Dynamics(Model<dim>                 &model,
                          const DynamicAnalysis<dim> &analysis)
    : model(model)
    , analysis(analysis)
    , output(model)
    , loads(model)
    , time(analysis.time_integration.start)
  {}

  template <int dim>
  void
  Dynamics<dim>::setup()
  {
    const auto timer = model.ledger.time("setup");
    auto      &space = *model.space;
    space.distribute_dofs();
    space.update_constraints(model.conditions);
    model.mechanics->reinit();
    supports.reinit(space, model.conditions);
    absorbing.reinit(space, model.materials, model.conditions, supports);
    loads.reinit();

    for (VectorType *vector : {&displacement,
                               &velocity,
                               &acceleration,
                               &mass,
                               &inverse_mass,
                               &internal,
                               &old_internal,
                               &external})
      model.mechanics->initialize_vector(*vector);
    if (loads.vary())
      old_external.reinit(external);
    if (!absorbing.empty())
      for (VectorType *vector : {&dashpots, &old_dashpots})
        vector->reinit(internal);
    mass.copy_locally_owned_data_from(lumped_mass(space, model.materials));
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      inverse_mass.local_element(i) =
        mass.local_element(i) > 0. ? 1. / mass.local_element(i) : 0.;
    add_loads(LoadKind::steady, external);
    if (loads.vary())
      {
        steady_load = external;
        add_loads(LoadKind::varying, external);
      }
    model.mechanics->balance_rest(external);
    if (analysis.wave_refinement.is_on())
      rest_energy = energy_at_rest();
  }

  template <int dim>
  void
  Dynamics<dim>::set_initial_motion()
  {
    if (model.initial_velocity)
      {
        VectorType v = model.space->make_relevant_vector();
        VectorTools::interpolate(model.space->mapping,
                                 model.space->dof_handler,
                                 *model.initial_velocity,
                                 v);
        velocity.copy_locally_owned_data_from(v);
        if (!std::isfinite(velocity.l2_norm()))
          throw UserError(model.file.where({"Initial state"}, "Velocity"),
                          "a velocity that is not finite in some point",
                          "an expression that is finite in all points",
                          "look for divisions by zero, roots and logarithms "
                          "of negative numbers");
        for (unsigned int i = 0; i < velocity.locally_owned_size(); ++i)
          if (!(mass.local_element(i) > 0.)) // follows others
            velocity.local_element(i) = 0.;
        supports.project(velocity);
      }
    evaluate_dashpots();
    const DynamicSums own =
      model.mechanics->dynamic_force(displacement, internal, true, -1.);
    model.mechanics->commit();
    const auto sums = sum<2>({{own.stored, own.voids}});
    receipt.stored  = sums[0];
    receipt.voids   = sums[1];
    receipt.kinetic = kinetic_energy();
    receipt.initial = receipt.stored + receipt.kinetic;
    accelerate(0.);
  }

  template <int dim>
  void
  Dynamics<dim>::add_loads(const LoadKind kind, VectorType &force)
  {
    const auto timer = model.ledger.time("external force");
    model.set_time(time);
    loads.add(kind, force);
  }

  template <int dim>
  void
  Dynamics<dim>::evaluate_loads()
  {
    if (!loads.vary())
      return;
    external = steady_load;
    add_loads(LoadKind::varying, external);
  }

  template <int dim>
  bool
  Dynamics<dim>::pass_jump()
  {
    const double behind = model.times_to_meet.behind_jump(time);
    if (!(behind > time))
      return false;
    time = behind;
    evaluate_loads();
    return true;
  }

  template <int dim>
  double
  Dynamics<dim>::kinetic_energy() const
  {
    double own = 0.;
    for (unsigned int i = 0; i < velocity.locally_owned_size(); ++i)
      own += 0.5 * mass.local_element(i) * velocity.local_element(i) *
             velocity.local_element(i);
    return sum<1>({{own}})[0];
  }

  template <int dim>
  std::array<double, dim>
  Dynamics<dim>::momentum() const
  {
    const auto     &dofs  = model.space->dof_handler;
    const IndexSet &owned = dofs.locally_owned_dofs();
    const auto components = DoFTools::locally_owned_dofs_per_component(dofs);
    std::array<double, dim> own{};
    for (unsigned int c = 0; c < dim; ++c)
      for (const auto dof : components[c])
        {
          const unsigned int i = owned.index_within_set(dof);
          own[c] += mass.local_element(i) * velocity.local_element(i);
        }
    return sum(own);
  }

  template <int dim>
  void
  Dynamics<dim>::accelerate(const double step)
  {
    for (unsigned int i = 0; i < acceleration.locally_owned_size(); ++i)
      acceleration.local_element(i) =
        inverse_mass.local_element(i) *
        (external.local_element(i) - internal.local_element(i));
    supports.project(acceleration);
    if (!absorbing.empty())
      absorbing.accelerate(mass, velocity, step, acceleration);
  }

  template <int dim>
  void
  Dynamics<dim>::evaluate_dashpots()
  {
    if (absorbing.empty())
      return;
    dashpots = 0.;
    absorbing.add_force(velocity, dashpots);
  }

  template <int dim>
  DynamicSums
  Dynamics<dim>::enter_step(const double       force_work,
                            const double       outer_work,
                            const double       damped,
                            const double       kinetic,
                            const DynamicSums &own)
  {
    const auto all   = sum<12>({{force_work,
                                 outer_work,
                                 damped,
                                 kinetic,
                                 own.stored,
                                 own.voids,
                                 own.dissipated,
                                 own.viscous,
                                 own.shock,
                                 own.quiet_cells,
                               SignalWatch::received() ? 1. : 0.,
                                 own.failed}});
    is_interrupted   = all[10] > 0.;
    DynamicSums sums = own;
    sums.stored      = all[4];
    sums.voids       = all[5];
    sums.dissipated  = all[6];
    sums.viscous     = all[7];
    sums.shock       = all[8];
    sums.quiet_cells = all[9];
    sums.failed      = all[11];
    refuse_failure(sums);
    // Between the lines of statistics the material is not asked what it has
    // stored: the next answer makes up for that.
    receipt.time_stepping +=
      all[0] - (sums.stored - receipt.stored) - sums.dissipated - sums.shock;
    receipt.external_work += all[1];
    receipt.absorbed += all[2];
    receipt.kinetic = all[3];
    receipt.stored  = sums.stored;
    receipt.voids   = sums.voids;
    receipt.plastic += sums.dissipated - sums.viscous;
    receipt.viscous += sums.viscous;
    receipt.shock += sums.shock;
    receipt.note();
    return sums;
  }

  template <int dim>
  void
  Dynamics<dim>::refuse_failure(const DynamicSums &sums) const
  {
    if (!(sums.failed > 0.))
      return;
    refuse_trouble_of_loads(model);
    throw UserError("t = " + number_text(time),
                    in_words(model.mechanics->failure(), model.communicator),
                    "a scheme that answers every strain",
                    "smaller steps, or constants that differ less",
                    ExitStatus::failure);
  }

  template <int dim>
  VectorType
  Dynamics<dim>::support_forces() const
  {
    VectorType force(internal);
    for (unsigned int i = 0; i < force.locally_owned_size(); ++i)
      force.local_element(i) -= external.local_element(i);
    if (!absorbing.empty())
      force += dashpots;
    if (!supports.moving().empty())
      {
        // a prescribed velocity changes from this step to the next
        VectorType next(velocity);
        supports.move(displacement, time, time_step, next);
        next -= velocity;
        for (const auto &node : supports.moving())
          node.write(node.read(force) + mass.local_element(node.index[0]) /
                                          time_step * node.held_part(next),
                     force);
      }
    return force;
  }

  template <int dim>
  void
  Dynamics<dim>::add_statistics(const State &state)
  {
    CSVTable::Row row = {{"step", n_steps},
                         {"time", time},
                         {"step size", time_step},
                         {"cells", model.space->mesh.n_global_active_cells()},
                         {"unknowns", model.space->dof_handler.n_dofs()},
                         {"kinetic energy", receipt.kinetic},
                         {"stored energy", receipt.stored},
                         {"plastic dissipation", receipt.plastic},
                         {"viscous dissipation", receipt.viscous},
                         {"shock dissipation", receipt.shock},
                         {"absorbed energy", receipt.absorbed},
                         {"lost by transfer", receipt.transfer},
                         {"lost by time stepping", receipt.time_stepping},
                         {"external work", receipt.external_work},
                         {"initial energy", receipt.initial},
                         {"energy gap", receipt.gap()},
                         {"unknowns by steps", unknown_steps}};
    if (std::any_of(model.materials.begin(),
                    model.materials.end(),
                    [](const auto &m) { return m.has_cone; }))
      row.emplace_back("volume of voids", receipt.voids);
    const char *axes[] = {"momentum x", "momentum y", "momentum z"};
    const auto  p      = momentum();
    for (unsigned int d = 0; d < dim; ++d)
      row.emplace_back(axes[d], p[d]);
    add_columns(row);
    const auto reactions = reaction_columns(model, support_forces());
    row.insert(row.end(), reactions.begin(), reactions.end());
    model.set_time(time); // of references
    output.add_common(row,
                      state,
                      {"constitutive update",
                       "time integration",
                       "external force",
                       "mesh and transfer",
                       "output"});
    output.append(row);
    ++n_reported;
  }

  template <int dim>
  void
  Dynamics<dim>::report()
  {
    if (!is_told())
      return;
    const auto timer = model.ledger.time("output");
    VectorType u(displacement), v(velocity);
    model.space->mesh_constraints.distribute(u);
    model.space->mesh_constraints.distribute(v);
    model.set_time(time); // of references
    const State state{time,
                      n_steps,
                      {{"displacement", "m", &u}, {"velocity", "m/s", &v}}};
    if (is_reported())
      add_statistics(state);
    if (is_snapshot_due())
      {
        n_snapshots = part_of(analysis.time_integration.snapshots);
        output.write_fields(state);
      }
    if (is_sample_due())
      {
        n_samples = part_of(analysis.transect_samples);
        output.write_transects(state);
      }
    if (is_screen_line_due())
      {
        n_screen_lines = part_of(20);
        output.screen << std::setw(8) << n_steps << std::setw(12)
                      << short_number(time, 5) << std::setw(10)
                      << model.space->dof_handler.n_dofs() << std::setw(11)
                      << short_number(receipt.kinetic) << std::setw(11)
                      << short_number(receipt.stored) << std::setw(11)
                      << short_number(std::abs(receipt.gap())) << std::setw(9)
                      << screen_column().second << std::setw(10)
                      << short_number(model.ledger.total_seconds()) << "  "
                      << (is_finished() ? "-" : output.time_left(time))
                      << std::endl;
      }
  }

  template <int dim>
  std::vector<std::pair<std::string, double *>>
  Dynamics<dim>::numbers_to_keep()
  {
    return {{"time", &time},
            {"time step", &time_step},
            {"stored energy", &receipt.stored},
            {"kinetic energy", &receipt.kinetic},
            {"plastic dissipation", &receipt.plastic},
            {"viscous dissipation", &receipt.viscous},
            {"shock dissipation", &receipt.shock},
            {"absorbed energy", &receipt.absorbed},
            {"lost by transfer", &receipt.transfer},
            {"lost by time stepping", &receipt.time_stepping},
            {"external work", &receipt.external_work},
            {"initial energy", &receipt.initial},
            {"unknowns by steps", &unknown_steps},
            {"largest energy", &receipt.largest},
            {"largest jump", &largest_jump},
            {"missed look at the mesh", &missed_look}};
  }

  template <int dim>
  void
  Dynamics<dim>::save()
  {
    const auto      timer = model.ledger.time("output");
    Checkpoint<dim> checkpoint(model, output.checkpoint_directory());
    missed_look = is_finished() && is_look_due() ? 1. : 0.;
    for (const auto &[name, number] : numbers_to_keep())
      checkpoint.set(name, *number);
    checkpoint.set("accepted steps", n_steps);
    checkpoint.set("lines of statistics", n_reported);
    output.save(checkpoint);
    checkpoint.write({&displacement, &velocity, &acceleration, &internal});
  }

  template <int dim>
  bool
  Dynamics<dim>::resume(const std::string &directory)
  {
    output.lock();
    Checkpoint<dim> checkpoint(model, directory);
    checkpoint.load_mesh();
    for (const auto &[name, number] : numbers_to_keep())
      *number = checkpoint.number(name);
    if (is_finished())
      return false;
    if (missed_look > 0.)
      time_step = 0.; // that of the last step may have been cut
    n_steps    = checkpoint.number("accepted steps");
    n_reported = checkpoint.number("lines of statistics");
    // the end may be another one now
    n_snapshots    = part_of(analysis.time_integration.snapshots);
    n_samples      = part_of(analysis.transect_samples);
    n_screen_lines = part_of(20);
    setup();
    checkpoint.load_fields(
      {&displacement, &velocity, &acceleration, &internal});
    // follow others, whatever they were given
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      if (!(mass.local_element(i) > 0.))
        for (VectorType *vector :
             {&displacement, &velocity, &acceleration, &internal})
          vector->local_element(i) = 0.;
    evaluate_dashpots();
    model.mechanics->begin_step(displacement);
    output.resume(checkpoint, n_reported);
    return true;
  }

  template <int dim>
  void
  Dynamics<dim>::make_up_for_mesh()
  {
    if (missed_look > 0. && analysis.wave_refinement.is_on() && mark())
      transfer();
    missed_look = 0.;
  }

  template <int dim>
  void
  Dynamics<dim>::validate()
  {
    model.mechanics->set_shock_viscosity(
      analysis.time_integration.shock_viscosity);
    setup();
    choose_step();
    refuse_jump();
  }

  template <int dim>
  ExitStatus
  Dynamics<dim>::run(const std::string &resume_directory)
  {
    model.mechanics->set_shock_viscosity(
      analysis.time_integration.shock_viscosity);
    model.set_time(time);
    if (resume_directory.empty())
      {
        setup();
        choose_step();
        start();
      }
    else
      {
        if (!resume(resume_directory))
          return output.nothing_left(time, "Time integration");
        choose_step();
        make_up_for_mesh();
      }
    output.start(analysis.time_integration.start,
                 analysis.time_integration.end);
    output.screen << introduction() << "\n\n"
                  << "    step           t  unknowns    kinetic     stored"
                     "        gap"
                  << std::setw(9) << screen_column().first
                  << "   seconds  left\n";
    if (resume_directory.empty())
      report();
    const unsigned int every = model.output.checkpoint_every;
    while (!is_finished())
      {
        try
          {
            step();
          }
        catch (const UserError &)
          {
            output.finish(n_steps);
            throw;
          }
        unknown_steps += model.space->dof_handler.n_dofs();
        report();
        model.mechanics->commit();
        if (is_mesh_due() && mark())
          {
            const auto timer = model.ledger.time("mesh and transfer");
            transfer();
          }
        const bool ends_early = is_interrupted && !is_finished();
        if (ends_early ||
            (every > 0 && (is_finished() || n_steps % every == 0)))
          save();
        if (ends_early)
          return output.interrupt(n_steps, time);
      }
    if (std::abs(receipt.lost_part()) > 0.01)
      output.screen << "\n  warning: the steps have "
                    << (receipt.time_stepping > 0. ? "lost " : "gained ")
                    << short_number(100. * std::abs(receipt.lost_part()))
                    << " % of the largest total energy ('lost by time "
                       "stepping'); shorter steps lose less, and shock "
                       "viscosity keeps contacts from gaining\n";
    output.finish(n_steps);
    return ExitStatus::completed;
  }

  template class Dynamics<2>;
  template class Dynamics<3>;
} // namespace Signoton
