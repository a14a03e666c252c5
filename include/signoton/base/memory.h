#ifndef signoton_base_memory_h
#define signoton_base_memory_h

#include <deal.II/base/mpi.h>

#include <string>

namespace Signoton
{
  using namespace dealii;

  /** Bytes that can still be had, and what limits them. */
  struct FreeMemory
  {
    double      bytes;
    std::string limit;
  };

  /** Of the limits of the process (`ulimit`). */
  FreeMemory
  memory_of_process();

  /** Of the machine and of the control groups (containers, batch jobs) that
   *  this process is in, which all ranks on the machine share. Infinite where
   *  the system does not tell. */
  FreeMemory
  memory_of_machine();

  /** Throw a UserError on all ranks if what they need is not free on one of
   *  their machines.
   *  @param bytes  needed on this rank
   *  @param where, what, try_this parts of the message */
  void
  require_memory(const MPI_Comm    &communicator,
                 const double       bytes,
                 const std::string &where,
                 const std::string &what,
                 const std::string &try_this);
} // namespace Signoton

#endif
