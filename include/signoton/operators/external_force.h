#ifndef signoton_operators_external_force_h
#define signoton_operators_external_force_h

#include <signoton/discretization/space.h>
#include <signoton/rheology/material.h>

namespace Signoton
{
  /** Loads that do not depend on time are integrated once. */
  enum class LoadKind
  {
    steady,
    varying
  };

  inline LoadKind
  load_kind(const bool varies)
  {
    return varies ? LoadKind::varying : LoadKind::steady;
  }

  /**
   * The weight of all materials with a density. What is the same at all places
   * but varies in time, as in a quake, is integrated once for each direction.
   */
  template <int dim>
  class BodyForce
  {
  public:
    /** Adapt to the current mesh. All arguments must outlive the object.
     *  @param gravity nullptr for none */
    void
    reinit(const Space<dim>                      &space,
           const std::vector<Rheology::Material> &materials,
           const SpaceTimeFunction<dim>          *gravity);

    /** Add $\int\rho g\cdot v$, if it is of a kind, at the time last set to
     *  @p force in N, as the mesh bears it: see EnergyTerm. The caller
     *  compresses. */
    void
    add(const LoadKind kind, VectorType &force) const;

  private:
    /** Add the force of an acceleration. */
    template <typename Acceleration>
    void
    integrate(const Acceleration &acceleration, VectorType &force) const;

    const Space<dim>                      *space     = nullptr;
    const std::vector<Rheology::Material> *materials = nullptr;
    const SpaceTimeFunction<dim>          *gravity   = nullptr;
    /** Forces of an acceleration of one along each axis, if they serve. */
    std::vector<VectorType> of_unit;
  };

  /**
   * Tractions and pressures on the boundary. The geometry of the loaded faces
   * is kept, so that a load that varies in time costs its expressions and
   * little more.
   */
  template <int dim>
  class SurfaceLoad
  {
  public:
    /** Find the loaded faces of the current mesh. Both arguments must outlive
     *  the object. */
    void
    reinit(const Space<dim> &space, const BoundaryConditions<dim> &conditions);

    /** Add $\int t\cdot v$ of the loads of a kind at the time last set to
     *  @p force in N, as BodyForce does. */
    void
    add(const LoadKind kind, VectorType &force) const;

  private:
    struct Face
    {
      const BoundaryCondition<dim>        *condition;
      LoadKind                             kind;
      std::vector<types::global_dof_index> dofs;
      std::vector<unsigned int>            component; ///< of the dofs
      std::vector<Point<dim>>              points;
      std::vector<Tensor<1, dim>>          normals;
      FullMatrix<double>                   weights; ///< dof times point, in m^2
    };

    const AffineConstraints<double> *mesh_constraints = nullptr;
    std::vector<Face>                faces;
  };
} // namespace Signoton

#endif
