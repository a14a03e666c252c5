#ifndef signoton_drivers_run_checks_h
#define signoton_drivers_run_checks_h

#include <signoton/drivers/model.h>

namespace Signoton
{
  /** Refuse a run that would never end, whose clock would not move, or that
   *  would fill any disk.
   *  @param where   the key that has led to it
   *  @param n_steps forecast for the whole run
   *  @param n_lines the same, of statistics */
  void
  check_steps(const std::string &where,
              const double       time_step,
              const double       start,
              const double       end,
              const double       n_steps,
              const double       n_lines,
              const std::string &remedy);

  /** Throw a UserError if any load or prescribed motion had a value that is not
   *  finite on some rank. Collective. */
  template <int dim>
  void
  refuse_trouble_of_loads(const Model<dim> &model);
} // namespace Signoton

#endif
