#ifndef signoton_drivers_analysis_h
#define signoton_drivers_analysis_h

#include <signoton/base/exceptions.h>
#include <signoton/base/function.h>
#include <signoton/base/number.h>

#include <deal.II/base/parameter_handler.h>

namespace Signoton
{
  /** What times, and lengths of time, may be. */
  inline const Patterns::Double time_pattern(-largest_number, largest_number),
    length_pattern(0., largest_number);

  /** From when to when a run goes, and the times besides that its steps have to
   *  meet. */
  struct TimeSpan
  {
    std::string section; ///< of the scene that has them
    double      start = 0.;
    double      end   = 1.;
    std::string times = "";
  };

  /**
   * What a scene asks of its body: the keys that go with it, what it needs, and
   * the run. Made before the file is parsed, by its first keys.
   */
  template <int dim>
  class Analysis
  {
  public:
    virtual ~Analysis() = default;

    /** As the scene file chooses it: behind 'Analysis = '. */
    const std::string name;
    const bool        has_inertia;
    /** Whether steps are solutions of equations, by tangents and a matrix. */
    const bool solves_equations;

    /** Declare the keys that this analysis has besides those of every scene. */
    virtual void
    add_parameters(ParameterHandler &handler) = 0;

    /** Check the values against each other, the materials and the probes, and
     *  set what follows from them.
     *  @param constants of the expressions */
    virtual void
    check(const Constants &constants) = 0;

    virtual TimeSpan &
    time_span() = 0;

    virtual bool
    has_shock_viscosity() const
    {
      return false;
    }

    /** How the mesh changes. */
    struct Adaptivity
    {
      bool        is_on;
      std::string key;            ///< by which it is
      double      unknowns_limit; ///< that refinement does not go beyond, about
    };

    virtual Adaptivity
    adaptivity() const = 0;

    /** The equations in words, for --explain. */
    virtual std::string
    equations() const = 0;

    /** Throw what run() would throw before its first step. */
    virtual void
    validate()
    {}

    /** Start anew, or go on from a checkpoint. */
    virtual ExitStatus
    run(const std::string &resume_directory) = 0;

  protected:
    Analysis(const std::string &name,
             const bool         has_inertia,
             const bool         solves_equations)
      : name(name)
      , has_inertia(has_inertia)
      , solves_equations(solves_equations)
    {}
  };
} // namespace Signoton

#endif
