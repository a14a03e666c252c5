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
   * lines have files of their own, from which pictures over place and time are
   * drawn.
   */
  template <int dim>
  class Probes
  {
  public:
    /** Names of columns with their values. */
    using Line = std::vector<std::pair<std::string, double>>;

    Probes(Model<dim> &model, OutputDirectory &directory);

    /** Add the columns of points and surfaces.
     *  @param displacement with hanging nodes set, as is
     *  @param velocity     nullptr in statics */
    void
    add_columns(Line             &line,
                const VectorType &displacement,
                const VectorType *velocity);

    bool
    has_lines() const
    {
      return !model.probe_lines.empty();
    }

    /** Append the present state to the files of the lines.
     *  @return see CSVTable::append() */
    std::string
    write_lines(const double      time,
                const VectorType &displacement,
                const VectorType *velocity);

    /** Draw the lines over place and time, if there is gnuplot; false if there
     *  is not. */
    bool
    draw_lines() const;

    /** A regular expression of the files of lines, to follow others. */
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

    Line
    columns_of_points(const VectorType &displacement,
                      const VectorType *velocity);

    Line
    columns_of_surface(const std::string &name,
                       const Surface     &surface,
                       const VectorType  &displacement,
                       const VectorType  *velocity);

    /** Whose material the columns of a target are of, if it shares its point
     *  with others. */
    std::string
    material_name(const types::material_id id) const;

    bool
    wants(const std::string &quantity) const;

    /** Where a line is, in numbers for a checkpoint. */
    std::vector<std::pair<std::string, double>>
    place(const unsigned int line) const;

    /** The name of a file without its directory. */
    static std::string
    file(const unsigned int line, const std::string &ending);

    Model<dim>                                    &model;
    OutputDirectory                               &directory;
    const std::vector<std::string>                 wanted; ///< quantities
    const std::vector<PointQuantity>               quantities, line_quantities;
    std::vector<CSVTable>                          tables; ///< of lines
    std::unique_ptr<PointValues<dim>>              points;
    std::vector<std::unique_ptr<PointValues<dim>>> lines;
    bool                                           surfaces_are_current = false;
    boost::signals2::scoped_connection             mesh_changes;
    std::vector<Surface>                           surfaces;
    unsigned int                                   n_samples = 0;
  };
} // namespace Signoton

#endif
