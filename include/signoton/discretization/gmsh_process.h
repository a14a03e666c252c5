#ifndef signoton_discretization_gmsh_process_h
#define signoton_discretization_gmsh_process_h

#include <signoton/base/child_process.h>

#include <string>
#include <vector>

namespace Signoton
{
  /** Meshes of one geometry, or why there are none. */
  struct GmshMeshes
  {
    /** Texts of .msh files, ASCII of version 2.2, one for each order that was
     *  asked for. Corners have the same numbers in all of them. */
    std::vector<std::string> texts;
    std::string              problem; ///< in words, those of gmsh if it has any
  };

  /**
   * Mesh a .geo file by the gmsh library, in a child process (see
   * run_in_child()): a geometry is a program, which can exit, loop, take all
   * memory and crash the library. Unless it is trusted it reads files, and
   * has no other effect (see forbid_side_effects()); even its mesh leaves the
   * process by a pipe. Whatever gmsh calls an error is one.
   *
   * Cells without a physical group are part of the mesh if no cell has one.
   * @param file absolute name of the geometry
   * @param orders orders of the elements of the meshes
   * @param trusted whether the geometry may execute programs and write files
   */
  GmshMeshes
  mesh_geometry(const std::string      &file,
                const int               dim,
                const std::vector<int> &orders,
                const bool              trusted,
                const ChildLimits      &limits);
} // namespace Signoton

#endif
