#include <signoton/base/number.h>
#include <signoton/base/quoting.h>
#include <signoton/drivers/point.h>
#include <signoton/rheology/classification.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <sstream>

// What the file of a material point says: its keys, and what they mean.

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
  } // namespace

  void
  PointDriver::add_parameters()
  {
    handler.add_parameter("Title", title, "What the file shows.");
    handler.enter_subsection("Materials");
    handler.enter_subsection(constants->name);
    constants->add_parameters(handler);
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
  PointDriver::refuse(const std::string &key,
                      const std::string &found,
                      const std::string &expected,
                      const std::string &hint) const
  {
    throw UserError(file.where({"Program"}, key), found, expected, hint);
  }

  void
  PointDriver::interpret()
  {
    material = constants->make(file);
    for (unsigned int c = 0; c < 6; ++c)
      components[c].factor = c < 3 ? 1. : std::sqrt(2.);
    interpret_components();
    interpret_kind();
    interpret_times();
    choose_axes();
    by_strain = stress_is_given() == std::array<bool, 6>{};
    if (by_strain)
      Rheology::require_stress_from_strain(material->scheme, material->where);
    else
      Rheology::require_resistance(material->scheme, material->where);
    law = std::make_unique<PointLaw>(*material);
    law->set_control(stress_is_given());
  }

  void
  PointDriver::interpret_components()
  {
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
          if (kind != "components")
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
          give(mandel_index[c], text, is_stress, file.where({"Program"}, key));
        }
  }

  void
  PointDriver::interpret_kind()
  {
    const bool by_component = kind == "components",
               is_shear     = kind == "simple shear",
               is_uniaxial  = kind == "uniaxial",
               is_triaxial  = kind == "triaxial",
               both         = !strain_text.empty() && !stress_text.empty(),
               any          = !strain_text.empty() || !stress_text.empty();
    if (by_component == any || both)
      refuse(strain_text.empty() ? "Stress" : "Strain",
             by_component ? "Strain or Stress with Kind 'components'" :
             !any         ? "neither Strain nor Stress" :
                            "both Strain and Stress",
             by_component ? "keys with a component, 'Strain xx'" :
                            "one of them",
             "for instance 'set Strain = 0: 0, 1: -1e-3, 2: 0'");
    if (file.has({"Program"}, "Confining pressure") && !is_triaxial &&
        !is_shear)
      refuse("Confining pressure",
             "a value with Kind '" + kind + "'",
             "Kind triaxial or simple shear",
             "remove it, it would have no effect");
    if (by_component)
      return;
    const bool        by_stress = strain_text.empty();
    const std::string text      = by_stress ? stress_text : strain_text;
    const std::string place =
      file.where({"Program"}, by_stress ? "Stress" : "Strain");
    std::ostringstream side;
    side.precision(17);
    side << -confining_pressure;
    if (kind == "hydrostatic")
      for (unsigned int c = 0; c < 3; ++c)
        {
          give(c, text, by_stress, place);
          components[c].factor = by_stress ? 1. : 1. / 3.;
        }
    else
      give(is_shear ? mandel_index[3] : 0, text, by_stress, place);
    // what else the apparatus prescribes
    if (is_uniaxial || is_triaxial)
      for (unsigned int c = 1; c < (is_uniaxial ? 6u : 3u); ++c)
        give(c, side.str(), true, place);
    if (is_shear)
      give(1, side.str(), true, place);
  }

  void
  PointDriver::choose_axes()
  {
    std::string driven = kind == "simple shear" ? "xy" : "xx";
    for (unsigned int c = 6; kind == "components" && c-- > 0;)
      if (components[mandel_index[c]].program)
        driven = component_names[c];
    if (horizontal.empty())
      horizontal = kind == "hydrostatic" ? "volume strain" : "strain " + driven;
    if (vertical.empty())
      vertical = kind == "hydrostatic" ? "mean stress" : "stress " + driven;
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
} // namespace Signoton
