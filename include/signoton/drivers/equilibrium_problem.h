#ifndef signoton_drivers_equilibrium_problem_h
#define signoton_drivers_equilibrium_problem_h

#include <signoton/discretization/supports.h>
#include <signoton/drivers/loads.h>

namespace Signoton
{
  /**
   * The minimization that a load step of statics, or an implicit step of
   * dynamics, is: $J(u)=\sum_i J_i(u)-L(u)$ over the displacements that fulfill
   * the constraints of the space. The first term is that of the material,
   * others are added by the analysis.
   *
   * Each evaluation is one sweep, in the forces of the mesh: with all that
   * balances in a node, whether it is supported or not. What the supports take
   * is the reactions; the rest is the gradient.
   */
  template <int dim>
  class EquilibriumProblem : public ConvexProblem
  {
  public:
    /** All arguments must outlive the object.
     *  @param others terms beside that of the material */
    EquilibriumProblem(Model<dim>                           &model,
                       const Supports<dim>                  &supports,
                       const std::vector<EnergyTerm<dim> *> &others = {});

    /** Adapt to a new mesh. There are no loads then. */
    void
    reinit();

    /** Take the loads and constraints of the time last set in the model. */
    void
    update_loads(const Loads<dim> &loads);

    /** The loads last taken, in N. */
    const VectorType &
    loads() const
    {
      return load;
    }

    /** The forces of all terms at the displacement last evaluated, in N. */
    const VectorType &
    forces() const
    {
      return force;
    }

    /** forces() without loads: what the supports bear, see
     *  reaction_columns(). */
    VectorType
    support_forces() const;

    double
    evaluate(const VectorType &u,
             VectorType       &gradient,
             const bool        linearize) override;

    std::string
    failure() const override
    {
      return trouble;
    }

    bool
    has_potential() const override;

    bool
    is_linear() const override;

    /** The forces of supports and loads. Where they vanish, since contacts are
     *  open or a load is taken off again, a small part of the largest so far, or
     *  of what the strain would make of closed contacts. */
    double
    force_scale(const VectorType &u) override;

    double
    round_off(const VectorType &u) override;

    bool
    follows_supports(const VectorType &u) const override;

    bool
    flows(const VectorType &u) override;

    LinearResult
    solve(const VectorType &rhs,
          VectorType       &du,
          const double      tolerance,
          const double      regularization) override;

    /**
     * Move @p u by one linear step with the tangent there such that its
     * prescribed part moves by @p lift: the displacement spreads into the body
     * instead of crushing a layer of cells.
     */
    bool
    predict(VectorType &u, const VectorType &lift, const double regularization);

  private:
    /** Assemble and prepare the solver unless that is done already. */
    void
    prepare(const double regularization);

    Model<dim>                          &model;
    const Supports<dim>                 &supports;
    const std::vector<EnergyTerm<dim> *> others;

    VectorType                       load, force;
    double                           free_load = 0.; ///< norm of it, in N
    TrilinosWrappers::SparseMatrix   matrix;
    LinearSolver                     linear_solver;
    std::vector<std::vector<double>> near_null_space;
    double                           largest_scale = 0.; ///< of forces so far
    std::string                      trouble;            ///< see failure()
    /** Regularization that the matrix was assembled with, none if the point
     *  of linearization has moved since. */
    std::optional<double> assembled;
  };
} // namespace Signoton

#endif
