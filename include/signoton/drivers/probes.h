#ifndef signoton_drivers_probes_h
#define signoton_drivers_probes_h

#include <signoton/base/csv_table.h>
#include <signoton/drivers/checkpoint.h>
#include <signoton/drivers/output_directory.h>
#include <signoton/drivers/point_quantities.h>
#include <signoton/drivers/point_values.h>

#include <deal.II/fe/fe_values.h>

namespace Signoton
{
  /**
   * Histories: what points, parts of the boundary and lines of the body see in
   * the course of a run. Points and surfaces are columns of the statistics;
   * transects, along lines, have files of their own, from which pictures over
   * place and time are drawn.
   */
  template <int dim>
  class Probes
  {
  public:
    Probes(Model<dim> &model, OutputDirectory &directory);

    /** Add the columns of points and surfaces. */
    void
    add_columns(CSVTable::Row &row, const State &state);

    bool
    has_transects() const
    {
      return !model.transects.empty();
    }

    /** Append a state to the files of the transects.
     *  @return see CSVTable::append() */
    std::string
    write_transects(const State &state);

    /** Draw the transects over place and time, if there is gnuplot; false if
     *  there is not. */
    bool
    draw_transects() const;

    /** A regular expression of the files of transects, to follow others. */
    std::string
    file_names() const;

    void
    save(Checkpoint<dim> &checkpoint) const;

    /** Drop what is written again. */
    void
    resume(const Checkpoint<dim> &checkpoint);

  private:
    /** Means over a part of the boundary. */
    struct Surface
    {
      std::vector<types::global_dof_index> dofs;
      std::vector<unsigned int>            component;
      std::vector<double>                  weight;
      std::vector<unsigned int>            cells; ///< as the mechanics has them
      /** For each quadrature point of each cell: n dA of the points of the
       *  face, to which the stress is extrapolated. */
      std::vector<Tensor<1, dim>> area_vectors;
      double                      area = 0.; ///< own

      void
      add(const Space<dim>                                     &space,
          const typename DoFHandler<dim>::active_cell_iterator &cell,
          const unsigned int                                    f,
          const FEFaceValues<dim>                              &values,
          const FEFaceValues<dim>                              &of_points);
    };

    /** Look for faces on a new mesh. */
    void
    update_surfaces();

    void
    add_points(CSVTable::Row &row, const State &state);

    void
    add_surface(CSVTable::Row     &row,
                const std::string &name,
                const Surface     &surface,
                const State       &state);

    /** Write what draws a transect. */
    void
    write_script(const unsigned int transect) const;

    /** Whose material the columns of a target are of, if it shares its point
     *  with others. */
    std::string
    material_name(const types::material_id id) const;

    bool
    wants(const std::string &quantity) const;

    /** Where a transect is, in numbers for a checkpoint. */
    CSVTable::Row
    place(const unsigned int transect) const;

    /** The name of a file without its directory. */
    static std::string
    file(const unsigned int transect, const std::string &ending);

    Model<dim>                       &model;
    OutputDirectory                  &directory;
    const std::vector<std::string>    wanted; ///< quantities
    const std::vector<PointQuantity>  quantities, transect_quantities;
    std::vector<CSVTable>             tables; ///< of transects
    std::unique_ptr<PointValues<dim>> points;
    std::vector<std::unique_ptr<PointValues<dim>>> transects;
    bool                                           surfaces_are_current = false;
    boost::signals2::scoped_connection             mesh_changes;
    std::vector<Surface>                           surfaces;
    unsigned int                                   n_samples = 0;
    std::vector<State::Field> drawn_fields; ///< of transects, as last written
  };
} // namespace Signoton

#endif
