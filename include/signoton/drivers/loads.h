#ifndef signoton_drivers_loads_h
#define signoton_drivers_loads_h

#include <signoton/drivers/model.h>
#include <signoton/operators/external_force.h>
#include <signoton/operators/point_forces.h>

namespace Signoton
{
  /** All that pushes the body of a model: weight, tractions and pressures,
   *  point forces. */
  template <int dim>
  class Loads
  {
  public:
    /** @p model must outlive the object. */
    explicit Loads(const Model<dim> &model);

    /** Adapt to a new mesh. */
    void
    reinit();

    /** Whether any depends on time. */
    bool
    vary() const;

    /** Add those of a kind, at the time last set in the model, to @p force in
     *  N, as the mesh bears them: see EnergyTerm. */
    void
    add(const LoadKind kind, VectorType &force) const;

    /** Add all of them. */
    void
    add_all(VectorType &force) const;

  private:
    const Model<dim> &model;
    BodyForce<dim>    body_force;
    SurfaceLoad<dim>  surface_load;
    PointForces<dim>  point_forces;
  };
} // namespace Signoton

#endif
