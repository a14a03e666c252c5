#ifndef signoton_rheology_scheme_h
#define signoton_rheology_scheme_h

#include <signoton/rheology/hydrostatic.h>
#include <signoton/rheology/mises_schleicher.h>
#include <signoton/rheology/principal_set.h>
#include <signoton/rheology/von_mises.h>

#include <map>
#include <string>
#include <variant>
#include <vector>

namespace Signoton::Rheology
{
  /** What may confine the stress of a contact or of a hinge. */
  using AdmissibleSet = std::variant<HydrostaticSet,
                                     MisesSchleicherCone,
                                     PrincipalSet,
                                     NoCompression,
                                     VonMisesCylinder<false>,
                                     VonMisesCylinder<true>>;

  /**
   * A rheological scheme: a tree of elements in series (equal stress, strains
   * add up) and in parallel (equal strain, stresses add up).
   *
   * As text:
   *
   *     series(spring(bulk = 1e8, shear = 6e7),
   *            parallel(contact(mises schleicher, friction = 0.5),
   *                     damper(shear viscosity = 1e9)))
   *
   * Elements are
   *  - `spring(bulk = , shear = )`, in Pa, one may be zero, or
   *    `spring(young = , poisson = )`;
   *  - `damper(bulk viscosity = , shear viscosity = )`, in Pa s, one may be
   *    left out;
   *  - `contact(CONE, ...)`, rigid and without dissipation: its strain is
   *    normal to the cone at its stress. With `gap = g`, and without cohesion,
   *    it closes only after a volumetric strain of -g;
   *  - `hinge(SET, ...)`: the rate of its strain is normal to the set at its
   *    stress.
   *
   * Sets, with strengths in Pa and angles in degrees:
   *  - `mises schleicher, friction = , cohesion = `;
   *  - `coulomb mohr, friction angle = , cohesion = `;
   *  - `no tension, tensile strength = `, contacts only;
   *  - `no compression`, contacts only, for fibers;
   *  - `hydrostatic, tensile strength = ` (contact), `strength = ` (hinge);
   *  - `von mises, strength = , isotropic hardening = `, hinges only;
   *  - `tresca, strength = `, hinges only.
   *
   * A word without parentheses is the name of a subtree defined elsewhere.
   * Source: Sadovskaya and Sadovskii (2012), Ch. 2, for the elements.
   */
  struct Scheme
  {
    enum class Kind
    {
      series,
      parallel,
      spring,
      damper,
      hinge,
      contact
    };

    Kind                kind = Kind::spring;
    std::vector<Scheme> parts; ///< of a group: two or more
    /** Elasticity of a spring in Pa, viscosity of a damper in Pa s. */
    Moduli moduli = {0., 0.};
    /** One set for contacts and hinges, none for others. */
    std::vector<AdmissibleSet> set;
    /** Volumetric strain, as a positive number, after which a contact closes. */
    double gap = 0.;
    /** The subtree as it was written, to speak about it. */
    std::string text;

    bool
    is_group() const
    {
      return kind == Kind::series || kind == Kind::parallel;
    }
  };

  /**
   * Read a scheme.
   * @param text        see Scheme
   * @param where       the place of the text, for error messages
   * @param definitions subtrees by name
   */
  Scheme
  parse_scheme(const std::string                        &text,
               const std::string                        &where,
               const std::map<std::string, std::string> &definitions = {});

  /** Whether a subtree can have this name: one that the text can hold, and that
   *  means nothing else. */
  bool
  is_scheme_name(const std::string &name);
} // namespace Signoton::Rheology

#endif
