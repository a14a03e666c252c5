#ifndef signoton_discretization_wave_refinement_h
#define signoton_discretization_wave_refinement_h

#include <signoton/discretization/space.h>

namespace Signoton
{
  /**
   * A mesh that goes with the waves: cells are refined where the traction jumps
   * between them by more than a part of the largest jump, and wherever a wave
   * from there can arrive until the mesh is looked at again; cells behind, with
   * small jumps, are coarsened. Small waves get cells of a medium size.
   */
  class WaveRefinement
  {
  public:
    void
    add_parameters(ParameterHandler &handler);

    /** Check the entries against each other. */
    void
    check(const SceneFile &file) const;

    /** The coarsest level, unless the scene sets it. */
    void
    set_minimum_level(const unsigned int level)
    {
      minimum_level = level;
    }

    bool
    is_on() const
    {
      return follow;
    }

    /** Steps between two looks at the mesh. */
    unsigned int
    interval() const
    {
      return every;
    }

    /** The size of the smallest cells there can be, as a part of that of the
     *  smallest cells there are. */
    template <int dim>
    double
    finest_part(const Space<dim> &space) const;

    /** How often the mesh can change before it is at its finest. */
    unsigned int
    n_levels() const
    {
      return maximum_level - minimum_level;
    }

    /** Unknowns that refinement does not go beyond, about. */
    double
    unknowns_limit() const
    {
      return maximum_unknowns;
    }

    /**
     * Set refinement and coarsening flags.
     * @param jump     see StressJumps; rounded here
     * @param distance that waves go until the next time, in m
     * @param largest  jump of the run so far: what waves leave behind as they
     *   fade is small beside it
     * @return whether any cell changes
     */
    template <int dim>
    bool
    mark(Space<dim>          &space,
         std::vector<double> &jump,
         const double         distance,
         double              &largest) const;

  private:
    /**
     * The least level of every cell, by active cell index; only own cells count.
     * @param jump      see StressJumps
     * @param threshold of what is to be refined
     * @param distance  as in mark()
     */
    template <int dim>
    std::vector<unsigned int>
    needed_levels(const parallel::distributed::Triangulation<dim> &mesh,
                  const std::vector<double>                       &jump,
                  const double                                     threshold,
                  const double distance) const;

    bool         follow            = false;
    unsigned int every             = 40;
    double       refine_threshold  = 0.1;
    double       coarsen_threshold = 0.02;
    unsigned int maximum_level     = 0;
    unsigned int minimum_level     = 0;
    unsigned int maximum_unknowns  = 1000000;
  };
} // namespace Signoton

#endif
