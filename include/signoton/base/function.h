#ifndef signoton_base_function_h
#define signoton_base_function_h

#include <signoton/base/kinks.h>
#include <signoton/base/time_table.h>

#include <deal.II/base/function_parser.h>

#include <memory>
#include <optional>

namespace Signoton
{
  /** Read `a = 1, b = 2`; the constant `pi` is always there. */
  Constants
  parse_constants(const std::string &text, const std::string &where);

  /**
   * A function of space and time from the scene file. A component is an
   * expression in the variables `x, y, z` (as many as dimensions, none of them
   * if that is one) and `t`, or a TimeTable. It remembers where it has no finite
   * value: the rank that meets it must not throw while the others go on.
   */
  template <int dim>
  class SpaceTimeFunction : public Function<dim>
  {
  public:
    /** @param where place named if a component cannot be parsed */
    SpaceTimeFunction(const std::vector<std::string> &components,
                      const Constants                &constants,
                      const std::string              &where);

    double
    value(const Point<dim> &p, const unsigned int component = 0) const override;

    /** The value at a place that need not be in the body, where it may be
     *  anything. */
    double
    sample(const Point<dim> &p, const unsigned int component) const;

    void
    set_time(const double time) override;

    /** The first time and point without a finite value, on this rank; empty
     *  if there is none. */
    const std::string &
    trouble() const
    {
      return found;
    }

    /** Whether it depends on time. */
    bool
    varies() const;

    /** Whether it is the same at all places. */
    bool
    is_uniform() const;

    /** The last time of its tables; nothing if there is none. */
    std::optional<double>
    end_of_tables() const;

    /** Where it bends or jumps in time, see find_kinks(), with Kink::jumps as
     *  seen at @p places. Leaves another time set. */
    std::vector<Kink>
    kinks(const double                   start,
          const double                   end,
          const std::vector<Point<dim>> &places);

    const std::string where; ///< for messages

  private:
    struct Component
    {
      std::string                          text;
      std::unique_ptr<FunctionParser<dim>> expression;
      std::unique_ptr<TimeTable>           table; ///< if no expression
    };

    std::vector<Component> components;
    Constants              constants;
    mutable std::string    found;
  };

  /** @copydoc SpaceTimeFunction */
  template <int dim>
  std::unique_ptr<SpaceTimeFunction<dim>>
  make_function(const std::vector<std::string> &components,
                const Constants                &constants,
                const std::string              &where);

  /** Throw a UserError if one of some functions of the scene had a value that is
   *  not finite on some rank; null pointers are skipped. Collective. */
  template <int dim>
  void
  refuse_trouble(const MPI_Comm                           &communicator,
                 const std::vector<const Function<dim> *> &functions);

  /** Whether a variable, of one letter, occurs in an expression. */
  bool
  depends_on(const std::string &expression, const char variable);

  /** Whether the variable `t` does. */
  bool
  depends_on_time(const std::string &expression);

  /** Components separated by `;`. Throws unless there are @p n. */
  std::vector<std::string>
  split_components(const std::string &text,
                   const unsigned int n,
                   const std::string &where);
} // namespace Signoton

#endif
