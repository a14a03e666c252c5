#ifndef signoton_tensors_mandel_h
#define signoton_tensors_mandel_h

#include <signoton/tensors/isotropic.h>

#include <array>
#include <cmath>

namespace Signoton
{
  /**
   * Symmetric tensors as vectors with six entries, xx, yy, zz, and sqrt(2)
   * times xy, xz, yz, so that the scalar product of vectors is the double
   * contraction of tensors (Mandel's notation). Small and on the stack; for
   * one point at a time.
   */
  using Vector6 = std::array<double, 6>;

  inline Vector6
  to_mandel(const Tensor2<> &t)
  {
    Vector6 v;
    for (unsigned int c = 0; c < 6; ++c)
      v[c] = (c < 3 ? 1. : numbers::SQRT2) * t.access_raw_entry(c);
    return v;
  }

  inline Tensor2<>
  from_mandel(const Vector6 &v)
  {
    Tensor2<> t;
    for (unsigned int c = 0; c < 6; ++c)
      t.access_raw_entry(c) = (c < 3 ? 1. : numbers::SQRT1_2) * v[c];
    return t;
  }

  inline double
  dot(const Vector6 &a, const Vector6 &b)
  {
    double sum = 0.;
    for (unsigned int c = 0; c < 6; ++c)
      sum += a[c] * b[c];
    return sum;
  }

  /** `a + factor b`. */
  inline Vector6
  add_scaled(const Vector6 &a, const double factor, const Vector6 &b)
  {
    Vector6 sum;
    for (unsigned int c = 0; c < 6; ++c)
      sum[c] = a[c] + factor * b[c];
    return sum;
  }

  /** Scale the spherical and the deviatoric part of a vector. */
  inline Vector6
  scale(const double spherical, const double deviatoric, const Vector6 &v)
  {
    // The factors may differ by many powers of ten: no part of the spherical
    // part is to be in the deviator, not even round-off.
    const double mean = (v[0] + v[1] + v[2]) / 3.;
    Vector6      deviator;
    for (unsigned int c = 0; c < 6; ++c)
      deviator[c] = v[c] - (c < 3 ? mean : 0.);
    const double rest = (deviator[0] + deviator[1] + deviator[2]) / 3.;
    Vector6      result;
    for (unsigned int c = 0; c < 6; ++c)
      result[c] =
        c < 3 ? deviatoric * (deviator[c] - rest) + spherical * (mean + rest) :
                deviatoric * deviator[c];
    return result;
  }

  /** A linear map of such vectors, row by row. */
  class Matrix6
  {
  public:
    double &
    operator()(const unsigned int i, const unsigned int j)
    {
      return entries[6 * i + j];
    }

    double
    operator()(const unsigned int i, const unsigned int j) const
    {
      return entries[6 * i + j];
    }

    /** The map that scales spherical and deviatoric part. */
    static Matrix6
    isotropic(const double spherical, const double deviatoric)
    {
      Matrix6 m;
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          m(i, j) = (i == j ? deviatoric : 0.) +
                    (i < 3 && j < 3 ? (spherical - deviatoric) / 3. : 0.);
      return m;
    }

    Vector6
    operator*(const Vector6 &v) const
    {
      Vector6 result;
      for (unsigned int i = 0; i < 6; ++i)
        {
          result[i] = 0.;
          for (unsigned int j = 0; j < 6; ++j)
            result[i] += entries[6 * i + j] * v[j];
        }
      return result;
    }

    Matrix6
    operator*(const Matrix6 &other) const
    {
      Matrix6 result;
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int k = 0; k < 6; ++k)
          for (unsigned int j = 0; j < 6; ++j)
            result(i, j) += entries[6 * i + k] * other(k, j);
      return result;
    }

    Matrix6 &
    operator+=(const Matrix6 &other)
    {
      for (unsigned int i = 0; i < 36; ++i)
        entries[i] += other.entries[i];
      return *this;
    }

  private:
    std::array<double, 36> entries{};
  };

  inline Matrix6
  to_mandel(const Tensor4<> &t)
  {
    Matrix6 m;
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int j = 0; j < 6; ++j)
        m(i, j) = (i < 3 ? 1. : numbers::SQRT2) *
                  (j < 3 ? 1. : numbers::SQRT2) * t.access_raw_entry(6 * i + j);
    return m;
  }

  inline Tensor4<>
  from_mandel(const Matrix6 &m)
  {
    Tensor4<> t;
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int j = 0; j < 6; ++j)
        t.access_raw_entry(6 * i + j) = (i < 3 ? 1. : numbers::SQRT1_2) *
                                        (j < 3 ? 1. : numbers::SQRT1_2) *
                                        m(i, j);
    return t;
  }

  /** The inverse of a symmetric positive definite matrix, by $LDL^T$ after
   *  scaling the diagonal to one, which keeps badly scaled ones accurate. */
  inline Matrix6
  invert_positive(const Matrix6 &m)
  {
    Matrix6 l;
    Vector6 root, d;
    for (unsigned int i = 0; i < 6; ++i)
      root[i] = 1. / std::sqrt(m(i, i));
    for (unsigned int i = 0; i < 6; ++i)
      {
        for (unsigned int j = 0; j <= i; ++j)
          {
            double sum = root[i] * m(i, j) * root[j];
            for (unsigned int k = 0; k < j; ++k)
              sum -= l(i, k) * l(j, k) * d[k];
            if (i == j)
              d[i] = sum;
            else
              l(i, j) = sum / d[j];
          }
        l(i, i) = 1.;
      }
    // columns of the inverse of L, then L^-T D^-1 L^-1
    Matrix6 inverse_l;
    for (unsigned int j = 0; j < 6; ++j)
      for (unsigned int i = j; i < 6; ++i)
        {
          double sum = i == j ? 1. : 0.;
          for (unsigned int k = j; k < i; ++k)
            sum -= l(i, k) * inverse_l(k, j);
          inverse_l(i, j) = sum;
        }
    Matrix6 result;
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        {
          double sum = 0.;
          for (unsigned int k = i; k < 6; ++k)
            sum += inverse_l(k, i) * inverse_l(k, j) / d[k];
          result(i, j) = result(j, i) = root[i] * sum * root[j];
        }
    return result;
  }
} // namespace Signoton

#endif
