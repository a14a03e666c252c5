#ifndef signoton_drivers_receipt_h
#define signoton_drivers_receipt_h

#include <algorithm>
#include <cmath>

namespace Signoton
{
  /**
   * Where the energy of a dynamic run went since its start, in J (per metre in
   * plane strain).
   *
   * What goes in is the work of loads and of boundaries with a prescribed
   * motion. It is found in the velocity and in the material, or was dissipated,
   * radiated, or lost when the mesh changed. The sum closes up to round-off if
   * forces, masses and motions belong to each other; it says nothing of how
   * well they approximate. That is told by `time_stepping`: the work of the
   * internal forces over finite steps is not quite the energy that the material
   * has stored and dissipated. It vanishes with the square of the step where
   * the solution is smooth.
   */
  struct Receipt
  {
    double kinetic       = 0.; ///< at present
    double stored        = 0.; ///< at present
    double plastic       = 0.; ///< dissipated by hinges
    double viscous       = 0.; ///< dissipated by dampers
    double shock         = 0.; ///< dissipated by shock viscosity
    double absorbed      = 0.; ///< by absorbing boundaries
    double transfer      = 0.; ///< lost by changes of the mesh
    double time_stepping = 0.; ///< lost by the finite steps
    double external_work = 0.; ///< of loads and moving boundaries
    double initial       = 0.; ///< kinetic and stored at the start
    double voids         = 0.; ///< volume of open contacts at present, in m^3

    /** The largest total energy so far: kinetic and stored, or the work done;
     *  see note(). */
    double largest = 0.;

    /** Keep the largest total energy. */
    void
    note()
    {
      largest =
        std::max({largest, kinetic + stored, initial, std::abs(external_work)});
    }

    /** What the steps have lost, or gained, as a part of the largest energy. */
    double
    lost_part() const
    {
      return largest > 0. ? time_stepping / largest : 0.;
    }

    /** What is missing, relative to the largest energy. */
    double
    gap() const
    {
      const double found = kinetic + stored + plastic + viscous + shock +
                           absorbed + transfer + time_stepping,
                   given   = initial + external_work,
                   largest = std::max({kinetic,
                                       stored,
                                       std::abs(external_work),
                                       initial,
                                       plastic,
                                       absorbed});
      return largest > 0. ? (found - given) / largest : 0.;
    }
  };
} // namespace Signoton

#endif
