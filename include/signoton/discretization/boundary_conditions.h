#ifndef signoton_discretization_boundary_conditions_h
#define signoton_discretization_boundary_conditions_h

#include <signoton/base/function.h>
#include <signoton/discretization/geometry.h>

#include <array>
#include <memory>

namespace Signoton
{
  /**
   * What happens at one named part of the boundary: prescribed components of
   * the displacement or the velocity, symmetry (no normal displacement), a
   * traction, a pressure, dashpots that absorb waves. Parts that no condition
   * names are free of traction.
   */
  template <int dim>
  class BoundaryCondition
  {
  public:
    explicit BoundaryCondition(const std::string &name)
      : name(name)
    {}

    void
    add_parameters(ParameterHandler &handler);

    /** Parse the expressions; contradictions are a UserError. */
    void
    initialize(const SceneFile     &file,
               const BoundaryNames &names,
               const Constants     &constants);

    void
    set_time(const double time);

    /** Whether any displacement is prescribed, so that a reaction exists. */
    bool
    constrains() const;

    /** Whether there are dashpots at the boundary. */
    bool
    absorbs() const
    {
      return absorbing != "no";
    }

    /** Whether they are matched to the loosened, not the closed medium. */
    bool
    absorbs_loosened() const
    {
      return absorbing == "loosened";
    }

    /** What only dynamics knows, by its key; empty if there is none. */
    std::string
    dynamic_key() const;

    /** Whether its loads depend on time. */
    bool
    varies() const;

    std::string        name;
    types::boundary_id id = numbers::invalid_boundary_id;

    bool symmetry = false;
    /** In degrees: facets with symmetry that turn by more are held both. */
    double kink_angle = 25.;
    /** One expression per prescribed component. */
    std::array<std::unique_ptr<SpaceTimeFunction<dim>>, dim> displacement;
    std::array<std::unique_ptr<SpaceTimeFunction<dim>>, dim> velocity;
    std::unique_ptr<SpaceTimeFunction<dim>>                  traction;
    std::unique_ptr<SpaceTimeFunction<dim>>                  pressure;

  private:
    std::array<std::string, dim> displacement_text;
    std::array<std::string, dim> velocity_text;
    std::string                  absorbing = "no";
    std::string                  traction_text;
    std::string                  pressure_text;
  };

  /** The boundary of a name; a UserError if nobody is called so.
   *  @param where in the scene file the name stands */
  types::boundary_id
  boundary_id_of(const std::string   &name,
                 const BoundaryNames &names,
                 const std::string   &where);

  template <int dim>
  using BoundaryConditions = std::vector<BoundaryCondition<dim>>;
} // namespace Signoton

#endif
