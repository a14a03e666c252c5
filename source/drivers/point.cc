#include <signoton/base/quoting.h>
#include <signoton/base/signals.h>
#include <signoton/drivers/point.h>
#include <signoton/rheology/classification.h>

#include <deal.II/base/conditional_ostream.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace Signoton
{
  using namespace Rheology;

  namespace
  {
    double
    size(const Vector6 &v)
    {
      return std::sqrt(dot(v, v));
    }
  } // namespace

  PointDriver::PointDriver(const MPI_Comm &communicator, const SceneFile &file)
    : communicator(communicator)
    , file(file)
  {
    const auto names = file.subsections({"Materials"});
    if (names.size() != 1)
      throw UserError(file.where({"Materials"}),
                      std::to_string(names.size()) + " materials",
                      "one, the material of the point",
                      "'subsection Materials', 'subsection sand', 'set "
                      "Rheology = ...'");
    constants.emplace(names[0]);
    add_parameters();
    file.apply_to(handler);
    title     = unquoted(title);
    directory = unquoted(directory);
    interpret();
  }

  std::array<bool, 6>
  PointDriver::stress_is_given() const
  {
    std::array<bool, 6> result{};
    for (unsigned int c = 0; c < 6; ++c)
      result[c] = components[c].program && components[c].is_stress;
    return result;
  }

  std::string
  PointDriver::explanation() const
  {
    return material->description() + "\n" + law->description();
  }

  std::optional<PointDriver::State>
  PointDriver::step(const State &from, const double time_step)
  {
    Vector6 given = origin;
    for (unsigned int c = 0; c < 6; ++c)
      if (components[c].program)
        given[c] = (components[c].is_stress ? 0. : origin[c]) +
                   components[c].factor *
                     (*components[c].program)(from.time + time_step);
    auto found = law->step(from, given, time_step);
    if (!found)
      return {};
    // a stress that the scheme cannot bear is not met by strains without end
    const double allowed =
      1e-8 * std::max(stress_scale, size(found->stress)) +
      law->round_off(std::max(strain_scale, size(found->strain)));
    for (unsigned int c = 0; c < 6; ++c)
      if (components[c].program && components[c].is_stress &&
          std::abs(found->stress[c] - given[c]) > allowed)
        return {};
    return found;
  }

  std::optional<PointDriver::State>
  PointDriver::start()
  {
    const double least = resolution * (end_time - start_time);
    const State  rest  = law->at_rest(start_time - least);
    // the answer to what is given at the start, at once: dampers stand still
    std::optional<State> state;
    if (kind == "triaxial")
      {
        law->set_control({{true, true, true, false, false, false}});
        Vector6 pressure{};
        for (unsigned int c = 0; c < 3; ++c)
          pressure[c] = -confining_pressure;
        state = law->step(rest, pressure, least);
        law->set_control(stress_is_given());
        if (state)
          origin = state->strain;
      }
    else
      state = step(rest, least);
    if (state)
      state->time = start_time;
    return state;
  }

  double
  PointDriver::difference(const State &a, const State &b) const
  {
    const auto relative = [](const Vector6 &u,
                             const Vector6 &v,
                             const double   scale,
                             const double   round_off) {
      const double error   = size(add_scaled(u, -1., v)),
                   largest = std::max({scale, size(u), size(v)});
      return error > round_off ? error / largest : 0.;
    };
    // rigid schemes have strains of round-off, loose ones stresses
    const double least = 1e-3 * stress_scale / law->stiffness();
    const double strain =
      std::max({strain_scale, size(a.strain), size(b.strain), least});
    double error = std::max(
      relative(a.strain, b.strain, strain, 0.),
      relative(a.stress, b.stress, stress_scale, law->round_off(strain)));
    // what relaxes behind an open contact shows later
    for (std::size_t k = 0; k < a.tensors.size(); ++k)
      error = std::max(error, relative(a.tensors[k], b.tensors[k], strain, 0.));
    for (std::size_t k = 0; k < a.scalars.size(); ++k)
      if (const double d = std::abs(a.scalars[k] - b.scalars[k]); d > 0.)
        error = std::max(error, d / strain);
    return error;
  }

  ExitStatus
  PointDriver::run()
  {
    results = std::make_unique<OutputDirectory>(communicator, directory);
    results->begin("point\\.(csv|gp|svg)");
    try
      {
        return drive();
      }
    catch (const UserError &)
      {
        write(); // what was accepted before
        throw;
      }
  }

  ExitStatus
  PointDriver::drive()
  {
    ConditionalOStream screen(std::cout,
                              Utilities::MPI::this_mpi_process(communicator) ==
                                0);
    const SignalWatch  watch;
    screen << explanation() << std::flush;
    const double least = resolution * (end_time - start_time);
    // a step over which a jump is taken, as when a damper strikes
    const double jump    = 1e-5 * (end_time - start_time);
    unsigned int n_steps = 0, n_cut = 0, most_iterations = 0;
    double       dt         = step_size;
    State        state      = law->at_rest(start_time);
    bool         has_failed = false, is_interrupted = false;
    if (const auto first = start())
      state = *first;
    else
      has_failed = true;
    if (!has_failed)
      record(state);
    while (!has_failed && !is_interrupted && end_time - state.time > least)
      {
        double target = times_to_meet.next(state.time + least);
        if (end_time - target < least)
          target = end_time;
        const double left = target - state.time;
        // whole steps to the turning point, of nearly the same size
        const double wanted = std::min(dt, step_size);
        const double h = left / std::max(1., std::ceil(left / wanted - 1e-9));
        std::optional<State> one, half, two;
        double               error = 0.;
        if (tolerance > 0.)
          {
            one  = step(state, h);
            half = step(state, 0.5 * h);
            if (half)
              two = step(*half, 0.5 * h);
            if (one && two)
              error = difference(*one, *two);
          }
        else
          two = step(state, h);
        if (!two ||
            (tolerance > 0. && (!one || (error > tolerance && h > jump))))
          {
            dt =
              two && one ?
                h * std::clamp(0.9 * std::sqrt(tolerance / error), 0.1, 0.7) :
                0.25 * h;
            ++n_cut;
            has_failed = !(dt > least);
            continue;
          }
        if (tolerance > 0.)
          {
            record(*half);
            dt =
              h * (error > 0. ?
                     std::clamp(0.9 * std::sqrt(tolerance / error), 0.5, 2.) :
                     2.);
            dt = std::max(dt, jump);
          }
        else
          dt = 2. * h;
        state = *two;
        if (target - state.time < least)
          state.time = target;
        record(state);
        ++n_steps;
        most_iterations = std::max(most_iterations, state.iterations);
        is_interrupted =
          Utilities::MPI::max(SignalWatch::received(), communicator) != 0;
      }
    const bool drawn = write();
    screen << n_steps << " steps, " << n_cut
           << " repeated with a smaller size; "
           << "at most " << most_iterations << " local iterations\n"
           << "Results: " << directory << "/point.csv"
           << (drawn ? ", point.svg" : "") << "\n";
    if (is_interrupted)
      {
        screen << "A signal ends the program at t = " << state.time << "\n";
        return interrupted;
      }
    if (!has_failed)
      return ExitStatus::completed;
    screen << "No state found that follows t = " << state.time
           << " by the program. The lines before are complete.\n"
           << "  " << classification(material->scheme) << "\n"
           << (by_strain ?
                 "  try: smaller strains, or moduli that differ less\n" :
                 "  try: a program that stays within the strength, or by "
                 "strain instead of stress\n");
    return ExitStatus::no_equilibrium;
  }
} // namespace Signoton
