#ifndef signoton_drivers_field_output_h
#define signoton_drivers_field_output_h

#include <signoton/drivers/model.h>
#include <signoton/drivers/output_directory.h>
#include <signoton/drivers/state.h>

#include <deal.II/numerics/data_out.h>

namespace Signoton
{
  /**
   * Fields for ParaView: a snapshot for some steps, and `fields.pvd` which
   * lists them by time. Those of the nodes are continuous. All else are
   * averages over cells, which stay admissible; the stress is also there as
   * NodalFields, whose names begin with `nodal_`. What no material of the scene
   * has is not written.
   */
  template <int dim>
  class FieldOutput
  {
  public:
    FieldOutput(Model<dim> &model, OutputDirectory &directory);

    /** Write a snapshot and enter it in the list. */
    void
    write(const State &state);

    /** The time and the file of each snapshot. */
    using List = std::vector<std::pair<double, std::string>>;

    const List &
    snapshots() const
    {
      return list;
    }

    /** Go on with a list from before a restart. */
    void
    resume(const List &old)
    {
      list = old;
    }

  private:
    using CellFields = std::vector<std::pair<std::string, Vector<float>>>;

    CellFields
    cell_fields(const VectorType &displacement);

    /** Write this rank's part of a snapshot, and what lists the parts.
     *  @return the name of the file that stands for all */
    std::string
    write_pieces(const DataOut<dim> &output, const unsigned int step);

    Model<dim>      &model;
    OutputDirectory &directory;
    List             list;
  };
} // namespace Signoton

#endif
