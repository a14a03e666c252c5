#ifndef signoton_rheology_projection_h
#define signoton_rheology_projection_h

#include <signoton/tensors/isotropic.h>

#include <array>

namespace Signoton::Rheology
{
  /**
   * Where on its admissible set a stress lies: the branch of the material law.
   * A mesh is refined where neighbors differ in it.
   */
  enum class Region : unsigned int
  {
    interior,         ///< the spring alone
    face,             ///< lateral surface of a cone, plane of a polyhedral cone
    compression_edge, ///< edge where the two larger principal stresses meet
    extension_edge,   ///< edge where the two smaller principal stresses meet
    vertex,           ///< apex: loosened material
    cylinder,         ///< plastic flow at a strength that ignores the pressure
    corner            ///< circle where cone and cylinder meet
  };

  constexpr unsigned int n_regions = 7;

  inline const std::array<const char *, n_regions> region_names = {
    {"interior",
     "face",
     "compression edge",
     "extension edge",
     "vertex",
     "cylinder",
     "corner"}};

  /** As a number that fits a lane of a vectorized array. */
  constexpr double
  index(const Region region)
  {
    return static_cast<unsigned int>(region);
  }

  /** The derivative in a Projection, if it is asked for: to set up tensors that
   *  nobody reads costs as much as the rest. */
  template <typename Number, bool with_tangent>
  struct ProjectionTangent
  {
    /** $d\pi/de$ with $t = E_c:e$; symmetric, between 0 and $E_c$. */
    Tensor4<Number> tangent;
  };

  template <typename Number>
  struct ProjectionTangent<Number, false>
  {};

  /**
   * The result of projecting a trial stress $t$ onto a convex set of stresses
   * in the energy norm of moduli $(k_c,\mu_c)$. The sets' functions project()
   * fill it. Their surely_contains() tells by the pressure, $\tau^2$ and the
   * accumulated plastic shear of a stress whether it is inside in all lanes, a
   * test without a root; a set may say no to a stress that is inside.
   */
  template <typename Number, bool with_tangent>
  struct Projection : ProjectionTangent<Number, with_tangent>
  {
    /** The nearest admissible stress $\pi$. */
    Tensor2<Number> stress;
    /** Region of every lane, see index(). */
    Number region;
    /** Accumulated plastic shear: accepted value in, new value out; only
     *  sets that harden read or write it. */
    Number hardening;
    /** What hardening adds to the incremental potential, in J/m^3. */
    Number potential_correction;
    /** The part of the shear of $t-\pi$ that belongs to the cylinder, where a
     *  set has one next to a cone; others leave it untouched. */
    Number cylinder_share;
  };

  /**
   * The same for a set of revolution about the hydrostatic axis, which leaves
   * the direction of the deviator as it is: `set.radial_return(p, tau_2,
   * hardening, moduli)` of the invariants $p$, $\tau^2$ of $t$. Such sets have
   * `of_revolution`. Members as in Projection.
   */
  template <typename Number>
  struct RadialReturn
  {
    Number pressure;    ///< of $\pi$ in Pa
    Number shear_scale; ///< $\pi'=$ this times $t'$
    Number region, hardening, cylinder_share;
  };

  /**
   * A tangent that is isotropic but for the direction $n=t'/\tau$ of the trial
   * deviator, $n:n=2$: all sets of revolution have this one. In the basis
   * $I$, $n$: $$ T = a_{II}\,I\otimes I + a_{In}(I\otimes n+n\otimes I)
   *                + a_{nn}\,n\otimes n + a_d (I_d - n\otimes n/2). $$
   */
  template <typename Number>
  Tensor4<Number>
  revolution_tangent(const Number          &a_II,
                     const Number          &a_In,
                     const Number          &a_nn,
                     const Number          &a_d,
                     const Tensor2<Number> &n)
  {
    const auto I = unit_symmetric_tensor<3, Number>();
    return isotropic_tensor<Number>(a_II, a_d) +
           a_In * (tensor_product(I, n) + tensor_product(n, I)) +
           (a_nn - 0.5 * a_d) * tensor_product(n, n);
  }
} // namespace Signoton::Rheology

#endif
