#include <signoton/drivers/explicit_dynamics.h>
#include <signoton/operators/lumped_mass.h>

#include <deal.II/numerics/vector_tools_interpolate.h>

#include <iomanip>

namespace Signoton
{
  template <int dim>
  ExplicitDynamics<dim>::ExplicitDynamics(Model<dim> &model)
    : model(model)
    , output(model)
    , time(model.time_integration.start)
  {}

  template <int dim>
  void
  ExplicitDynamics<dim>::setup()
  {
    const auto timer = model.ledger.time("setup");
    auto      &space = *model.space;
    space.distribute_dofs();
    space.update_constraints(model.conditions);
    model.mechanics->reinit();
    supports.reinit(space, model.conditions);
    moved = supports.moved();
    absorbing.reinit(space, model.materials, model.conditions, supports);
    surface_load.reinit(space, model.conditions);
    loads_vary = model.gravity_varies ||
                 std::any_of(model.conditions.begin(),
                             model.conditions.end(),
                             [](const auto &c) { return c.varies(); });
    remembers = model.mechanics->history_width() > 0;
    if (remembers && history_space)
      history_space->distribute_dofs();
    else if (remembers)
      history_space =
        std::make_unique<PointSpace<dim>>(space,
                                          model.mechanics->history_width());

    for (VectorType *vector : {&displacement,
                               &velocity,
                               &acceleration,
                               &mass,
                               &inverse_mass,
                               &internal,
                               &external,
                               &old_internal})
      model.mechanics->initialize_vector(*vector);
    if (loads_vary)
      old_external.reinit(external);
    if (!absorbing.empty())
      for (VectorType *vector : {&dashpots, &old_dashpots})
        vector->reinit(internal);
    mass.copy_locally_owned_data_from(lumped_mass(space, model.materials));
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      inverse_mass.local_element(i) =
        mass.local_element(i) > 0. ? 1. / mass.local_element(i) : 0.;

    // viscosity shortens the stable step by the part of critical damping
    const double c = model.time_integration.shock_viscosity.linear;
    stable_step =
      model.mechanics->stable_time_step() * (std::sqrt(1. + c * c) - c);
  }

  template <int dim>
  void
  ExplicitDynamics<dim>::choose_step()
  {
    const TimeIntegration &parameters = model.time_integration;
    if (parameters.time_step > stable_step)
      throw UserError(model.file.where({"Time integration"}, "Time step"),
                      Utilities::to_string(parameters.time_step),
                      "at most the stable step, " +
                        Utilities::to_string(stable_step) + " s",
                      "leave it out: 'Safety' chooses a part of the stable "
                      "step");
    const double wanted = parameters.time_step > 0. ?
                            parameters.time_step :
                            parameters.safety * stable_step;
    const double left   = parameters.end - time;
    steps_left =
      std::max(1U, static_cast<unsigned int>(std::ceil(left / wanted - 1e-9)));
    time_step = left / steps_left;
    model.mechanics->set_time_step(time_step);
  }

  template <int dim>
  void
  ExplicitDynamics<dim>::start()
  {
    if (model.initial_velocity)
      {
        VectorType v = model.space->make_relevant_vector();
        VectorTools::interpolate(model.space->mapping,
                                 model.space->dof_handler,
                                 *model.initial_velocity,
                                 v);
        velocity.copy_locally_owned_data_from(v);
        for (unsigned int i = 0; i < velocity.locally_owned_size(); ++i)
          if (!(mass.local_element(i) > 0.)) // follows others
            velocity.local_element(i) = 0.;
        supports.project(velocity);
      }
    evaluate_loads();
    const auto sums = material_sums(
      model.mechanics->dynamic_force(displacement, internal, true, -1.));
    model.mechanics->commit();
    receipt.stored  = sums.stored;
    receipt.kinetic = kinetic_energy();
    receipt.initial = receipt.stored + receipt.kinetic;
    initial_stored  = receipt.stored;
    accelerate();
  }

