#ifndef signoton_drivers_reactions_h
#define signoton_drivers_reactions_h

#include <signoton/base/csv_table.h>
#include <signoton/drivers/model.h>

namespace Signoton
{
  /**
   * Forces and moments of the supports on the body, as columns of the
   * statistics: 'reaction NAME x' in N, 'moment NAME' (in 3D 'moment NAME x')
   * in N m about the origin, of each boundary section that holds something.
   *
   * The force of the supports on a node is split into multipliers of the
   * conditions that hold it, see HeldNode: what is along a direction belongs to
   * the section that holds it, once. A smooth plane of symmetry gives a normal
   * force only. With the loads, and in dynamics the inertia and the dashpots,
   * reactions add up to zero, and so do moments. Per metre in plane strain;
   * over the full circle in axisymmetry, where radial forces cancel out there
   * and moments have no columns.
   *
   * @param support_forces internal force minus loads, plus inertia and dashpots
   *   in dynamics, before the elimination of conditions
   */
  template <int dim>
  CSVTable::Row
  reaction_columns(const Model<dim> &model, const VectorType &support_forces);

  /** What binders bear of the reactions, by boundary sections: those of which it
   *  is more than 3 %, and that take at least a hundredth of the largest
   *  reaction.
   *
   *  @param binder_force see Mechanics::binder_force() */
  template <int dim>
  CSVTable::Row
  binder_shares(const Model<dim> &model,
                const VectorType &support_forces,
                const VectorType &binder_force);
} // namespace Signoton

#endif
