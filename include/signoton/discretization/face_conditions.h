#ifndef signoton_discretization_face_conditions_h
#define signoton_discretization_face_conditions_h

#include <signoton/discretization/facet_normals.h>
#include <signoton/discretization/space.h>

#include <map>

namespace Signoton
{
  /** A node with what all its faces say. */
  template <int dim>
  struct NodeConditions
  {
    std::array<types::global_dof_index, dim> dofs;
    Point<dim>                               point;
    std::vector<HeldDirection<dim>>          faces;

    /** All directions in the order of the file, normals of one smooth surface
     *  as one. */
    std::vector<HeldDirection<dim>>
    directions(const BoundaryConditions<dim> &conditions) const;
  };

  /** The own nodes that are not free, by their first unknown. The rank that
   *  owns a node sees all its faces. */
  template <int dim>
  std::map<types::global_dof_index, NodeConditions<dim>>
  collect_face_conditions(const Space<dim>              &space,
                          const BoundaryConditions<dim> &conditions,
                          const FacetNormals<dim>       &facets);
} // namespace Signoton

#endif
