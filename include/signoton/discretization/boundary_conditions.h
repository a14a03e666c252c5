#ifndef signoton_discretization_boundary_conditions_h
#define signoton_discretization_boundary_conditions_h

#include <signoton/base/function.h>
#include <signoton/discretization/geometry.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <optional>

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

  /** Add the conditions on the displacement to @p constraints, as they are at
   *  the time last set. Does not close the constraints. */
  template <int dim>
  void
  constrain_displacement(const Mapping<dim>            &mapping,
                         const DoFHandler<dim>         &dof_handler,
                         const BoundaryConditions<dim> &conditions,
                         AffineConstraints<double>     &constraints);

  /**
   * Names of the rigid motions that the constraints leave free, such as
   * "translation x" or "rotation about z". Statics has no unique solution
   * unless the list is empty.
   * @param constraints conditions on the displacement, without hanging nodes
   */
  template <int dim>
  std::vector<std::string>
  free_rigid_motions(const Mapping<dim>              &mapping,
                     const DoFHandler<dim>           &dof_handler,
                     const AffineConstraints<double> &constraints,
                     const bool                       axisymmetric);

  /**
   * The rigid motions as vectors of nodal values at the locally owned dofs:
   * translations, then rotations about the center of gravity scaled to order
   * one. In axisymmetry only the translation along the axis.
   */
  template <int dim>
  std::vector<std::vector<double>>
  rigid_motions(const Mapping<dim>    &mapping,
                const DoFHandler<dim> &dof_handler,
                const IndexSet        &dofs,
                const bool             axisymmetric);
} // namespace Signoton

#endif
