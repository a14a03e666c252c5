#ifndef signoton_rheology_principal_set_h
#define signoton_rheology_principal_set_h

#include <signoton/rheology/projection.h>
#include <signoton/tensors/lanes.h>
#include <signoton/tensors/spectral.h>

namespace Signoton::Rheology
{
  /**
   * Sets bounded by planes in the space of principal stresses
   * $\sigma_1\ge\sigma_2\ge\sigma_3$:
   * $$ F = \{\sigma_1 - m\,\sigma_3 \le (1-m)\,p_0 + Y\},\quad 0\le m\le 1. $$
   *  - Coulomb-Mohr cone: $m=(1-\sin\phi)/(1+\sin\phi)$, apex at the
   *    hydrostatic tension $p_0=c\cot\phi$, $Y=0$;
   *  - no tension: $m=0$, apex at the tensile strength $p_0$, $Y=0$;
   *  - Tresca: $m=1$, $Y=2\tau_Y$.
   *
   * The energy-norm projection keeps the principal directions. With
   * $y$ the principal trial stresses minus $p_0$, $E$ principal elasticity,
   * $a=(1,0,-m)$, it is found in sequence, without trial loops:
   *  1. $a\cdot y\le Y$: interior, $x=y$;
   *  2. face: $x=y-L\,Ea$, $L=(a\cdot y-Y)/(a\cdot Ea)$, if it keeps the order;
   *  3. else the edge that the order violation points to: the line
   *     $x=x_0+t\,r$ with $r=-(m,m,1)$ where $x_1<x_2$ (compression edge) and
   *     $r=-(m,1,1)$ where $x_2<x_3$ (extension edge),
   *     $t=w\cdot(y-x_0)/(w\cdot r)$, $w=E^{-1}r$;
   *  4. vertex, if the edge is a ray and $t\le 0$.
   *
   * Source: sequential form of the return map in principal space, compare
   * Clausen, Damkilde and Andersen, Comput. Struct. 85 (2007); derived anew
   * here from the optimality conditions and checked by brute force.
   */
  class PrincipalSet
  {
  public:
    static constexpr bool hardens       = false;
    static constexpr bool of_revolution = false;

    /** @param friction_angle in radians, $0<\phi<\pi/2$
     *  @param apex hydrostatic tensile strength $p_0$ in Pa */
    static PrincipalSet
    coulomb_mohr(const double friction_angle, const double apex)
    {
      const double s = std::sin(friction_angle);
      return PrincipalSet((1. - s) / (1. + s), apex, 0.);
    }

    /** @param tensile_strength in Pa */
    static PrincipalSet
    no_tension(const double tensile_strength)
    {
      return PrincipalSet(0., tensile_strength, 0.);
    }

    /** @param shear_strength $\tau_Y$ in Pa, half the uniaxial strength */
    static PrincipalSet
    tresca(const double shear_strength)
    {
      return PrincipalSet(1., 0., 2. * shear_strength);
    }

    /** See Projection. */
    template <typename Number, bool with_tangent>
    void
    project(const Tensor2<Number>            &trial,
            const Moduli                     &moduli,
            Projection<Number, with_tangent> &result) const
    {
      result.potential_correction = 0.;
      for (unsigned int i = 0; i < n_lanes<Number>(); ++i)
        {
          const Tensor2<>                         t = lane(trial, i);
          Tensor2<>                               stress;
          ProjectionTangent<double, with_tangent> derivative;
          const Region region = project_lane(t, moduli, stress, derivative);
          set_lane(result.stress, i, stress);
          set_lane(result.region, i, index(region));
          if constexpr (with_tangent)
            set_lane(result.tangent, i, derivative.tangent);
        }
    }

    /** See Projection. It spares most points inside the spectral
     *  decomposition: all principal values lie within $-p\pm 2\tau/\sqrt3$. */
    template <typename Number>
    DEAL_II_ALWAYS_INLINE bool
    surely_contains(const Number &pressure,
                    const Number &shear_invariant,
                    const Number &) const
    {
      const Number room = bound + (1. - m) * (pressure + apex);
      return all_not_greater(Number(0.), room) &&
             all_not_greater(Number((4. / 3. * (1. + m) * (1. + m)) *
                                    shear_invariant),
                             Number(room * room));
    }

    bool
    ignores_pressure() const
    {
      return !is_cone;
    }

    double
    apex_tension() const
    {
      return apex;
    }

  private:
    using Vector3 = std::array<double, 3>;
    using Matrix3 = std::array<Vector3, 3>;

    PrincipalSet(const double m, const double apex, const double bound)
      : m(m)
      , apex(apex)
      , bound(bound)
      , is_cone(m < 1.)
    {}

