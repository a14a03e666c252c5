#ifndef signoton_base_exceptions_h
#define signoton_base_exceptions_h

#include <stdexcept>
#include <string>

namespace Signoton
{
  /** Exit status of the program; only a completed run returns 0. */
  enum class ExitStatus : int
  {
    completed      = 0,
    failure        = 1, ///< an error of the program or of the system
    bad_input      = 2, ///< the scene file, the command line or a mesh
    no_equilibrium = 3, ///< the load has no equilibrium, or none was found
    output_failed  = 4  ///< results could not be written
  };

  /**
   * An error that the user can mend. The message always has four parts: where
   * it is, what was found there, what was expected and what to try.
   */
  class UserError : public std::runtime_error
  {
  public:
    UserError(const std::string &where,
              const std::string &found,
              const std::string &expected,
              const std::string &try_this,
              const ExitStatus   status = ExitStatus::bad_input)
      : std::runtime_error("  where:    " + where + "\n  found:    " + found +
                           "\n  expected: " + expected +
                           "\n  try:      " + try_this + "\n")
      , status(status)
    {}

    const ExitStatus status;
  };
} // namespace Signoton

#endif
