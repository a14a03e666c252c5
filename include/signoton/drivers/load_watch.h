#ifndef signoton_drivers_load_watch_h
#define signoton_drivers_load_watch_h

#include <signoton/base/function.h>

namespace Signoton
{
  /** Looks at loads and prescribed motions between the ends of a step, so that
   *  no step goes over a pulse that it does not see at its ends. */
  template <int dim>
  class LoadWatch
  {
  public:
    /** Watch a function, which must outlive the object, in a run from @p start
     *  to @p end. Leaves another time set. */
    void
    add(SpaceTimeFunction<dim> &function, const double start, const double end);

    /** Places at which functions are looked at. */
    std::vector<Point<dim>> places;

    /** The largest distance of a function in an interval from the straight line
     *  between its ends, relative to its largest value in the run. Leaves
     *  another time set. */
    double
    bend(const double from, const double to);

  private:
    struct Watched
    {
      SpaceTimeFunction<dim> *function;
      std::vector<double>     largest; ///< in the run, by component
    };

    /** Values at one time, by component and place. */
    std::vector<double>
    values(SpaceTimeFunction<dim> &function, const double time) const;

    std::vector<Watched> watched;
  };
} // namespace Signoton

#endif
