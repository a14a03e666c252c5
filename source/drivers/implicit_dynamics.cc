#include <signoton/base/number.h>
#include <signoton/drivers/implicit_dynamics.h>
#include <signoton/drivers/run_checks.h>

namespace Signoton
{
  template <int dim>
  ImplicitDynamics<dim>::ImplicitDynamics(Model<dim>                 &model,
                                          const DynamicAnalysis<dim> &analysis)
    : Dynamics<dim>(model, analysis)
    , radius(analysis.time_integration.spectral_radius)
    , beta(1. / ((1. + radius) * (1. + radius)))
    , gamma(0.5 + (1. - radius) / (1. + radius))
    , inertia(*model.space, mass, predicted, pull)
    , resistance(*model.space, absorbing, predicted)
    , problem(model, supports, {&inertia, &resistance})
    , newton(model.newton)
  {}

  template <int dim>
  void
  ImplicitDynamics<dim>::setup()
  {
    Dynamics<dim>::setup();
    problem.reinit();
    this->old_external.reinit(external);
    stable_step = model.mechanics->stable_time_step() *
                  analysis.wave_refinement.finest_part(*model.space);
  }

  template <int dim>
  double
  ImplicitDynamics<dim>::shortest_step() const
  {
    return 1e-3 *
           (is_automatic ? stable_step : analysis.time_integration.time_step);
  }

  template <int dim>
  void
  ImplicitDynamics<dim>::choose_step()
  {
    const TimeIntegration &parameters = analysis.time_integration;
    is_automatic                      = !(parameters.time_step > 0.);
    if (!is_automatic)
      next_step = parameters.time_step;
    else if (!(next_step > 0.))
      next_step = std::min(stable_step, parameters.longest_step());
    if (!(time_step > 0.)) // the mesh looks ahead before the first step
      time_step = next_step;
  }

  template <int dim>
  std::string
  ImplicitDynamics<dim>::introduction() const
  {
    const double longest =
      is_automatic ? analysis.time_integration.longest_step() : next_step;
    // After a jump of a load on a bar, in steps that cross two to ten cells,
    // velocities and stresses go up and down by 4 to 18 % at a radius of 0.9, by
    // half of that at 0.8, the default, and by less than 3 % at 0.5.
    constexpr double ripples = 0.85;
    return (is_automatic ? "Steps from " : "Steps of ") +
           short_number(next_step) + " s" +
           (is_automatic ?
              " up to " + short_number(longest) + " s by the local error" :
              std::string()) +
           "; waves cross a cell in " + short_number(stable_step) + " s" +
           (radius > ripples && longest > stable_step ?
              "\n  warning: at a spectral radius of " + short_number(radius) +
                " what such steps do not resolve goes up and down from step to "
                "step; 0.5 damps it" :
              std::string());
  }

  template <int dim>
  void
  ImplicitDynamics<dim>::add_columns(CSVTable::Row &row) const
  {
    row.emplace_back("local error", error);
    row.emplace_back("Newton iterations", newton_iterations);
    row.emplace_back("linear iterations", linear_iterations);
    row.emplace_back("rejected steps", rejected);
  }

  template <int dim>
  std::pair<std::string, std::string>
  ImplicitDynamics<dim>::screen_column() const
  {
    return {"Newton", short_number(newton_iterations)};
  }

  template <int dim>
  std::vector<std::pair<std::string, double *>>
  ImplicitDynamics<dim>::numbers_to_keep()
  {
    auto numbers = Dynamics<dim>::numbers_to_keep();
    numbers.emplace_back("next step", &next_step);
    numbers.emplace_back("largest displacement", &largest);
    numbers.emplace_back("rejected steps", &rejected);
    return numbers;
  }

  template <int dim>
  double
  ImplicitDynamics<dim>::norm(const VectorType &vector) const
  {
    double own = 0.;
    for (unsigned int i = 0; i < vector.locally_owned_size(); ++i)
      own += mass.local_element(i) * vector.local_element(i) *
             vector.local_element(i);
    return std::sqrt(this->template sum<1>({{own}})[0]);
  }

