#include <signoton/base/number.h>
#include <signoton/base/output_file.h>
#include <signoton/base/quoting.h>
#include <signoton/base/signals.h>
#include <signoton/drivers/point.h>
#include <signoton/rheology/classification.h>

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace Signoton
{
  using namespace Rheology;

  namespace
  {
    const std::array<const char *, 6> component_names = {
      {"xx", "yy", "zz", "xy", "xz", "yz"}};

    /** Where they are in Mandel's order. */
    const std::array<unsigned int, 6> mandel_index = [] {
      std::array<unsigned int, 6> result{};
      for (unsigned int c = 0; c < 6; ++c)
        {
          Tensor2<> unit;
          unit.access_raw_entry(c) = 1.;
          const Vector6 v          = to_mandel(unit);
          result[c] = std::max_element(v.begin(), v.end()) - v.begin();
        }
      return result;
    }();

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
    material.emplace(names[0]);
    add_parameters();
    file.apply_to(handler);
    title     = unquoted(title);
    directory = unquoted(directory);
    interpret();
  }

  void
  PointDriver::add_parameters()
  {
    handler.add_parameter("Title", title, "What the file shows.");
    handler.enter_subsection("Materials");
    handler.enter_subsection(material->name);
    material->add_parameters(handler);
    handler.leave_subsection();
    handler.leave_subsection();
    handler.enter_subsection("Schemes");
    for (const auto &name : file.keys({"Schemes"}))
      handler.declare_entry(name,
                            "",
                            Patterns::Anything(),
                            "A scheme by name.");
    handler.leave_subsection();

    const std::string numbers =
      "An expression in t and the constants, or a table 't: value, t: value' "
      "with straight lines in between. ";
    handler.enter_subsection("Program");
    handler.add_parameter(
      "Kind",
      kind,
      "oedometer: Strain or Stress is the component xx, all other strains are "
      "zero. uniaxial: the component xx, all other stresses are zero. "
      "triaxial: "
      "the component xx, the stresses yy and zz are minus the confining "
      "pressure; it starts with all three, and strains count from there. "
      "simple shear: the component xy, the stress yy is minus the "
      "confining pressure, other strains are zero. hydrostatic: the volume "
      "strain or the mean stress, no shear. components: each component by its "
      "own key, strains are zero where nothing is given.",
      Patterns::Selection(
        "oedometer|uniaxial|triaxial|simple shear|hydrostatic|components"));
    handler.add_parameter("Strain", strain_text, numbers);
    handler.add_parameter("Stress", stress_text, numbers + "In Pa.");
    handler.add_parameter("Confining pressure",
                          confining_pressure,
                          "In Pa, from the start on.",
                          Patterns::Double(0., largest_number));
    for (unsigned int c = 0; c < 6; ++c)
      {
        const std::string name = component_names[c];
        handler.add_parameter("Strain " + name,
                              components[mandel_index[c]].strain_text,
                              numbers);
        handler.add_parameter("Stress " + name,
                              components[mandel_index[c]].stress_text,
                              numbers + "In Pa.");
      }
    handler.add_parameter("Constants",
                          constants_text,
                          "For the expressions: 'r = 1e-3, T = 2'.");
    const Patterns::Double time(-largest_number, largest_number);
    handler.add_parameter("Start time", start_time, "In s.", time);
    handler.add_parameter("End time",
                          end_time,
                          "In s; by default where the last table ends, or 1.",
                          time);
    handler.add_parameter("Turning points",
                          turning_text,
                          "Times in s, separated by commas, that steps have to "
                          "meet; those of tables, and those at which "
                          "expressions bend or jump, are met anyway.");
    handler.leave_subsection();

    handler.enter_subsection("Time steps");
    handler.add_parameter("Largest step",
                          step_size,
                          "In s; 0: a hundredth of the program.",
                          Patterns::Double(0., largest_number));
    handler.add_parameter(
      "Tolerance",
      tolerance,
      "Error that a step may add to stress, strain and what "
      "the elements remember, relative to the largest so "
      "far; 0: all steps are as "
      "large as they may be.",
      Patterns::Double(0., 1.));
    handler.leave_subsection();

    handler.enter_subsection("Output");
    handler.add_parameter("Directory",
                          directory,
                          "Directory of the results; by default output/ and "
                          "the name of the file.");
    std::string choices = columns[0];
    for (std::size_t c = 1; c < columns.size(); ++c)
      choices += "|" + columns[c];
    handler.add_parameter("Plot horizontal",
                          horizontal,
                          "Column of point.csv on the horizontal axis; by "
                          "default the strain that is driven.",
                          Patterns::Selection("|" + choices));
    handler.add_parameter("Plot vertical",
                          vertical,
                          "Column on the vertical axis; by default its stress.",
                          Patterns::Selection("|" + choices));
    handler.leave_subsection();
  }

  void
  PointDriver::give(const unsigned int component,
                    const std::string &text,
                    const bool         is_stress,
                    const std::string &where)
  {
    Component &c = components[component];
    c.program.emplace(text,
                      parse_constants(constants_text,
                                      file.where({"Program"}, "Constants")),
                      where);
    c.is_stress = is_stress;
  }

  void
  PointDriver::interpret()
  {
    const SceneFile::Path path   = {"Program"};
    const auto            refuse = [&](const std::string &key,
                            const std::string &found,
                            const std::string &expected,
                            const std::string &hint) {
      throw UserError(file.where(path, key), found, expected, hint);
    };
    material->check(file);
    for (unsigned int c = 0; c < 6; ++c)
      components[c].factor = c < 3 ? 1. : std::sqrt(2.);

    const bool by_component = kind == "components";
    for (unsigned int c = 0; c < 6; ++c)
      for (const bool is_stress : {false, true})
        {
          const std::string key =
            std::string(is_stress ? "Stress " : "Strain ") + component_names[c];
          const Component  &target = components[mandel_index[c]];
          const std::string text =
            is_stress ? target.stress_text : target.strain_text;
          if (text.empty())
            continue;
          if (!by_component)
            refuse(key,
                   "'" + text + "' with Kind '" + kind + "'",
                   "Strain or Stress, without a component",
                   "or 'set Kind = components'");
          if (target.program)
            refuse(key,
                   "both strain and stress of " +
                     std::string(component_names[c]),
                   "one of them",
                   "the other is what the point answers");
          give(mandel_index[c], text, is_stress, file.where(path, key));
        }
    if (by_component == (!strain_text.empty() || !stress_text.empty()) ||
        (!strain_text.empty() && !stress_text.empty()))
      refuse(strain_text.empty() ? "Stress" : "Strain",
             by_component ? "Strain or Stress with Kind 'components'" :
             strain_text.empty() && stress_text.empty() ?
                            "neither Strain nor Stress" :
                            "both Strain and Stress",
             by_component ? "keys with a component, 'Strain xx'" :
                            "one of them",
             "for instance 'set Strain = 0: 0, 1: -1e-3, 2: 0'");
    const bool is_shear = kind == "simple shear",
               confined = kind == "triaxial" || is_shear;
    if (file.has(path, "Confining pressure") && !confined)
      refuse("Confining pressure",
             "a value with Kind '" + kind + "'",
             "Kind triaxial or simple shear",
             "remove it, it would have no effect");
    const bool        by_stress = strain_text.empty();
    const std::string text      = by_stress ? stress_text : strain_text;
    const std::string place = file.where(path, by_stress ? "Stress" : "Strain");
    std::ostringstream side;
    side.precision(17);
    side << -confining_pressure;
    if (kind == "hydrostatic")
      for (unsigned int c = 0; c < 3; ++c)
        {
          give(c, text, by_stress, place);
          components[c].factor = by_stress ? 1. : 1. / 3.;
        }
    else if (!by_component)
      give(is_shear ? mandel_index[3] : 0, text, by_stress, place);
    if (kind == "uniaxial" || kind == "triaxial")
      for (unsigned int c = 1; c < (kind == "uniaxial" ? 6u : 3u); ++c)
        give(c, side.str(), true, place);
    if (is_shear)
      give(1, side.str(), true, place);

    interpret_times();
    std::string driven = is_shear ? "xy" : "xx";
    for (unsigned int c = 6; by_component && c-- > 0;)
      if (components[mandel_index[c]].program)
        driven = component_names[c];
    if (horizontal.empty())
      horizontal = kind == "hydrostatic" ? "volume strain" : "strain " + driven;
    if (vertical.empty())
      vertical = kind == "hydrostatic" ? "mean stress" : "stress " + driven;
    by_strain = stress_is_given() == std::array<bool, 6>{};
    if (by_strain)
      material->require_stress_from_strain();
    else
      material->require_resistance();
    law = std::make_unique<PointLaw>(*material);
    law->set_control(stress_is_given());
  }

  void
  PointDriver::interpret_times()
  {
    const SceneFile::Path path = {"Program"};
    std::optional<double> end_of_tables;
    for (const Component &c : components)
      if (const auto end = c.program ? c.program->end_of_table() : std::nullopt)
        end_of_tables = std::max(*end, end_of_tables.value_or(*end));
    if (!file.has(path, "End time") && end_of_tables)
      end_time = *end_of_tables;
    // steps down to a part of the program have to move the clock
    const double length = end_time - start_time;
    if (!(length > 1e-5 * std::max(std::abs(start_time), std::abs(end_time))))
      throw UserError(file.where(path, "End time"),
                      number_text(end_time),
                      "a time after the start at " + number_text(start_time),
                      "set it");
    times_to_meet = TimesToMeet(start_time, end_time);
    for (const double time :
         read_times(turning_text, file.where(path, "Turning points")))
      times_to_meet.add(time);
    for (const Component &c : components)
      if (c.program)
        if (const auto kinks = c.program->kinks(start_time, end_time);
            kinks.size() <= most_kinks)
          times_to_meet.add(kinks);
    step_size = step_size > 0. ? std::min(step_size, length) : length / 100.;
    if (!(length / step_size <= 1e7))
      throw UserError(file.where({"Time steps"}, "Largest step"),
                      number_text(step_size) + ", " +
                        number_text(std::round(length / step_size)) + " steps",
                      "at most 1e7 steps",
                      "'Tolerance' makes steps short where it is needed");
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
           << "  " << classification(material->scheme()) << "\n"
           << (by_strain ?
                 "  try: smaller strains, or moduli that differ less\n" :
                 "  try: a program that stays within the strength, or by "
                 "strain instead of stress\n");
    return ExitStatus::no_equilibrium;
  }
} // namespace Signoton
