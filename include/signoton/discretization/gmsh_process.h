#ifndef signoton_discretization_gmsh_process_h
#define signoton_discretization_gmsh_process_h

#include <signoton/base/child_process.h>
#include <signoton/discretization/curved_geometry.h>

#include <string>

namespace Signoton
{
  /** The mesh of a geometry, or why there is none. */
  struct GmshMesh
  {
    std::string    text;    ///< of a .msh file, ASCII of version 2.2, order 1
    CurvedElements curved;  ///< what the geometry knows of its shape
    std::string    problem; ///< in words, those of gmsh if it has any
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
   * @param trusted whether the geometry may execute programs and write files
   */
  GmshMesh
  mesh_geometry(const std::string &file,
                const int          dim,
                const bool         trusted,
                const ChildLimits &limits);
} // namespace Signoton

#endif
