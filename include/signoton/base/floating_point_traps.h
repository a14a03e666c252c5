#ifndef signoton_base_floating_point_traps_h
#define signoton_base_floating_point_traps_h

#include <cfenv> // of glibc, it defines __GLIBC__

namespace Signoton
{
  /**
   * In a debug build, as long as it lives, a division by zero, an invalid
   * operation or an overflow ends the program where it happens (SIGFPE). For
   * loops of our own over cells and points, all lanes of a batch included;
   * not around what others wrote: MPI, solvers, expressions of a scene.
   * Otherwise it is nothing.
   */
  class FloatingPointTraps
  {
  public:
#if defined(DEBUG) && defined(__GLIBC__)
    FloatingPointTraps()
      : before(fegetexcept())
    {
      // what happened before is not ours
      std::feclearexcept(FE_ALL_EXCEPT);
      feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
    }

    ~FloatingPointTraps()
    {
      fedisableexcept(FE_ALL_EXCEPT);
      feenableexcept(before);
    }

  private:
    int before;
#else
    // not trivial, so that no compiler calls it unused
    FloatingPointTraps()
    {}
#endif
  };
} // namespace Signoton

#endif
