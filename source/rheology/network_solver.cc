#include <signoton/rheology/network.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>
#include <limits>

// The solver of the local problem of a Network. Its class comment tells the
// idea, doc/rheology.md the equations.

namespace Signoton::Rheology
{
  void
  Network::find_modes()
  {
    // The potential of the linear elements is diagonal in the eigenvectors of
    // the map of waves, which is symmetric: (1 + n) / (1 - n) / 2 times strain
    // squared for an eigenvalue n.
    const unsigned int n = controlled.m();
    if (n == 0)
      return;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        modes(i, j) = 0.5 * (controlled(i, j) + controlled(j, i));
    // Many eigenvalues are repeated, which LAPACK's expert driver, the one in
    // LAPACKFullMatrix, does not always take.
    const types::blas_int size = n;
    types::blas_int       info = 0, n_work = -1;
    double                best_n_work = 0.;
    syev("V",
         "U",
         &size,
         &modes(0, 0),
         &size,
         stiff_part.begin(),
         &best_n_work,
         &n_work,
         &info);
    n_work = static_cast<types::blas_int>(best_n_work);
    std::vector<double> workspace(n_work);
    syev("V",
         "U",
         &size,
         &modes(0, 0),
         &size,
         stiff_part.begin(),
         workspace.data(),
         &n_work,
         &info);
    AssertThrow(info == 0, ExcInternalError());
    constexpr double rigid = 1e-13;
    for (double &value : stiff_part)
      value = std::max(1. - value, rigid);
  }

  template <bool with_slope>
  void
  Network::project(const bool penalized)
  {
    for (Leaf &leaf : leaves)
      {
        const Node     &node    = nodes[leaf.node];
        const double    penalty = penalized ? leaf.penalty : 1.;
        const Tensor2<> trial =
          from_mandel(scale(leaf.root[0], leaf.root[1], leaf.wave));
        Projection<double, with_slope> projection;
        projection.hardening =
          node.hardening < 0 ? 0. : accepted_scalars[node.hardening];
        std::visit(
          [&](const auto &set) {
            set.project(trial,
                        Moduli{penalty * node.stiffness.bulk,
                               penalty * node.stiffness.shear},
                        projection);
          },
          leaf.set);
        leaf.admissible = scale(1. / leaf.root[0],
                                1. / leaf.root[1],
                                to_mandel(projection.stress));
        leaf.region =
          static_cast<Region>(static_cast<unsigned int>(projection.region));
        leaf.hardening  = projection.hardening;
        leaf.correction = projection.potential_correction;
        if constexpr (with_slope)
          {
            // scaled to eigenvalues between 0 and 1, and symmetric
            const IsotropicScaling half{1. / leaf.root[0], 1. / leaf.root[1]};
            const Matrix6 J = to_mandel(half.both_sides(projection.tangent));
            for (unsigned int i = 0; i < 6; ++i)
              for (unsigned int j = 0; j < 6; ++j)
                leaf.slope(i, j) = 0.5 / penalty * (J(i, j) + J(j, i));
          }
      }
  }

  double
  Network::evaluate()
  {
    const unsigned int n = rhs.size();
    if (n == 0) // springs and dampers alone
      return 0.;
    project<false>(false);
    for (unsigned int i = 0; i < n; ++i)
      work[i] = leaves[i / 6].reflected(i % 6);
    controlled.vmult(rhs, work);
    for (unsigned int i = 0; i < n; ++i)
      leaves[i / 6].defect[i % 6] =
        leaves[i / 6].start[i % 6] + rhs[i] - leaves[i / 6].wave[i % 6];
    return relative_defect();
  }

  double
  Network::evaluate_augmented()
  {
    // (1 + N) e + (1 - N) s = start for the strains e of the contacts and
    // hinges, with the stresses s that these cause
    for (Leaf &leaf : leaves)
      leaf.wave = add_scaled(leaf.multiplier, leaf.penalty, leaf.strain);
    project<false>(true);
    const unsigned int n = rhs.size();
    for (unsigned int i = 0; i < n; ++i)
      work[i] = leaves[i / 6].admissible[i % 6] - leaves[i / 6].strain[i % 6];
    controlled.vmult(rhs, work);
    for (unsigned int i = 0; i < n; ++i)
      {
        Leaf &leaf         = leaves[i / 6];
        leaf.defect[i % 6] = leaf.start[i % 6] + rhs[i] -
                             leaf.admissible[i % 6] - leaf.strain[i % 6];
      }
    return relative_defect();
  }

