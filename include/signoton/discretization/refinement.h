#ifndef signoton_discretization_refinement_h
#define signoton_discretization_refinement_h

#include <signoton/discretization/space.h>

namespace Signoton
{
  /**
   * Where to refine and to coarsen.
   *
   * The indicator of a cell is built on the jumps of the traction over its
   * faces and on the mismatch with the given traction at the boundary,
   * $\eta_K^2=\sum_{F\subset\partial K} c_F \frac{h_F}{2\mu}
   *  \|[\sigma]n\|_F^2$, $c_F=\frac12$ inside (Kelly et al., Int. J. Numer.
   * Meth. Eng. 19 (1983), in the energy scale). Cells in which the material
   * switches its branch, or whose neighbor is in another one, count more. See
   * traction_jumps.h.
   */
  class Refinement
  {
  public:
    void
    add_parameters(ParameterHandler &handler);

    /** Cycles of solving and refining in a step, 0 for a fixed mesh. */
    unsigned int
    cycles(const unsigned int step) const;

    /** Whether steps after the first refine. */
    bool
    is_used_later() const
    {
      return cycles_per_step > 0;
    }

    /** Check the entries against each other. */
    void
    check(const SceneFile &file) const;

    /** Unknowns that refinement does not go beyond, about. */
    double
    unknowns_limit() const
    {
      return maximum_unknowns;
    }

    /** The coarsest level, unless the scene sets it. */
    void
    set_minimum_level(const unsigned int level)
    {
      minimum_level = level;
    }

    /**
     * Set refinement and coarsening flags.
     * @param indicators from traction_jumps(); weighted and rounded here, so
     *   that the choice does not depend on round-off, and zero on return where
     *   a cell is at the finest level
     * @param region     by active cell, see Rheology::Region
     * @param mixed      whether points of a cell are in different regions
     * @return whether the mesh should change: cells are to be refined, or
     *   enough of them to be coarsened; not if all indicators are zero
     */
    template <int dim>
    bool
    mark(Space<dim>                      &space,
         Vector<float>                   &indicators,
         const std::vector<unsigned int> &region,
         const std::vector<bool>         &mixed) const;

  private:
    unsigned int cycles_per_step  = 0;
    unsigned int cycles_first     = 0;
    unsigned int every            = 1;
    double       refine_fraction  = 0.5;
    double       coarsen_fraction = 0.02;
    double       region_weight    = 4.;
    unsigned int maximum_level    = 8;
    unsigned int minimum_level    = 0;
    unsigned int maximum_unknowns = 1000000;
  };

  /** What a traction at a point of the boundary is short of the given one, in Pa.
   *  What moves a boundary, or absorbs, takes any; nullptr is for a free one. */
  template <int dim>
  Tensor<1, dim>
  missing_traction(const BoundaryCondition<dim> *condition,
                   const Point<dim>             &p,
                   const Tensor<1, dim>         &normal,
                   const Tensor<1, dim>         &traction);

  /**
   * Leave the coarsening flags only of complete families above a level without
   * a finer neighbor, and no refinement flags. Whether such a neighbor is to be
   * coarsened too is not known if it is on another rank, and the mesh must not
   * depend on that.
   */
  template <int dim>
  void
  keep_coarsenable(parallel::distributed::Triangulation<dim> &mesh,
                   const unsigned int                         minimum_level);
} // namespace Signoton

#endif
