#ifndef signoton_base_sandbox_h
#define signoton_base_sandbox_h

#include <string>

namespace Signoton
{
  /**
   * Give up, for the rest of the life of this process, what a program needs to
   * act on the world: executing programs, starting processes, network
   * connections, signals to others, and every change of the file system. Files
   * can be opened for reading alone, threads can be started, memory and open
   * files can be used as before.
   *
   * The kernel enforces it by a filter of system calls (seccomp), without new
   * privileges. It looks at the flags of a call that opens a file and not at
   * its path, so that it needs no directory to which writing is confined, and
   * leaves no file behind. Refused calls fail as they do without permission;
   * those that are newer than Linux 5.0 as if they did not exist, upon which
   * the C library takes older ones.
   *
   * @return why it cannot be done, in words; empty if it is done
   */
  std::string
  forbid_side_effects();
} // namespace Signoton

#endif
