#ifndef signoton_operators_inertia_h
#define signoton_operators_inertia_h

#include <signoton/operators/absorbing_boundary.h>
#include <signoton/operators/energy_term.h>

namespace Signoton
{
  /**
   * The inertia of a diagonal mass in an implicit step, with all forces that do
   * not depend on its solution:
   * $$ \tfrac m2(u-\tilde u)\cdot M(u-\tilde u)-p\cdot(u-\tilde u). $$
   * The displacement $\tilde u$ is where the step would lead without an
   * acceleration at its end.
   */
  template <int dim>
  class Inertia : public EnergyTerm<dim>
  {
  public:
    /** All arguments must outlive the object. Prescribed components of
     *  @p predicted are those of the solution, of the forces p, @p pull, they
     *  are zero. */
    Inertia(const Space<dim> &space,
            const VectorType &mass,
            const VectorType &predicted,
            const VectorType &pull);

    /** Set m, in 1/s^2. */
    void
    set_coefficient(const double m)
    {
      coefficient = m;
    }

    double
    evaluate(const VectorType &u,
             VectorType       &force,
             const bool        linearize) override;

    void
    apply_tangent(const VectorType &increment,
                  VectorType       &force) const override;

    void
    assemble(TrilinosWrappers::SparseMatrix &matrix,
             const double                    regularization) override;

    double
    size_of_differences(const VectorType &u) override;

    double
    outer_force() const override;

  private:
    const Space<dim> &space;
    const VectorType &mass, &predicted, &pull;

    double coefficient = 0.;
    double own_square  = 0.; ///< of the inertial forces, on this rank
  };

  /**
   * The dashpots of absorbing boundaries in an implicit step:
   * $\tfrac c2(u-\tilde u)\cdot C(u-\tilde u)$.
   */
  template <int dim>
  class Dashpots : public EnergyTerm<dim>
  {
  public:
    /** All arguments must outlive the object; @p predicted as for Inertia. */
    Dashpots(const Space<dim>             &space,
             const AbsorbingBoundary<dim> &absorbing,
             const VectorType             &predicted);

    /** Set c, in 1/s. */
    void
    set_coefficient(const double c)
    {
      coefficient = c;
    }

    double
    evaluate(const VectorType &u,
             VectorType       &force,
             const bool        linearize) override;

    void
    apply_tangent(const VectorType &increment,
                  VectorType       &force) const override;

    void
    assemble(TrilinosWrappers::SparseMatrix &matrix,
             const double                    regularization) override;

    double
    size_of_differences(const VectorType &) override
    {
      return 0.; // far less than that of inertia
    }

  private:
    const Space<dim>             &space;
    const AbsorbingBoundary<dim> &absorbing;
    const VectorType             &predicted;

    double coefficient = 0.;
  };
} // namespace Signoton

#endif
