// Energy-norm projections onto every admissible set, for ordinary and for
// adversarial trial stresses. The optimality conditions are checked in the
// space of full tensors through the support function h of the set: pi is the
// projection of t if and only if pi is in the set and q = E^-1 (t - pi) has
// h(q) = pi:q. A subset is compared with an enumeration of all active sets.

#include "common.h"

#include <functional>

using namespace Signoton;
using namespace Signoton::Testing;

namespace
{
  using Real = long double;

  /** Eigenvalues by another algorithm than the code under test. */
  SpectralDecomposition
  independent_spectrum(const Tensor2<> &t)
  {
    SpectralDecomposition spectrum{Tensor2<>()};
    const auto            pairs =
      eigenvectors(t, SymmetricTensorEigenvectorMethod::ql_implicit_shifts);
    for (unsigned int a = 0; a < 3; ++a)
      {
        spectrum.values[a]     = pairs[a].first;
        spectrum.directions[a] = pairs[a].second;
      }
    return spectrum;
  }

  template <std::size_t d>
  Real
  dot(const std::array<Real, d> &a, const std::array<Real, d> &b)
  {
    Real sum = 0;
    for (unsigned int i = 0; i < d; ++i)
      sum += a[i] * b[i];
    return sum;
  }

  /** Solves the first `m` equations of `M` by Gauss-Jordan elimination, the
   *  right-hand side in column `m`; false if singular. */
  template <std::size_t d>
  bool
  solve(std::array<std::array<Real, d + 1>, d> &M, const unsigned int m)
  {
    Real scale = 0;
    for (unsigned int r = 0; r < m; ++r)
      scale = std::max(scale, M[r][r]);
    for (unsigned int c = 0; c < m; ++c)
      {
        unsigned int pivot = c;
        for (unsigned int r = c + 1; r < m; ++r)
          if (std::abs(M[r][c]) > std::abs(M[pivot][c]))
            pivot = r;
        if (std::abs(M[pivot][c]) < 1e-13L * scale)
          return false;
        std::swap(M[pivot], M[c]);
        for (unsigned int r = 0; r < m; ++r)
          {
            if (r == c)
              continue;
            const Real factor = M[r][c] / M[c][c];
            for (unsigned int k = c; k <= m; ++k)
              M[r][k] -= factor * M[c][k];
          }
      }
    for (unsigned int r = 0; r < m; ++r)
      M[r][m] /= M[r][r];
    return true;
  }

  /**
   * The nearest point to `y` with `planes[i] * x <= bounds[i]` in the norm of
   * $E^{-1}$: of all candidates with up to `d` active planes, the one that
   * violates the optimality conditions least.
   */
  template <std::size_t d>
  std::array<Real, d>
  enumerate_active_sets(const std::vector<std::array<Real, d>>   &planes,
                        const std::vector<Real>                  &bounds,
                        const std::array<std::array<Real, d>, d> &E,
                        const std::array<Real, d>                &y)
  {
    const unsigned int               n = planes.size();
    std::vector<std::array<Real, d>> E_a(n);
    for (unsigned int p = 0; p < n; ++p)
      for (unsigned int i = 0; i < d; ++i)
        E_a[p][i] = dot(E[i], planes[p]);

    std::array<Real, d> best           = y;
    Real                best_violation = std::numeric_limits<Real>::max();
    for (unsigned int subset = 0; subset < (1u << n); ++subset)
      {
        std::vector<unsigned int> active;
        for (unsigned int p = 0; p < n; ++p)
          if (subset & (1u << p))
            active.push_back(p);
        const unsigned int m = active.size();
        if (m > d)
          continue;

        // (a E a) L = a y - bound for the multipliers L
        std::array<std::array<Real, d + 1>, d> M;
        for (unsigned int r = 0; r < m; ++r)
          {
            for (unsigned int c = 0; c < m; ++c)
              M[r][c] = dot(planes[active[r]], E_a[active[c]]);
            M[r][m] = dot(planes[active[r]], y) - bounds[active[r]];
          }
        if (!solve<d>(M, m))
          continue;

        std::array<Real, d> x         = y;
        Real                violation = 0;
        for (unsigned int r = 0; r < m; ++r)
          {
            const auto &step = E_a[active[r]];
            for (unsigned int i = 0; i < d; ++i)
              x[i] -= M[r][m] * step[i];
            violation =
              std::max(violation, -M[r][m] * std::sqrt(dot(step, step)));
          }
        for (unsigned int p = 0; p < n; ++p)
          violation = std::max(violation, dot(planes[p], x) - bounds[p]);
        if (violation < best_violation)
          {
            best           = x;
            best_violation = violation;
          }
      }
    return best;
  }

