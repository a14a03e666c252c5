#include <signoton/solvers/newton.h>

#include <algorithm>
#include <cmath>

namespace Signoton
{
  void
  Newton::Parameters::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection("Newton");
    handler.add_parameter("Maximum iterations",
                          maximum_iterations,
                          "Iterations after which a step has failed and is "
                          "cut.",
                          Patterns::Integer(1));
    handler.add_parameter("Tolerance",
                          tolerance,
                          "Norm of the residual relative to the forces in "
                          "balance.",
                          Patterns::Double(1e-15, 1e-2));
    handler.add_parameter("Maximum line search steps",
                          maximum_line_search_steps,
                          "Trials of a line search after which a step has "
                          "failed.",
                          Patterns::Integer(1));
    handler.add_parameter("Tangent regularization",
                          regularization,
                          "Multiple of the elastic tangent added to the "
                          "tangent from the start. 0: only where the linear "
                          "solver needs it, and 1e-6 if a material can lose "
                          "all stiffness. The residual never has it.",
                          Patterns::Double(0., 1.));
    handler.leave_subsection();
  }

  unsigned int
  NewtonResult::most_linear_iterations() const
  {
    unsigned int most = 0;
    for (const auto &iteration : history)
      most = std::max(most, iteration.linear_iterations);
    return most;
  }

  unsigned int
  NewtonResult::linear_iterations() const
  {
    unsigned int sum = 0;
    for (const auto &iteration : history)
      sum += iteration.linear_iterations;
    return sum;
  }

  double
  Newton::search(ConvexProblem    &problem,
                 const VectorType &dx,
                 VectorType       &x,
                 VectorType       &gradient,
                 double           &energy,
                 const double      shortest) const
  {
    const double     slope_0  = gradient * dx;
    const double     energy_0 = energy;
    const double     norm_0   = gradient.l2_norm();
    const VectorType x_0(x);
    double           alpha = 1.;
    for (unsigned int trial = 0;
         trial < parameters.maximum_line_search_steps && alpha >= shortest;
         ++trial)
      {
        x = x_0;
        x.add(alpha, dx);
        // the full step is nearly always taken: linearize there at once
        energy             = problem.evaluate(x, gradient, trial == 0);
        const double slope = gradient * dx;
        const double noise =
          1e-13 * std::max(std::abs(energy), std::abs(energy_0));
        const bool decrease = energy <= energy_0 + 1e-4 * alpha * slope_0 &&
                              std::abs(alpha * slope_0) > noise;
        const bool flat = std::abs(slope) <= 0.5 * std::abs(slope_0) &&
                          energy <= energy_0 + noise;
        const bool better =
          problem.has_potential() ?
            decrease || flat :
            gradient.l2_norm() <= (1. - 1e-4 * alpha) * norm_0;
        if (problem.failure().empty() && std::isfinite(energy) && better)
          {
            if (trial > 0)
              energy = problem.evaluate(x, gradient, true);
            return alpha;
          }
        const double secant = std::isfinite(slope) && slope > slope_0 ?
                                alpha * slope_0 / (slope_0 - slope) :
                                0.;
        alpha               = std::clamp(secant, 0.1 * alpha, 0.7 * alpha);
      }
    x      = x_0;
    energy = problem.evaluate(x, gradient, true);
    return 0.;
  }

  namespace
  {
    /** Whether the residual is at its round-off; if so, the result says it. A
     *  body that flows away has large displacements and with them round-off, but
     *  no answer; one that only follows its supports has no forces but round-off,
     *  and there are no digits to ask for. Of a nonlinear one neither the residual
     *  nor the displacements may change any more, and what flows by far more than
     *  elastic strains has none, either.
     *
     *  @param dx the last increment, taken or not
     *  @param previous_norm of the residual before it */
    bool
    accept_round_off(ConvexProblem                   &problem,
                     const ConvexProblem::VectorType &x,
                     const ConvexProblem::VectorType &dx,
                     const double                     norm,
                     const double                     previous_norm,
                     NewtonResult                    &result)
    {
      const bool   is_linear = problem.is_linear();
      const double residual  = result.history.back().residual;
      if (!is_linear && !(norm >= 0.3 * previous_norm &&
                          dx.linfty_norm() <= 1e-6 * x.linfty_norm()))
        return false;
      if (!problem.follows_supports(x) &&
          (residual > (is_linear ? 1e-6 : 1e-4) ||
           (!is_linear && problem.flows(x))))
        return false;
      result.at_round_off = norm <= problem.round_off(x);
      result.converged    = result.at_round_off;
      return result.converged;
    }
  } // namespace

  NewtonResult
  Newton::solve(ConvexProblem &problem,
                VectorType    &x,
                const double   initial_regularization) const
  {
    NewtonResult result;
    result.regularization =
      std::max(parameters.regularization, initial_regularization);
    VectorType gradient(x), rhs(x), dx(x);
    double     energy = problem.evaluate(x, gradient, true);
    result.reason     = problem.failure();
    double scale      = problem.force_scale(x);
    double norm = gradient.l2_norm(), previous_norm = norm;
    result.history.push_back({norm > 0. ? norm / scale : norm});
    if (!result.reason.empty())
      return result;
    for (unsigned int iteration = 0;; ++iteration)
      {
        if (!std::isfinite(norm))
          {
            result.reason = "the residual is not a number";
            return result;
          }
        if (norm <= parameters.tolerance * scale)
          {
            result.converged = true;
            return result;
          }
        if (iteration > 0 &&
            accept_round_off(problem, x, dx, norm, previous_norm, result))
          return result;
        if (iteration == parameters.maximum_iterations)
          {
            result.reason =
              "no convergence in " + std::to_string(iteration) + " iterations";
            return result;
          }

        // Inexact Newton: solve as accurately as quadratic convergence can
        // use, and not beyond the tolerance (Eisenstat and Walker, choice 2).
        const double ratio = norm / previous_norm,
                     all   = std::min(1e-3,
                                    0.1 * parameters.tolerance * scale / norm);
        const double forcing =
          problem.is_linear() ?
            std::max(all, 1e-15) :
            std::max(std::clamp(iteration == 0 ? 1e-3 : 0.1 * ratio * ratio,
                                1e-6,
                                1e-3),
                     all);
        rhs = gradient;
        rhs *= -1.;
        NewtonIteration next;
        LinearResult    linear;
        while (true)
          {
            dx     = 0.;
            linear = problem.solve(rhs, dx, forcing, result.regularization);
            ++next.linear_solves;
            next.linear_iterations += linear.iterations;
            next.regularization = result.regularization;
            // Short steps say that the tangent is trusted too far: many points
            // are about to switch their branch, or the body is near its limit
            // load. A part of the elastic tangent shortens the increment where
            // the body is loose, and only there.
            double &rho = result.regularization;
            if (linear.converged &&
                (!problem.has_potential() || gradient * dx < 0.))
              {
                const double shortest = rho < 0.1 ? 0.2 : 0.;
                next.step_length =
                  search(problem, dx, x, gradient, energy, shortest);
                if (next.step_length > 0.)
                  break;
                linear.reason = "the line search found no decrease";
                rho           = std::max(1e-3, 4. * rho);
              }
            else
              {
                if (linear.converged)
                  linear.reason = "the tangent gives no descent direction";
                rho = std::max(1e-8, 100. * rho);
              }
            // where there is no decrease any more there may be none to find
            if (next.linear_solves == 2 &&
                accept_round_off(problem, x, dx, norm, norm, result))
              return result;
            if (rho > 2.)
              {
                if (!accept_round_off(problem, x, dx, norm, norm, result))
                  result.reason = linear.reason;
                return result;
              }
          }
        if (next.step_length > 0.9)
          result.regularization =
            result.regularization > std::max(1e-5, parameters.regularization) ?
              std::max(parameters.regularization, 0.1 * result.regularization) :
              parameters.regularization;
        previous_norm = norm;
        norm          = gradient.l2_norm();
        scale         = std::max(scale, problem.force_scale(x));
        next.residual = norm / scale;
        result.history.push_back(next);
      }
  }
} // namespace Signoton
