#ifndef signoton_operators_failure_h
#define signoton_operators_failure_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <string>

namespace Signoton
{
  using namespace dealii;

  /** Where the law of a material had no answer in a sweep: the worst point of
   *  this rank. */
  template <int dim>
  struct Failure
  {
    /** Relative, at which the local solver gave up; zero if all is well. */
    double     residual = 0.;
    Point<dim> place; ///< center of the cell
  };

  /** The worst failure of all ranks in words, nothing if there is none.
   *  Collective. */
  template <int dim>
  std::string
  in_words(const Failure<dim> &failure, const MPI_Comm &communicator);
} // namespace Signoton

#endif