  /** A set under test with independent knowledge of it. */
  template <typename Set>
  struct Candidate
  {
    Set set;
    /** By how much a stress leaves the set, in Pa. */
    std::function<double(const Tensor2<> &)> excess;
    /** By how much a strain leaves the domain of the support function. */
    std::function<double(const Tensor2<> &)> outside_domain;
    /** The support function, in J/m^3. A cone that ends at a pressure above
     *  all stresses at hand, the second argument, may end there instead:
     *  normal cones are local, and those stresses then scale round-off. */
    std::function<double(const Tensor2<> &, const double)> support;
    /** Independent projection. */
    std::function<Tensor2<>(const Tensor2<> &, const Moduli &)> brute_force;
    /** Apex and strength, for the scale of round-off and for trial points. */
    double apex;
    double strength;
  };

  double
  gamma_of(const Tensor2<> &strain)
  {
    const Tensor2<> deviator = deviatoric_part(strain);
    return std::sqrt(2. * (deviator * deviator));
  }

  /** Sets of revolution: lines in the plane of shifted pressure and shear. */
  Tensor2<>
  project_revolution(const Tensor2<>                        &t,
                     const Moduli                           &moduli,
                     const double                            apex,
                     const std::vector<std::array<Real, 2>> &lines,
                     const std::vector<Real>                &bounds)
  {
    const Tensor2<> deviator = deviatoric_part(t);
    const double    tau      = shear_intensity(deviator);
    const auto      x =
      enumerate_active_sets<2>(lines,
                               bounds,
                               {{{{moduli.bulk, 0.}}, {{0., moduli.shear}}}},
                               {{Real(pressure(t)) + apex, tau}});
    return (tau > 0. ? double(x[1] / tau) : 0.) * deviator +
           double(apex - x[0]) * unit_symmetric_tensor<3>();
  }

  Candidate<MisesSchleicherCone>
  mises_schleicher(const double friction,
                   const double apex,
                   const double strength)
  {
    const bool cut = std::isfinite(strength);

    std::vector<std::array<Real, 2>> lines  = {{{-friction, 1.}}, {{0., -1.}}};
    std::vector<Real>                bounds = {0., 0.};
    if (cut)
      {
        lines.push_back({{0., 1.}});
        bounds.push_back(strength);
      }
    return {MisesSchleicherCone(friction, apex, strength),
            [=](const Tensor2<> &s) {
              const double tau = shear_intensity(deviatoric_part(s));
              return tau - std::min(friction * (pressure(s) + apex), strength);
            },
            [=](const Tensor2<> &q) {
              return (cut ? 0. : friction * gamma_of(q)) - trace(q);
            },
            [=](const Tensor2<> &q, const double reach) {
              return apex * trace(q) +
                     (cut ? std::min(strength / friction, reach) *
                              std::max(0., friction * gamma_of(q) - trace(q)) :
                            0.);
            },
            [=](const Tensor2<> &t, const Moduli &moduli) {
              return project_revolution(t, moduli, apex, lines, bounds);
            },
            apex,
            cut ? strength : 0.};
  }

  Candidate<VonMisesCylinder<false>>
  von_mises(const double strength)
  {
    return {VonMisesCylinder<false>(strength),
            [=](const Tensor2<> &s) {
              return shear_intensity(deviatoric_part(s)) - strength;
            },
            [=](const Tensor2<> &q) { return std::abs(trace(q)); },
            [=](const Tensor2<> &q, const double) {
              return strength * gamma_of(q);
            },
            [=](const Tensor2<> &t, const Moduli &moduli) {
              return project_revolution(
                t, moduli, 0., {{{0., 1.}}, {{0., -1.}}}, {strength, 0.});
            },
            0.,
            strength};
  }

