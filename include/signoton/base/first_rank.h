#ifndef signoton_base_first_rank_h
#define signoton_base_first_rank_h

#include <signoton/base/scene_file.h>

#include <deal.II/base/mpi.h>

namespace Signoton
{
  /** Read a scene on the first rank, which may be the only one that has the
   *  file; what is wrong with it, all ranks throw. Collective. */
  SceneFile
  read_scene(const MPI_Comm &communicator, const std::string &file_name);

  /**
   * Whether all ranks come here within some seconds. A rank that fails alone
   * learns by this that the others will wait for it in vain. It waits the
   * longer, the higher its number, so that one of several such ranks is the
   * first to know. Collective if it returns true.
   */
  bool
  all_arrive(const MPI_Comm &communicator);
} // namespace Signoton

#endif
