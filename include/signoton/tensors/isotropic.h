#ifndef signoton_tensors_isotropic_h
#define signoton_tensors_isotropic_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/vectorization.h>

namespace Signoton
{
  using namespace dealii;

  /**
   * Stress and strain are three-dimensional at every material point, whatever
   * the dimension of the mesh; see Embedding for the way in and out.
   */
  template <typename Number = double>
  using Tensor2 = SymmetricTensor<2, 3, Number>;

  template <typename Number = double>
  using Tensor4 = SymmetricTensor<4, 3, Number>;

  /** Pressure $p = -\mathrm{tr}\,\sigma/3$, positive in compression. */
  template <typename Number>
  inline DEAL_II_ALWAYS_INLINE Number
  pressure(const Tensor2<Number> &stress)
  {
    return trace(stress) * (-1. / 3.);
  }

  /** $t+sI$, without the products with zeros of $I$ that a compiler has to
   *  keep. */
  template <typename Number>
  inline DEAL_II_ALWAYS_INLINE Tensor2<Number>
  add_spherical(const Tensor2<Number> &t, const Number &s)
  {
    Tensor2<Number> result = t;
    for (unsigned int i = 0; i < 3; ++i)
      result.access_raw_entry(i) += s;
    return result;
  }

  /** $t-\mathrm{tr}\,t\,I/3$. The deviator() of deal.II 9.4 divides by an
   *  `int`, which vectorized numbers do not take. */
  template <typename Number>
  inline DEAL_II_ALWAYS_INLINE Tensor2<Number>
                               deviatoric_part(const Tensor2<Number> &t)
  {
    return add_spherical(t, pressure(t));
  }

  /** $\tau^2 = s':s'/2$ of a *deviatoric* stress. */
  template <typename Number>
  inline DEAL_II_ALWAYS_INLINE Number
  shear_invariant(const Tensor2<Number> &stress_deviator)
  {
    return 0.5 * (stress_deviator * stress_deviator);
  }

  /** Shear intensity $\tau = \sqrt{s':s'/2}$ of a *deviatoric* stress. */
  template <typename Number>
  inline DEAL_II_ALWAYS_INLINE Number
  shear_intensity(const Tensor2<Number> &stress_deviator)
  {
    return std::sqrt(shear_invariant(stress_deviator));
  }

  /** $a\otimes b$ on the 36 stored components. The outer_product() of deal.II
   *  9.4 goes through all 81 and takes several times as long. */
  template <typename Number>
  Tensor4<Number>
  tensor_product(const Tensor2<Number> &a, const Tensor2<Number> &b)
  {
    constexpr unsigned int n = Tensor2<Number>::n_independent_components;
    Tensor4<Number>        result;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        result.access_raw_entry(n * i + j) =
          a.access_raw_entry(i) * b.access_raw_entry(j);
    return result;
  }

  /** The isotropic tensor $c_v\, I\otimes I + c_d\, I_d$, with the deviatoric
   *  identity $I_d$: the elasticity tensor for $c_v=k$, $c_d=2\mu$. */
  template <typename Number>
  Tensor4<Number>
  isotropic_tensor(const Number &volumetric, const Number &deviatoric)
  {
    constexpr unsigned int n      = Tensor2<Number>::n_independent_components;
    Tensor4<Number>        result = deviatoric * deviator_tensor<3, Number>();
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        result.access_raw_entry(n * i + j) += volumetric;
    return result;
  }

  /**
   * Moduli of an isotropic spring: bulk modulus $k$ and shear modulus $\mu$,
   * both in Pa. Also the metric of an energy norm,
   * $|\sigma|^2 = p^2/k + \tau^2/\mu$.
   */
  struct Moduli
  {
    double bulk;
    double shear;

    /** $E:\varepsilon = k\,\theta\,I + 2\mu\,\varepsilon'$. */
    template <typename Number>
    DEAL_II_ALWAYS_INLINE Tensor2<Number>
                          stress(const Tensor2<Number> &strain) const
    {
      return add_spherical(Tensor2<Number>((2. * shear) * strain),
                           Number((bulk - 2. / 3. * shear) * trace(strain)));
    }

    /** The inverse of stress(). */
    template <typename Number>
    DEAL_II_ALWAYS_INLINE Tensor2<Number>
                          strain(const Tensor2<Number> &stress) const
    {
      return add_spherical(Tensor2<Number>(1. / (2. * shear) * stress),
                           Number((1. / (9. * bulk) - 1. / (6. * shear)) *
                                  trace(stress)));
    }

    template <typename Number>
    Tensor4<Number>
    tensor() const
    {
      return isotropic_tensor<Number>(Number(bulk), Number(2. * shear));
    }

    /** The inner product $\sigma : a : \tau$ of the energy norm, in J/m^3. */
    template <typename Number>
    Number
    energy_product(const Tensor2<Number> &a, const Tensor2<Number> &b) const
    {
      return (1. / (9. * bulk) - 1. / (6. * shear)) * trace(a) * trace(b) +
             1. / (2. * shear) * (a * b);
    }
  };

  /**
   * An operator that scales the spherical and the deviatoric part of a
   * tensor by a factor each. It commutes with isotropic elasticity.
   */
  struct IsotropicScaling
  {
    IsotropicScaling(const double spherical, const double deviatoric)
      : spherical(spherical)
      , deviatoric(deviatoric)
      , offset((spherical - deviatoric) / 3.)
    {}

    double spherical;
    double deviatoric;
    double offset; ///< what it adds to the diagonal by the trace

    template <typename Number>
    DEAL_II_ALWAYS_INLINE Tensor2<Number>
                          operator()(const Tensor2<Number> &t) const
    {
      return add_spherical(Tensor2<Number>(deviatoric * t),
                           Number(offset * trace(t)));
    }

    /** $A : T : A$ for a tangent $T$ with both minor symmetries. */
    template <typename Number>
    Tensor4<Number>
    both_sides(const Tensor4<Number> &tangent) const
    {
      const auto      I      = unit_symmetric_tensor<3, Number>();
      Tensor4<Number> scaled = (deviatoric * deviatoric) * tangent;
      if (offset != 0.)
        {
          const Tensor2<Number> right = tangent * I, left = I * tangent;
          scaled += (deviatoric * offset) *
                    (tensor_product(right, I) + tensor_product(I, left));
          scaled += (offset * offset * trace(right)) * tensor_product(I, I);
        }
      return scaled;
    }
  };
} // namespace Signoton

#endif
