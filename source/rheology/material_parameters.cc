#include <signoton/base/number.h>
#include <signoton/base/quoting.h>
#include <signoton/rheology/library.h>
#include <signoton/rheology/material_parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

// The constants of a material in the scene file, and what is asked of them.

namespace Signoton::Rheology
{
  namespace
  {
    constexpr double degree = numbers::PI / 180.;

    bool
    contains(const std::vector<std::string> &list, const std::string &item)
    {
      return std::find(list.begin(), list.end(), item) != list.end();
    }
    /** The size of a number, zero for other texts. */
    double
    size_of(const std::string &text)
    {
      char        *end   = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      return *end == '\0' ? std::abs(value) : 0.;
    }
  } // namespace

  void
  MaterialParameters::add_parameters(ParameterHandler &handler)
  {
    const Patterns::Double non_negative(0.);
    handler.add_parameter("Material id",
                          id,
                          "The material id of the cells that consist of it.",
                          Patterns::Integer(0));
    std::vector<std::string> names;
    for (const auto &scheme : ready_schemes())
      names.push_back(
        scheme.name +
        (scheme.figure.empty() ? "" : " (Fig. " + scheme.figure + ")") + ": " +
        scheme.text);
    handler.add_parameter(
      "Rheology",
      rheology,
      "The scheme of springs, dampers, plastic hinges and rigid contacts: by "
      "the name of a ready one, of one in the section Schemes, or written out, "
      "as series(spring(bulk = 1e8, shear = 6e7), contact(coulomb mohr, "
      "friction angle = 30)). Ready ones take their constants from the keys of "
      "the material: " +
        join(names, ". ") + ".");
    handler.add_parameter(
      "Admissible set",
      admissible_set,
      "The set that confines the stress. mises schleicher: tau <= kappa p + "
      "cohesion. coulomb mohr: Mohr's circles below c + tan(phi) pressure. no "
      "tension: principal stresses below the tensile strength. von mises, "
      "tresca: cylinders of the shear strength, for plastic hinges.",
      Patterns::Selection(
        "mises schleicher|coulomb mohr|no tension|von mises|tresca"));
    handler.add_parameter("Bulk modulus",
                          bulk_modulus,
                          "Bulk modulus k of the spring in Pa, positive.",
                          non_negative);
    handler.add_parameter("Shear modulus",
                          shear_modulus,
                          "Shear modulus mu of the spring in Pa, positive.",
                          non_negative);
    handler.add_parameter("Young modulus",
                          young_modulus,
                          "Young's modulus in Pa, positive; with Poisson "
                          "ratio, instead of bulk and shear modulus.",
                          non_negative);
    handler.add_parameter("Poisson ratio",
                          poisson_ratio,
                          "Poisson's ratio, above -1 and below 0.5.",
                          Patterns::Double(-0.9999999, 0.49999999));
    handler.add_parameter("Density",
                          density,
                          "Mass density in kg/m^3; gravity acts on it.",
                          non_negative);
    handler.add_parameter("Friction parameter",
                          friction_parameter,
                          "kappa of the von Mises-Schleicher cone, "
                          "dimensionless and positive.",
                          non_negative);
    handler.add_parameter("Friction angle",
                          friction_angle,
                          "phi of the Coulomb-Mohr cone in degrees, between "
                          "1.6 and 89.9.",
                          Patterns::Double(0., 89.9));
    handler.add_parameter("Cohesion",
                          cohesion,
                          "Shear strength at zero pressure in Pa: c of "
                          "Coulomb-Mohr, tau at p = 0 of von "
                          "Mises-Schleicher.",
                          non_negative);
    handler.add_parameter("Tensile strength",
                          tensile_strength,
                          "Largest principal stress of the no tension set in "
                          "Pa.",
                          non_negative);
    handler.add_parameter("Shear strength",
                          shear_strength,
                          "tau_Y of the von Mises and Tresca cylinders in Pa: "
                          "the strength in simple shear.",
                          non_negative);
    handler.add_parameter(
      "Plastic flow",
      plastic_flow,
      "Which stress of an elastic plastic granular material the hinge sees. "
      "series: that of the contact, as the scheme says. conditional: the one "
      "that the spring would have with all pores closed, which is confined to "
      "the yield set first and to the cone then; loosened material yields, "
      "too. They agree until loosened material is sheared.",
      Patterns::Selection("series|conditional"));
    handler.add_parameter(
      "Binder",
      binder_kind,
      "A second spring in parallel with the contact, which keeps loosened "
      "zones together. none: none. proportional: the spring scaled so that "
      "the law is lambda times elastic plus (1 - lambda) times granular. "
      "moduli: by its own bulk and shear modulus.",
      Patterns::Selection("none|proportional|moduli"));
    handler.add_parameter("Binder ratio",
                          proportional_binder,
                          "lambda of the proportional binder, between 0 and "
                          "1; in loosened zones the stiffness is lambda times "
                          "the elastic one.",
                          Patterns::Double(0., 0.999));
    handler.add_parameter("Binder bulk modulus",
                          binder_bulk_modulus,
                          "Bulk modulus of the binder in Pa.",
                          non_negative);
    handler.add_parameter("Binder shear modulus",
                          binder_shear_modulus,
                          "Shear modulus of the binder in Pa.",
                          non_negative);
    handler.add_parameter("Isotropic hardening modulus",
                          isotropic_hardening_modulus,
                          "H in tau_Y + H gamma of the von Mises hinge, gamma "
                          "the accumulated plastic shear; in Pa.",
                          non_negative);
    handler.add_parameter("Kinematic hardening modulus",
                          kinematic_hardening_modulus,
                          "Shear back stress per plastic shear of the von "
                          "Mises hinge (Prager) in Pa.",
                          non_negative);
    handler.add_parameter("Bulk viscosity",
                          bulk_viscosity,
                          "Of the damper, in Pa s.",
                          non_negative);
    handler.add_parameter("Shear viscosity",
                          shear_viscosity,
                          "Of the damper, in Pa s.",
                          non_negative);
    handler.add_parameter("Second bulk modulus",
                          second_bulk_modulus,
                          "Of the second spring of a ready scheme, in Pa: "
                          "binder, hardening, fibers.",
                          non_negative);
    handler.add_parameter("Second shear modulus",
                          second_shear_modulus,
                          "Of the second spring, in Pa.",
                          non_negative);
    handler.add_parameter("Gap",
                          gap,
                          "Volumetric strain, as a positive number, after "
                          "which pores are closed.",
                          non_negative);
  }

