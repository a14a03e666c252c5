#ifndef signoton_base_kinks_h
#define signoton_base_kinks_h

#include <signoton/base/scene_file.h>

#include <map>

namespace Signoton
{
  /** Named constants that a scene defines for its expressions. */
  using Constants = std::map<std::string, double>;

  /** A time at which a function of time bends or jumps: neighbors among the
   *  numbers, up to round-off of the time. */
  struct Kink
  {
    double before; ///< the last time before
    double after;  ///< the first time behind
    bool   jumps = false;
  };

  /** A function with more kinks than this is sampled as it is. */
  constexpr unsigned int most_kinks = 10000;

  /**
   * The times strictly between @p start and @p end at which an expression may
   * bend or jump because of what it is made of: comparisons, `if` and `?:`,
   * `min`, `max`, `abs`, `sign`, `floor`, `ceil`, `int`, `rint`. Only those
   * switches count that depend on t and not on x, y, z. None is invented for
   * smooth functions; one that is hidden (the absolute value as a root of a
   * square) is not found.
   *
   * Each switch is sampled some 20,000 times; changes between two samples are
   * bracketed to round-off, and where it only comes near a change between
   * them, the nearest point is looked at.
   * @return sorted by time, at most most_kinks + 1 of them; Kink::jumps is not
   *   known here
   */
  std::vector<Kink>
  find_kinks(const std::string &expression,
             const Constants   &constants,
             const double       start,
             const double       end);

  /** The times that steps have to meet: the end, those that a user gives, and
   *  the kinks of loads and prescribed motions. */
  class TimesToMeet
  {
  public:
    TimesToMeet(const double start = 0., const double end = 1.)
      : start(start)
      , end(end)
    {}

    void
    add(const std::vector<Kink> &kinks);

    /** A time of the user's choice; outside of the run it has no effect. */
    void
    add(const double time)
    {
      add({Kink{time, time, false}});
    }

    /** Whether there is anything to meet before the end. */
    bool
    empty() const
    {
      return kinks.empty();
    }

    std::size_t
    size() const
    {
      return kinks.size();
    }

    /** The first kink behind @p time, or the end. */
    double
    next(const double time) const;

    /** The end, or if something jumps there the time before. */
    double
    end_before_jump() const;

    /** The end of a step of some size from @p time: not beyond the next of
     *  these times, and leaving no sliver before it. */
    double
    end_of_step(const double time, const double size) const;

    /** The time behind a jump that happens at @p time; @p time itself if there
     *  is none. */
    double
    behind_jump(const double time) const;

  private:
    double            start, end;
    std::vector<Kink> kinks; ///< sorted, at least a round-off apart
  };

  /** A list of numbers separated by commas. */
  std::vector<double>
  read_times(const std::string &text, const std::string &where);
} // namespace Signoton

#endif
