#ifndef signoton_solvers_linear_solver_h
#define signoton_solvers_linear_solver_h

#include <signoton/base/ledger.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_solver.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>

namespace Signoton
{
  using namespace dealii;

  /** How a linear solve went. */
  struct LinearResult
  {
    bool         converged  = false;
    unsigned int iterations = 0;  ///< 1 for a direct solve
    double       residual   = 0.; ///< relative to the right hand side
    std::string  reason;          ///< in words, if it did not converge
  };

  /**
   * Trilinos' solvers for an assembled matrix: conjugate gradients or GMRES
   * with smoothed aggregation (ML), which is given the rigid body motions as
   * near-null space; or a factorization (KLU or MUMPS) of small systems, and of
   * plane ones of middling size: it does not mind the nearly singular tangents
   * of loosened and flowing zones.
   */
  class LinearSolver
  {
  public:
    using VectorType = LinearAlgebra::distributed::Vector<double>;

    struct Parameters
    {
      void
      add_parameters(ParameterHandler &handler);

      /** Whether a system of so many unknowns is factorized. */
      bool
      is_direct(const double n_unknowns, const unsigned int dim) const;

      std::string  method                = "auto";
      unsigned int direct_limit_2d       = 100000;
      unsigned int direct_limit_3d       = 5000;
      unsigned int maximum_iterations    = 400;
      double       aggregation_threshold = 0.02;
      unsigned int smoother_sweeps       = 4;
    };

    LinearSolver(const Parameters &parameters, Ledger &ledger)
      : parameters(parameters)
      , ledger(ledger)
    {}

    /**
     * Prepare for a matrix, which must live as long as solves go on. If it turns
     * out singular, it is solve() that says so.
     * @param near_null_space vectors of locally owned entries
     * @param dim unknowns at a node, which are numbered one after the other
     * @param degree polynomial degree of the elements
     * @param symmetric if not, GMRES takes the place of conjugate gradients
     */
    void
    initialize(const TrilinosWrappers::SparseMatrix   &matrix,
               const std::vector<std::vector<double>> &near_null_space,
               const unsigned int                      dim,
               const unsigned int                      degree,
               const bool                              symmetric);

    /** Forget the matrix: to be called before it changes its size. */
    void
    clear();

    /** Solve to a residual below @p tolerance times that of zero. */
    LinearResult
    solve(VectorType &solution, const VectorType &rhs, const double tolerance);

  private:
    /** Factorize, or set up the multigrid. */
    void
    prepare(const std::vector<std::vector<double>> &near_null_space,
            const unsigned int                      dim,
            const unsigned int                      degree);

    const Parameters                                  &parameters;
    Ledger                                            &ledger;
    const TrilinosWrappers::SparseMatrix              *matrix       = nullptr;
    bool                                               is_ready     = false;
    bool                                               is_symmetric = true;
    std::unique_ptr<TrilinosWrappers::PreconditionAMG> amg;
    std::unique_ptr<SolverControl>                     direct_control;
    std::unique_ptr<TrilinosWrappers::SolverDirect>    direct;
  };
} // namespace Signoton

#endif
