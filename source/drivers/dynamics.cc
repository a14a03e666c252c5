#include <signoton/discretization/momentum_transfer.h>
#include <signoton/drivers/dynamics.h>
#include <signoton/operators/lumped_mass.h>

#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <iomanip>

namespace Signoton
{
  template <int dim>
  Dynamics<dim>::Dynamics(Model<dim> &model)
    : model(model)
    , output(model)
    , time(model.time_integration.start)
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
    moved = supports.moved();
    absorbing.reinit(space, model.materials, model.conditions, supports);
    surface_load.reinit(space, model.conditions);
    point_forces.reinit(space, model.point_forces);
    loads_vary = model.gravity_varies ||
                 std::any_of(model.point_forces.begin(),
                             model.point_forces.end(),
                             [](const auto &p) { return p.varies; }) ||
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
    if (model.wave_refinement.is_on())
      rest_energy = energy_at_rest();
  }

  template <int dim>
  double
  Dynamics<dim>::energy_at_rest() const
  {
    if (!model.initial_strain && !model.initial_stress)
      return 0.;
    VectorType nowhere;
    nowhere.reinit(displacement);
    return model.mechanics->energy_balance(nowhere).stored;
  }

  template <int dim>
  void
  Dynamics<dim>::start()
  {
    set_initial_motion();
    if (!model.wave_refinement.is_on())
      return;
    for (unsigned int level = 0; level < model.wave_refinement.n_levels();
         ++level)
      {
        if (!mark())
          break;
        model.space->mesh.execute_coarsening_and_refinement();
        setup();
        choose_step();
        set_initial_motion();
      }
  }

  template <int dim>
  bool
  Dynamics<dim>::mark()
  {
    const auto   timer = model.ledger.time("error estimate");
    auto        &space = *model.space;
    const double ahead = model.wave_refinement.interval() * time_step;
    double       speed = 0.;
    boost::container::flat_map<types::material_id, double> shear_modulus;
    for (const auto &material : model.materials)
      {
        speed = std::max(speed, material.longitudinal_speed());
        shear_modulus[material.id] = material.elasticity().shear;
      }
    // Waves that are only in the velocity yet, and loads that only begin, are
    // seen by going ahead.
    VectorType u(displacement), v(velocity);
    supports.move(displacement, time, ahead, v);
    u.add(ahead, v);
    space.mesh_constraints.distribute(u);
    model.set_time(time + ahead);
    const PointSpace<dim> points(space, dim * (dim + 1) / 2);
    VectorType            stress = points.make_relevant_vector();
    model.mechanics->stress_field(u, points, stress);
    stress.update_ghost_values();
    const bool changes =
      model.wave_refinement.mark(space,
                                 Refinement::traction_jumps(space,
                                                            points,
                                                            stress,
                                                            model.conditions,
                                                            shear_modulus),
                                 speed * ahead,
                                 largest_jump);
    model.set_time(time);
    return changes;
  }

  template <int dim>
  void
  Dynamics<dim>::transfer()
  {
    const auto  &mechanics   = model.mechanics;
    auto        &space       = *model.space;
    const double rest_before = rest_energy;
    const double before      = receipt.kinetic + receipt.stored - rest_before;

    using Transfer = parallel::distributed::SolutionTransfer<dim, VectorType>;
    VectorType u   = space.make_relevant_vector(), v(u), history;
    u.copy_locally_owned_data_from(displacement);
    v.copy_locally_owned_data_from(velocity);
    for (VectorType *vector : {&u, &v})
      {
        space.mesh_constraints.distribute(*vector);
        vector->update_ghost_values();
      }
    CellMass<dim>             cell_mass(space, model.materials);
    Transfer                  motion(space.dof_handler);
    std::unique_ptr<Transfer> of_history;
    space.mesh.prepare_coarsening_and_refinement();
    motion.prepare_for_coarsening_and_refinement(
      std::vector<const VectorType *>{&u, &v});
    if (history_space)
      {
        history = history_space->make_relevant_vector();
        mechanics->save_history(*history_space, history);
        history.update_ghost_values();
        of_history = std::make_unique<Transfer>(history_space->dof_handler);
        of_history->prepare_for_coarsening_and_refinement(history);
      }
    MomentumTransfer<dim> momentum(space, v, std::ref(cell_mass));
    space.mesh.execute_coarsening_and_refinement();

    setup();
    u = space.make_relevant_vector();
    v.reinit(u);
    std::vector<VectorType *> moved_fields{&displacement, &velocity};
    motion.interpolate(moved_fields);
    if (history_space)
      {
        VectorType new_history = history_space->make_relevant_vector();
        of_history->interpolate(new_history);
        mechanics->load_history(*history_space, new_history);
      }
    v.copy_locally_owned_data_from(velocity);
    space.mesh_constraints.distribute(v);
    v.update_ghost_values();
    const VectorType missing = momentum.missing(v);
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      if (!(mass.local_element(i) > 0.)) // follows others
        displacement.local_element(i) = velocity.local_element(i) = 0.;

    // back to the admissible set, at fixed strain and in no time: dampers stand
    // still
    mechanics->remember_dilatation(displacement);
    mechanics->set_time_step(1e-6 * time_step);
    const DynamicSums own =
      mechanics->dynamic_force(displacement, internal, true, -1.);
    mechanics->commit();
    mechanics->set_time_step(time_step);
    // the new points see the initial state anew
    receipt.initial += rest_energy - rest_before;
    receipt.stored = sum<1>({{own.stored}})[0];
    balance_transfer(missing, before);

    evaluate_loads();
    evaluate_dashpots();
    accelerate(0.);
    choose_step();
  }

  template <int dim>
  bool
  Dynamics<dim>::slow_down(const std::vector<bool> &wanted, const double energy)
  {
    const auto                 &dofs  = model.space->dof_handler;
    const IndexSet             &owned = dofs.locally_owned_dofs();
    const std::vector<IndexSet> components =
      DoFTools::locally_owned_dofs_per_component(dofs);
    const auto for_each = [&](const auto &action) {
      for (unsigned int c = 0; c < dim; ++c)
        for (const auto dof : components[c])
          if (const unsigned int i = owned.index_within_set(dof); wanted[i])
            action(c, mass.local_element(i), velocity.local_element(i));
    };
    std::array<double, 2 * dim + 1> sums{};
    for_each([&](const unsigned int c, const double m, const double v) {
      sums[c] += m;
      sums[dim + c] += m * v;
      sums[2 * dim] += 0.5 * m * v * v;
    });
    sums = sum(sums);
    std::array<double, dim> mean{};
    double                  relative = sums[2 * dim];
    for (unsigned int c = 0; c < dim; ++c)
      if (sums[c] > 0.)
        {
          mean[c] = sums[dim + c] / sums[c];
          relative -= 0.5 * sums[dim + c] * mean[c];
        }
    if (relative < energy)
      return false;
    const double factor = std::sqrt(1. - energy / relative);
    for_each([&](const unsigned int c, const double, double &v) {
      v = mean[c] + factor * (v - mean[c]);
    });
    return true;
  }

  template <int dim>
  void
  Dynamics<dim>::balance_transfer(VectorType missing, const double before)
  {
    supports.project(missing);
    const unsigned int n = velocity.locally_owned_size();
    std::vector<bool>  is_free(n), has_changed(n), moves(n);
    for (unsigned int i = 0; i < n; ++i)
      is_free[i] = mass.local_element(i) > 0.;
    for (const auto &node : supports.nodes())
      for (const unsigned int i : node.index)
        is_free[i] = false;
    for (unsigned int i = 0; i < n; ++i)
      {
        velocity.local_element(i) +=
          missing.local_element(i) * inverse_mass.local_element(i);
        has_changed[i] = is_free[i] && std::abs(missing.local_element(i)) > 0.;
        moves[i]       = is_free[i] && std::abs(velocity.local_element(i)) > 0.;
      }
    receipt.kinetic   = kinetic_energy();
    const double gain = receipt.kinetic + receipt.stored - rest_energy - before;
    // Interpolation may stretch the body a little: the nodes that changed pay
    // for it by their motion relative to each other, or else all that move.
    if (gain > 0. && !slow_down(has_changed, gain))
      slow_down(moves, gain);
    receipt.kinetic = kinetic_energy();
    receipt.transfer -= receipt.kinetic + receipt.stored - rest_energy - before;
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
        for (unsigned int i = 0; i < velocity.locally_owned_size(); ++i)
          if (!(mass.local_element(i) > 0.)) // follows others
            velocity.local_element(i) = 0.;
        supports.project(velocity);
      }
    evaluate_loads();
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
  Dynamics<dim>::evaluate_loads()
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
    point_forces.add(model.space->mesh_constraints, external);
    external.compress(VectorOperation::add);
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
  void
  Dynamics<dim>::add_statistics(const VectorType &u, const VectorType &v)
  {
    Line line = {{"step", n_steps},
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
                    [](const auto &m) { return m.has_cone(); }))
      line.emplace_back("volume of voids", receipt.voids);
    const char *axes[] = {"momentum x", "momentum y", "momentum z"};
    const auto  p      = momentum();
    for (unsigned int d = 0; d < dim; ++d)
      line.emplace_back(axes[d], p[d]);
    add_columns(line);
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

  template <int dim>
  void
  Dynamics<dim>::report()
  {
    const auto timer = model.ledger.time("output");
    VectorType u(displacement), v(velocity);
    model.space->mesh_constraints.distribute(u);
    model.space->mesh_constraints.distribute(v);
    model.set_time(time); // of references
    if (is_reported())
      add_statistics(u, v);
    const TimeIntegration &parameters = model.time_integration;
    const double           part       = part_of_run();
    const unsigned int     snapshot =
      static_cast<unsigned int>(part * parameters.snapshots + 1e-9);
    if (parameters.snapshots > 0 && (n_steps == 0 || snapshot > n_snapshots))
      {
        n_snapshots = snapshot;
        output.write_fields(u, &v, time, n_steps);
      }
    const unsigned int sample =
      static_cast<unsigned int>(part * model.output.line_samples + 1e-9);
    if (n_steps == 0 || sample > n_samples)
      {
        n_samples = sample;
        output.write_lines(u, &v, time);
      }
    if (is_line_due())
      {
        n_lines = twentieths();
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
            {"largest jump", &largest_jump}};
  }

  template <int dim>
  void
  Dynamics<dim>::save()
  {
    const auto      timer = model.ledger.time("output");
    Checkpoint<dim> checkpoint(model, output.checkpoint_directory());
    for (const auto &[name, number] : numbers_to_keep())
      checkpoint.set(name, *number);
    checkpoint.set("accepted steps", n_steps);
    checkpoint.set("lines of statistics", n_reported);
    checkpoint.set("snapshots", n_snapshots);
    checkpoint.set("samples", n_samples);
    output.save(checkpoint);
    checkpoint.write(history_space.get(),
                     {&displacement, &velocity, &acceleration, &internal});
  }

  template <int dim>
  void
  Dynamics<dim>::resume(const std::string &directory)
  {
    Checkpoint<dim> checkpoint(model, directory);
    checkpoint.load_mesh();
    for (const auto &[name, number] : numbers_to_keep())
      *number = checkpoint.number(name);
    n_steps     = checkpoint.number("accepted steps");
    n_reported  = checkpoint.number("lines of statistics");
    n_snapshots = checkpoint.number("snapshots");
    n_samples   = checkpoint.number("samples");
    n_lines     = twentieths();
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
    evaluate_dashpots();
    model.mechanics->remember_dilatation(displacement);
    output.resume(checkpoint, n_reported);
  }

  template <int dim>
  void
  Dynamics<dim>::validate()
  {
    model.mechanics->set_shock_viscosity(
      model.time_integration.shock_viscosity);
    setup();
    choose_step();
  }

  template <int dim>
  ExitStatus
  Dynamics<dim>::run(const std::string &resume_directory)
  {
    model.mechanics->set_shock_viscosity(
      model.time_integration.shock_viscosity);
    model.set_time(time);
    if (resume_directory.empty())
      {
        setup();
        choose_step();
        start();
      }
    else
      {
        resume(resume_directory);
        choose_step();
      }
    output.start(model.time_integration.start, model.time_integration.end);
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
        if (every > 0 && (is_finished() || n_steps % every == 0))
          save();
      }
    output.finish(n_steps);
    return ExitStatus::completed;
  }

  template class Dynamics<2>;
  template class Dynamics<3>;
} // namespace Signoton
