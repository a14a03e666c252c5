#ifndef signoton_rheology_hydrostatic_h
#define signoton_rheology_hydrostatic_h

#include <signoton/rheology/projection.h>
#include <signoton/tensors/lanes.h>

#include <limits>

namespace Signoton::Rheology
{
  /**
   * A bound on the pressure alone, $-p_0\le p\le p_1$; shear is not restricted.
   * As a contact, with $p_1=\infty$, it closes and opens with the volume; as a
   * hinge it crushes and dilates. The projection cuts the pressure.
   */
  class HydrostaticSet
  {
  public:
    static constexpr bool hardens = false;

    /** Both arguments in Pa.
     *  @param tension     $p_0\ge 0$, the largest hydrostatic tension
     *  @param compression $p_1>0$, the largest pressure */
    HydrostaticSet(
      const double tension,
      const double compression = std::numeric_limits<double>::infinity())
      : tension(tension)
      , compression(compression)
    {}

    /** See Projection. */
    template <typename Number, bool with_tangent>
    void
    project(const Tensor2<Number>            &trial,
            const Moduli                     &moduli,
            Projection<Number, with_tangent> &result) const
    {
      const Number p = pressure(trial);
      const Number new_p =
        std::min(std::max(p, Number(-tension)), Number(compression));
      const Number inside(index(Region::interior));
      const Number outside(index(Region::face));
      result.potential_correction = 0.;
      result.stress               = add_spherical(trial, Number(p - new_p));
      result.region               = select_if_not_greater(
        p,
        Number(compression),
        select_if_not_greater(Number(-tension), p, inside, outside),
        outside);
      if constexpr (with_tangent)
        result.tangent =
          isotropic_tensor<Number>(select_if_not_greater(result.region,
                                                         inside,
                                                         Number(moduli.bulk),
                                                         Number(0.)),
                                   Number(2. * moduli.shear));
    }

    double
    apex_tension() const
    {
      return tension;
    }

  private:
    double tension;
    double compression;
  };
} // namespace Signoton::Rheology

#endif
