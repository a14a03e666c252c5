#include <signoton/base/blas.h>
#include <signoton/solvers/linear_solver.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>

#include <Amesos.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <iostream>

namespace Signoton
{
  namespace
  {
    /** Say once that there are better ones. */
    void
    warn_of_slow_blas(const MPI_Comm &communicator)
    {
      static bool said = false;
      if (!said && BLAS::is_reference() &&
          Utilities::MPI::this_mpi_process(communicator) == 0)
        std::cout << "  warning: the reference BLAS factorizes, ten times "
                     "slower than others (Debian: libopenblas0-serial)"
                  << std::endl;
      said = true;
    }
  } // namespace

  void
  LinearSolver::Parameters::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection("Linear solver");
    handler.add_parameter(
      "Method",
      method,
      "auto: direct for small systems, else cg. cg: conjugate gradients with "
      "algebraic multigrid. gmres: the same for non-symmetric tangents. "
      "direct: sparse factorization, by KLU or, beyond 10,000 unknowns and "
      "where Trilinos has it, MUMPS.",
      Patterns::Selection("auto|cg|gmres|direct"));
    handler.add_parameter("Direct below in 2D",
                          direct_limit_2d,
                          "Number of unknowns up to which auto chooses direct "
                          "in two dimensions.",
                          Patterns::Integer(0));
    handler.add_parameter("Direct below in 3D",
                          direct_limit_3d,
                          "The same in three dimensions, where factors fill "
                          "up.",
                          Patterns::Integer(0));
    handler.add_parameter("Maximum iterations",
                          maximum_iterations,
                          "Iterations of cg or gmres after which a solve has "
                          "failed.",
                          Patterns::Integer(1));
    handler.add_parameter("Aggregation threshold",
                          aggregation_threshold,
                          "Couplings weaker than this part of the diagonal do "
                          "not aggregate in the multigrid.",
                          Patterns::Double(0., 1.));
    handler.add_parameter("Smoother sweeps",
                          smoother_sweeps,
                          "Degree of the Chebyshev smoother.",
                          Patterns::Integer(1, 20));
    handler.leave_subsection();
  }

  bool
  LinearSolver::Parameters::is_direct(const double       n_unknowns,
                                      const unsigned int dim) const
  {
    return method == "direct" ||
           (method == "auto" &&
            n_unknowns <= (dim == 2 ? direct_limit_2d : direct_limit_3d));
  }

  void
  LinearSolver::initialize(
    const TrilinosWrappers::SparseMatrix   &new_matrix,
    const std::vector<std::vector<double>> &near_null_space,
    const unsigned int                      dim,
    const unsigned int                      degree,
    const bool                              symmetric)
  {
    const auto timer = ledger.time("preconditioner");
    clear();
    matrix       = &new_matrix;
    is_symmetric = symmetric;
    try
      {
        prepare(near_null_space, dim, degree);
        is_ready = true;
      }
    catch (const ExceptionBase &)
      {
        // a zero pivot or an empty row; the same on all ranks
      }
  }

  void
  LinearSolver::prepare(const std::vector<std::vector<double>> &near_null_space,
                        const unsigned int                      dim,
                        const unsigned int                      degree)
  {
    if (parameters.is_direct(matrix->m(), dim))
      {
        // KLU is the faster one up to about 10,000 unknowns in the plane;
        // beyond, MUMPS has less fill-in and uses all ranks
        const std::string package =
          matrix->m() > 10000 && Amesos().Query("Amesos_Mumps") ?
            "Amesos_Mumps" :
            "Amesos_Klu";
        if (package == "Amesos_Mumps")
          warn_of_slow_blas(matrix->get_mpi_communicator());
        direct_control = std::make_unique<SolverControl>(1, 0.);
        direct         = std::make_unique<TrilinosWrappers::SolverDirect>(
          *direct_control,
          TrilinosWrappers::SolverDirect::AdditionalData(false, package));
        direct->initialize(*matrix);
        return;
      }

    TrilinosWrappers::PreconditionAMG::AdditionalData options;
    options.elliptic              = true;
    options.higher_order_elements = degree > 1;
    options.smoother_sweeps       = parameters.smoother_sweeps;
    options.aggregation_threshold = parameters.aggregation_threshold;
    Teuchos::ParameterList              list;
    std::unique_ptr<Epetra_MultiVector> unused;
    options.set_parameters(list, unused, *matrix);

    Epetra_MultiVector modes(matrix->trilinos_matrix().OperatorDomainMap(),
                             near_null_space.size(),
                             false);
    for (unsigned int a = 0; a < near_null_space.size(); ++a)
      for (int i = 0; i < modes.MyLength(); ++i)
        modes[a][i] = near_null_space[a][i];
    // The coarsest matrices are nearly dense: factoring one of deal.II's default
    // size of 2000 costs more than all the rest of the setup.
    list.set("coarse: max size", 200);
    list.set("PDE equations", static_cast<int>(dim));
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", static_cast<int>(modes.NumVectors()));
    list.set("null space: vectors", modes.Values());
    amg = std::make_unique<TrilinosWrappers::PreconditionAMG>();
    amg->initialize(*matrix, list);
  }

  void
  LinearSolver::clear()
  {
    amg.reset();
    direct.reset();
    matrix   = nullptr;
    is_ready = false;
  }

  LinearResult
  LinearSolver::solve(VectorType       &solution,
                      const VectorType &rhs,
                      const double      tolerance)
  {
    const auto   timer = ledger.time("linear solve");
    LinearResult result;
    if (!is_ready)
      {
        result.reason = "the matrix is singular";
        return result;
      }
    const double rhs_norm = rhs.l2_norm();
    if (!(rhs_norm > 0.))
      {
        solution         = 0.;
        result.converged = std::isfinite(rhs_norm);
        result.reason    = "the residual is not a number";
        return result;
      }

    SolverControl control(parameters.maximum_iterations,
                          tolerance * rhs_norm,
                          false,
                          false);
    try
      {
        if (direct)
          direct->solve(solution, rhs);
        else if (parameters.method == "gmres" || !is_symmetric)
          {
            SolverGMRES<VectorType>::AdditionalData options;
            options.max_n_tmp_vectors = 80;
            // the residual that is compared is then that of the equations
            options.right_preconditioning = true;
            SolverGMRES<VectorType>(control, options)
              .solve(*matrix, solution, rhs, *amg);
          }
        else
          SolverCG<VectorType>(control).solve(*matrix, solution, rhs, *amg);
        result.converged = true;
      }
    catch (const SolverControl::NoConvergence &failure)
      {
        result.reason = "no convergence in " +
                        std::to_string(failure.last_step) + " iterations";
      }
    catch (const ExceptionBase &)
      {
        result.reason = "the matrix is singular or not positive definite";
      }
    result.iterations = direct ? 1 : control.last_step();
    result.residual   = direct ? 0. : control.last_value() / rhs_norm;
    if (!std::isfinite(solution.l2_norm()))
      {
        result.converged = false;
        result.reason    = "the matrix is singular";
      }
    return result;
  }
} // namespace Signoton
