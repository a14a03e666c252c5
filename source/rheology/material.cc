#include <signoton/rheology/material.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <sstream>

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
  } // namespace

  void
  Material::add_parameters(ParameterHandler &handler)
  {
    const Patterns::Double non_negative(0.);
    handler.add_parameter("Material id",
                          id,
                          "The material id of the cells that consist of it.");
    handler.add_parameter(
      "Rheology",
      rheology,
      "elastic: a spring. elastic granular: spring in series with a rigid "
      "contact on a cone (reversible, no tension). elastic plastic: spring in "
      "series with a plastic hinge on a yield set. elastic plastic granular: "
      "spring, contact on the cone and hinge on a von Mises cylinder in "
      "series.",
      Patterns::Selection("elastic|elastic granular|elastic plastic|"
                          "elastic plastic granular"));
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
  }

  bool
  Material::is_elastic() const
  {
    return rheology == "elastic";
  }

  bool
  Material::is_reversible() const
  {
    return rheology == "elastic" || rheology == "elastic granular";
  }

  bool
  Material::has_cone() const
  {
    return rheology == "elastic granular" ||
           rheology == "elastic plastic granular";
  }

  bool
  Material::has_binder() const
  {
    return binder_kind != "none";
  }

  bool
  Material::may_lose_stiffness() const
  {
    const Moduli parallel = binder({});
    return !is_elastic() && admissible_set != "von mises" &&
           admissible_set != "tresca" &&
           !(parallel.bulk > 0. && parallel.shear > 0.);
  }

  std::vector<std::string>
  Material::required_keys() const
  {
    std::vector<std::string> keys = {"Rheology"};
    if (is_elastic())
      return keys;
    if (rheology != "elastic plastic granular")
      keys.emplace_back("Admissible set");
    if (admissible_set == "mises schleicher")
      keys.emplace_back("Friction parameter");
    else if (admissible_set == "coulomb mohr")
      keys.emplace_back("Friction angle");
    if (rheology == "elastic plastic granular" ||
        admissible_set == "von mises" || admissible_set == "tresca")
      keys.emplace_back("Shear strength");
    if (binder_kind == "moduli")
      {
        keys.emplace_back("Binder bulk modulus");
        keys.emplace_back("Binder shear modulus");
      }
    return keys;
  }

  std::vector<std::string>
  Material::optional_keys() const
  {
    std::vector<std::string> keys = {"Material id",
                                     "Density",
                                     "Bulk modulus",
                                     "Shear modulus",
                                     "Young modulus",
                                     "Poisson ratio"};
    if (is_elastic())
      return keys;
    if (rheology == "elastic plastic granular")
      keys.emplace_back("Admissible set");
    if (admissible_set == "mises schleicher" ||
        admissible_set == "coulomb mohr")
      keys.emplace_back("Cohesion");
    if (admissible_set == "no tension")
      keys.emplace_back("Tensile strength");
    if (has_cone())
      keys.emplace_back("Binder");
    if (binder_kind == "proportional")
      keys.emplace_back("Binder ratio");
    if (admissible_set == "von mises")
      {
        keys.emplace_back("Isotropic hardening modulus");
        keys.emplace_back("Kinematic hardening modulus");
      }
    return keys;
  }

  void
  Material::check(const SceneFile &file) const
  {
    const SceneFile::Path path     = {"Materials", name};
    const auto            required = required_keys();
    const auto            optional = optional_keys();
    const auto            given    = [&](const std::string &key) {
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
                 (is_elastic() ?
                    "" :
                    " and Admissible set '" + admissible_set + "'"),
               "add 'set " + key + " = ...'");
    for (const std::string &key : file.keys(path))
      if (!contains(required, key) && !contains(optional, key))
        refuse(key,
               "no such key with Rheology '" + rheology + "'" +
                 (is_elastic() ? std::string() :
                                 ", Admissible set '" + admissible_set +
                                   "' and Binder '" + binder_kind + "'"),
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
    if (!by_young && !(bulk_modulus > 0.))
      refuse("Bulk modulus", "a positive number in Pa", "set it");
    if (!by_young && !(shear_modulus > 0.))
      refuse("Shear modulus", "a positive number in Pa", "set it");

    const auto allow_sets = [&](const std::vector<std::string> &sets) {
      if (!contains(sets, admissible_set))
        refuse("Admissible set",
               "one of " + join(sets, ", ") + " for Rheology '" + rheology +
                 "'",
               "a rigid contact needs a cone, a plastic hinge a yield set");
    };
    if (rheology == "elastic granular")
      allow_sets({"mises schleicher", "coulomb mohr", "no tension"});
    if (rheology == "elastic plastic")
      allow_sets({"mises schleicher", "coulomb mohr", "von mises", "tresca"});
    if (rheology == "elastic plastic granular")
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
    if (contains(required, "Shear strength") && !(shear_strength > 0.))
      refuse("Shear strength", "a positive number in Pa", "set it");
  }

  Moduli
  Material::elasticity() const
  {
    if (young_modulus > 0.)
      return {young_modulus / (3. * (1. - 2. * poisson_ratio)),
              young_modulus / (2. * (1. + poisson_ratio))};
    return {bulk_modulus, shear_modulus};
  }

  double
  Material::binder_ratio() const
  {
    return binder_kind == "proportional" ? proportional_binder : 1.;
  }

  Moduli
  Material::binder(const std::optional<double> &ratio) const
  {
    const Moduli spring = elasticity();
    if (binder_kind == "moduli")
      return {binder_bulk_modulus, binder_shear_modulus};
    if (binder_kind == "proportional")
      {
        const double lambda = ratio.value_or(proportional_binder);
        const double factor = lambda / (1. - lambda);
        return {factor * spring.bulk, factor * spring.shear};
      }
    return {0., kinematic_hardening_modulus};
  }

  double
  Material::apex() const
  {
    if (admissible_set == "mises schleicher")
      return cohesion / friction_parameter;
    if (admissible_set == "coulomb mohr")
      return cohesion / std::tan(friction_angle * degree);
    return tensile_strength;
  }

  Law
  Material::law(const std::optional<double> &ratio) const
  {
    const Moduli spring        = elasticity();
    const Moduli parallel      = binder(ratio);
    const auto   principal_set = [&]() {
      if (admissible_set == "coulomb mohr")
        return PrincipalSet::coulomb_mohr(friction_angle * degree, apex());
      if (admissible_set == "no tension")
        return PrincipalSet::no_tension(apex());
      return PrincipalSet::tresca(shear_strength);
    };
    const auto cone = [&]() {
      return MisesSchleicherCone(friction_parameter, apex());
    };

    if (is_elastic())
      return Elastic(spring);
    if (rheology == "elastic plastic granular")
      return SpringAndProjection<MisesSchleicherCone, Memory::cylinder>(
        spring,
        parallel,
        MisesSchleicherCone(friction_parameter, apex(), shear_strength));
    if (rheology == "elastic granular")
      {
        if (admissible_set == "mises schleicher")
          return SpringAndProjection<MisesSchleicherCone, Memory::none>(
            spring, parallel, cone());
        return SpringAndProjection<PrincipalSet, Memory::none>(spring,
                                                               parallel,
                                                               principal_set());
      }
    if (admissible_set == "mises schleicher")
      return SpringAndProjection<MisesSchleicherCone, Memory::all>(spring,
                                                                   parallel,
                                                                   cone());
    if (admissible_set == "von mises")
      {
        if (isotropic_hardening_modulus > 0.)
          return SpringAndProjection<VonMisesCylinder<true>, Memory::all>(
            spring,
            parallel,
            VonMisesCylinder<true>(shear_strength,
                                   isotropic_hardening_modulus));
        return SpringAndProjection<VonMisesCylinder<false>, Memory::all>(
          spring, parallel, VonMisesCylinder<false>(shear_strength));
      }
    return SpringAndProjection<PrincipalSet, Memory::all>(spring,
                                                          parallel,
                                                          principal_set());
  }

  std::string
  Material::description() const
  {
    std::ostringstream text;
    const Moduli       spring = elasticity();
    text << rheology << ": spring k = " << spring.bulk
         << " Pa, mu = " << spring.shear << " Pa";
    if (is_elastic())
      return text.str();
    text << (is_reversible() ? "; rigid contact on " :
             has_cone()      ? "; rigid contact and plastic hinge on " :
                               "; plastic hinge on ");
    if (admissible_set == "mises schleicher")
      text << "tau <= " << friction_parameter << " p + " << cohesion << " Pa";
    else if (admissible_set == "coulomb mohr")
      text << "Coulomb-Mohr with phi = " << friction_angle
           << " degrees, c = " << cohesion << " Pa";
    else if (admissible_set == "no tension")
      text << "principal stresses <= " << tensile_strength << " Pa";
    else
      text << admissible_set << " with tau_Y = " << shear_strength << " Pa";
    if (rheology == "elastic plastic granular")
      text << " and tau <= " << shear_strength << " Pa";
    if (binder_kind == "proportional")
      text << "; binder lambda = " << proportional_binder;
    else if (binder_kind == "moduli")
      text << "; binder k = " << binder_bulk_modulus
           << " Pa, mu = " << binder_shear_modulus << " Pa";
    if (isotropic_hardening_modulus > 0. || kinematic_hardening_modulus > 0.)
      text << "; hardening " << isotropic_hardening_modulus << " Pa isotropic, "
           << kinematic_hardening_modulus << " Pa kinematic";
    return text.str();
  }
} // namespace Signoton::Rheology
