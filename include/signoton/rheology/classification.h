#ifndef signoton_rheology_classification_h
#define signoton_rheology_classification_h

#include <signoton/rheology/laws.h>
#include <signoton/rheology/scheme.h>

#include <optional>

namespace Signoton::Rheology
{
  /** Whether something holds for the spherical and the deviatoric part. */
  struct Parts
  {
    bool spherical, deviatoric;

    explicit operator bool() const
    {
      return spherical && deviatoric;
    }
  };

  /**
   * Whether the history of strain determines the stress: springs and dampers
   * do, contacts and hinges do not; one part in series is enough, in parallel
   * it takes all. This is strict convexity of the complementary potential.
   */
  Parts
  stress_follows_from_strain(const Scheme &scheme);

  /** Whether the history of stress determines the strain, the dual of the
   *  former: one part in parallel is enough, in series it takes all. Hinges of
   *  von Mises that harden do, and the volume of von Mises and Tresca. */
  Parts
  strain_follows_from_stress(const Scheme &scheme);

  /** Refuse a scheme of which a part in series has no stiffness against
   *  changes of volume or of shape, a zero constant: the whole would have no
   *  pressure, or no shear stress. */
  void
  require_resistance(const Scheme &scheme, const std::string &where);

  /** Refuse a scheme whose stress the strain leaves open (the monograph calls
   *  it incorrect in the mechanical sense), with the element that cures it.
   *  Includes require_resistance(). */
  void
  require_stress_from_strain(const Scheme &scheme, const std::string &where);

  /** Whether an element of a kind is in the scheme. */
  bool
  contains(const Scheme &scheme, const Scheme::Kind kind);

  /** Moduli of the springs in Pa where nothing slips, opens or creeps. If that
   *  is rigid, dampers are left out, and if it still is, all but springs.
   *  Infinite or zero where there is no spring at all. */
  Moduli
  spring_moduli(const Scheme &scheme);

  /** Moduli left, in Pa, where all contacts are open and all hinges whose
   *  strength depends on the pressure have lost it. */
  Moduli
  loosened_moduli(const Scheme &scheme);

  /** Moduli in Pa of a scheme at rest, where dampers bear nothing and nothing
   *  slips or opens: zero if a damper in series lets all stress fade away. */
  Moduli
  rest_moduli(const Scheme &scheme);

  /** A time in s of the order of the longest that it takes dampers to relax;
   *  zero without dampers or without springs. */
  double
  relaxation_time(const Scheme &scheme);

  /** The stiffest that a scheme is in a time step, in Pa: nothing slips or
   *  opens, and dampers are springs of twice their viscosity by the step, which
   *  is what bounds the step of explicit time integration. */
  Moduli
  stiffest_moduli(const Scheme &scheme, const double time_step);

  /** The law of a scheme with a closed form; none if it has no such form. */
  std::optional<Law>
  closed_form(const Scheme &scheme);

  /** The law of a spring, a contact on a cone and a hinge on a von Mises
   *  cylinder, with a binder in parallel, whose hinge sees the conditional
   *  stress: see ConditionalPlasticity. */
  Law
  conditional_form(const Scheme &scheme);

  /** Properties in words, for --explain. */
  std::string
  classification(const Scheme &scheme);
} // namespace Signoton::Rheology

#endif