  std::vector<std::string>
  MaterialParameters::required_keys() const
  {
    std::vector<std::string> keys = {"Rheology"};
    if (uses_set())
      {
        if (!uses("bound cone and hinge"))
          keys.emplace_back("Admissible set");
        if (admissible_set == "mises schleicher")
          keys.emplace_back("Friction parameter");
        else if (admissible_set == "coulomb mohr")
          keys.emplace_back("Friction angle");
      }
    if (uses("hinge") || uses("bound cone and hinge") ||
        (uses_set() &&
         (admissible_set == "von mises" || admissible_set == "tresca")))
      keys.emplace_back("Shear strength");
    if (may_be_bound() && binder_kind == "moduli")
      {
        keys.emplace_back("Binder bulk modulus");
        keys.emplace_back("Binder shear modulus");
      }
    if (uses("damper"))
      keys.emplace_back("Shear viscosity");
    if (uses("cohesive hinge"))
      keys.emplace_back("Cohesion");
    if (uses("second spring"))
      {
        keys.emplace_back("Second bulk modulus");
        keys.emplace_back("Second shear modulus");
      }
    if (uses("contact with gap"))
      keys.emplace_back("Gap");
    return keys;
  }

  std::vector<std::string>
  MaterialParameters::optional_keys() const
  {
    std::vector<std::string> keys = {"Material id", "Density"};
    if (uses("spring"))
      for (const char *key :
           {"Bulk modulus", "Shear modulus", "Young modulus", "Poisson ratio"})
        keys.emplace_back(key);
    if (uses("bound cone and hinge"))
      {
        keys.emplace_back("Admissible set");
        keys.emplace_back("Plastic flow");
      }
    if (uses_set() && !uses("contact with gap"))
      {
        if (admissible_set == "mises schleicher" ||
            admissible_set == "coulomb mohr")
          keys.emplace_back("Cohesion");
        if (admissible_set == "no tension")
          keys.emplace_back("Tensile strength");
      }
    if (may_be_bound())
      {
        keys.emplace_back("Binder");
        if (binder_kind == "proportional")
          keys.emplace_back("Binder ratio");
      }
    if (uses("hinge on set") && admissible_set == "von mises")
      {
        keys.emplace_back("Isotropic hardening modulus");
        keys.emplace_back("Kinematic hardening modulus");
      }
    if (uses("damper"))
      keys.emplace_back("Bulk viscosity");
    return keys;
  }

  void
  MaterialParameters::refuse(const SceneFile   &file,
                             const std::string &key,
                             const std::string &expected,
                             const std::string &hint) const
  {
    const SceneFile::Path path = {"Materials", name};
    throw UserError(file.where(path, key),
                    file.has(path, key) ? "'" + file.value(path, key) + "'" :
                                          "no value",
                    expected,
                    hint);
  }

  void
  MaterialParameters::find_rheology(const SceneFile &file)
  {
    where = file.where({"Materials", name}, "Rheology");
    for (const std::string &key : file.keys({"Schemes"}))
      {
        if (ready_scheme(key) != nullptr || !is_scheme_name(key))
          throw UserError(file.where({"Schemes"}, key),
                          "the name '" + key + "'",
                          "a name that is not one of an element, a group or a "
                          "ready scheme",
                          "'my " + key + "', for instance");
        definitions[key] = file.value({"Schemes"}, key);
      }
    if (ready_scheme(unquoted(rheology)) != nullptr)
      rheology = unquoted(rheology);
    for (const auto &[key, text] : definitions)
      parse_scheme(text, file.where({"Schemes"}, key), definitions);
    const bool is_written = rheology.find('(') != std::string::npos ||
                            definitions.count(unquoted(rheology)) > 0;
    if (is_written || ready_scheme(rheology) != nullptr)
      return;
    std::vector<std::string> names;
    for (const auto &scheme : ready_schemes())
      names.push_back(scheme.name);
    for (const auto &definition : definitions)
      names.push_back(definition.first);
    const std::string nearest = nearest_name(rheology, names);
    throw UserError(where,
                    "'" + rheology + "'",
                    "a scheme as text, or one of: " + join(names, ", "),
                    nearest.empty() ?
                      "for instance 'set Rheology = elastic granular'" :
                      "did you mean '" + nearest + "'?");
  }

