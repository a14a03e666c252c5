#ifndef signoton_discretization_mesh_identity_h
#define signoton_discretization_mesh_identity_h

#include <signoton/discretization/space.h>

#include <map>

namespace Signoton
{
  /**
   * What tells one coarse mesh from another, in a few numbers by name: how many
   * cells and vertices, the box around them, and checksums of coordinates, of
   * materials, of boundaries, of what is periodic and of the points that a
   * curved geometry would put between the vertices. Refinement, the number of
   * ranks and the last digits of coordinates (a hundred-millionth of the
   * diagonal) make no difference.
   */
  template <int dim>
  std::map<std::string, double>
  mesh_identity(const Space<dim> &space);

  /** In words, in what two meshes differ; empty if they are the same.
   *  @param before by mesh_identity(); what else it has is ignored */
  std::string
  difference_of_meshes(const std::map<std::string, double> &before,
                       const std::map<std::string, double> &now);
} // namespace Signoton

#endif
