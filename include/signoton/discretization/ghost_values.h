#ifndef signoton_discretization_ghost_values_h
#define signoton_discretization_ghost_values_h

#include <signoton/discretization/space.h>

namespace Signoton
{
  /** Lets the ghost values of a vector be read as long as it lives: sweeps take
   *  vectors that keep theirs as up to date. On all ranks. */
  class GhostValues
  {
  public:
    explicit GhostValues(const VectorType &vector)
      : vector(vector)
      , had_them(vector.has_ghost_elements())
    {
      if (!had_them)
        vector.update_ghost_values();
    }

    GhostValues(const GhostValues &) = delete;
    GhostValues &
    operator=(const GhostValues &) = delete;

    ~GhostValues()
    {
      if (!had_them)
        vector.zero_out_ghost_values();
    }

  private:
    const VectorType &vector;
    const bool        had_them;
  };
} // namespace Signoton

#endif
