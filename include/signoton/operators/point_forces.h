#ifndef signoton_operators_point_forces_h
#define signoton_operators_point_forces_h

#include <signoton/discretization/point_locator.h>
#include <signoton/operators/external_force.h>

namespace Signoton
{
  /** A concentrated force, by its subsection of `Point forces`. */
  template <int dim>
  class PointForce
  {
  public:
    explicit PointForce(const std::string &name)
      : name(name)
    {}

    void
    add_parameters(ParameterHandler &handler);

    /** Parse the place and the expressions. */
    void
    initialize(const SceneFile &file, const Constants &constants);

    std::string                             name;
    Point<dim>                              place;
    std::unique_ptr<SpaceTimeFunction<dim>> force;          ///< in N
    bool                                    varies = false; ///< in time

  private:
    std::string place_text, force_text;
  };

  /**
   * Forces on the nodes from concentrated forces, in N (per metre in plane
   * strain, on the whole circle in axisymmetry). The displacement under a point
   * force is infinite in the continuum: it depends on the mesh; elsewhere it
   * converges.
   */
  template <int dim>
  class PointForces
  {
  public:
    using List = std::vector<PointForce<dim>>;

    /** Find the points in the current mesh. All arguments must outlive the
     *  object.
     *  @param places of the forces, in their order; nullptr if there are none
     */
    void
    reinit(const Space<dim>  &space,
           const List        &list,
           PointLocator<dim> *places);

    /** Add the forces of a kind at the time last set, as the mesh bears them:
     *  see EnergyTerm. The caller compresses. */
    void
    add(const LoadKind kind, VectorType &force) const;

  private:
    const Space<dim>  *space  = nullptr;
    const List        *list   = nullptr;
    PointLocator<dim> *places = nullptr;
  };

  /** Coordinates separated by ','. */
  template <int dim>
  Point<dim>
  parse_point(const std::string &text, const std::string &where);
} // namespace Signoton

#endif