  void
  MaterialParameters::check_keys(const SceneFile &file) const
  {
    const SceneFile::Path path = {"Materials", name};
    const auto required = required_keys(), optional = optional_keys();
    for (const std::string &key : required)
      if (!file.has(path, key))
        refuse(file,
               key,
               "a value, since Rheology is '" + rheology + "'" +
                 (uses_set() ? " and Admissible set '" + admissible_set + "'" :
                               ""),
               "add 'set " + key + " = ...'");
    for (const std::string &key : file.keys(path))
      if (!contains(required, key) && !contains(optional, key))
        refuse(file,
               key,
               "no such key with Rheology '" + rheology + "'" +
                 (uses_set() ? ", Admissible set '" + admissible_set +
                                 "' and Binder '" + binder_kind + "'" :
                               ""),
               "remove the key, it would have no effect, or choose the "
               "rheology that it belongs to");
  }

  void
  MaterialParameters::check_numbers(const SceneFile &file) const
  {
    const SceneFile::Path path  = {"Materials", name};
    const auto            given = [&](const std::string &key) {
      return file.has(path, key);
    };
    for (const std::string &key : file.keys(path))
      if (const double size =
            key == "Material id" ? 0. : size_of(file.value(path, key));
          size > 0. && !(size >= 1. / largest_number && size <= largest_number))
        refuse(file,
               key,
               "zero, or a number between 1e-30 and 1e30",
               "check the unit; scale all stresses if they are that far from "
               "one");

    const bool by_young  = given("Young modulus") || given("Poisson ratio");
    const bool by_moduli = given("Bulk modulus") || given("Shear modulus");
    if (by_young && by_moduli)
      refuse(file,
             "Young modulus",
             "either bulk and shear modulus or Young's modulus and Poisson's "
             "ratio",
             "remove one pair");
    const auto require_positive = [&](const std::string &key,
                                      const double       value) {
      if (!(value > 0.))
        refuse(file, key, "a positive number in Pa", "set it");
    };
    if (by_young)
      require_positive("Young modulus", young_modulus);
    else if (uses("spring"))
      {
        require_positive("Bulk modulus", bulk_modulus);
        require_positive("Shear modulus", shear_modulus);
      }
  }

  void
  MaterialParameters::check_set(const SceneFile &file) const
  {
    const SceneFile::Path path     = {"Materials", name};
    const auto            required = required_keys();
    const auto            allow    = [&](const std::vector<std::string> &sets) {
      if (!contains(sets, admissible_set))
        refuse(file,
               "Admissible set",
               "one of " + join(sets, ", ") + " for Rheology '" + rheology +
                 "'",
               "a rigid contact needs a cone, a plastic hinge a yield set");
    };
    const bool on_contact = uses("contact") || uses("bound contact") ||
                            uses("contact with gap"),
               on_hinge = uses("hinge on set") || uses("cohesive hinge");
    if (on_contact && on_hinge)
      allow({"mises schleicher", "coulomb mohr"});
    else if (on_contact)
      allow({"mises schleicher", "coulomb mohr", "no tension"});
    else if (on_hinge)
      allow({"mises schleicher", "coulomb mohr", "von mises", "tresca"});
    if (uses("bound cone and hinge"))
      {
        if (plastic_flow == "conditional")
          allow({"mises schleicher", "coulomb mohr", "no tension"});
        else
          allow({"mises schleicher"});
      }

    if (contains(required, "Friction angle") && friction_angle < 1.6)
      refuse(file,
             "Friction angle",
             "an angle in degrees, between 1.6 and 89.9",
             friction_angle > 0. ?
               "if the value is in radians, write " +
                 number_text(std::round(100. * friction_angle / degree) /
                             100.) :
               "for zero friction take Rheology = elastic plastic with "
               "Admissible set = tresca");
    if (contains(required, "Friction parameter") && !(friction_parameter > 0.))
      refuse(file,
             "Friction parameter",
             "a positive number",
             "for instance 0.5");
    for (const char *key : {"Shear strength",
                            "Shear viscosity",
                            "Second bulk modulus",
                            "Second shear modulus",
                            "Cohesion",
                            "Gap"})
      if (contains(required, key) &&
          !(Utilities::string_to_double(file.value(path, key)) > 0.))
        refuse(file, key, "a positive number", "set it");
  }
} // namespace Signoton::Rheology
