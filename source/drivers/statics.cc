#include <signoton/discretization/traction_jumps.h>
#include <signoton/drivers/checkpoint.h>
#include <signoton/drivers/mesh_change.h>
#include <signoton/drivers/reactions.h>
#include <signoton/drivers/statics.h>

namespace Signoton
{
  template <int dim>
  Statics<dim>::Statics(Model<dim> &model, const StaticAnalysis<dim> &analysis)
    : model(model)
    , analysis(analysis)
    , loads(model)
    , problem(model, supports)
    , newton(model.newton)
    , results(model, analysis)
    , time(analysis.load_steps.start)
    , step_size(analysis.load_steps.step_size)
  {}

  template <int dim>
  void
  Statics<dim>::setup_unknowns()
  {
    {
      const auto timer = model.ledger.time("setup");
      model.space->distribute_dofs();
      model.space->update_constraints(model.conditions);
      model.mechanics->reinit();
      supports.reinit(*model.space, model.conditions);
      loads.reinit();
    }
    problem.reinit();
  }

  template <int dim>
  NewtonResult
  Statics<dim>::solve(const double new_time, VectorType &u, const bool predict)
  {
    model.set_time(new_time);
    // a jump takes no time: dampers stand still
    model.mechanics->set_time_step(
      model.times_to_meet.behind_jump(time) > time ? 1e-6 * step_size :
                                                     new_time - time);
    problem.update_loads(loads);
    if (predict)
      {
        VectorType lift(u);
        model.space->constraints.distribute(lift);
        lift -= u;
        support_work = support_force * lift;
        problem.predict(u, lift, model.newton.regularization);
      }
    else
      model.space->constraints.distribute(u);
    const VectorType guess(u);
    // A solution moved to a finer mesh is wrong on the scale of an element,
    // where points then switch their branch: a part of the elastic tangent
    // takes that out first.
    NewtonResult result = newton.solve(problem, u, predict ? 0. : 0.1);
    record.solves.push_back(result);
    if (result.converged)
      return result;

    // Continuation in the binders: each solution starts the next.
    double weakest = 1.;
    for (const auto &material : model.materials)
      weakest = std::min(weakest, material.binder_ratio);
    if (!(weakest < 0.1))
      return result;
    u                           = guess;
    const double weakest_of_all = 1e-8; // there may be no binder at all
    for (double ratio = 0.1; true; ratio *= 0.1)
      {
        const bool is_last = ratio <= 1.1 * std::max(weakest, weakest_of_all);
        model.mechanics->set_scaling({is_last ? 0. : ratio});
        result = newton.solve(problem, u);
        record.solves.push_back(result);
        if (is_last || !result.converged)
          break;
      }
    model.mechanics->set_scaling({});
    return result;
  }

  template <int dim>
  bool
  Statics<dim>::refine(VectorType &trial)
  {
    auto &space = *model.space;
    bool  changes;
    {
      const auto            timer = model.ledger.time("error estimate");
      const PointSpace<dim> points(space, dim * (dim + 1) / 2);
      VectorType            stress = points.make_relevant_vector();
      model.mechanics->stress_field(trial, points, stress);
      stress.update_ghost_values();
      ByMaterial shear_modulus, stiffness;
      for (const auto &material : model.materials)
        {
          const Moduli &moduli       = material.elasticity;
          shear_modulus[material.id] = moduli.shear;
          stiffness[material.id]     = moduli.bulk + 2. * moduli.shear;
        }
      Vector<float> indicators =
        traction_jumps(space, points, stress, model.conditions, shear_modulus);
      VectorType u = space.make_relevant_vector();
      u.copy_locally_owned_data_from(trial);
      u.update_ghost_values();
      drop_round_off(space, stress, u, shear_modulus, stiffness, indicators);
      double sum = 0.;
      for (const float value : indicators)
        sum += value;
      record.estimated_error =
        std::sqrt(Utilities::MPI::sum(sum, model.communicator));

      const auto averages = model.mechanics->cell_averages(trial);
      std::vector<unsigned int> region;
      std::vector<bool>         mixed;
      for (const auto &average : averages)
        {
          region.push_back(average.region);
          mixed.push_back(average.mixed);
        }
      changes = analysis.refinement.mark(space, indicators, region, mixed);
    }
    if (changes)
      transfer(trial);
    return changes;
  }