  /** Planes $\sigma_i - m\sigma_j\le Y$ for all pairs $i\ne j$. */
  Tensor2<>
  project_planes(const Tensor2<> &t,
                 const Moduli    &moduli,
                 const double     m,
                 const double     apex,
                 const double     bound)
  {
    const SpectralDecomposition spectrum = independent_spectrum(t);

    std::vector<std::array<Real, 3>>   planes;
    std::array<Real, 3>                y;
    std::array<std::array<Real, 3>, 3> E;
    for (unsigned int i = 0; i < 3; ++i)
      {
        y[i] = Real(spectrum.values[i]) - apex;
        for (unsigned int j = 0; j < 3; ++j)
          {
            E[i][j] = moduli.bulk + (i == j ? 4. : -2.) / 3.L * moduli.shear;
            if (i == j)
              continue;
            std::array<Real, 3> plane{};
            plane[i] = 1.;
            plane[j] = -m;
            planes.push_back(plane);
          }
      }
    const auto x =
      enumerate_active_sets<3>(planes, std::vector<Real>(6, bound), E, y);
    return spectrum.compose(
      {{double(x[0] + apex), double(x[1] + apex), double(x[2] + apex)}});
  }

  /** Cones: $\mathrm{tr}\,q\ge\sin\phi\,\sum|q_a|$ is the polar cone. */
  Candidate<PrincipalSet>
  coulomb(const double degrees, const double apex)
  {
    const double phi  = degrees * numbers::PI / 180.;
    const double sine = degrees < 90. ? std::sin(phi) : 1.;
    const double m    = (1. - sine) / (1. + sine);
    return {degrees < 90. ? PrincipalSet::coulomb_mohr(phi, apex) :
                            PrincipalSet::no_tension(apex),
            [=](const Tensor2<> &s) {
              const auto values = independent_spectrum(s).values;
              return values[0] - apex - m * (values[2] - apex);
            },
            [=](const Tensor2<> &q) {
              const auto values = independent_spectrum(q).values;
              return sine * (std::abs(values[0]) + std::abs(values[1]) +
                             std::abs(values[2])) -
                     trace(q);
            },
            [=](const Tensor2<> &q, const double) { return apex * trace(q); },
            [=](const Tensor2<> &t, const Moduli &moduli) {
              return project_planes(t, moduli, m, apex, 0.);
            },
            apex,
            0.};
  }

  Candidate<PrincipalSet>
  tresca(const double strength)
  {
    return {PrincipalSet::tresca(strength),
            [=](const Tensor2<> &s) {
              const auto values = independent_spectrum(s).values;
              return values[0] - values[2] - 2. * strength;
            },
            [=](const Tensor2<> &q) { return std::abs(trace(q)); },
            [=](const Tensor2<> &q, const double) {
              const auto values = independent_spectrum(q).values;
              return strength * (std::abs(values[0]) + std::abs(values[1]) +
                                 std::abs(values[2]));
            },
            [=](const Tensor2<> &t, const Moduli &moduli) {
              return project_planes(t, moduli, 1., 0., 2. * strength);
            },
            0.,
            strength};
  }

  Candidate<NoCompression>
  no_compression()
  {
    return {
      NoCompression(),
      [](const Tensor2<> &s) { return -independent_spectrum(s).values[2]; },
      [](const Tensor2<> &q) { return independent_spectrum(q).values[0]; },
      [](const Tensor2<> &, const double) { return 0.; },
      [](const Tensor2<> &t, const Moduli &moduli) {
        return -project_planes(-t, moduli, 0., 0., 0.);
      },
      0.,
      0.};
  }

  Candidate<HydrostaticSet>
  hydrostatic(const double tension, const double compression)
  {
    return {HydrostaticSet(tension, compression),
            [=](const Tensor2<> &s) {
              return std::max(-tension - pressure(s),
                              pressure(s) - compression);
            },
            [=](const Tensor2<> &q) {
              const double shear = deviatoric_part(q).norm();
              return std::isfinite(compression) ? shear :
                                                  std::max(shear, -trace(q));
            },
            [=](const Tensor2<> &q, const double force) {
              return trace(q) *
                     (trace(q) > 0. ? tension : -std::min(compression, force));
            },
            [=](const Tensor2<> &t, const Moduli &moduli) {
              std::vector<std::array<Real, 1>> planes = {{{-1.}}};
              std::vector<Real>                bounds = {Real(tension)};
              if (std::isfinite(compression))
                {
                  planes.push_back({{1.}});
                  bounds.push_back(compression);
                }
              const auto p = enumerate_active_sets<1>(planes,
                                                      bounds,
                                                      {{{{moduli.bulk}}}},
                                                      {{pressure(t)}});
              return deviatoric_part(t) -
                     double(p[0]) * unit_symmetric_tensor<3>();
            },
            tension,
            0.};
  }

