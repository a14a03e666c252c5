#ifndef signoton_discretization_mesh_reader_h
#define signoton_discretization_mesh_reader_h

#include <signoton/discretization/msh_file.h>

#include <deal.II/base/types.h>
#include <deal.II/grid/tria.h>

#include <map>
#include <string>
#include <vector>

namespace Signoton
{
  /** What a mesh file says of the boundary of its body. */
  struct BoundaryGroups
  {
    /** Ids by the names of the physical groups, as far as they have faces.
     *  Faces without a group have the id 0, which no group has. */
    std::map<std::string, types::boundary_id> names;
    /** Names of which some, or all, faces lie inside the body, where nothing
     *  can be prescribed, with the numbers of faces inside and in all. */
    std::map<std::string, std::pair<unsigned int, unsigned int>> inside;
  };

  /**
   * Make a coarse mesh of quadrilaterals or hexahedra from what stands in a
   * .msh file. Groups of cells become material ids, groups of faces boundary
   * ids. Cells of either orientation are taken; everything that deal.II would
   * refuse, or crash at, is a MeshError in words that point to it: by the line
   * if @p with_lines, for a text that the user can look at, and by coordinates.
   */
  template <int dim>
  BoundaryGroups
  make_mesh(const MshFile      &file,
            const bool          with_lines,
            Triangulation<dim> &mesh);

  /** The center of a cell that is folded, flat or inverted at one of its
   *  corners, or nothing. */
  template <int dim>
  std::string
  folded_cell(const Triangulation<dim> &mesh);
} // namespace Signoton

#endif
