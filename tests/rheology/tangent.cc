// The consistent tangent of every law: against finite differences of the
// stress, symmetric, between zero and elasticity in the energy metric. The
// stress: against finite differences of the incremental potential. At strains
// from every region, with and without history, and at repeated principal
// values.

#include <deal.II/lac/lapack_full_matrix.h>

#include "common.h"

#include <optional>

using namespace Signoton;
using namespace Signoton::Testing;

namespace
{
  struct Checks
  {
    Worst   stress{1e-7}, tangent{1e-7}, symmetry{1e-14}, bounds{1e-13};
    Regions regions;
  };

  /** A quantity of a law at strains $\varepsilon+nh\,e$, n = -2...2, nothing
   *  if a kink lies between: those have one derivative on either side. */
  template <typename Law>
  std::optional<std::array<Response<double>, 5>>
  stencil(const Law                  &law,
          const Tensor2<>            &strain,
          const Tensor2<>            &direction,
          const double                h,
          const History<Law, double> &accepted)
  {
    std::array<Response<double>, 5> responses;
    for (int n = -2; n <= 2; ++n)
      {
        responses[n + 2] =
          Step<Law>(law, strain + n * h * direction, accepted).response;
        if (responses[n + 2].region != responses[0].region)
          return {};
      }
    return responses;
  }

  /** Extreme eigenvalues of $E^{-1/2}:T:E^{-1/2}$. */
  std::pair<double, double>
  spectrum_in_energy_metric(const Tensor4<> &tangent, const Moduli &elasticity)
  {
    const auto scaled = [&](const unsigned int c) {
      const Tensor2<> e    = basis(c);
      const Tensor2<> mean = trace(e) / 3. * unit_symmetric_tensor<3>();
      return mean / std::sqrt(3. * elasticity.bulk) +
             (e - mean) / std::sqrt(2. * elasticity.shear);
    };
    LAPACKFullMatrix<double> matrix(6, 6);
    for (unsigned int a = 0; a < 6; ++a)
      for (unsigned int b = 0; b < 6; ++b)
        matrix(a, b) = scaled(a) * (tangent * scaled(b));
    matrix.compute_eigenvalues();
    std::array<double, 6> values;
    for (unsigned int a = 0; a < 6; ++a)
      values[a] = matrix.eigenvalue(a).real();
    const auto [smallest, largest] =
      std::minmax_element(values.begin(), values.end());
    return {*smallest, *largest};
  }

  template <typename Law>
  void
  check(const Law                  &law,
        const Tensor2<>            &strain,
        const History<Law, double> &accepted,
        Checks                     &checks)
  {
    const Moduli   &elasticity = law.elasticity();
    const double    stiffness  = 3. * elasticity.bulk + 2. * elasticity.shear;
    const double    h          = 2e-4;
    const Step<Law> step(law, strain, accepted);
    const Tensor4<> tangent = step.response.tangent;
    checks.regions.add(step.response.region);

    const auto derivative = [&](const auto &f) {
      return (8. * (f[3] - f[1]) - (f[4] - f[0])) / (12. * h);
    };
    for (unsigned int c = 0; c < 6; ++c)
      if (const auto responses = stencil(law, strain, basis(c), h, accepted))
        {
          std::array<Tensor2<>, 5> stress;
          std::array<double, 5>    potential;
          for (unsigned int n = 0; n < 5; ++n)
            {
              stress[n]    = (*responses)[n].stress;
              potential[n] = (*responses)[n].potential;
            }
          checks.tangent.add((derivative(stress) - tangent * basis(c)).norm() /
                             stiffness);
          checks.stress.add(
            std::abs(derivative(potential) - step.response.stress * basis(c)) /
            stiffness);
        }

    for (unsigned int a = 0; a < 6; ++a)
      for (unsigned int b = 0; b < a; ++b)
        checks.symmetry.add(std::abs(basis(a) * (tangent * basis(b)) -
                                     basis(b) * (tangent * basis(a))) /
                            stiffness);
    const auto [smallest, largest] =
      spectrum_in_energy_metric(tangent, elasticity);
    checks.bounds.add(std::max(-smallest, largest - 1.));
  }

  /** Strains with principal values that coincide, some of them nearly. */
  Tensor2<>
  repeated(Random &random)
  {
    const double a = random.uniform(), b = random.uniform();
    const double gap = random.below(2) ? 0. : random.power_of_ten(-17., -5.);
    switch (random.below(3))
      {
        case 0:
          return diagonal(a, b, a + gap);
        case 1:
          return rotate(random.rotation(), diagonal(a, a + gap, b));
        default:
          return diagonal(a, a + gap, a - gap);
      }
  }

  template <typename Law>
  bool
  check_law(const std::string &name, const Law &law)
  {
    Random random(1970);
    Checks random_points, repeated_points;
    for (unsigned int i = 0; i < 2000; ++i)
      check(law,
            (random.below(4) ? 1. : .15) *
              (random.tensor() + random.uniform() * unit_symmetric_tensor<3>()),
            random.below(2) ? random_history(law, random) : virgin<Law>(),
            random_points);
    for (unsigned int i = 0; i < 500; ++i)
      check(law, repeated(random), virgin<Law>(), repeated_points);

    bool passed = true;
    std::cout << std::left << std::setw(36) << name;
    for (const Checks *checks : {&random_points, &repeated_points})
      {
        for (const Worst *worst : {&checks->stress,
                                   &checks->tangent,
                                   &checks->symmetry,
                                   &checks->bounds})
          {
            std::cout << worst->verdict() << ' ';
            passed &= worst->passed();
          }
        std::cout << checks->regions.marks() << "  ";
      }
    std::cout << std::endl;
    return passed;
  }
} // namespace

int
main()
{
  std::cout << "Stress = dW/de, tangent = dstress/de, symmetry, 0 <= T <= E;\n"
               "then the same where principal strains coincide\n";
  print_legend();
  const bool passed =
    for_all_laws<false>([](const std::string &name, const auto &law) {
      return check_law(name, law);
    });
  return passed ? 0 : 1;
}