  template <int dim>
  void
  ExplicitDynamics<dim>::evaluate_loads()
  {
    const auto timer = model.ledger.time("external force");
    model.set_time(time);
    external = 0.;
    if (model.gravity)
      add_body_force(*model.space,
                     model.materials,
                     *model.gravity,
                     model.space->mesh_constraints,
                     external);
    surface_load.add(model.space->mesh_constraints, external);
    external.compress(VectorOperation::add);
  }

  template <int dim>
  DynamicSums
  ExplicitDynamics<dim>::material_sums(const DynamicSums &own) const
  {
    std::array<double, 5> sums{
      {own.stored, own.dissipated, own.viscous, own.shock, own.quiet_cells}};
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        model.communicator,
                        ArrayView<double>(sums.data(), sums.size()));
    return {sums[0], sums[1], sums[2], sums[3], sums[4]};
  }

  template <int dim>
  double
  ExplicitDynamics<dim>::kinetic_energy() const
  {
    double sum = 0.;
    for (unsigned int i = 0; i < velocity.locally_owned_size(); ++i)
      sum += mass.local_element(i) * velocity.local_element(i) *
             velocity.local_element(i);
    return 0.5 * Utilities::MPI::sum(sum, model.communicator);
  }

  template <int dim>
  void
  ExplicitDynamics<dim>::accelerate()
  {
    for (unsigned int i = 0; i < acceleration.locally_owned_size(); ++i)
      acceleration.local_element(i) =
        inverse_mass.local_element(i) *
        (external.local_element(i) - internal.local_element(i));
    supports.project(acceleration);
    if (!absorbing.empty())
      absorbing.accelerate(mass, velocity, time_step, acceleration);
  }

  template <int dim>
  double
  ExplicitDynamics<dim>::quiet_displacement()
  {
    if (!model.time_integration.quiet_zones)
      return -1.;
    // The foot of a wave runs ahead of it by a cell a step and fades to nothing
    // that counts: what is below the round-off of the largest displacement
    // would not change it.
    constexpr unsigned int every     = 8;
    constexpr double       round_off = 1e-16;
    if (n_steps <= every || n_steps % every == 0)
      largest_displacement =
        std::max(largest_displacement, displacement.linfty_norm());
    return round_off * largest_displacement;
  }

  template <int dim>
  void
  ExplicitDynamics<dim>::step()
  {
    const double       dt = time_step;
    const unsigned int n  = displacement.locally_owned_size();
    // of the prescribed unknowns, and of the half steps
    double moving_before = 0., half_before = 0.;
    {
      const auto timer = model.ledger.time("time integration");
      internal.swap(old_internal);
      if (loads_vary)
        external.swap(old_external);
      if (!absorbing.empty())
        dashpots.swap(old_dashpots);
      for (const unsigned int i : moved)
        moving_before += mass.local_element(i) * velocity.local_element(i) *
                         velocity.local_element(i);
      for (unsigned int i = 0; i < n; ++i)
        {
          const double a = acceleration.local_element(i);
          half_before += mass.local_element(i) * a * a;
          velocity.local_element(i) += 0.5 * dt * a;
        }
      supports.move(displacement, time, dt, velocity);
      for (unsigned int i = 0; i < n; ++i)
        displacement.local_element(i) += dt * velocity.local_element(i);
    }
    --steps_left;
    ++n_steps;
    time = model.time_integration.end - steps_left * dt;
    if (loads_vary)
      evaluate_loads();
    DynamicSums own;
    {
      const auto timer = model.ledger.time("constitutive update");
      own              = model.mechanics->dynamic_force(displacement,
                                           internal,
                                           remembers || is_reported(),
                                           quiet_displacement());
    }
    const auto timer = model.ledger.time("time integration");
    accelerate();
    for (unsigned int i = 0; i < n; ++i)
      velocity.local_element(i) += 0.5 * dt * acceleration.local_element(i);
    if (!absorbing.empty())
      {
        dashpots = 0.;
        absorbing.add_force(velocity, dashpots);
      }

    // work of the mean of the forces before and after
    const VectorType &external_before = loads_vary ? old_external : external;
    double inner = 0., outer = 0., damped = 0., half_after = 0., kinetic = 0.;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double a = acceleration.local_element(i),
                     v = velocity.local_element(i), m = mass.local_element(i),
                     path = 0.5 * dt * (v - 0.5 * dt * a);
        inner +=
          path * (internal.local_element(i) + old_internal.local_element(i));
        outer +=
          path * (external.local_element(i) + external_before.local_element(i));
        half_after += m * a * a;
        kinetic += m * v * v;
      }
    if (!absorbing.empty())
      for (unsigned int i = 0; i < n; ++i)
        damped += 0.5 * dt *
                  (velocity.local_element(i) -
                   0.5 * dt * acceleration.local_element(i)) *
                  (dashpots.local_element(i) + old_dashpots.local_element(i));
    // a prescribed motion takes the force that it takes
    double supported = -0.5 * moving_before;
    for (const unsigned int i : moved)
      {
        const double v    = velocity.local_element(i);
        const double path = 0.5 * dt * v;
        supported +=
          0.5 * mass.local_element(i) * v * v +
          path * (internal.local_element(i) + old_internal.local_element(i) -
                  external.local_element(i) - external_before.local_element(i));
      }
    std::array<double, 10> sums{{inner,
                                 outer + supported,
                                 damped,
                                 0.125 * dt * dt * (half_after - half_before),
                                 0.5 * kinetic,
                                 own.stored,
                                 own.dissipated,
                                 own.viscous,
                                 own.shock,
                                 own.quiet_cells}};
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        model.communicator,
                        ArrayView<double>(sums.data(), sums.size()));
    internal_work += sums[0];
    receipt.external_work += sums[1];
    receipt.absorbed += sums[2];
    half_steps += sums[3];
    receipt.kinetic = sums[4];
    receipt.stored  = sums[5];
    receipt.plastic += sums[6] - sums[7];
    receipt.viscous += sums[7];
    receipt.shock += sums[8];
    quiet_share           = sums[9] / model.space->mesh.n_global_active_cells();
    receipt.time_stepping = internal_work - half_steps -
                            (receipt.stored - initial_stored) -
                            receipt.plastic - receipt.viscous - receipt.shock;
    if (!std::isfinite(receipt.kinetic))
      throw UserError("t = " + Utilities::to_string(time),
                      "a velocity that is not a number",
                      "a stable run",
                      "a smaller 'Time integration / Safety', and loads that "
                      "are finite at all times",
                      ExitStatus::failure);
  }

  template <int dim>
  void
  ExplicitDynamics<dim>::report()
  {
    const auto timer = model.ledger.time("output");
    VectorType u(displacement), v(velocity);
    model.space->mesh_constraints.distribute(u);
    model.space->mesh_constraints.distribute(v);
    model.set_time(time); // of references
    if (is_reported())
      {
        typename RunOutput<dim>::Line line = {
          {"step", n_steps},
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
          {"share of quiet cells", quiet_share}};
        output.add_common(line,
                          u,
                          &v,
                          {"constitutive update",
                           "time integration",
                           "external force",
                           "mesh and transfer",
                           "output"});
        output.append(line);
        ++n_reported;
      }
    const TimeIntegration &parameters = model.time_integration;
    const double           part =
      (time - parameters.start) / (parameters.end - parameters.start);
    const unsigned int snapshot =
      static_cast<unsigned int>(part * parameters.snapshots + 1e-9);
    if (parameters.snapshots > 0 && (n_steps == 0 || snapshot > n_snapshots))
      {
        n_snapshots = snapshot;
        output.write_fields(u, &v, time, n_steps);
      }
    const unsigned int twentieth = static_cast<unsigned int>(20. * part + 1e-9);
    if (n_steps > 0 && twentieth > n_lines)
      {
        n_lines = twentieth;
        output.screen << std::setw(8) << n_steps << std::setw(12)
                      << short_number(time, 5) << std::setw(10)
                      << model.space->dof_handler.n_dofs() << std::setw(11)
                      << short_number(receipt.kinetic) << std::setw(11)
                      << short_number(receipt.stored) << std::setw(11)
                      << short_number(std::abs(receipt.gap())) << std::setw(9)
                      << short_number(100. * quiet_share) << std::setw(10)
                      << short_number(model.ledger.total_seconds()) << "  "
                      << (steps_left == 0 ? "-" : output.time_left(time))
                      << std::endl;
      }
  }

  template <int dim>
  std::vector<std::pair<std::string, double *>>
  ExplicitDynamics<dim>::numbers_to_keep()
  {
    return {{"time", &time},
            {"stored energy", &receipt.stored},
            {"kinetic energy", &receipt.kinetic},
            {"plastic dissipation", &receipt.plastic},
            {"viscous dissipation", &receipt.viscous},
            {"shock dissipation", &receipt.shock},
            {"absorbed energy", &receipt.absorbed},
            {"lost by transfer", &receipt.transfer},
            {"external work", &receipt.external_work},
            {"initial energy", &receipt.initial},
            {"initial stored energy", &initial_stored},
            {"internal work", &internal_work},
            {"half steps", &half_steps},
            {"largest displacement", &largest_displacement},
            {"time step", &time_step}};
  }

  template <int dim>
  void
  ExplicitDynamics<dim>::save()
  {
    const auto      timer = model.ledger.time("output");
    Checkpoint<dim> checkpoint(model, output.checkpoint_directory());
    for (const auto &[name, number] : numbers_to_keep())
      checkpoint.set(name, *number);
    checkpoint.set("accepted steps", n_steps);
    checkpoint.set("lines of statistics", n_reported);
    checkpoint.set("snapshots", n_snapshots);
    output.save(checkpoint);
    checkpoint.write(history_space.get(),
                     {&displacement, &velocity, &acceleration, &internal});
  }

  template <int dim>
  void
  ExplicitDynamics<dim>::resume(const std::string &directory)
  {
    Checkpoint<dim> checkpoint(model, directory);
    checkpoint.load_mesh();
    for (const auto &[name, number] : numbers_to_keep())
      *number = checkpoint.number(name);
    n_steps     = checkpoint.number("accepted steps");
    n_reported  = checkpoint.number("lines of statistics");
    n_snapshots = checkpoint.number("snapshots");
    const TimeIntegration &parameters = model.time_integration;
    n_lines = static_cast<unsigned int>(20. * (time - parameters.start) /
                                        (parameters.end - parameters.start));
    setup();
    checkpoint.load_fields(
      history_space.get(),
      {&displacement, &velocity, &acceleration, &internal});
    // follow others, whatever they were given
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      if (!(mass.local_element(i) > 0.))
        for (VectorType *vector :
             {&displacement, &velocity, &acceleration, &internal})
          vector->local_element(i) = 0.;
    evaluate_loads();
    if (!absorbing.empty())
      absorbing.add_force(velocity, dashpots);
    model.mechanics->remember_dilatation(displacement);
    output.resume(checkpoint, n_reported);
  }

  template <int dim>
  void
  ExplicitDynamics<dim>::validate()
  {
    model.mechanics->set_shock_viscosity(
      model.time_integration.shock_viscosity);
    setup();
    choose_step();
  }

  template <int dim>
  ExitStatus
  ExplicitDynamics<dim>::run(const std::string &resume_directory)
  {
    model.mechanics->set_shock_viscosity(
      model.time_integration.shock_viscosity);
    model.set_time(time);
    if (resume_directory.empty())
      setup();
    else
      resume(resume_directory);
    choose_step();
    output.start(model.time_integration.start, model.time_integration.end);
    output.screen << "Steps of " << short_number(time_step)
                  << " s; stable are up to " << short_number(stable_step)
                  << " s\n\n"
                  << "    step           t  unknowns    kinetic     stored"
                     "        gap  quiet %   seconds  left\n";
    if (resume_directory.empty())
      {
        start();
        report();
      }
    const unsigned int every = model.output.checkpoint_every;
    while (steps_left > 0)
      {
        step();
        report();
        model.mechanics->commit();
        if (every > 0 && (steps_left == 0 || n_steps % every == 0))
          save();
      }
    output.finish(n_steps);
    return ExitStatus::completed;
  }

  template class ExplicitDynamics<2>;
  template class ExplicitDynamics<3>;
} // namespace Signoton
