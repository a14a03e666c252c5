#ifndef signoton_drivers_mesh_change_h
#define signoton_drivers_mesh_change_h

#include <signoton/drivers/model.h>

#include <deal.II/distributed/solution_transfer.h>

namespace Signoton
{
  /**
   * The way of fields at the nodes, and of what points remember, to another
   * mesh, in three steps: to be made when cells are marked; execute(); and
   * finish() when unknowns and mechanics know the new mesh.
   */
  template <int dim>
  class MeshChange
  {
  public:
    /** Note what goes along: the fields, and the accepted history.
     *  Collective. */
    MeshChange(Model<dim>                            &model,
               const std::vector<const VectorType *> &fields);

    /** A field as it was, ghosted and with hanging nodes set. */
    const VectorType &
    old(const unsigned int field) const
    {
      return old_fields[field];
    }

    /** Change the mesh. */
    void
    execute();

    /** Interpolate to @p fields in their order, which are made vectors of the
     *  new unknowns, and to the history. */
    void
    finish(const std::vector<VectorType *> &fields);

  private:
    using Transfer = parallel::distributed::SolutionTransfer<dim, VectorType>;

    Model<dim>               &model;
    std::vector<VectorType>   old_fields;
    VectorType                old_history;
    Transfer                  of_fields;
    std::unique_ptr<Transfer> of_history;
  };
} // namespace Signoton

#endif
