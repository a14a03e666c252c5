#ifndef signoton_state_point_history_h
#define signoton_state_point_history_h

#include <signoton/tensors/isotropic.h>

#include <deal.II/base/aligned_vector.h>

#include <vector>

namespace Signoton
{
  /**
   * What the quadrature points remember, in two copies: accepted, at the
   * beginning of the step, and trial, at the iterate last evaluated. A step is
   * accepted by commit(); until then nothing accepted is touched, so that a
   * failed step needs no repair. Explicit time integration takes no step back
   * and writes to the accepted copy: without begin_trial() there is no other.
   *
   * The memory is one array, cell batch after cell batch, with as many numbers
   * a point as the law of the batch asks for; a law without memory takes none.
   */
  class PointHistory
  {
  public:
    using Number = VectorizedArray<double>;

    /** @param width numbers a point of each cell batch
     *  @param n_points points a cell */
    void
    reinit(const std::vector<unsigned int> &width, const unsigned int n_points)
    {
      widths = width;
      offset.assign(width.size() + 1, 0);
      for (std::size_t i = 0; i < width.size(); ++i)
        offset[i + 1] = offset[i] + width[i] * n_points;
      accepted_values.clear();
      accepted_values.resize(offset.back(), Number(0.));
      trial_values.clear();
      has_trial = false;
    }

    /** Before trial values are written, of all points. */
    void
    begin_trial()
    {
      trial_values.resize_fast(accepted_values.size());
      has_trial = true;
    }

    Number *
    accepted(const unsigned int batch, const unsigned int point)
    {
      return accepted_values.data() + offset[batch] + widths[batch] * point;
    }

    Number *
    trial(const unsigned int batch, const unsigned int point)
    {
      return trial_values.data() + offset[batch] + widths[batch] * point;
    }

    unsigned int
    width(const unsigned int batch) const
    {
      return widths[batch];
    }

    /** Make the trial state, if there is one, the accepted one. */
    void
    commit()
    {
      if (has_trial)
        accepted_values.swap(trial_values);
      has_trial = false;
    }

    /** Forget the trial state. */
    void
    discard()
    {
      has_trial = false;
    }

    std::size_t
    memory_consumption() const
    {
      return (accepted_values.size() + trial_values.size()) * sizeof(Number);
    }

  private:
    std::vector<unsigned int> widths;
    std::vector<std::size_t>  offset;
    AlignedVector<Number>     accepted_values;
    AlignedVector<Number>     trial_values;
    bool                      has_trial = false;
  };
} // namespace Signoton

#endif
