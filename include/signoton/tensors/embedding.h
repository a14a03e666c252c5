#ifndef signoton_tensors_embedding_h
#define signoton_tensors_embedding_h

#include <signoton/tensors/isotropic.h>

namespace Signoton
{
  /**
   * How a mesh of dimension `dim` sits in space. The law sees the full 3x3
   * strain; an embedding says which of its entries the mesh can produce, in
   * the order xx, yy, zz, xy, xz, yz (0 to 5) of deal.II's raw entries.
   *
   *  - `strain_entries`: the entries that vary, so also rows and columns of a
   *    condensed tangent;
   *  - `tensor_entries`: the entries of stresses and history that are not
   *    zero by symmetry.
   */
  struct PlaneStrain
  {
    static constexpr int  dim          = 2;
    static constexpr bool axisymmetric = false;

    static constexpr std::array<unsigned int, 3> strain_entries = {{0, 1, 3}};
    static constexpr std::array<unsigned int, 4> tensor_entries = {
      {0, 1, 2, 3}};
  };

  /** Coordinates $(x,y)$ are radius and axis $(r,z)$; entry zz is the hoop
   *  strain $u_r/r$. */
  struct Axisymmetric
  {
    static constexpr int  dim          = 2;
    static constexpr bool axisymmetric = true;

    static constexpr std::array<unsigned int, 4> strain_entries = {
      {0, 1, 2, 3}};
    static constexpr std::array<unsigned int, 4> tensor_entries = {
      {0, 1, 2, 3}};
  };

  struct Solid
  {
    static constexpr int  dim          = 3;
    static constexpr bool axisymmetric = false;

    static constexpr std::array<unsigned int, 6> strain_entries = {
      {0, 1, 2, 3, 4, 5}};
    static constexpr std::array<unsigned int, 6> tensor_entries = {
      {0, 1, 2, 3, 4, 5}};
  };

  /** A 2D tensor as the xx, yy, xy entries of a 3x3 one; the rest is zero. */
  template <typename Number>
  Tensor2<Number>
  to_3d(const SymmetricTensor<2, 2, Number> &t)
  {
    Tensor2<Number> result;
    result.access_raw_entry(0) = t.access_raw_entry(0);
    result.access_raw_entry(1) = t.access_raw_entry(1);
    result.access_raw_entry(3) = t.access_raw_entry(2);
    return result;
  }

  template <typename Number>
  const Tensor2<Number> &
  to_3d(const Tensor2<Number> &t)
  {
    return t;
  }

  /** The in-plane part of a 3x3 tensor. */
  template <int dim, typename Number>
  SymmetricTensor<2, dim, Number>
  to_mesh(const Tensor2<Number> &t)
  {
    if constexpr (dim == 3)
      return t;
    else
      {
        SymmetricTensor<2, 2, Number> result;
        result.access_raw_entry(0) = t.access_raw_entry(0);
        result.access_raw_entry(1) = t.access_raw_entry(1);
        result.access_raw_entry(2) = t.access_raw_entry(3);
        return result;
      }
  }

  /** Entries that a tangent of an embedding keeps: the condensed matrix, of a
   *  symmetric one the upper triangle. */
  template <typename Embedding>
  constexpr unsigned int
  n_tangent_entries(const bool symmetric)
  {
    constexpr unsigned int n = Embedding::strain_entries.size();
    return symmetric ? n * (n + 1) / 2 : n * n;
  }

  /** Write the condensed tangent to @p packed, row by row. */
  template <typename Embedding, bool symmetric, typename Number>
  void
  pack_tangent(const Tensor4<Number> &tangent, Number *packed)
  {
    constexpr auto &entries = Embedding::strain_entries;
    for (unsigned int a = 0; a < entries.size(); ++a)
      for (unsigned int b = symmetric ? a : 0; b < entries.size(); ++b)
        {
          const auto row = Tensor2<>::unrolled_to_component_indices(entries[a]);
          const auto col = Tensor2<>::unrolled_to_component_indices(entries[b]);
          *packed++      = tangent[row[0]][row[1]][col[0]][col[1]];
        }
  }

  /** The stress increment of a strain increment by a packed tangent. */
  template <typename Embedding, bool symmetric, typename Number>
  Tensor2<Number>
  apply_packed_tangent(const Number *packed, const Tensor2<Number> &strain)
  {
    constexpr auto        &entries = Embedding::strain_entries;
    constexpr unsigned int n       = entries.size();
    Number                 in[n], out[n];
    for (unsigned int a = 0; a < n; ++a)
      {
        in[a] = strain.access_raw_entry(entries[a]);
        if (entries[a] >= 3) // both xy and yx
          in[a] += in[a];
        out[a] = Number(0.);
      }
    for (unsigned int a = 0; a < n; ++a)
      if constexpr (symmetric)
        {
          out[a] += *packed++ * in[a];
          for (unsigned int b = a + 1; b < n; ++b)
            {
              out[a] += *packed * in[b];
              out[b] += *packed++ * in[a];
            }
        }
      else
        for (unsigned int b = 0; b < n; ++b)
          out[a] += *packed++ * in[b];
    Tensor2<Number> stress;
    for (unsigned int a = 0; a < n; ++a)
      stress.access_raw_entry(entries[a]) = out[a];
    return stress;
  }
} // namespace Signoton

#endif
