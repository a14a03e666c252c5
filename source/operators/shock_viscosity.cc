#include <signoton/operators/shock_viscosity.h>

#include <limits>

// The numbers here were found with tests/verification: fronts from weak to
// strong ones, smooth pulses, falling columns.

namespace Signoton
{
  namespace
  {
    constexpr double tiny = std::numeric_limits<double>::min();

    double
    dilatation(const double *rates)
    {
      return rates[0] + rates[1] + rates[2];
    }

    /** The product of the deviators of two rates. */
    template <int dim>
    double
    shear_product(const double *a, const double *b)
    {
      double result = -dilatation(a) * dilatation(b) / 3.;
      for (unsigned int i = 0; i < FrontSensor<dim>::n_rates; ++i)
        result += a[i] * b[i];
      return result;
    }

    /** A dilatation below which no contact counts as open: what the fastest
     *  motion closes at once. Never zero. */
    template <int dim>
    double
    closed_at_once(const FrontSensor<dim> &sensor,
                   const ShockMaterial    &material,
                   const double            size)
    {
      return 1e-3 * size * sensor.fastest() / material.longitudinal_speed +
             tiny;
    }
  } // namespace

  template <int dim>
  ShockCoefficients
  shock_coefficients(const FrontSensor<dim> &sensor,
                     const unsigned int      cell,
                     const ShockMaterial    &material,
                     const ShockViscosity   &viscosity,
                     const double            size,
                     const double            extent)
  {
    using Sensor                = FrontSensor<dim>;
    const double     *told      = sensor[cell];
    const double      speed     = material.longitudinal_speed;
    const double      impedance = material.density * speed;
    const double      voids     = told[Sensor::voids];
    const double      rate      = size * material.stiffening * dilatation(told);
    const double      closed    = closed_at_once(sensor, material, size);
    const double      open = voids / (voids + told[Sensor::elastic] + closed);
    ShockCoefficients result;
    if (open > 0.)
      {
        const double closing = std::max(rate, 0.);
        const double most    = 0.87 * impedance * viscosity.bound();
        // waves of binders, which leave the contacts open, are no fronts
        const double fast  = 4. * closing,
                     slow  = material.loosened_speed * voids,
                     front = fast * fast / (fast * fast + slow * slow + tiny);
        result.quadratic   = material.density * viscosity.quadratic * open /
                           (voids + closing / speed + closed);
        const double q = closing * std::min(result.quadratic * closing, most);
        // About half of it: a neighbor that is pressed by this viscosity alone
        // would keep it up, and the grains in the air.
        const double support = 0.55 * sensor.support(cell);
        result.freedom       = front * (q > support ? support / q : 1.);
        result.quadratic *= result.freedom;
        result.cap = most * result.freedom;
      }
    const double noise =
      std::min(0.36, 1e-3 * extent / size) * sensor.sharpness(cell);
    const double fresh = told[Sensor::fresh];
    const double whole = (1. - open) * viscosity.linear * impedance;
    result.linear      = whole * std::min(noise + fresh, 1.);
    result.opening     = whole * std::min(noise + 0.5 * fresh, 1.);
    // contacts can part: at least half of their pressure is left
    const double pressure = impedance * speed * told[Sensor::elastic];
    if (-rate * result.opening > 0.5 * pressure)
      result.opening = -0.5 * pressure / rate;
    if (noise > 0.)
      {
        // plane longitudinal waves, which shear too, have the pressure
        const double spherical = dilatation(told) * dilatation(told),
                     shear     = 1.5 * shear_product<dim>(told, told);
        if (shear > spherical)
          result.shear = 2. * material.density * material.shear_speed * size *
                         viscosity.linear * noise * (1. - spherical / shear);
      }
    return result;
  }

  template <int dim>
  double
  tell_neighbors(FrontSensor<dim>       &sensor,
                 const unsigned int      cell,
                 const ShockMaterial    &material,
                 const ShockReport<dim> &report,
                 const double            freedom,
                 const double            size,
                 const double            time_step)
  {
    using Sensor       = FrontSensor<dim>;
    double       *told = sensor[cell];
    const double *rate = report.rate.data();
    const double  correction =
      0.5 * time_step *
      ((told[Sensor::viscous] - report.viscous) * dilatation(rate) +
       told[Sensor::viscosity] * shear_product<dim>(told, rate) -
       report.viscosity * shear_product<dim>(rate, rate));

    const double speed = material.longitudinal_speed;
    // times in which waves cross a cell
    const double crossings = time_step * speed / size;
    told[Sensor::sharp] /= 1. + 0.4 * crossings;
    told[Sensor::fresh] /= 1. + 0.125 * crossings;
    // Contacts that were open wide, beside the strain of the spring, have been
    // closed by a front, whose stress comes and goes if it is weak.
    if (material.stiffening * dilatation(rate) > 0.)
      {
        const double largest = *std::max_element(told + Sensor::traction,
                                                 told + Sensor::traction + dim);
        const double narrow  = largest / (material.density * speed * speed) +
                              closed_at_once(sensor, material, size);
        const double part = std::min(1., told[Sensor::voids] / narrow);
        told[Sensor::fresh] =
          std::max(told[Sensor::fresh], freedom * part * part);
      }
    for (unsigned int d = 0; d < dim; ++d)
      {
        double &traction = told[Sensor::traction + d];
        traction =
          std::max(report.traction[d], traction / (1. + 0.02 * crossings));
      }
    std::copy(report.rate.begin(), report.rate.end(), told);
    told[Sensor::voids] = report.voids;
    double pressed = 0., sum = tiny;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double share = sensor.stretching(cell, d) + tiny;
        pressed += share * report.of_law[d];
        sum += share;
      }
    told[Sensor::elastic] = pressed / (sum * material.density * speed * speed);
    told[Sensor::viscous] = report.viscous;
    told[Sensor::viscosity] = report.viscosity;
    return correction;
  }

#define instantiate(dim)                                                  \
  template ShockCoefficients shock_coefficients(const FrontSensor<dim> &, \
                                                const unsigned int,       \
                                                const ShockMaterial &,    \
                                                const ShockViscosity &,   \
                                                const double,             \
                                                const double);            \
  template double            tell_neighbors(FrontSensor<dim> &,           \
                                            const unsigned int,           \
                                            const ShockMaterial &,        \
                                            const ShockReport<dim> &,     \
                                            const double,                 \
                                            const double,                 \
                                            const double)
  instantiate(2);
  instantiate(3);
#undef instantiate
} // namespace Signoton
