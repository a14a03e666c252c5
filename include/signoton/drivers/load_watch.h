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
    /** @p function must outlive the object. */
    void
    add(SpaceTimeFunction<dim> &function)
    {
      watched.push_back(
        {&function, std::vector<double>(function.n_components)});
    }

    /** Places at which functions are looked at. */
    std::vector<Point<dim>> places;

    /** The largest distance of a function in an interval from the straight line
     *  between its ends, relative to the largest value that was ever seen.
     *  Leaves another time set. */
    double
    bend(const double from, const double to);

  private:
    struct Watched
    {
      SpaceTimeFunction<dim> *function;
      std::vector<double>     largest; ///< seen so far, by component
    };

    std::vector<Watched> watched;
  };
} // namespace Signoton

#endif
