#ifndef signoton_base_mpi_session_h
#define signoton_base_mpi_session_h

#include <signoton/base/blas.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Signoton
{
  using namespace dealii;

  /**
   * MPI, and the libraries that deal.II starts with it, as long as this object
   * lives; one thread a rank, in the BLAS as well. They are told the name of
   * the program alone: PETSc, where deal.II has it, would read our command
   * line as its own, answer `--help`, and print the options that it did not
   * use to standard output, into what is written there. What deal.II has not
   * implemented is an exception, as are the assertions of a debug build: newer
   * versions end the program by a signal otherwise.
   */
  class MPISession
  {
  public:
    MPISession(const int argc, char **argv)
      : count(std::min(argc, 1))
      , name{count == 1 ? argv[0] : nullptr, nullptr}
      , arguments(name)
      , mpi(count, arguments, 1)
    {
      BLAS::use_one_thread();
      deal_II_exceptions::disable_abort_on_exception();
    }

  private:
    int                              count;
    char                            *name[2];
    char                           **arguments;
    Utilities::MPI::MPI_InitFinalize mpi;
  };
} // namespace Signoton

#endif
