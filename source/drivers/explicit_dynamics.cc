#include <signoton/base/number.h>
#include <signoton/drivers/explicit_dynamics.h>
#include <signoton/drivers/run_checks.h>

namespace Signoton
{
  template <int dim>
  void
  ExplicitDynamics<dim>::setup()
  {
    Dynamics<dim>::setup();
    stable_step = model.mechanics->stable_time_step() *
                  analysis.wave_refinement.finest_part(*model.space);
    // viscosity shortens the stable step by the part of critical damping
    const double part = analysis.time_integration.shock_viscosity.bound();
    stable_step *= std::sqrt(1. + part * part) - part;
  }

  template <int dim>
  void
  ExplicitDynamics<dim>::choose_step()
  {
    const TimeIntegration &parameters = analysis.time_integration;
    if (parameters.time_step > stable_step)
      throw UserError(model.file.where({"Time integration"}, "Time step"),
                      number_text(parameters.time_step),
                      "at most the stable step, " + number_text(stable_step) +
                        " s",
                      "leave it out: 'Safety' chooses a part of the stable "
                      "step");
    const double wanted = parameters.time_step > 0. ?
                            parameters.time_step :
                            parameters.safety * stable_step;
    const double all    = (parameters.end - time) / wanted;
    check_steps(model.file.where({"Time integration"},
                                 parameters.time_step > 0. ? "Time step" :
                                                             "End time"),
                wanted,
                parameters.start,
                parameters.end,
                all,
                all / parameters.statistics_every,
                std::string("end earlier, ") +
                  (parameters.time_step > 0. ? "take longer steps" :
                                               "let the mesh be coarser") +
                  ", or take 'Scheme = implicit'");
    next_to_meet      = model.times_to_meet.next(time);
    const double left = next_to_meet - time;
    steps_left =
      std::max(1U, static_cast<unsigned int>(std::ceil(left / wanted - 1e-9)));
    time_step = left / steps_left;
    model.mechanics->set_time_step(time_step);
  }

  template <int dim>
  std::string
  ExplicitDynamics<dim>::introduction() const
  {
    return "Steps of " + short_number(time_step) + " s; stable are up to " +
           short_number(stable_step) + " s";
  }

  template <int dim>
  void
  ExplicitDynamics<dim>::add_columns(CSVTable::Row &row) const
  {
    row.emplace_back("share of quiet cells", quiet_share);
  }

  template <int dim>
  std::pair<std::string, std::string>
  ExplicitDynamics<dim>::screen_column() const
  {
    return {"quiet %", short_number(100. * quiet_share)};
  }

  template <int dim>
  std::vector<std::pair<std::string, double *>>
  ExplicitDynamics<dim>::numbers_to_keep()
  {
    auto numbers = Dynamics<dim>::numbers_to_keep();
    numbers.emplace_back("largest displacement", &largest_displacement);
    return numbers;
  }

  template <int dim>
  double
  ExplicitDynamics<dim>::quiet_displacement()
  {
    if (!analysis.time_integration.quiet_zones)
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
  std::pair<double, double>
  ExplicitDynamics<dim>::move()
  {
    std::pair<double, double> before{0., 0.};
    internal.swap(old_internal);
    if (loads.vary())
      external.swap(old_external);
    if (!absorbing.empty())
      dashpots.swap(old_dashpots);
    for (const auto &node : supports.moving())
      before.first += mass.local_element(node.index[0]) *
                      node.held_part(velocity).norm_square();
    const unsigned int n = displacement.locally_owned_size();
    for (unsigned int i = 0; i < n; ++i)
      {
        const double a = acceleration.local_element(i);
        before.second += mass.local_element(i) * a * a;
        velocity.local_element(i) += 0.5 * time_step * a;
      }
    supports.move(displacement, time, time_step, velocity);
    for (unsigned int i = 0; i < n; ++i)
      displacement.local_element(i) += time_step * velocity.local_element(i);
    return before;
  }

  template <int dim>
  void
  ExplicitDynamics<dim>::step()
  {
    if (steps_left == 0)
      choose_step();
    if (this->pass_jump())
      this->accelerate(0.);
    std::pair<double, double> before;
    {
      const auto timer = model.ledger.time("time integration");
      before           = move();
    }
    --steps_left;
    ++n_steps;
    time = next_to_meet - steps_left * time_step;
    this->evaluate_loads();
    DynamicSums own;
    {
      const auto timer = model.ledger.time("constitutive update");
      own              = model.mechanics->dynamic_force(displacement,
                                           internal,
                                           this->is_observed(),
                                           quiet_displacement());
    }
    const auto timer = model.ledger.time("time integration");
    this->accelerate(time_step);
    for (unsigned int i = 0; i < velocity.locally_owned_size(); ++i)
      velocity.local_element(i) +=
        0.5 * time_step * acceleration.local_element(i);
    this->evaluate_dashpots();
    account(own, before);
    if (std::isfinite(receipt.kinetic))
      return;
    refuse_trouble_of_loads(model);
    throw UserError("t = " + number_text(time),
                    "a velocity that is not a number",
                    "a stable run",
                    "a smaller 'Time integration / Safety'",
                    ExitStatus::failure);
  }

  template <int dim>
  void
  ExplicitDynamics<dim>::account(const DynamicSums               &own,
                                 const std::pair<double, double> &before)
  {
    const double       dt = time_step;
    const unsigned int n  = displacement.locally_owned_size();
    // work of the mean of the forces before and after
    const VectorType &external_before = loads.vary() ? old_external : external;
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
    double supported = -0.5 * before.first;
    for (const auto &node : supports.moving())
      {
        const Tensor<1, dim> v = node.held_part(velocity);
        Tensor<1, dim> force   = node.read(internal) + node.read(old_internal) -
                               node.read(external) - node.read(external_before);
        if (!absorbing.empty())
          force += node.read(dashpots) + node.read(old_dashpots);
        supported += 0.5 * mass.local_element(node.index[0]) * v.norm_square() +
                     0.5 * dt * (v * force);
      }
    const DynamicSums sums =
      this->enter_step(inner - 0.125 * dt * dt * (half_after - before.second),
                       outer + supported,
                       damped,
                       0.5 * kinetic,
                       own);
    quiet_share = sums.quiet_cells / model.space->mesh.n_global_active_cells();
  }

  template class ExplicitDynamics<2>;
  template class ExplicitDynamics<3>;
} // namespace Signoton
