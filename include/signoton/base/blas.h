#ifndef signoton_base_blas_h
#define signoton_base_blas_h

#include <string>

namespace Signoton
{
  /**
   * The library of dense linear algebra that the program was started with,
   * which the machine chooses, not the build. Factorizations spend nearly all
   * their time in it: with the reference implementation ten times as much as
   * with one that is made for the processor.
   */
  namespace BLAS
  {
    /** Name and version in its own words, or the file that it came from. */
    std::string
    name();

    /** Whether it is the reference implementation. */
    bool
    is_reference();

    /** Keep it to one thread a rank, unless the environment asks for more
     *  (`OPENBLAS_NUM_THREADS` and the like): the threads of all ranks on all
     *  cores would wait for each other. */
    void
    use_one_thread();
  } // namespace BLAS
} // namespace Signoton

#endif