  template <int dim>
  void
  Statics<dim>::transfer(VectorType &trial)
  {
    const double stored_before =
      model.mechanics->energy_balance(displacement).stored;
    {
      const auto      timer = model.ledger.time("mesh and transfer");
      MeshChange<dim> change(model, {&displacement, &trial});
      change.execute();
      setup_unknowns();
      change.finish({&displacement, &trial});
    }
    // The accepted state need not fulfill conditions: the next one will.
    model.space->mesh_constraints.distribute(displacement);
    // back to the admissible set, at fixed strain and in no time: dampers stand
    // still
    const auto timer = model.ledger.time("constitutive update");
    model.mechanics->set_time_step(1e-6 * step_size);
    VectorType force;
    force.reinit(displacement);
    model.mechanics->evaluate(displacement, force, false);
    model.mechanics->commit();
    const double stored_after =
      model.mechanics->energy_balance(displacement).stored;
    record.transfer_drift += stored_after - stored_before;
    // a step that is cut starts from here
    find_carried_load();
    if (results.n_accepted() > 0)
      {
        force = 0.;
        model.mechanics->evaluate(displacement, force, false);
        support_force = force;
        support_force -= carried_load;
      }
    else
      support_force.reinit(displacement);
  }

  template <int dim>
  double
  Statics<dim>::whole_step_end() const
  {
    const double behind = model.times_to_meet.behind_jump(time);
    return behind > time ? behind :
                           model.times_to_meet.end_of_step(time, step_size);
  }

  template <int dim>
  bool
  Statics<dim>::advance()
  {
    const LoadSteps &steps  = analysis.load_steps;
    bool             is_cut = !step_ends.empty();
    unsigned int     cycle  = 0;
    record                  = StepRecord();
    if (!is_cut)
      step_ends.push_back(whole_step_end());
    while (true)
      {
        const double end = step_ends.back();
        record.time      = end;
        record.step_size = end - time;
        VectorType trial(displacement);
        last_result = solve(end, trial, true);
        const unsigned int cycles =
          analysis.refinement.cycles(results.n_accepted() + 1);
        for (; cycle < cycles && last_result.converged; ++cycle)
          {
            if (!refine(trial))
              break;
            results.cycle_line(cycle + 1, record);
            last_result = solve(end, trial, false);
          }
        if (last_result.converged)
          {
            accept(trial);
            break;
          }
        results.failed_line(end, last_result);
        if (0.5 * record.step_size < steps.minimum_step_size)
          return false;
        is_cut = true;
        step_ends.push_back(time + 0.5 * record.step_size);
      }
    step_ends.pop_back();
    if (is_cut && step_ends.empty()) // what had grown was too large
      step_size =
        std::max(0.5 * step_size, std::min(step_size, steps.step_size));
    else if (!is_cut && record.step_size > 0.999 * step_size &&
             last_result.iterations() <= steps.easy_iterations)
      step_size = std::min(steps.maximum_step_size, step_size * steps.growth);
    return true;
  }

  template <int dim>
  bool
  Statics<dim>::is_last_step() const
  {
    return !(time < analysis.load_steps.end);
  }

  template <int dim>
  void
  Statics<dim>::report_start()
  {
    model.mechanics->set_time_step(step_size);
    record         = StepRecord();
    record.time    = time;
    record.balance = model.mechanics->energy_balance(displacement);
    VectorType nothing(displacement);
    nothing          = 0.;
    record.reactions = reaction_columns(model, nothing);
    results.at_rest(displacement, record);
  }

