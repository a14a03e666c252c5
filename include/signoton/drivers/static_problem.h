#ifndef signoton_drivers_static_problem_h
#define signoton_drivers_static_problem_h

#include <signoton/drivers/loads.h>

namespace Signoton
{
  /**
   * The minimization that a load step is: $J(u)=\int W_n(\varepsilon(u))-L(u)$
   * over the displacements that fulfill the constraints of the space.
   */
  template <int dim>
  class StaticProblem : public ConvexProblem
  {
  public:
    explicit StaticProblem(Model<dim> &model);

    /** Adapt to a new mesh. */
    void
    reinit();

    /** Take the loads and constraints of the time last set in the model. */
    void
    update_loads(const Loads<dim> &loads);

    /** The loads of that time in N, before the elimination of constraints. */
    VectorType
    loads_of_mesh(const Loads<dim> &loads) const;

    double
    evaluate(const VectorType &u,
             VectorType       &gradient,
             const bool        linearize) override;

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

    /** Internal force minus loads with the entries of constrained unknowns:
     *  the forces of the supports, see reaction_columns(). */
    VectorType
    support_forces(const VectorType &u);

    /** Internal force before the elimination of constraints. */
    VectorType
    internal_force_of_mesh(const VectorType &u);

  protected:
    /** What force_scale() returns instead of a scale that may vanish. */
    double
    not_vanishing(const double scale, const VectorType &u);

    /** Add what the stiffness is not to the matrix. */
    virtual void
    complete(TrilinosWrappers::SparseMatrix &)
    {}

    Model<dim> &model;

  private:
    /** Assemble and prepare the solver unless that is done already. */
    void
    prepare(const double regularization);

    VectorType                       load;
    VectorType                       load_of_mesh;
    TrilinosWrappers::SparseMatrix   matrix;
    LinearSolver                     linear_solver;
    std::vector<std::vector<double>> near_null_space;
    double                           largest_scale = 0.; ///< of forces so far
    /** Regularization that the matrix was assembled with, none if the point
     *  of linearization has moved since. */
    std::optional<double> assembled;
  };
} // namespace Signoton

#endif
