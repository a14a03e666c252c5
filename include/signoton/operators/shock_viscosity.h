#ifndef signoton_operators_shock_viscosity_h
#define signoton_operators_shock_viscosity_h

#include <signoton/discretization/front_sensor.h>
#include <signoton/operators/mechanics.h>

#include <algorithm>
#include <cmath>

namespace Signoton
{
  /** What shock viscosity knows of a material. */
  struct ShockMaterial
  {
    double density;            ///< in kg/m^3
    double longitudinal_speed; ///< of the closed medium, in m/s
    double shear_speed;        ///< of the closed medium, in m/s
    double loosened_speed;     ///< longitudinal, if all contacts are open
    bool   opens;              ///< whether there are contacts
    /** The sign of the dilatation that stiffens it: -1 where contacts close
     *  under compression, 1 where fibers become taut. */
    double stiffening;
  };

  /**
   * The viscous stress in a batch of cells over a step: a pressure, which is
   * the derivative of a convex function of the distance $d$ by which the cell
   * closes, h times the dilatation that stiffens the material,
   * $$ q=\dot d(\eta+\min(\zeta\dot d,\hat\eta)),\quad \dot d\ge 0,\qquad
   *    q=\eta_-\dot d,\quad \dot d<0, $$
   * and a shear stress. For the coefficients see shock_coefficients().
   */
  template <typename Number>
  struct ShockStress
  {
    Number rate      = 0.; ///< of steps, in 1/s
    Number size      = 0.; ///< h in m
    Number linear    = 0.; ///< $\eta$ in Pa s/m
    Number opening   = 0.; ///< $\eta_-$ in Pa s/m
    Number quadratic = 0.; ///< $\zeta$ in Pa s^2/m^2
    Number cap       = 0.; ///< $\hat\eta$ in Pa s/m
    Number shear     = 0.; ///< in Pa s
    Number freedom   = 0.; ///< see ShockCoefficients
    double sign      = -1.;
    // of the material
    bool   opens        = false;
    double bulk_modulus = 1., impedance = 1.;

    /** By which a cell closes in the step, in m; negative if it opens. */
    Number
    closing(const Tensor2<Number> &change) const
    {
      return (sign * size) * trace(change);
    }

    Number
    pressure(const Number &distance) const
    {
      const Number zero(0.), speed = rate * distance,
                             closing = std::max(speed, zero);
      return closing * (linear + std::min(Number(quadratic * closing), cap)) +
             std::min(speed, zero) * opening;
    }

    /** What the law's stress is to be added to it by a change of strain. */
    Tensor2<Number>
    stress(const Tensor2<Number> &change) const
    {
      return add_spherical(Tensor2<Number>((shear * rate) *
                                           deviatoric_part(change)),
                           Number(sign * pressure(closing(change))));
    }

    /** $q:\Delta\varepsilon$, in J/m^3. */
    Number
    dissipation(const Tensor2<Number> &change) const
    {
      const Number          distance  = closing(change);
      const Tensor2<Number> deviation = deviatoric_part(change);
      return pressure(distance) * distance / size +
             (shear * rate) * (deviation * deviation);
    }

    /** Of which stress() is the derivative, in J/m^3. */
    Number
    potential(const Tensor2<Number> &change) const
    {
      const Number zero(0.), distance = closing(change),
                             closed = std::max(distance, zero),
                             opened = std::min(distance, zero);
      // Up to where the quadratic part reaches its cap. Where there is none,
      // none has been reached: a division by zero would be trapped.
      const Number part =
        std::min(closed,
                 Number(cap /
                        std::max(Number(quadratic * rate), Number(1e-100))));
      const Tensor2<Number> deviation = deviatoric_part(change);
      return rate *
               (0.5 * linear * closed * closed +
                0.5 * opening * opened * opened +
                (1. / 3.) * quadratic * rate * part * part * part +
                0.5 * cap * (closed * closed - part * part)) /
               size +
             0.5 * (shear * rate) * (deviation * deviation);
    }

    /** The derivative of stress(). */
    Tensor4<Number>
    tangent(const Tensor2<Number> &change) const
    {
      const Number zero(0.), distance = closing(change);
      const Number of_speed = quadratic * rate * distance;
      const Number stiffness =
        rate * (linear + compare_and_apply_mask<SIMDComparison::less_than>(
                           of_speed, cap, Number(2. * of_speed), cap));
      return isotropic_tensor<Number>(
        size * compare_and_apply_mask<SIMDComparison::greater_than>(
                 distance, zero, stiffness, Number(rate * opening)),
        Number(shear * rate));
    }
  };

  /** The coefficients of one cell, in the units of ShockStress. */
  struct ShockCoefficients
  {
    double linear = 0., opening = 0., quadratic = 0., cap = 0., shear = 0.;
    /** How much of the viscosity of closing contacts is left in view of what
     *  presses from outside. */
    double freedom = 0.;
  };

  /**
   * Viscosity goes by the speed of the front.
   *
   * Where contacts are open, a front closes the dilatation e that is left by the
   * speed $\dot d$ of one side of the cell against the other: its secant speed
   * is of the order of $\dot d/e$, and $q=c_q\rho\dot d^2/e$ spreads it
   * over $\pi\sqrt{c_q}$ cells in the shape of a half wave, whatever its
   * strength, and brings the contacts to rest as they close. It is bounded by
   * what the closed medium would have, $c_l\rho c_p\dot d$, and by about half the
   * stress of those neighbors that are closed: what flies freely is not slowed
   * down before it lands. Of a medium with binders, what closes no faster than
   * their waves is no front.
   *
   * Where contacts are closed, waves are linear: they need no viscosity but for
   * their noise. Behind a front that has just closed a cell, and where the
   * motion jumps from cell to cell, $q=c\rho c_p\dot d$ takes it out.
   *
   * @param extent of the body in cells: what a wave of jumps loses as it
   *   crosses the body is to be small
   */
  template <int dim>
  ShockCoefficients
  shock_coefficients(const FrontSensor<dim> &sensor,
                     const unsigned int      cell,
                     const ShockMaterial    &material,
                     const ShockViscosity   &viscosity,
                     const double            size,
                     const double            extent);

  /** What a cell tells its neighbors about a step: means over its points. */
  template <int dim>
  struct ShockReport
  {
    std::array<double, FrontSensor<dim>::n_rates> rate; ///< see FrontSensor
    /** Across the axes of the cell in Pa, with the viscous one: its size. */
    std::array<double, dim> traction;
    std::array<double, dim> of_law; ///< the same without the viscous one
    double voids;              ///< dilatation of the contacts, if they are open
    double viscous, viscosity; ///< see FrontSensor
  };

  /** Keep a report of a step of so many seconds for the neighbors, and for the
   *  cell itself that a front has closed it.
   *
   *  @return what is to be added to the dissipation of the step, in J/m^3. A
   *    step goes on under the mean of the stresses before and after: that is
   *    what takes the energy, rather than the stress after it. Between the means
   *    over a cell; within it the difference is small. */
  template <int dim>
  double
  tell_neighbors(FrontSensor<dim>       &sensor,
                 const unsigned int      cell,
                 const ShockMaterial    &material,
                 const ShockReport<dim> &report,
                 const double            freedom,
                 const double            size,
                 const double            time_step);
} // namespace Signoton

#endif
