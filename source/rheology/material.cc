#include <signoton/base/number.h>
#include <signoton/rheology/classification.h>
#include <signoton/rheology/library.h>
#include <signoton/rheology/material.h>

#include <cmath>

namespace Signoton::Rheology
{
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

  Moduli
  Material::binder() const
  {
    return may_be_bound() && has_binder() ? binder({}) : Moduli{0., 0.};
  }

  bool
  Material::has_potential() const
  {
    return plastic_flow != "conditional";
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

  void
  Material::require_stress_from_strain() const
  {
    Rheology::require_stress_from_strain(scheme(), where);
  }

  void
  Material::require_resistance() const
  {
    Rheology::require_resistance(scheme(), where);
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
  Material::set_text(const bool with_cohesion) const
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
  Material::element(const std::string           &name,
                    const std::optional<double> &ratio) const
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
    const Scheme tree = scheme(ratio);
    if (plastic_flow == "conditional")
      return conditional_form(tree,
                              has_binder() ? binder(ratio) : Moduli{0., 0.});
    const std::optional<Law> closed = closed_form(tree);
    return closed ? *closed : General(tree);
  }

  double
  Material::longitudinal_speed() const
  {
    const Moduli moduli = elasticity();
    return std::sqrt((moduli.bulk + 4. / 3. * moduli.shear) / density);
  }

  double
  Material::crossing_time(const double       distance,
                          const unsigned int n_extensions) const
  {
    // Dampers are the stiffer the shorter the step: a fixed point, from above,
    // where the error shrinks by half each time or faster.
    const Scheme tree = scheme();
    double       time = 1e30;
    for (unsigned int i = 0; i < 100; ++i)
      {
        const Moduli m    = stiffest_moduli(tree, time);
        const double lame = m.bulk - 2. / 3. * m.shear;
        time              = distance *
               std::sqrt(density /
                         (n_extensions * std::max(lame, 0.) + 2. * m.shear));
      }
    return time;
  }

  std::string
  Material::description() const
  {
    const Scheme tree = scheme();
    if (!has_potential())
      return rheology + " = " + tree.text +
             ", the hinge on the conditional stress; " + classification(tree) +
             "; has a closed form and no potential";
    const bool        closed = closed_form(tree).has_value();
    const std::string text =
      rheology +
      (ready_scheme(rheology) != nullptr ? " = " + tree.text : std::string());
    return text + "; " + classification(tree) +
           (closed ? "; has a closed form" : "; general local solver");
  }
} // namespace Signoton::Rheology
