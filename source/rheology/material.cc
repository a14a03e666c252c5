#include <signoton/rheology/classification.h>
#include <signoton/rheology/library.h>
#include <signoton/rheology/material.h>

#include <cmath>

namespace Signoton::Rheology
{
  double
  Material::longitudinal_speed() const
  {
    return std::sqrt((elasticity.bulk + 4. / 3. * elasticity.shear) / density);
  }

  double
  Material::crossing_time(const double       distance,
                          const unsigned int n_extensions) const
  {
    // Dampers are the stiffer the shorter the step: a fixed point, from above,
    // where the error shrinks by half each time or faster.
    double time = 1e30;
    for (unsigned int i = 0; i < 100; ++i)
      {
        const Moduli m    = stiffest_moduli(scheme, time);
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
    if (!has_potential)
      return rheology + " = " + scheme.text +
             ", the hinge on the conditional stress; " +
             classification(scheme) + "; has a closed form and no potential";
    const std::string text =
      rheology +
      (ready_scheme(rheology) != nullptr ? " = " + scheme.text : std::string());
    return text + "; " + classification(scheme) +
           (closed_form(scheme) ? "; has a closed form" :
                                  "; general local solver");
  }

  Law
  make_law(const Material &material, const Scaling &scaling)
  {
    const double ratio  = scaling.least_binder_ratio;
    const Scheme scheme = ratio > material.binder_ratio ?
                            material.with_binder_ratio(ratio) :
                            material.scheme;
    if (!material.has_potential)
      return conditional_form(scheme);
    const std::optional<Law> closed = closed_form(scheme);
    return closed ? *closed : General(scheme);
  }
} // namespace Signoton::Rheology