    /** The part of project() for one point. */
    template <bool with_tangent>
    Region
    project_lane(const Tensor2<>                         &trial,
                 const Moduli                            &moduli,
                 Tensor2<>                               &stress,
                 ProjectionTangent<double, with_tangent> &derivative) const
    {
      if (surely_contains(pressure(trial),
                          shear_invariant(deviatoric_part(trial)),
                          0.))
        {
          stress = trial;
          if constexpr (with_tangent)
            derivative.tangent = moduli.tensor<double>();
          return Region::interior;
        }
      const SpectralDecomposition spectrum(trial);
      Vector3                     y = spectrum.values, x;
      for (double &value : y)
        value -= apex;
      Matrix3      J_E;
      const Region region = project_principal(y, moduli, x, J_E);
      for (double &value : x)
        value += apex;
      stress = region == Region::interior ? trial : spectrum.compose(x);
      if constexpr (with_tangent)
        derivative.tangent = region == Region::interior ?
                               moduli.tensor<double>() :
                               spectrum.tangent(x, J_E, moduli.shear);
      return region;
    }

    /** The projection of principal values $y$, with $x$ and $JE$. */
    Region
    project_principal(const Vector3 &y,
                      const Moduli  &moduli,
                      Vector3       &x,
                      Matrix3       &J_E) const
    {
      const double lambda = moduli.bulk - 2. / 3. * moduli.shear;
      const double mu2    = 2. * moduli.shear;
      const double excess = y[0] - m * y[2] - bound;
      if (excess <= 0.)
        {
          x = y;
          return Region::interior;
        }

      const Vector3 E_a   = {{lambda * (1. - m) + mu2,
                              lambda * (1. - m),
                              lambda * (1. - m) - mu2 * m}};
      const double  a_E_a = E_a[0] - m * E_a[2];
      for (unsigned int i = 0; i < 3; ++i)
        x[i] = y[i] - excess / a_E_a * E_a[i];
      if (x[0] >= x[1] && x[1] >= x[2])
        {
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              J_E[i][j] =
                lambda + (i == j ? mu2 : 0.) - E_a[i] * E_a[j] / a_E_a;
          return Region::face;
        }
      return project_on_edge(y, moduli, x[0] < x[1], x, J_E);
    }

    /** Steps 3 and 4 of the sequence in the class comment. */
    Region
    project_on_edge(const Vector3 &y,
                    const Moduli  &moduli,
                    const bool     compression,
                    Vector3       &x,
                    Matrix3       &J_E) const
    {
      const Vector3 r  = {{-m, compression ? -m : -1., -1.}};
      const Vector3 x0 = {{bound, compression ? bound : 0., 0.}};
      // Spherical and deviatoric parts apart: summed up, they would cancel for
      // a ray close to the hydrostatic axis and k >> mu.
      const double mean_r = (r[0] + r[1] + r[2]) / 3.;
      double       w_r = 0., w_y = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const double w =
            mean_r / (3. * moduli.bulk) + (r[i] - mean_r) / (2. * moduli.shear);
          w_r += w * r[i];
          w_y += w * (y[i] - x0[i]);
        }
      const double t = w_y / w_r;
      if (is_cone && t <= 0.)
        {
          x.fill(0.);
          J_E.fill(x);
          return Region::vertex;
        }
      for (unsigned int i = 0; i < 3; ++i)
        {
          x[i] = x0[i] + t * r[i];
          for (unsigned int j = 0; j < 3; ++j)
            J_E[i][j] = r[i] * r[j] / w_r;
        }
      return compression ? Region::compression_edge : Region::extension_edge;
    }

    double m;
    double apex;
    double bound;
    bool   is_cone;
  };

  /**
   * No principal stress below zero: fibers, which carry tension only. The
   * mirror image of the set without tension.
   */
  class NoCompression
  {
  public:
    static constexpr bool hardens       = false;
    static constexpr bool of_revolution = false;

    /** See Projection. */
    template <typename Number, bool with_tangent>
    void
    project(const Tensor2<Number>            &trial,
            const Moduli                     &moduli,
            Projection<Number, with_tangent> &result) const
    {
      no_tension.project(Tensor2<Number>(-trial), moduli, result);
      result.stress *= -1.;
    }

    /** See Projection. */
    template <typename Number>
    DEAL_II_ALWAYS_INLINE bool
    surely_contains(const Number &pressure,
                    const Number &shear_invariant,
                    const Number &plastic_shear) const
    {
      return no_tension.surely_contains(Number(-pressure),
                                        shear_invariant,
                                        plastic_shear);
    }

    double
    apex_tension() const
    {
      return 0.;
    }

  private:
    PrincipalSet no_tension = PrincipalSet::no_tension(0.);
  };
} // namespace Signoton::Rheology

#endif
