#include <signoton/rheology/classification.h>
#include <signoton/rheology/library.h>
#include <signoton/rheology/material.h>

#include <deal.II/base/utilities.h>

#include <charconv>
#include <cmath>

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

    /** The shortest text that is read as the same number. */
    std::string
    exact(const double value)
    {
      std::array<char, 32> text;
      return {text.data(),
              std::to_chars(text.data(), text.data() + text.size(), value).ptr};
    }
  } // namespace

  void
  Material::add_parameters(ParameterHandler &handler)
  {
    const Patterns::Double non_negative(0.);
    handler.add_parameter("Material id",
                          id,
                          "The material id of the cells that consist of it.");
    std::vector<std::string> names;
    for (const auto &scheme : ready_schemes())
      names.push_back(scheme.name + " (Fig. " + scheme.figure +
                      "): " + scheme.text);
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

  bool
  Material::is_elastic() const
  {
    return std::holds_alternative<Elastic>(law());
  }

  bool
  Material::is_reversible() const
  {
    return !contains(scheme(), Scheme::Kind::hinge) && !is_viscous();
  }

  bool
  Material::is_viscous() const
  {
    return contains(scheme(), Scheme::Kind::damper);
  }

  bool
  Material::has_cone() const
  {
    return contains(scheme(), Scheme::Kind::contact);
  }

  bool
  Material::has_binder() const
  {
    return binder_kind != "none";
  }

  bool
  Material::may_lose_stiffness() const
  {
    const Moduli left = loosened_moduli(scheme());
    return !(left.bulk > 0. && left.shear > 0.);
  }

  bool
  Material::uses(const std::string &element) const
  {
    const ReadyScheme *ready = ready_scheme(rheology);
    return ready != nullptr &&
           ready->text.find("{" + element + "}") != std::string::npos;
  }

  bool
  Material::may_be_bound() const
  {
    return uses("bound contact") || uses("bound cone and hinge");
  }

  bool
  Material::uses_set() const
  {
    return uses("contact") || uses("bound contact") ||
           uses("bound cone and hinge") || uses("contact with gap") ||
           uses("hinge on set");
  }

  std::vector<std::string>
  Material::required_keys() const
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
  Material::optional_keys() const
  {
    std::vector<std::string> keys = {"Material id", "Density"};
    if (uses("spring"))
      for (const char *key :
           {"Bulk modulus", "Shear modulus", "Young modulus", "Poisson ratio"})
        keys.emplace_back(key);
    if (uses("bound cone and hinge"))
      keys.emplace_back("Admissible set");
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
  Material::check(const SceneFile &file)
  {
    const SceneFile::Path path = {"Materials", name};
    where                      = file.where(path, "Rheology");
    for (const std::string &key : file.keys({"Schemes"}))
      definitions[key] = file.value({"Schemes"}, key);
    const bool is_written = rheology.find('(') != std::string::npos ||
                            definitions.count(rheology) > 0;
    if (!is_written && ready_scheme(rheology) == nullptr)
      {
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
    const auto required = required_keys();
    const auto optional = optional_keys();
    const auto given    = [&](const std::string &key) {
      return file.has(path, key);
    };
    const auto refuse = [&](const std::string &key,
                            const std::string &expected,
                            const std::string &hint) {
      throw UserError(file.where(path, key),
                      given(key) ? "'" + file.value(path, key) + "'" :
                                   "no value",
                      expected,
                      hint);
    };

    for (const std::string &key : required)
      if (!given(key))
        refuse(key,
               "a value, since Rheology is '" + rheology + "'" +
                 (uses_set() ? " and Admissible set '" + admissible_set + "'" :
                               ""),
               "add 'set " + key + " = ...'");
    for (const std::string &key : file.keys(path))
      if (!contains(required, key) && !contains(optional, key))
        refuse(key,
               "no such key with Rheology '" + rheology + "'" +
                 (uses_set() ? ", Admissible set '" + admissible_set +
                                 "' and Binder '" + binder_kind + "'" :
                               ""),
               "remove the key, it would have no effect, or choose the "
               "rheology that it belongs to");

    const bool by_young  = given("Young modulus") || given("Poisson ratio");
    const bool by_moduli = given("Bulk modulus") || given("Shear modulus");
    if (by_young && by_moduli)
      refuse("Young modulus",
             "either bulk and shear modulus or Young's modulus and Poisson's "
             "ratio",
             "remove one pair");
    if (by_young && !(young_modulus > 0.))
      refuse("Young modulus", "a positive number in Pa", "set it");
    if (uses("spring") && !by_young && !(bulk_modulus > 0.))
      refuse("Bulk modulus", "a positive number in Pa", "set it");
    if (uses("spring") && !by_young && !(shear_modulus > 0.))
      refuse("Shear modulus", "a positive number in Pa", "set it");

    const auto allow_sets = [&](const std::vector<std::string> &sets) {
      if (!contains(sets, admissible_set))
        refuse("Admissible set",
               "one of " + join(sets, ", ") + " for Rheology '" + rheology +
                 "'",
               "a rigid contact needs a cone, a plastic hinge a yield set");
    };
    if (uses("contact") || uses("bound contact") || uses("contact with gap"))
      allow_sets({"mises schleicher", "coulomb mohr", "no tension"});
    if (uses("hinge on set") && !uses("contact with gap"))
      allow_sets({"mises schleicher", "coulomb mohr", "von mises", "tresca"});
    if (uses("bound cone and hinge"))
      allow_sets({"mises schleicher"});

    if (contains(required, "Friction angle") && friction_angle < 1.6)
      refuse("Friction angle",
             "an angle in degrees, between 1.6 and 89.9",
             friction_angle > 0. ?
               "if the value is in radians, write " +
                 Utilities::to_string(
                   std::round(100. * friction_angle / degree) / 100.) :
               "for zero friction take Rheology = elastic plastic with "
               "Admissible set = tresca");
    if (contains(required, "Friction parameter") && !(friction_parameter > 0.))
      refuse("Friction parameter", "a positive number", "for instance 0.5");
    for (const char *key : {"Shear strength",
                            "Shear viscosity",
                            "Second bulk modulus",
                            "Second shear modulus",
                            "Gap"})
      if (contains(required, key) &&
          !(Utilities::string_to_double(file.value(path, key)) > 0.))
        refuse(key, "a positive number", "set it");
    scheme(); // complains about errors in it
  }

  void
  Material::require_stress_from_strain() const
  {
    Rheology::require_stress_from_strain(scheme(), where);
  }

  Moduli
  Material::spring() const
  {
    if (young_modulus > 0.)
      return {young_modulus / (3. * (1. - 2. * poisson_ratio)),
              young_modulus / (2. * (1. + poisson_ratio))};
    return {bulk_modulus, shear_modulus};
  }

  Moduli
  Material::elasticity() const
  {
    return spring_moduli(scheme());
  }

  double
  Material::binder_ratio() const
  {
    return binder_kind == "proportional" ? proportional_binder : 1.;
  }

  Moduli
  Material::binder(const std::optional<double> &ratio) const
  {
    if (binder_kind == "moduli")
      return {binder_bulk_modulus, binder_shear_modulus};
    const double lambda = ratio.value_or(proportional_binder);
    const double factor = lambda / (1. - lambda);
    return {factor * spring().bulk, factor * spring().shear};
  }

  std::string
  Material::set_text() const
  {
    std::string text = admissible_set + ", ";
    if (admissible_set == "mises schleicher")
      text += "friction = " + exact(friction_parameter);
    else if (admissible_set == "coulomb mohr")
      text += "friction angle = " + exact(friction_angle);
    else if (admissible_set == "no tension")
      text += "tensile strength = " + exact(tensile_strength);
    else
      text += "strength = " + exact(shear_strength);
    if (cohesion > 0.)
      text += ", cohesion = " + exact(cohesion);
    if (isotropic_hardening_modulus > 0.)
      text += ", isotropic hardening = " + exact(isotropic_hardening_modulus);
    return text;
  }

  std::string
  Material::element(const std::string           &name,
                    const std::optional<double> &ratio) const
  {
    const auto spring_text = [](const Moduli &moduli) {
      return "spring(bulk = " + exact(moduli.bulk) +
             ", shear = " + exact(moduli.shear) + ")";
    };
    if (name == "spring")
      return spring_text(spring());
    if (name == "second spring")
      return spring_text({second_bulk_modulus, second_shear_modulus});
    if (name == "damper")
      return "damper(bulk viscosity = " + exact(bulk_viscosity) +
             ", shear viscosity = " + exact(shear_viscosity) + ")";
    if (name == "hinge")
      return "hinge(von mises, strength = " + exact(shear_strength) + ")";
    if (name == "contact with gap")
      return "contact(" + set_text() + ", gap = " + exact(gap) + ")";

    const bool        is_hinge = name == "hinge on set";
    const std::string set =
                        (is_hinge ? "hinge(" : "contact(") + set_text() + ")",
                      confined = name == "bound cone and hinge" ?
                                   "series(" + set + ", " +
                                     element("hinge", ratio) + ")" :
                                   set;
    const Moduli parallel = is_hinge ? Moduli{0., kinematic_hardening_modulus} :
                            may_be_bound() && binder_kind != "none" ?
                                       binder(ratio) :
                                       Moduli{0., 0.};
    return parallel.bulk > 0. || parallel.shear > 0. ?
             "parallel(" + confined + ", " + spring_text(parallel) + ")" :
             confined;
  }

  Scheme
  Material::scheme(const std::optional<double> &ratio) const
  {
    const ReadyScheme *ready = ready_scheme(rheology);
    if (ready == nullptr)
      return parse_scheme(rheology, where, definitions);
    std::string text = ready->text;
    for (std::size_t begin; (begin = text.find('{')) != std::string::npos;)
      {
        const std::size_t end = text.find('}', begin);
        text.replace(begin,
                     end - begin + 1,
                     element(text.substr(begin + 1, end - begin - 1), ratio));
      }
    return parse_scheme(text, where);
  }

  Law
  Material::law(const std::optional<double> &ratio) const
  {
    const Scheme             tree   = scheme(ratio);
    const std::optional<Law> closed = closed_form(tree);
    return closed ? *closed : General(tree);
  }

  std::string
  Material::description() const
  {
    const Scheme      tree   = scheme();
    const bool        closed = closed_form(tree).has_value();
    const std::string text =
      rheology +
      (ready_scheme(rheology) != nullptr ? " = " + tree.text : std::string());
    return text + "; " + classification(tree) +
           (closed ? "; closed form" : "; general local solver");
  }
} // namespace Signoton::Rheology
