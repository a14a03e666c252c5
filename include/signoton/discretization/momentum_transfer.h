#ifndef signoton_discretization_momentum_transfer_h
#define signoton_discretization_momentum_transfer_h

#include <signoton/discretization/space.h>

#include <functional>

namespace Signoton
{
  /**
   * Keeps the momentum of a velocity when the mesh changes. Interpolation
   * loses some of it where cells are coarsened and where nodes begin to hang.
   * What each cell had in its nodes, by its diagonal mass, goes along with the
   * mesh: to children by interpolation, to parents by the transpose of it; and
   * what a cell misses on the new mesh is given to its nodes again. The sum
   * over the body is the same, to round-off, and nothing else changes but the
   * nodes of those cells.
   */
  template <int dim>
  class MomentumTransfer
  {
  public:
    using CellIterator = typename DoFHandler<dim>::cell_iterator;
    /** The diagonal mass of a cell at its unknowns, also of a parent. */
    using CellMass =
      std::function<const Vector<double> &(const CellIterator &)>;

    /** To be called when cells are marked, before the mesh changes.
     *  @param velocity ghosted, with hanging nodes set; must live until then
     *  @param cell_mass must be callable during the life of the object */
    MomentumTransfer(Space<dim>       &space,
                     const VectorType &velocity,
                     const CellMass   &cell_mass);

    /** What is missing at the nodes of the new mesh, in kg m/s, condensed from
     *  hanging nodes.
     *  @param velocity interpolated to the new mesh; ghosted, with hanging
     *    nodes set */
    VectorType
    missing(const VectorType &velocity);

  private:
    using MeshCell = typename Triangulation<dim>::cell_iterator;
    using Status   = typename Triangulation<dim>::CellStatus;

    std::vector<char>
    pack(const MeshCell &cell, const Status status) const;

    CellIterator
    with_unknowns(const MeshCell &cell) const;

    Space<dim>       &space;
    const VectorType *old_velocity;
    CellMass          cell_mass;
    unsigned int      handle;
  };
} // namespace Signoton

#endif
