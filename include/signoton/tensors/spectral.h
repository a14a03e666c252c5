#ifndef signoton_tensors_spectral_h
#define signoton_tensors_spectral_h

#include <signoton/tensors/isotropic.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Signoton
{
  /**
   * Principal values in descending order with their directions,
   * $t=\sum_a y_a\,v_a\otimes v_a$. Jacobi rotations: safe for repeated roots.
   */
  struct SpectralDecomposition
  {
    explicit SpectralDecomposition(const Tensor2<> &t)
    {
      const auto pairs =
        eigenvectors(t, SymmetricTensorEigenvectorMethod::jacobi);
      for (unsigned int a = 0; a < 3; ++a)
        {
          values[a]     = pairs[a].first;
          directions[a] = pairs[a].second;
        }
    }

    std::array<double, 3>       values;
    std::array<Tensor<1, 3>, 3> directions;

    /** $\sum_a x_a\,v_a\otimes v_a$ for other principal values. */
    Tensor2<>
    compose(const std::array<double, 3> &x) const
    {
      Tensor2<> result;
      for (unsigned int a = 0; a < 3; ++a)
        result += x[a] * dyad(a, a);
      return result;
    }

    /** The symmetric part of $v_a\otimes v_b$. */
    Tensor2<>
    dyad(const unsigned int a, const unsigned int b) const
    {
      return symmetrize(outer_product(directions[a], directions[b]));
    }

    /**
     * Derivative of the isotropic tensor function with principal values
     * $x_a(y)$, composed with isotropic elasticity of shear modulus $\mu$:
     * $$ \sum_{ab} (JE)_{ab} M_a\otimes M_b +
     *    4\mu\sum_{a<b}\theta_{ab} S_{ab}\otimes S_{ab},\quad
     *    \theta_{ab}=\frac{x_a-x_b}{y_a-y_b}. $$
     * Where $y_a$ and $y_b$ coincide, $\theta_{ab}=J_{aa}-J_{ab}$.
     * @param x             principal values of the function
     * @param J_E           derivative $dx/dy$ times principal elasticity
     * @param shear_modulus $\mu$ in Pa
     */
    Tensor4<>
    tangent(const std::array<double, 3>                &x,
            const std::array<std::array<double, 3>, 3> &J_E,
            const double                                shear_modulus) const
    {
      const double scale = std::max(std::abs(values[0]), std::abs(values[2]));
      Tensor4<>    result;
      std::array<Tensor2<>, 3> M = {{dyad(0, 0), dyad(1, 1), dyad(2, 2)}};
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          result += J_E[a][b] * tensor_product(M[a], M[b]);
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = a + 1; b < 3; ++b)
          {
            const double gap = values[a] - values[b];
            // Projections are monotone and nonexpansive: theta is in [0,1].
            // At the threshold, round-off in the quotient is about 1e-8.
            const double theta =
              std::clamp(gap > 1e-7 * scale ?
                           (x[a] - x[b]) / gap :
                           (J_E[a][a] - J_E[a][b]) / (2. * shear_modulus),
                         0.,
                         1.);
            const Tensor2<> S = dyad(a, b);
            result += (4. * shear_modulus * theta) * tensor_product(S, S);
          }
      return result;
    }
  };
} // namespace Signoton

#endif