  template <int dim>
  void
  Statics<dim>::find_carried_load()
  {
    carried_load.reinit(displacement);
    if (results.n_accepted() == 0)
      model.mechanics->evaluate(displacement, carried_load, false);
    else
      {
        model.set_time(time);
        loads.add_all(carried_load);
        model.set_time(record.time);
      }
  }

  template <int dim>
  void
  Statics<dim>::accept(const VectorType &trial)
  {
    const auto timer = model.ledger.time("results");
    record.balance   = model.mechanics->energy_balance(trial);
    VectorType increment(trial);
    increment -= displacement;
    record.external_work = 0.5 * (support_work + carried_load * increment +
                                  problem.forces() * increment);
    support_force        = problem.support_forces();
    carried_load         = problem.loads();
    record.reactions     = reaction_columns(model, support_force);
    // Regions and flow are those of the step: they are seen from its begin.
    time = record.time;
    results.step(trial, record, is_last_step());
    model.mechanics->commit();
    displacement = trial;
  }

  template <int dim>
  void
  Statics<dim>::report_binders()
  {
    const auto is_bound = [](const auto &material) {
      return material.has_binder;
    };
    if (results.n_accepted() == 0 ||
        std::none_of(model.materials.begin(), model.materials.end(), is_bound))
      return;
    VectorType force;
    model.mechanics->binder_force(displacement, force);
    results.binders(binder_shares(model, support_force, force));
  }

  template <int dim>
  ExitStatus
  Statics<dim>::run(const std::string &resume_directory)
  {
    model.set_time(time);
    if (resume_directory.empty())
      {
        setup_unknowns();
        for (VectorType *vector : {&displacement, &support_force})
          model.mechanics->initialize_vector(*vector);
        find_carried_load();
      }
    else
      {
        results.lock();
        Checkpoint<dim> checkpoint(model, resume_directory);
        checkpoint.load_mesh();
        time = checkpoint.number("time");
        if (is_last_step())
          return results.nothing_left(time);
        step_size = checkpoint.number("step size");
        for (const auto &name : checkpoint.names("end of a cut step "))
          step_ends.push_back(checkpoint.number(name));
        std::sort(step_ends.begin(), step_ends.end(), std::greater<double>());
        model.set_time(time);
        setup_unknowns();
        for (VectorType *vector : {&displacement, &support_force})
          model.mechanics->initialize_vector(*vector);
        checkpoint.load_fields({&displacement, &support_force});
        model.space->mesh_constraints.distribute(displacement);
        model.space->mesh_constraints.set_zero(support_force);
        results.resume(checkpoint);
        find_carried_load();
      }
    results.start(time);
    if (resume_directory.empty())
      report_start();

    while (!is_last_step())
      {
        if (!advance())
          {
            results.finish();
            report_binders();
            results.no_equilibrium(time, 0.5 * record.step_size, last_result);
            return ExitStatus::no_equilibrium;
          }
        const unsigned int every = model.output.checkpoint_every;
        const bool         is_interrupted =
          !is_last_step() &&
          Utilities::MPI::max(SignalWatch::received(), model.communicator) != 0;
        if (is_interrupted ||
            (every > 0 &&
             (is_last_step() || results.n_accepted() % every == 0)))
          {
            const auto      timer = model.ledger.time("output");
            Checkpoint<dim> checkpoint(model, results.checkpoint_directory());
            checkpoint.set("time", time);
            checkpoint.set("step size", step_size);
            for (std::size_t i = 0; i < step_ends.size(); ++i)
              checkpoint.set("end of a cut step " + std::to_string(i),
                             step_ends[i]);
            results.save(checkpoint);
            checkpoint.write({&displacement, &support_force});
          }
        if (is_interrupted)
          return results.interrupt(time);
      }
    results.finish();
    report_binders();
    return ExitStatus::completed;
  }

  template class Statics<2>;
  template class Statics<3>;
} // namespace Signoton
