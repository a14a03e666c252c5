#include <signoton/base/number.h>
#include <signoton/rheology/classification.h>
#include <signoton/rheology/library.h>
#include <signoton/rheology/material_parameters.h>

// The scheme that the constants of a material mean, and the material.

namespace Signoton::Rheology
{
  bool
  MaterialParameters::uses(const std::string &element) const
  {
    const ReadyScheme *ready = ready_scheme(rheology);
    return ready != nullptr &&
           ready->text.find("{" + element + "}") != std::string::npos;
  }

  bool
  MaterialParameters::may_be_bound() const
  {
    return uses("bound contact") || uses("bound cone and hinge");
  }

  bool
  MaterialParameters::uses_set() const
  {
    return uses("contact") || uses("bound contact") ||
           uses("bound cone and hinge") || uses("contact with gap") ||
           uses("hinge on set");
  }

  Moduli
  MaterialParameters::spring() const
  {
    if (young_modulus > 0.)
      return {young_modulus / (3. * (1. - 2. * poisson_ratio)),
              young_modulus / (2. * (1. + poisson_ratio))};
    return {bulk_modulus, shear_modulus};
  }

  Moduli
  MaterialParameters::binder(const double ratio) const
  {
    if (binder_kind == "moduli")
      return {binder_bulk_modulus, binder_shear_modulus};
    const double factor = ratio / (1. - ratio);
    return {factor * spring().bulk, factor * spring().shear};
  }

  std::string
  MaterialParameters::set_text(const bool with_cohesion) const
  {
    std::string text = admissible_set + ", ";
    if (admissible_set == "mises schleicher")
      text += "friction = " + number_text(friction_parameter);
    else if (admissible_set == "coulomb mohr")
      text += "friction angle = " + number_text(friction_angle);
    else if (admissible_set == "no tension")
      text += "tensile strength = " + number_text(tensile_strength);
    else
      text += "strength = " + number_text(shear_strength);
    if (with_cohesion && cohesion > 0.)
      text += ", cohesion = " + number_text(cohesion);
    if (isotropic_hardening_modulus > 0.)
      text +=
        ", isotropic hardening = " + number_text(isotropic_hardening_modulus);
    return text;
  }

  std::string
  MaterialParameters::element(const std::string &name, const double ratio) const
  {
    const auto spring_text = [](const Moduli &moduli) {
      return "spring(bulk = " + number_text(moduli.bulk) +
             ", shear = " + number_text(moduli.shear) + ")";
    };
    if (name == "spring")
      return spring_text(spring());
    if (name == "second spring")
      return spring_text({second_bulk_modulus, second_shear_modulus});
    if (name == "damper")
      return "damper(bulk viscosity = " + number_text(bulk_viscosity) +
             ", shear viscosity = " + number_text(shear_viscosity) + ")";
    if (name == "cohesive hinge")
      return "hinge(" + set_text() + ")";
    if (name == "hinge")
      return "hinge(von mises, strength = " + number_text(shear_strength) + ")";
    if (name == "contact" && uses("cohesive hinge"))
      return "contact(" + set_text(false) + ")";
    if (name == "contact with gap")
      return "contact(" + set_text() + ", gap = " + number_text(gap) + ")";

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
  MaterialParameters::scheme(const double ratio) const
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

  Material
  MaterialParameters::make(const SceneFile &file)
  {
    find_rheology(file);
    check_keys(file);
    check_numbers(file);
    check_set(file);

    Material material;
    material.name       = name;
    material.id         = id;
    material.density    = density;
    material.rheology   = rheology;
    material.where      = where;
    material.scheme     = scheme(proportional_binder); // finds errors in it
    material.has_binder = binder_kind != "none";
    if (may_be_bound() && material.has_binder)
      material.binder = binder(proportional_binder);
    if (binder_kind == "proportional")
      material.binder_ratio = proportional_binder;
    material.with_binder_ratio = [constants = *this](const double ratio) {
      return constants.scheme(ratio);
    };
    material.has_potential = plastic_flow != "conditional";
    material.elasticity    = spring_moduli(material.scheme);
    material.is_viscous    = contains(material.scheme, Scheme::Kind::damper);
    material.is_reversible =
      !contains(material.scheme, Scheme::Kind::hinge) && !material.is_viscous;
    material.has_cone   = contains(material.scheme, Scheme::Kind::contact);
    const auto closed   = closed_form(material.scheme);
    material.is_elastic = closed && std::holds_alternative<Elastic>(*closed);
    const Moduli left   = loosened_moduli(material.scheme);
    material.may_lose_stiffness = !(left.bulk > 0. && left.shear > 0.);
    return material;
  }
} // namespace Signoton::Rheology
