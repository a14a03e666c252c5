#ifndef signoton_solvers_newton_h
#define signoton_solvers_newton_h

#include <signoton/solvers/linear_solver.h>

namespace Signoton
{
  /**
   * A convex minimization problem as Newton's method sees it: the energy
   * $J(x)$, its gradient, and a solver for the linearization. Equations without
   * a potential pass as well: of them, only the residual is looked at.
   */
  class ConvexProblem
  {
  public:
    using VectorType = LinearAlgebra::distributed::Vector<double>;

    virtual ~ConvexProblem() = default;

    /**
     * Gradient and energy at @p x.
     * @param linearize also keep what solve() needs
     * @return the energy
     */
    virtual double
    evaluate(const VectorType &x,
             VectorType       &gradient,
             const bool        linearize) = 0;

    /** Why there is no gradient at the point last evaluated; empty if there is
     *  one. */
    virtual std::string
    failure() const
    {
      return "";
    }

    /** Whether evaluate() returns an energy whose gradient it is. */
    virtual bool
    has_potential() const
    {
      return true;
    }

    /** Whether the gradient is linear, so that one exact solve is all. */
    virtual bool
    is_linear() const
    {
      return false;
    }

    /** Size of the forces that balance in the gradient at the point last
     *  evaluated: what a small gradient is compared with. */
    virtual double
    force_scale(const VectorType &x) = 0;

    /** The norm of what is left of a gradient at @p x that vanishes, by the
     *  digits that differences of large forces lose. */
    virtual double
    round_off(const VectorType &x) = 0;

    /** Whether @p x is as large as what is prescribed of it, so that there may
     *  be no forces to compare with. */
    virtual bool
    follows_supports(const VectorType &x) const
    {
      (void)x;
      return false;
    }

    /** Whether @p x is so large that it is no answer, beside a gradient that is
     *  not below the tolerance: plastic flow without end. */
    virtual bool
    flows(const VectorType &x)
    {
      (void)x;
      return false;
    }

    /** Solve (tangent + regularization * elastic tangent) @p dx = @p rhs. */
    virtual LinearResult
    solve(const VectorType &rhs,
          VectorType       &dx,
          const double      tolerance,
          const double      regularization) = 0;
  };

  /** One line of the history of a Newton solve. */
  struct NewtonIteration
  {
    double       residual          = 0.; ///< relative to the force scale
    unsigned int linear_solves     = 0;  ///< from the previous iterate to here
    unsigned int linear_iterations = 0;  ///< of these solves together
    double       regularization    = 0.; ///< of the tangent that led here
    double       step_length       = 0.; ///< of the line search
  };

  /** How a Newton solve went. */
  struct NewtonResult
  {
    bool converged = false;
    /** Converged to what round-off leaves, which is more than the tolerance. */
    bool                         at_round_off = false;
    std::string                  reason; ///< why it stopped, if not converged
    std::vector<NewtonIteration> history;
    double                       regularization = 0.;

    unsigned int
    iterations() const
    {
      return history.empty() ? 0 : history.size() - 1;
    }

    unsigned int
    most_linear_iterations() const;

    unsigned int
    linear_iterations() const;
  };

  /**
   * Semismooth Newton with a line search on the convex energy.
   *
   * A step length is accepted if it decreases the energy sufficiently
   * (Armijo), or, where differences of energies drown in round-off, if it
   * halves the slope. Otherwise the next trial is the secant zero of the
   * slope, which a convex function makes monotone. Without an energy, the norm
   * of the residual has to decrease. If only short steps are
   * acceptable, or the linear solver gives up, the tangent (never the
   * residual) is regularized by a multiple of the elastic one, which shrinks
   * again once full steps succeed.
   *
   * A residual is small if it is below the tolerance times the forces in
   * balance. A linear problem is solved to that at once, or to the round-off of
   * the forces of elements that the residual is a difference of: in a slender
   * body, or beside a material a million times as stiff, these are far larger
   * than the loads. So is a nonlinear one, once iterations change nothing more.
   */
  class Newton
  {
  public:
    using VectorType = LinearAlgebra::distributed::Vector<double>;

    struct Parameters
    {
      void
      add_parameters(ParameterHandler &handler);

      unsigned int maximum_iterations        = 30;
      double       tolerance                 = 1e-10;
      unsigned int maximum_line_search_steps = 12;
      double       regularization            = 0.;
    };

    explicit Newton(const Parameters &parameters)
      : parameters(parameters)
    {}

    /** Minimize from @p x, which fulfills all constraints, as do all iterates
     *  since increments fulfill the homogeneous ones. On failure @p x is the
     *  best iterate.
     *  @param initial_regularization of the first iteration, from where it
     *    shrinks: worth it where the first step is known to be short */
    NewtonResult
    solve(ConvexProblem &problem,
          VectorType    &x,
          const double   initial_regularization = 0.) const;

  private:
    /** Line search from x along dx; returns the step length, 0 if none at
     *  least as long as @p shortest is acceptable. Leaves the problem
     *  linearized at the new x. */
    double
    search(ConvexProblem    &problem,
           const VectorType &dx,
           VectorType       &x,
           VectorType       &gradient,
           double           &energy,
           const double      shortest) const;

    const Parameters &parameters;
  };
} // namespace Signoton

#endif