  /** Principal values with every kind of repetition. */
  Tensor2<>
  nearly_repeated(Random &random)
  {
    const double a = random.uniform(), b = random.uniform();
    const double gap = random.below(2) ? 0. : random.power_of_ten(-17., -6.);
    switch (random.below(3))
      {
        case 0:
          return diagonal(a, a * (1. + gap), b);
        case 1:
          return diagonal(a, a - gap, a + gap * random.uniform());
        default:
          return diagonal(a, a + gap, a + b);
      }
  }

  template <typename Set>
  Projection<double, false>
  project(const Set &set, const Tensor2<> &t, const Moduli &moduli)
  {
    Projection<double, false> projection;
    set.project(t, moduli, projection);
    return projection;
  }

  /** A point on the border between the regions of two trial stresses, found
   *  by bisection down to round-off. */
  template <typename Set>
  Tensor2<>
  between(const Set &set, const Moduli &moduli, Tensor2<> here, Tensor2<> there)
  {
    const double region = project(set, here, moduli).region;
    for (unsigned int i = 0; i < 54; ++i)
      {
        const Tensor2<> middle = .5 * (here + there);
        (project(set, middle, moduli).region == region ? here : there) = middle;
      }
    return here;
  }

  /** A trial stress of order `scale`, before rotation. */
  template <typename Set>
  Tensor2<>
  trial_stress(const Candidate<Set> &candidate,
               const Moduli         &moduli,
               const double          scale,
               Random               &random)
  {
    const Tensor2<> I       = unit_symmetric_tensor<3>();
    const auto      nearest = [&](const Tensor2<> &t) {
      return project(candidate.set, t, moduli).stress;
    };
    const Tensor2<> any =
      scale * (random.tensor() - random.uniform(-1., 2.) * I);
    const double tiny = random.power_of_ten(-17., -1.);
    switch (random.below(8))
      {
        case 0:
        case 1:
          return any;
        case 2:
          return scale * nearly_repeated(random);
        case 3: // hydrostatic
          return scale * (random.uniform() * I + tiny * random.tensor());
        case 4: // around the apex
          return candidate.apex * I + scale * tiny * random.tensor();
        case 5: // around the surface, with the edges of principal sets
          return nearest(random.below(2) ? any :
                                           scale * nearly_repeated(random)) +
                 (random.below(2) ? 0. : scale * tiny) * random.tensor();
        case 6: // along the normal cone: borders between regions
          {
            const Tensor2<> s = nearest(any);
            return s + random.power_of_ten(-3., 2.) * (any - s);
          }
        default: // the residual alone sits on the polar cone or inside it
          return candidate.apex * I + any - nearest(any) +
                 (random.below(2) ? 0. : scale * tiny) * random.tensor();
      }
  }

  constexpr unsigned int n_points           = 1000000;
  constexpr unsigned int brute_force_stride = 50;
  constexpr unsigned int border_stride      = 100;