  double
  Network::relative_defect() const
  {
    // Stresses count, strains do not: they may not be unique.
    double defects = 0., stresses = 0.;
    for (const Leaf &leaf : leaves)
      {
        defects += dot(leaf.defect, leaf.defect);
        stresses += dot(leaf.admissible, leaf.admissible);
      }
    if (!std::isfinite(defects))
      return std::numeric_limits<double>::infinity();
    return defects > 0. ? std::sqrt(defects / std::max(step.scale, stresses)) :
                          0.;
  }

  double
  Network::slope_along_direction()
  {
    // of the augmented potential, whose derivative is the defect divided by
    // 1 - N
    double             result = 0.;
    const unsigned int n      = rhs.size();
    for (unsigned int mode = 0; mode < n; ++mode)
      {
        double defect = 0., direction = 0.;
        for (unsigned int i = 0; i < n; ++i)
          {
            defect += modes(mode, i) * leaves[i / 6].defect[i % 6];
            direction += modes(mode, i) * leaves[i / 6].direction[i % 6];
          }
        result -= defect * direction / stiff_part[mode];
      }
    return result;
  }

  void
  Network::solve_augmented()
  {
    const unsigned int n = rhs.size();
    project<true>(true);
    matrix.reinit(n);
    constexpr double tiny = 1e-13;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          const Leaf &leaf = leaves[j / 6];
          double      sum  = 0.;
          for (unsigned int k = 0; k < 6; ++k)
            {
              const unsigned int column = j - j % 6 + k;
              sum += ((column == i ? 1. : 0.) - controlled(i, column)) *
                     leaf.slope(k, j % 6);
            }
          matrix(i, j) = leaf.penalty * sum + controlled(i, j) +
                         (i == j ? 1. + tiny * (1. + leaf.penalty) : 0.);
        }
    matrix.compute_lu_factorization();
    for (unsigned int i = 0; i < n; ++i)
      rhs[i] = leaves[i / 6].defect[i % 6];
    matrix.solve(rhs);
    for (unsigned int i = 0; i < n; ++i)
      leaves[i / 6].direction[i % 6] = rhs[i];
  }

  bool
  Network::search_line()
  {
    const double at_start = slope_along_direction();
    if (!(at_start < 0.)) // round-off
      return false;
    for (Leaf &leaf : leaves)
      leaf.old_strain = leaf.strain;
    const auto slope_at = [&](const double length) {
      for (Leaf &leaf : leaves)
        leaf.strain = add_scaled(leaf.old_strain, length, leaf.direction);
      step.residual = evaluate_augmented();
      return slope_along_direction();
    };
    // the Illinois variant of the rule of false position; the slope increases
    double low = 0., high = 1., low_slope = at_start, high_slope = slope_at(1.);
    if (high_slope <= -0.1 * at_start)
      return true;
    for (unsigned int i = 0; i < 25; ++i)
      {
        const double margin = 0.02 * (high - low);
        const double length =
          std::clamp(low + (high - low) * low_slope / (low_slope - high_slope),
                     low + margin,
                     high - margin);
        const double slope = slope_at(length);
        if (std::abs(slope) <= -0.1 * at_start)
          break;
        if (slope > 0.)
          {
            high       = length;
            high_slope = slope;
            low_slope *= 0.5;
          }
        else
          {
            low       = length;
            low_slope = slope;
            high_slope *= 0.5;
          }
      }
    return true;
  }

  void
  Network::minimize(const double sufficient)
  {
    step.residual = evaluate_augmented();
    for (unsigned int i = 0; i < 30 && !is_finished(); ++i)
      {
        if (i > 0 && step.residual <= sufficient)
          break;
        solve_augmented();
        ++step.iterations;
        if (!search_line())
          break;
      }
    // The strain that its stress accounts for; the compliance has the rest.
    for (Leaf &leaf : leaves)
      {
        leaf.multiplier = leaf.admissible;
        leaf.wave       = add_scaled(leaf.admissible,
                               1. / leaf.penalty,
                               add_scaled(leaf.wave, -1., leaf.admissible));
      }
    step.residual = evaluate();
    keep_best();
  }

  void
  Network::raise_penalties()
  {
    // where the compliance matters
    constexpr double share = 1e-2, factor = 10., most = 1e12;
    double           largest = 0.;
    for (const Leaf &leaf : leaves)
      largest = std::max(largest, dot(leaf.defect, leaf.defect));
    for (Leaf &leaf : leaves)
      if (dot(leaf.defect, leaf.defect) >= share * share * largest)
        leaf.penalty = std::min(factor * leaf.penalty, most);
  }

  void
  Network::factorize(const FullMatrix<double> &map, const double shift)
  {
    // the derivative of F; a shift keeps it regular
    const unsigned int n = rhs.size();
    project<true>(false);
    matrix.reinit(n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          const Leaf        &leaf  = leaves[j / 6];
          const unsigned int first = j - j % 6;
          double             sum   = map(i, j);
          for (unsigned int k = 0; k < 6; ++k)
            sum -= 2. * map(i, first + k) * leaf.slope(k, j % 6);
          matrix(i, j) = sum + (i == j ? 1. + shift : 0.);
        }
    matrix.compute_lu_factorization();
  }

  void
  Network::newton()
  {
    constexpr unsigned int longest  = 8;
    constexpr unsigned int patience = 2;
    constexpr double       least = 1e-12, most = 0.1, part = 1e-2;
    const double           first   = step.residual;
    unsigned int           in_vain = 0;
    double                 best    = first;
    for (unsigned int i = 0;
         i < longest && in_vain < patience && !is_finished();
         ++i)
      {
        factorize(controlled, std::clamp(part * step.residual, least, most));
        for (unsigned int k = 0; k < rhs.size(); ++k)
          rhs[k] = leaves[k / 6].defect[k % 6];
        matrix.solve(rhs);
        ++step.iterations;
        for (unsigned int k = 0; k < rhs.size(); ++k)
          leaves[k / 6].wave[k % 6] += rhs[k];
        step.residual = evaluate();
        in_vain       = step.residual < 0.5 * best ? 0 : in_vain + 1;
        best          = std::min(best, step.residual);
        keep_best();
      }
    if (best > 0.1 * first)
      return;
    // go on from here
    for (Leaf &leaf : leaves)
      leaf.wave = leaf.best_wave;
    step.residual = evaluate();
    for (Leaf &leaf : leaves)
      {
        leaf.multiplier = leaf.admissible;
        leaf.strain     = add_scaled(leaf.wave, -1., leaf.admissible);
      }
  }

  void
  Network::keep_best()
  {
    if (!(step.residual < best_residual))
      return;
    if (step.residual < 0.5 * best_residual)
      best_at = step.iterations;
    best_residual = step.residual;
    for (Leaf &leaf : leaves)
      leaf.best_wave = leaf.wave;
  }

  bool
  Network::is_finished() const
  {
    // what Newton's method gives for nothing more is taken: inaccuracies of this
    // step are contradictions between rigid elements in the next one
    const unsigned int in_vain = step.iterations - best_at;
    return best_residual <= 1e-2 * tolerance ||
           (best_residual <= tolerance && in_vain >= 1) ||
           (best_residual <= sufficient && in_vain >= 6) ||
           step.iterations >= maximum_iterations;
  }

  void
  Network::iterate()
  {
    step.iterations = 0;
    best_residual   = std::numeric_limits<double>::max();
    best_at         = 0;
    for (Leaf &leaf : leaves)
      {
        leaf.penalty    = 1.;
        leaf.multiplier = Vector6{};
        leaf.strain     = scale(0.5, 0.5, leaf.start);
        leaf.best_wave  = leaf.start;
      }
    if (leaves.empty())
      best_residual = 0.;
    double accuracy = 1., tried = std::numeric_limits<double>::max();
    while (!is_finished())
      {
        minimize(0.1 * accuracy);
        accuracy = step.residual;
        raise_penalties();
        if (!is_finished() && step.residual <= 0.1 * tried)
          {
            newton();
            accuracy = tried = std::min(accuracy, best_residual);
          }
      }
    for (Leaf &leaf : leaves)
      leaf.wave = leaf.best_wave;
    step.residual  = evaluate();
    step.converged = step.residual <= std::max(tolerance, sufficient);
  }

  void
  Network::find_tangent()
  {
    // dt = N R dt + B de, dsigma = K de + C R dt; a small shift picks one of
    // many strains of elements, all with the same stress of the whole
    step.tangent = Matrix6::isotropic(K[0], K[1]);
    if (leaves.empty())
      return;
    factorize(scattering, 1e-12);
    for (unsigned int column = 0; column < 6; ++column)
      {
        Vector6 unit{};
        unit[column] = 1.;
        for (unsigned int i = 0; i < leaves.size(); ++i)
          {
            const Vector6 wave = scale(B[0][i], B[1][i], unit);
            std::copy(wave.begin(), wave.end(), rhs.begin() + 6 * i);
          }
        matrix.solve(rhs);
        for (unsigned int i = 0; i < leaves.size(); ++i)
          {
            Vector6 wave;
            std::copy(rhs.begin() + 6 * i,
                      rhs.begin() + 6 * i + 6,
                      wave.begin());
            const Vector6 reflected =
              add_scaled(scale(-1., -1., wave), 2., leaves[i].slope * wave);
            const Vector6 stress = scale(C[0][i], C[1][i], reflected);
            for (unsigned int row = 0; row < 6; ++row)
              step.tangent(row, column) += stress[row];
          }
      }
  }
} // namespace Signoton::Rheology
