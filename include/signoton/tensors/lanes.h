#ifndef signoton_tensors_lanes_h
#define signoton_tensors_lanes_h

#include <signoton/tensors/isotropic.h>

namespace Signoton
{
  /**
   * Access to the lanes of a number that may be a `double` (one lane) or a
   * `VectorizedArray<double>`: laws that branch lane by lane are written once.
   */
  inline double
  lane(const double x, const unsigned int)
  {
    return x;
  }

  template <std::size_t width>
  double
  lane(const VectorizedArray<double, width> &x, const unsigned int i)
  {
    return x[i];
  }

  inline void
  set_lane(double &x, const unsigned int, const double value)
  {
    x = value;
  }

  template <std::size_t width>
  void
  set_lane(VectorizedArray<double, width> &x,
           const unsigned int              i,
           const double                    value)
  {
    x[i] = value;
  }

  template <typename Number>
  constexpr unsigned int
  n_lanes()
  {
    if constexpr (std::is_same_v<Number, double>)
      return 1;
    else
      return Number::size();
  }

  template <typename Number>
  Tensor2<>
  lane(const Tensor2<Number> &t, const unsigned int i)
  {
    Tensor2<> result;
    for (unsigned int c = 0; c < Tensor2<>::n_independent_components; ++c)
      result.access_raw_entry(c) = lane(t.access_raw_entry(c), i);
    return result;
  }

  template <typename Number>
  void
  set_lane(Tensor2<Number> &t, const unsigned int i, const Tensor2<> &value)
  {
    for (unsigned int c = 0; c < Tensor2<>::n_independent_components; ++c)
      set_lane(t.access_raw_entry(c), i, value.access_raw_entry(c));
  }

  template <typename Number>
  void
  set_lane(Tensor4<Number> &t, const unsigned int i, const Tensor4<> &value)
  {
    for (unsigned int c = 0; c < Tensor4<>::n_independent_components; ++c)
      set_lane(t.access_raw_entry(c), i, value.access_raw_entry(c));
  }

  /** `a <= b ? yes : no`, lane by lane. */
  template <typename Number>
  Number
  select_if_not_greater(const Number &a,
                        const Number &b,
                        const Number &yes,
                        const Number &no)
  {
    return compare_and_apply_mask<SIMDComparison::less_than_or_equal>(a,
                                                                      b,
                                                                      yes,
                                                                      no);
  }

  /** `a < b ? yes : no`, lane by lane. */
  template <typename Number>
  Number
  select_if_less(const Number &a,
                 const Number &b,
                 const Number &yes,
                 const Number &no)
  {
    return compare_and_apply_mask<SIMDComparison::less_than>(a, b, yes, no);
  }

  /** Whether `a <= b` holds in every lane. */
  template <typename Number>
  bool
  all_not_greater(const Number &a, const Number &b)
  {
    for (unsigned int i = 0; i < n_lanes<Number>(); ++i)
      if (!(lane(a, i) <= lane(b, i)))
        return false;
    return true;
  }
} // namespace Signoton

#endif
