#ifndef signoton_discretization_rigid_motions_h
#define signoton_discretization_rigid_motions_h

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

namespace Signoton
{
  using namespace dealii;

  /**
   * Names of the rigid motions that the constraints leave free, such as
   * "translation x" or "rotation about z". Statics has no unique solution
   * unless the list is empty.
   * @param constraints conditions on the displacement, without hanging nodes
   */
  template <int dim>
  std::vector<std::string>
  free_rigid_motions(const Mapping<dim>              &mapping,
                     const DoFHandler<dim>           &dof_handler,
                     const AffineConstraints<double> &constraints,
                     const bool                       axisymmetric);

  /**
   * The rigid motions as vectors of nodal values at the locally owned dofs:
   * translations, then rotations about the center of the box around the body,
   * scaled to order one. In axisymmetry only the translation along the axis.
   */
  template <int dim>
  std::vector<std::vector<double>>
  rigid_motions(const Mapping<dim>    &mapping,
                const DoFHandler<dim> &dof_handler,
                const IndexSet        &dofs,
                const bool             axisymmetric);
} // namespace Signoton

#endif
