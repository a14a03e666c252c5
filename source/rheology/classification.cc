#include <signoton/base/exceptions.h>
#include <signoton/rheology/classification.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Signoton::Rheology
{
  namespace
  {
    using Kind = Scheme::Kind;

    constexpr double infinite = std::numeric_limits<double>::infinity();

    Parts
    of_all(const std::vector<Scheme> &parts, Parts (*property)(const Scheme &))
    {
      Parts result{true, true};
      for (const Scheme &part : parts)
        {
          const Parts p = property(part);
          result.spherical &= p.spherical;
          result.deviatoric &= p.deviatoric;
        }
      return result;
    }

    Parts
    of_any(const std::vector<Scheme> &parts, Parts (*property)(const Scheme &))
    {
      Parts result{false, false};
      for (const Scheme &part : parts)
        {
          const Parts p = property(part);
          result.spherical |= p.spherical;
          result.deviatoric |= p.deviatoric;
        }
      return result;
    }

    bool
    ignores_pressure(const Scheme &scheme)
    {
      return std::holds_alternative<VonMisesCylinder<false>>(scheme.set[0]) ||
             std::holds_alternative<VonMisesCylinder<true>>(scheme.set[0]) ||
             (scheme.kind == Kind::hinge &&
              std::holds_alternative<PrincipalSet>(scheme.set[0]) &&
              std::get<PrincipalSet>(scheme.set[0]).ignores_pressure());
    }

    double
    in_series(const double a, const double b)
    {
      return !(a > 0.) || !(b > 0.) ? 0. : 1. / (1. / a + 1. / b);
    }
  } // namespace

  Parts
  stress_follows_from_strain(const Scheme &scheme)
  {
    switch (scheme.kind)
      {
        case Kind::spring:
        case Kind::damper:
          return {true, true}; // zero where a constant is zero
        case Kind::series:
          return of_any(scheme.parts, stress_follows_from_strain);
        case Kind::parallel:
          return of_all(scheme.parts, stress_follows_from_strain);
        default:
          return {false, false};
      }
  }

  Parts
  strain_follows_from_stress(const Scheme &scheme)
  {
    switch (scheme.kind)
      {
        case Kind::spring:
        case Kind::damper:
          return {scheme.moduli.bulk > 0., scheme.moduli.shear > 0.};
        case Kind::series:
          return of_all(scheme.parts, strain_follows_from_stress);
        case Kind::parallel:
          return of_any(scheme.parts, strain_follows_from_stress);
        case Kind::hinge:
          return {ignores_pressure(scheme),
                  std::holds_alternative<VonMisesCylinder<true>>(
                    scheme.set[0])};
        default:
          return {false, false};
      }
  }

  namespace
  {
    /** Moduli of the whole from those of its elements. */
    template <typename OfElement>
    Moduli
    composed(const Scheme &scheme, const OfElement &of_element)
    {
      if (!scheme.is_group())
        return of_element(scheme);
      const bool series = scheme.kind == Kind::series;
      Moduli     result = series ? Moduli{infinite, infinite} : Moduli{0., 0.};
      for (const Scheme &part : scheme.parts)
        {
          const Moduli m = composed(part, of_element);
          if (series)
            result = {in_series(result.bulk, m.bulk),
                      in_series(result.shear, m.shear)};
          else
            result = {result.bulk + m.bulk, result.shear + m.shear};
        }
      return result;
    }

    void
    require_determined_stress(const Scheme &scheme, const std::string &where)
    {
      if (stress_follows_from_strain(scheme))
        return;
      // the part in parallel that leaves it open, if there is one
      if (scheme.kind == Kind::parallel)
        for (const Scheme &part : scheme.parts)
          require_determined_stress(part, where);
      throw UserError(where,
                      "an ill-posed scheme: in '" + scheme.text +
                        "' its stress does not follow from its strain",
                      "a spring or damper in series with every contact and "
                      "hinge, or with the group they are in",
                      "series(spring(bulk = ..., shear = ...), " + scheme.text +
                        ")");
    }
  } // namespace

  void
  require_resistance(const Scheme &scheme, const std::string &where)
  {
    // of the parts first: the smallest one says most
    for (const Scheme &part : scheme.parts)
      if (scheme.kind == Kind::series || part.kind == Kind::series)
        require_resistance(part, where);
    const Moduli stiffness = composed(scheme, [](const Scheme &element) {
      return element.set.empty() ? element.moduli : Moduli{infinite, infinite};
    });
    if (stiffness.bulk > 0. && stiffness.shear > 0.)
      return;
    const bool is_volume = !(stiffness.bulk > 0.);
    throw UserError(where,
                    "'" + scheme.text + "' has no stiffness against changes " +
                      (is_volume ? "of volume" : "of shape"),
                    std::string("a ") + (is_volume ? "bulk" : "shear") +
                      " modulus or viscosity above zero: in series, the whole "
                      "has no more than its weakest part",
                    "a constant that is left out is zero; give it a large "
                    "value to make the part stiff");
  }

  void
  require_stress_from_strain(const Scheme &scheme, const std::string &where)
  {
    require_determined_stress(scheme, where);
    require_resistance(scheme, where);
  }

  bool
  contains(const Scheme &scheme, const Kind kind)
  {
    return scheme.kind == kind || std::any_of(scheme.parts.begin(),
                                              scheme.parts.end(),
                                              [kind](const Scheme &part) {
                                                return contains(part, kind);
                                              });
  }

  namespace
  {
    /** Moduli where dampers, or contacts and hinges, are rigid or else left
     *  out; none if all is left out. */
    std::optional<Moduli>
    moduli(const Scheme &scheme,
           const bool    rigid_dampers,
           const bool    rigid_sets)
    {
      if (scheme.kind == Kind::spring)
        return scheme.moduli;
      if (!scheme.is_group())
        return (scheme.kind == Kind::damper ? rigid_dampers : rigid_sets) ?
                 std::optional<Moduli>(Moduli{infinite, infinite}) :
                 std::nullopt;
      std::optional<Moduli> sum;
      for (const Scheme &part : scheme.parts)
        if (const auto m = moduli(part, rigid_dampers, rigid_sets))
          {
            if (!sum)
              sum = m;
            else if (scheme.kind == Kind::series)
              sum = Moduli{in_series(sum->bulk, m->bulk),
                           in_series(sum->shear, m->shear)};
            else
              sum = Moduli{sum->bulk + m->bulk, sum->shear + m->shear};
          }
      return sum;
    }
  } // namespace

  Moduli
  spring_moduli(const Scheme &scheme)
  {
    Moduli result{infinite, infinite};
    for (const auto &[dampers, sets] : {std::pair(true, true),
                                        std::pair(false, true),
                                        std::pair(false, false)})
      if (const auto m = moduli(scheme, dampers, sets))
        {
          if (!std::isfinite(result.bulk) || !(result.bulk > 0.))
            result.bulk = m->bulk;
          if (!std::isfinite(result.shear) || !(result.shear > 0.))
            result.shear = m->shear;
        }
    return result;
  }

  Moduli
  loosened_moduli(const Scheme &scheme)
  {
    return composed(scheme, [](const Scheme &element) -> Moduli {
      switch (element.kind)
        {
          case Kind::spring:
            return element.moduli;
          case Kind::damper:
            return {element.moduli.bulk > 0. ? infinite : 0.,
                    element.moduli.shear > 0. ? infinite : 0.};
          case Kind::hinge:
            if (ignores_pressure(element))
              return {infinite, infinite};
            return {0., 0.};
          default:
            return {0., 0.};
        }
    });
  }

  Moduli
  rest_moduli(const Scheme &scheme)
  {
    return composed(scheme, [](const Scheme &element) -> Moduli {
      switch (element.kind)
        {
          case Kind::spring:
            return element.moduli;
          case Kind::damper:
            return {0., 0.};
          default:
            return {infinite, infinite};
        }
    });
  }

  namespace
  {
    /** The largest viscosity in Pa s, and the smallest modulus in Pa that is not
     *  zero. */
    void
    collect_extremes(const Scheme &scheme, double &viscosity, double &modulus)
    {
      for (const double value : {scheme.moduli.bulk, scheme.moduli.shear})
        if (scheme.kind == Kind::damper)
          viscosity = std::max(viscosity, value);
        else if (scheme.kind == Kind::spring && value > 0.)
          modulus = std::min(modulus, value);
      for (const Scheme &part : scheme.parts)
        collect_extremes(part, viscosity, modulus);
    }
  } // namespace

  double
  relaxation_time(const Scheme &scheme)
  {
    double viscosity = 0., modulus = infinite;
    collect_extremes(scheme, viscosity, modulus);
    return std::isfinite(modulus) ? viscosity / modulus : 0.;
  }

  Moduli
  stiffest_moduli(const Scheme &scheme, const double time_step)
  {
    const double factor = 2. / time_step;
    return composed(scheme, [factor](const Scheme &element) -> Moduli {
      switch (element.kind)
        {
          case Kind::spring:
            return element.moduli;
          case Kind::damper:
            return {factor * element.moduli.bulk,
                    factor * element.moduli.shear};
          default:
            return {infinite, infinite};
        }
    });
  }

  namespace
  {
    /** Groups in groups of the same kind are one group, and the springs of a
     *  group are one spring. */
    Scheme
    simplified(const Scheme &scheme)
    {
      if (!scheme.is_group())
        return scheme;
      Scheme result;
      result.kind = scheme.kind;
      std::vector<Scheme> parts;
      for (const Scheme &part : scheme.parts)
        {
          const Scheme simple = simplified(part);
          if (simple.kind == scheme.kind)
            parts.insert(parts.end(), simple.parts.begin(), simple.parts.end());
          else
            parts.push_back(simple);
        }
      int spring = -1;
      for (const Scheme &part : parts)
        if (part.kind != Kind::spring)
          result.parts.push_back(part);
        else if (spring < 0)
          {
            spring = result.parts.size();
            result.parts.push_back(part);
          }
        else
          {
            Moduli &m = result.parts[spring].moduli;
            if (scheme.kind == Kind::series)
              m = {in_series(m.bulk, part.moduli.bulk),
                   in_series(m.shear, part.moduli.shear)};
            else
              m = {m.bulk + part.moduli.bulk, m.shear + part.moduli.shear};
          }
      return result.parts.size() == 1 ? result.parts[0] : result;
    }

    const Scheme *
    only(const Scheme &group, const Kind kind)
    {
      const Scheme *found = nullptr;
      for (const Scheme &part : group.parts)
        if (part.kind == kind)
          {
            if (found != nullptr)
              return nullptr;
            found = &part;
          }
      return found;
    }

    /** Spring, and a contact or hinge with or without a spring in parallel. */
    std::optional<Law>
    spring_and(const Moduli &spring,
               const Scheme &element,
               const Moduli &binder)
    {
      std::optional<Law> result;
      if (element.gap > 0.)
        return result;
      std::visit(
        [&](const auto &set) {
          using Set = std::decay_t<decltype(set)>;
          if constexpr (!std::is_same_v<Set, HydrostaticSet> &&
                        !std::is_same_v<Set, NoCompression>)
            {
              constexpr bool cylinder =
                std::is_same_v<Set, VonMisesCylinder<false>> ||
                std::is_same_v<Set, VonMisesCylinder<true>>;
              if (element.kind == Kind::hinge)
                result =
                  SpringAndProjection<Set, Memory::all>(spring, binder, set);
              else if constexpr (!cylinder)
                result =
                  SpringAndProjection<Set, Memory::none>(spring, binder, set);
            }
        },
        element.set[0]);
      return result;
    }
  } // namespace

  std::optional<Law>
  closed_form(const Scheme &given)
  {
    const Scheme scheme = simplified(given);
    if (scheme.kind == Kind::spring)
      return Elastic(scheme.moduli);
    const Scheme *spring = only(scheme, Kind::spring);
    if (scheme.kind != Kind::series || spring == nullptr)
      return {};
    // what is in series with the spring, and a binder in parallel with that
    std::vector<const Scheme *> rest;
    for (const Scheme &part : scheme.parts)
      if (&part != spring)
        rest.push_back(&part);
    Moduli binder{0., 0.};
    if (rest.size() == 1 && rest[0]->kind == Kind::parallel)
      {
        const Scheme &group  = *rest[0];
        const Scheme *second = only(group, Kind::spring);
        if (second == nullptr || group.parts.size() != 2)
          return {};
        binder              = second->moduli;
        const Scheme &other = group.parts[&group.parts[0] == second ? 1 : 0];
        rest                = {&other};
        if (other.kind == Kind::series)
          {
            rest.clear();
            for (const Scheme &part : other.parts)
              rest.push_back(&part);
          }
      }
    if (rest.size() == 1 && !rest[0]->set.empty())
      return spring_and(spring->moduli, *rest[0], binder);
    // a contact on a cone of revolution and a hinge on a cylinder
    if (rest.size() != 2)
      return {};
    if (rest[0]->kind != Kind::contact)
      std::swap(rest[0], rest[1]);
    const Scheme &contact = *rest[0], &hinge = *rest[1];
    if (contact.kind == Kind::contact && hinge.kind == Kind::hinge &&
        !(contact.gap > 0.) &&
        std::holds_alternative<MisesSchleicherCone>(contact.set[0]) &&
        std::holds_alternative<VonMisesCylinder<false>>(hinge.set[0]))
      return SpringAndProjection<MisesSchleicherCone, Memory::cylinder>(
        spring->moduli,
        binder,
        std::get<MisesSchleicherCone>(contact.set[0])
          .cut_at(std::get<VonMisesCylinder<false>>(hinge.set[0]).strength()));
    return {};
  }

  namespace
  {
    /** The first element of a kind, in the order of the text. */
    const Scheme *
    find(const Scheme &scheme, const Kind kind)
    {
      if (scheme.kind == kind)
        return &scheme;
      const Scheme *found = nullptr;
      for (auto part = scheme.parts.begin();
           found == nullptr && part != scheme.parts.end();
           ++part)
        found = find(*part, kind);
      return found;
    }
  } // namespace

  Law
  conditional_form(const Scheme &scheme)
  {
    const Moduli &spring = find(scheme, Kind::spring)->moduli;
    const Scheme *group  = find(scheme, Kind::parallel);
    const Moduli  binder =
      group != nullptr ? only(*group, Kind::spring)->moduli : Moduli{0., 0.};
    const auto &cylinder =
      std::get<VonMisesCylinder<false>>(find(scheme, Kind::hinge)->set[0]);
    const auto &cone = find(scheme, Kind::contact)->set[0];
    if (const auto *round = std::get_if<MisesSchleicherCone>(&cone))
      return ConditionalPlasticity<VonMisesCylinder<false>,
                                   MisesSchleicherCone>(spring,
                                                        binder,
                                                        cylinder,
                                                        *round);
    return ConditionalPlasticity<VonMisesCylinder<false>, PrincipalSet>(
      spring, binder, cylinder, std::get<PrincipalSet>(cone));
  }

  std::string
  classification(const Scheme &scheme)
  {
    const auto in_words = [](const Parts &parts) -> std::string {
      return parts            ? "yes" :
             parts.spherical  ? "its volumetric part" :
             parts.deviatoric ? "its deviatoric part" :
                                "no";
    };
    const bool dissipative =
      contains(scheme, Kind::damper) || contains(scheme, Kind::hinge);
    return "stress from strain: " +
           in_words(stress_follows_from_strain(scheme)) +
           "; strain from stress: " +
           in_words(strain_follows_from_stress(scheme)) +
           "; symmetric tangent; " +
           (dissipative ? "dissipative" : "reversible");
  }
} // namespace Signoton::Rheology
