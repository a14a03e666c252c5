#ifndef signoton_drivers_probes_h
#define signoton_drivers_probes_h

#include <signoton/base/csv_table.h>
#include <signoton/drivers/checkpoint.h>
#include <signoton/drivers/output_directory.h>

#include <deal.II/base/mpi_remote_point_evaluation.h>

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
    using Search = Utilities::MPI::RemotePointEvaluation<dim>;

    /** At points: displacement, velocity if there is one, stress. */
    struct Values
    {
      std::vector<Tensor<1, dim>> displacement, velocity;
      std::vector<Tensor<1, 6>>   stress; ///< averages of cells, in Pa
    };

    /** Means over a part of the boundary. */
    struct Surface
    {
      std::vector<std::pair<unsigned int, Tensor<1, dim>>> cells; ///< n dA
      std::vector<types::global_dof_index>                 dofs;
      std::vector<unsigned int>                            component;
      std::vector<double>                                  weight;
      double                                               area = 0.; ///< own
    };

    /** Look for points and faces on a new mesh. */
    void
    update();

    Values
    evaluate(Search           &search,
             const VectorType &displacement,
             const VectorType *velocity,
             const bool        with_stress);

    void
    add_surface(Line                            &line,
                const std::string               &name,
                const Surface                   &surface,
                const VectorType                &displacement,
                const VectorType                *velocity,
                const std::vector<CellAverages> &averages) const;

    bool
    wants(const std::string &quantity) const;

    /** Where a line is, in numbers for a checkpoint. */
    std::vector<std::pair<std::string, double>>
    place(const unsigned int line) const;

    /** The name of a file without its directory. */
    static std::string
    file(const unsigned int line, const std::string &ending);

    Model<dim>                          &model;
    OutputDirectory                     &directory;
    std::vector<CSVTable>                tables; ///< of lines
    bool                                 is_current = false;
    boost::signals2::scoped_connection   mesh_changes;
    std::unique_ptr<Search>              points;
    std::vector<std::unique_ptr<Search>> lines;
    std::vector<Surface>                 surfaces;
    unsigned int                         n_samples = 0;
  };
} // namespace Signoton

#endif