  template <int dim>
  NewtonResult
  ImplicitDynamics<dim>::solve(Motion &trial)
  {
    const double dt = time_step;
    this->evaluate_loads();
    model.mechanics->set_time_step(dt);
    trial = {displacement, velocity, acceleration};
    supports.move(displacement, time - dt, dt, trial.velocity);
    predicted = displacement;
    pull      = external;
    VectorType lift;
    lift.reinit(displacement);
    for (const auto &node : supports.moving())
      node.write(dt * node.held_part(trial.velocity), lift);

    // Without an acceleration at its end, the step would lead to a displacement
    // and a velocity; the one of the dashpots is kept in the trial.
    for (unsigned int i = 0; i < displacement.locally_owned_size(); ++i)
      {
        const double a = acceleration.local_element(i);
        predicted.local_element(i) +=
          dt * velocity.local_element(i) + dt * dt * (0.5 - beta) * a;
        trial.velocity.local_element(i) =
          velocity.local_element(i) + dt * (1. - gamma) * a;
        pull.local_element(i) +=
          radius * (old_external.local_element(i) - internal.local_element(i)) -
          (2. * radius - 1.) * mass.local_element(i) * a;
      }
    for (const auto &node : supports.moving())
      {
        const Tensor<1, dim> path = node.read(lift);
        node.set_held_part(path / dt, trial.velocity);
        node.set_held_part(node.held_part(displacement) + path, predicted);
      }
    if (!absorbing.empty())
      {
        VectorType damped;
        damped.reinit(pull);
        absorbing.add_force(trial.velocity, damped);
        pull.add(-1., damped, -radius, dashpots);
      }
    for (const auto &node : supports.moving())
      node.set_held_part(Tensor<1, dim>(), pull);
    inertia.set_coefficient((2. - radius) / (beta * dt * dt));
    resistance.set_coefficient(gamma / (beta * dt));

    model.space->mesh_constraints.distribute(trial.displacement);
    model.space->mesh_constraints.distribute(lift);
    problem.predict(trial.displacement, lift, model.newton.regularization);
    const NewtonResult result = newton.solve(problem, trial.displacement);
    newton_iterations         = result.iterations();
    linear_iterations         = result.linear_iterations();

    for (unsigned int i = 0; i < displacement.locally_owned_size(); ++i)
      if (mass.local_element(i) > 0.)
        {
          const double a =
            (trial.displacement.local_element(i) - predicted.local_element(i)) /
            (beta * dt * dt);
          trial.acceleration.local_element(i) = a;
          trial.velocity.local_element(i) += dt * gamma * a;
        }
      else // follows others
        trial.displacement.local_element(i) = 0.;
    for (const auto &node : supports.moving())
      {
        node.set_held_part(Tensor<1, dim>(), trial.acceleration);
        node.set_held_part(node.held_part(lift) / dt, trial.velocity);
      }
    return result;
  }

  template <int dim>
  double
  ImplicitDynamics<dim>::local_error(const Motion &trial) const
  {
    VectorType change(trial.acceleration);
    change -= acceleration;
    const double scale = std::max(largest, norm(trial.displacement));
    return scale > 0. ?
             (beta - 1. / 6.) * time_step * time_step * norm(change) / scale :
             0.;
  }

  template <int dim>
  void
  ImplicitDynamics<dim>::restart_at_jump()
  {
    if (!(model.times_to_meet.behind_jump(time) > time))
      return;
    const VectorType before(external);
    this->pass_jump();
    VectorType change(acceleration);
    for (unsigned int i = 0; i < change.locally_owned_size(); ++i)
      change.local_element(i) =
        this->inverse_mass.local_element(i) *
        (external.local_element(i) - before.local_element(i));
    supports.project(change);
    acceleration += change;
    if (is_automatic)
      next_step = std::min(next_step, stable_step);
  }

  template <int dim>
  double
  ImplicitDynamics<dim>::end_of_step(const double start)
  {
    // what loads may depart from straight lines within a step
    constexpr double most     = 0.02;
    const double     shortest = shortest_step();
    const double     met = model.times_to_meet.next(start), left = met - start;
    double           size = next_step;
    while (true)
      {
        // Whole steps to the next of these times if their size is given, else
        // the last two are alike: a sliver would be left with the round-off of
        // its inertia.
        const double n    = std::max(1., std::ceil(left / size - 1e-3));
        const double step = !is_automatic || n < 2.5 ? left / n : size;
        const double end  = n < 1.5 ? met : start + step;
        const double bend = model.load_watch.bend(start, end);
        if (!(bend > most))
          return end;
        if (!is_automatic || end - start < 1.01 * shortest)
          {
            warn_of_loads(start, bend);
            return end;
          }
        size = std::max(shortest, 0.5 * (end - start));
      }
  }

  template <int dim>
  void
  ImplicitDynamics<dim>::warn_of_loads(const double start, const double bend)
  {
    if (!has_warned)
      this->output.screen << "  warning: loads vary by "
                          << short_number(100. * bend)
                          << " % within the step from t = "
                          << short_number(start)
                          << (is_automatic ?
                                ", much faster than waves cross a cell\n" :
                                ": a smaller 'Time step', or 0 for automatic "
                                "ones, sees them\n");
    has_warned = true;
  }