  /** One row of the table. The set is built anew for every point, `make`
   *  takes the scale of stress and the amount of cohesion. */
  template <typename Make>
  bool
  sweep(const std::string &name, const Make &make)
  {
    Random random(20120831);
    Worst  feasibility(1e-12), normality(1e-12), complementarity(1e-12),
      distance(1e-12);
    Regions regions;
    for (unsigned int point = 0; point < n_points; ++point)
      {
        const double size  = random.power_of_ten(-12., 12.);
        const double shear = random.power_of_ten(-3., 9.);
        const Moduli moduli{shear * random.power_of_ten(std::log10(.3), 3.),
                            shear};

        const auto   candidate = make(size, random);
        const double scale     = size * random.power_of_ten(-2., 2.);

        Tensor2<> t = trial_stress(candidate, moduli, scale, random);
        if (random.below(4))
          t = rotate(random.rotation(), t);
        if (point % border_stride == 0)
          t = between(candidate.set,
                      moduli,
                      t,
                      trial_stress(candidate, moduli, scale, random));

        const auto projection = project(candidate.set, t, moduli);
        regions.add(projection.region);

        // The apex is subtracted from t, so its size counts in round-off.
        const Tensor2<> I     = unit_symmetric_tensor<3>();
        const Tensor2<> reach = t - candidate.apex * I;
        const double    shift = candidate.apex * candidate.apex / moduli.bulk;
        const double    force =
          reach.norm() + candidate.apex + std::numeric_limits<double>::min();
        const double strain =
          force / (3. * moduli.bulk) + force / (2. * moduli.shear);
        const double energy = moduli.energy_product(reach, reach) + shift +
                              std::numeric_limits<double>::min();

        const Tensor2<> difference = t - projection.stress;
        const Tensor2<> q =
          trace(difference) / (9. * moduli.bulk) * I +
          1. / (2. * moduli.shear) * deviatoric_part(difference);
        feasibility.add(candidate.excess(projection.stress) / force);
        normality.add(candidate.outside_domain(q) / strain);
        complementarity.add(
          std::abs(candidate.support(q, force + projection.stress.norm()) -
                   projection.stress * q) /
          energy);
        if (point % brute_force_stride == 0)
          distance.add(
            (candidate.brute_force(t, moduli) - projection.stress).norm() /
            force);
      }
    std::cout << std::left << std::setw(24) << name << std::setw(9)
              << feasibility.verdict() << std::setw(9) << normality.verdict()
              << std::setw(9) << complementarity.verdict() << std::setw(13)
              << distance.verdict() << regions.marks() << std::endl;
    return feasibility.passed() && normality.passed() &&
           complementarity.passed() && distance.passed();
  }

  /** No cohesion for one half of the points. */
  double
  cohesion(const double scale, Random &random)
  {
    return random.below(2) ? 0. : scale * random.power_of_ten(-3., 1.);
  }
} // namespace

int
main()
{
  std::cout << "relative residuals below 1e-12?\n";
  print_legend();
  std::cout << std::left << std::setw(24) << "set" << std::setw(9) << "in set"
            << std::setw(9) << "normal" << std::setw(9) << "h(q)=s:q" << ' '
            << std::setw(12) << "brute force"
            << "regions" << std::endl;

  bool passed = sweep("Mises-Schleicher", [](const double scale, Random &r) {
    return mises_schleicher(r.power_of_ten(-1.5, .5),
                            cohesion(scale, r),
                            std::numeric_limits<double>::infinity());
  });
  passed &= sweep("Mises-Schleicher, cut", [](const double scale, Random &r) {
    return mises_schleicher(r.power_of_ten(-1.5, .5),
                            cohesion(scale, r),
                            scale * r.power_of_ten(-1., 1.));
  });
  for (const double degrees : {5., 30., 60., 85.})
    passed &= sweep("Coulomb-Mohr, " + std::to_string(int(degrees)) + " deg",
                    [=](const double scale, Random &r) {
                      return coulomb(degrees, cohesion(scale, r));
                    });
  passed &= sweep("no tension", [](const double scale, Random &r) {
    return coulomb(90., cohesion(scale, r));
  });
  passed &= sweep("no compression",
                  [](const double, Random &) { return no_compression(); });
  passed &= sweep("hydrostatic contact", [](const double scale, Random &r) {
    return hydrostatic(cohesion(scale, r),
                       std::numeric_limits<double>::infinity());
  });
  passed &= sweep("hydrostatic hinge", [](const double scale, Random &r) {
    return hydrostatic(cohesion(scale, r), scale * r.power_of_ten(-1., 1.));
  });
  passed &= sweep("Tresca", [](const double scale, Random &r) {
    return tresca(scale * r.power_of_ten(-1., 1.));
  });
  passed &= sweep("von Mises", [](const double scale, Random &r) {
    return von_mises(scale * r.power_of_ten(-1., 1.));
  });
  return passed ? 0 : 1;
}