  template <int dim>
  void
  ImplicitDynamics<dim>::step()
  {
    const TimeIntegration &parameters = analysis.time_integration;
    restart_at_jump();
    const double start = time;
    old_external       = external;
    Motion trial;
    while (true)
      {
        const double wanted = next_step;
        time                = end_of_step(start);
        time_step           = time - start;
        model.set_time(time);
        const NewtonResult result = solve(trial);
        if (!result.converged)
          {
            refuse_trouble_of_loads(model);
            rejected += 1.;
            next_step = 0.5 * time_step;
            if (next_step < shortest_step())
              throw UserError("the step from t = " + number_text(start),
                              result.reason + ", in a step of " +
                                short_number(time_step) + " s, too",
                              "a step that converges",
                              "another 'Linear solver / Method', more 'Newton "
                              "/ Maximum iterations', shock viscosity, or "
                              "'Scheme = explicit'",
                              ExitStatus::failure);
            time = start;
            continue;
          }
        error = local_error(trial);
        if (!is_automatic)
          {
            next_step = std::min(parameters.time_step,
                                 std::max(next_step, 2. * time_step));
            break;
          }
        const double wish =
          0.8 * time_step *
          std::cbrt(parameters.error_tolerance /
                    std::max(error, 1e-3 * parameters.error_tolerance));
        const double bounded =
          std::clamp(wish,
                     0.2 * time_step,
                     std::max(stable_step, 2. * time_step));
        const bool is_short = time_step <= 1.001 * stable_step;
        if (error > 2. * parameters.error_tolerance && !is_short)
          {
            rejected += 1.;
            next_step = std::max(stable_step, bounded);
            time      = start;
            continue;
          }
        next_step =
          std::min(parameters.longest_step(),
                   std::max(std::min(stable_step, 2. * time_step), bounded));
        // that it had to end early does not make the others shorter
        if (next_step < wanted && time_step < 0.999 * wanted &&
            error < parameters.error_tolerance)
          next_step = wanted;
        break;
      }
    ++n_steps;
    accept(trial);
  }

  template <int dim>
  void
  ImplicitDynamics<dim>::accept(const Motion &trial)
  {
    internal.swap(old_internal);
    if (!absorbing.empty())
      dashpots.swap(old_dashpots);
    const Motion before{displacement, velocity, acceleration};
    displacement = trial.displacement;
    velocity     = trial.velocity;
    acceleration = trial.acceleration;
    this->evaluate_dashpots();
    largest = std::max(largest, norm(displacement));
    DynamicSums own;
    {
      const auto timer = model.ledger.time("constitutive update");
      own = model.mechanics->dynamic_force(displacement, internal, true, -1.);
    }
    const double lost = receipt.time_stepping;
    account(own, before);
    // Contacts that close within a long step may gain energy: no more than a
    // hundredth over the run, or else the next steps are shorter, down to where
    // waves cross a cell.
    constexpr double most = 0.01;
    const double     part = time_step / (analysis.time_integration.end -
                                     analysis.time_integration.start);
    if (is_automatic &&
        lost - receipt.time_stepping > most * part * receipt.largest)
      next_step = std::max(std::min(stable_step, next_step), 0.5 * time_step);
  }

  template <int dim>
  void
  ImplicitDynamics<dim>::account(const DynamicSums &own, const Motion &before)
  {
    // The equation of motion, tested with the increment of the displacement;
    // means are those of the method.
    const double new_part = 1. / (1. + radius), old_part = radius * new_part;
    const auto   mean = [&](const VectorType  &now,
                          const VectorType  &old,
                          const unsigned int i) {
      return new_part * now.local_element(i) + old_part * old.local_element(i);
    };
    double inner = 0., outer = 0., damped = 0., inertia = 0., kinetic = 0.,
           gained = 0.;
    for (unsigned int i = 0; i < displacement.locally_owned_size(); ++i)
      {
        const double m    = mass.local_element(i),
                     path = displacement.local_element(i) -
                            before.displacement.local_element(i),
                     v = velocity.local_element(i),
                     w = before.velocity.local_element(i);
        inner += path * mean(internal, old_internal, i);
        outer += path * mean(external, old_external, i);
        if (!absorbing.empty())
          damped += path * mean(dashpots, old_dashpots, i);
        inertia += path * m * new_part *
                   ((2. - radius) * acceleration.local_element(i) +
                    (2. * radius - 1.) * before.acceleration.local_element(i));
        kinetic += 0.5 * m * v * v;
        gained += 0.5 * m * (v * v - w * w);
      }
    // a prescribed motion takes the force that it takes
    double supported = 0.;
    for (const auto &node : supports.moving())
      {
        const Tensor<1, dim> path = node.held_part(displacement) -
                                    node.held_part(before.displacement),
                             v = node.held_part(velocity),
                             w = node.held_part(before.velocity);
        const double change    = 0.5 * mass.local_element(node.index[0]) *
                              (v.norm_square() - w.norm_square());
        supported += change;
        gained -= change;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int i = node.index[d];
            double             force =
              mean(internal, old_internal, i) - mean(external, old_external, i);
            if (!absorbing.empty())
              force += mean(dashpots, old_dashpots, i);
            supported += path[d] * force;
          }
      }
    this->enter_step(
      inner + inertia - gained, outer + supported, damped, kinetic, own);
  }

  template class ImplicitDynamics<2>;
  template class ImplicitDynamics<3>;
} // namespace Signoton
