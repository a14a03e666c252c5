// Plasticity in the conditional stress against the exact series scheme: the
// path on which they differ, their agreement while the conditional stress stays
// in the cone, stability of the conditional stress, dissipation, energy, and
// the tangent, which is not symmetric, against finite differences.

#include "common.h"

using namespace Signoton;
using namespace Signoton::Testing;

namespace
{
  const Moduli spring{1.5, .7}, none{0., 0.}, binder{.375, .175};

  using Series    = SpringAndProjection<MisesSchleicherCone, Memory::cylinder>;
  using Hinge     = SpringAndProjection<VonMisesCylinder<false>, Memory::all>;
  using RoundCone = SpringAndProjection<MisesSchleicherCone, Memory::none>;
  using OtherCone = SpringAndProjection<PrincipalSet, Memory::none>;
  using Round =
    ConditionalPlasticity<VonMisesCylinder<false>, MisesSchleicherCone>;
  using Other = ConditionalPlasticity<VonMisesCylinder<false>, PrincipalSet>;

  const MisesSchleicherCone     cone(.5, 0.);
  const PrincipalSet            coulomb = PrincipalSet::coulomb_mohr(.5, 0.);
  const VonMisesCylinder<false> cylinder(.4);

  bool passed = true;

  void
  print(const std::string &what, const Worst &worst)
  {
    std::cout << what << ": " << worst.verdict() << std::endl;
    passed &= worst.passed();
  }

  /** The volume opens by 3, shears by 2 and back by 1, closes by 4. */
  template <typename Law>
  double
  shear_stress_after_path(const Law &law)
  {
    History<Law, double> history = virgin<Law>();
    Tensor2<>            strain;
    Response<double>     response;
    const auto           go = [&](const double theta, const double shear) {
      for (unsigned int n = 0; n < 100; ++n)
        {
          strain += .01 * theta / 3. * unit_symmetric_tensor<3>();
          strain[0][1] += .01 * shear / 2.;
          const Step<Law> step(law, strain, history);
          history  = step.history;
          response = step.response;
        }
    };
    go(3., 0.);
    go(0., 2.);
    go(0., -1.);
    go(-4., 0.);
    return response.stress[0][1];
  }

  /** Where the conditional stress stays inside the cone, both readings are
   *  one. */
  void
  agreement()
  {
    Random random(2012);
    Worst  worst(1e-13);
    for (unsigned int path = 0; path < 200; ++path)
      {
        const Series a(spring, none, cone.cut_at(cylinder.strength()));
        const Round  b(spring, none, cylinder, cone);
        History<Series, double> history_a = virgin<Series>();
        History<Round, double>  history_b = virgin<Round>();
        Tensor2<>               strain    = -1. * unit_symmetric_tensor<3>();
        for (unsigned int n = 0; n < 50; ++n)
          {
            strain += deviatoric_part(Tensor2<>(.2 * random.tensor()));
            const Step<Series> step_a(a, strain, history_a);
            const Step<Round>  step_b(b, strain, history_b);
            worst.add((step_a.response.stress - step_b.response.stress).norm());
            worst.add(
              (step_a.history.tensors[0] - step_b.history.tensors[0]).norm());
            history_a = step_a.history;
            history_b = step_b.history;
          }
      }
    print("the series scheme under lasting pressure", worst);
  }

  /** Two states under the same strains: their conditional stresses do not move
   *  apart. */
  void
  stability()
  {
    Random      random(1943);
    Worst       worst(1e-13);
    const Round law(spring, none, cylinder, cone);
    for (unsigned int path = 0; path < 200; ++path)
      {
        std::array<History<Round, double>, 2> history{
          {random_history(law, random), random_history(law, random)}};
        Tensor2<>  strain;
        const auto distance = [&] {
          const Tensor2<> s = spring.stress(
            Tensor2<>(history[0].tensors[0] - history[1].tensors[0]));
          return spring.energy_product(s, s);
        };
        for (unsigned int n = 0; n < 50; ++n)
          {
            const double before = distance();
            strain += .3 * random.tensor();
            for (auto &h : history)
              h = Step<Round>(law, strain, h).history;
            worst.add(std::max(distance() - before, 0.));
          }
      }
    print("conditional stresses do not move apart", worst);
  }

  /** Dissipation is never negative on a round cone; the energy balance closes
   *  with the step. */
  void
  energy_balance()
  {
    Random                            random(1997);
    Worst                             negative(1e-13), balance(.1);
    std::array<double, 2>             error{{0., 0.}};
    const std::array<unsigned int, 2> n_steps = {{50, 400}};
    const Round                       law(spring, binder, cylinder, cone);
    for (unsigned int path = 0; path < 100; ++path)
      {
        const Tensor2<> to = 2. * random.tensor(), then = 2. * random.tensor();
        for (unsigned int level = 0; level < 2; ++level)
          {
            History<Round, double> history = virgin<Round>();
            Tensor2<>              strain, stress;
            double                 gap = 0., stored = 0.;
            for (const Tensor2<> &change : {to, then})
              for (unsigned int n = 0; n < n_steps[level]; ++n)
                {
                  const Tensor2<> increment = change / n_steps[level];
                  strain += increment;
                  const Step<Round> step(law, strain, history);
                  negative.add(std::max(-step.response.dissipation, 0.));
                  gap += step.response.stored_energy - stored +
                         step.response.dissipation -
                         .5 * ((stress + step.response.stress) * increment);
                  stored  = step.response.stored_energy;
                  stress  = step.response.stress;
                  history = step.history;
                }
            error[level] += std::abs(gap);
          }
      }
    balance.add(error[1] / error[0] - 1. / 8.);
    print("dissipation", negative);
    print("energy balance, first order in the step", balance);
  }

  /** The law is its two parts, one after the other, and so is its tangent. */
  template <typename Law, typename Contact, typename Cone>
  void
  check_tangent(const std::string &name, const Cone &set)
  {
    Random        random(1970);
    Worst         worst(1e-7), composed(1e-13);
    double        asymmetry = 0.;
    const Law     law(spring, binder, cylinder, set);
    const Hinge   hinge(spring, none, cylinder);
    const Contact contact(spring, binder, set);
    const double  h = 1e-4;
    Regions       regions;
    for (unsigned int i = 0; i < 3000; ++i)
      {
        const Tensor2<> strain =
          (random.below(4) ? 1. : .15) *
          (random.tensor() + random.uniform() * unit_symmetric_tensor<3>());
        const auto accepted =
          random.below(2) ? random_history(law, random) : virgin<Law>();
        const History<Hinge, double> of_hinge{accepted.tensors,
                                              accepted.scalars};
        const Step<Law>              step(law, strain, accepted);
        regions.add(step.response.region);
        const auto parts = [&](const Tensor2<> &e) {
          const Step<Hinge> plastic(hinge, e, of_hinge);
          return std::make_pair(plastic.response.region,
                                Step<Contact>(contact,
                                              spring.strain(
                                                plastic.response.stress),
                                              virgin<Contact>())
                                  .response);
        };
        composed.add(
          (parts(strain).second.stress - step.response.stress).norm());
        const auto &T = step.response.tangent;
        for (unsigned int a = 0; a < 6; ++a)
          {
            for (unsigned int b = 0; b < a; ++b)
              asymmetry = std::max(asymmetry,
                                   std::abs(basis(a) * (T * basis(b)) -
                                            basis(b) * (T * basis(a))));
            std::array<Tensor2<>, 5> f;
            bool                     smooth = true;
            const auto               first  = parts(strain - 2. * h * basis(a));
            for (int n = -2; n <= 2; ++n)
              {
                const auto now = parts(strain + n * h * basis(a));
                f[n + 2]       = now.second.stress;
                smooth &=
                  std::abs(now.first - first.first) < .5 &&
                  std::abs(now.second.region - first.second.region) < .5;
              }
            if (smooth)
              worst.add(((8. * (f[3] - f[1]) - (f[4] - f[0])) / (12. * h) -
                         T * basis(a))
                          .norm());
          }
      }
    std::cout << name << ", regions " << regions.marks() << '\n';
    print("  stress of its parts", composed);
    print("  tangent", worst);
    const bool is_asymmetric = asymmetry > .1;
    std::cout << "  not symmetric: " << (is_asymmetric ? "yes" : "no") << '\n';
    passed &= is_asymmetric;
  }
} // namespace

int
main()
{
  std::cout << std::fixed << std::setprecision(12) << "Shear stress: series "
            << shear_stress_after_path(
                 Series(spring, none, cone.cut_at(cylinder.strength())))
            << ", conditional "
            << shear_stress_after_path(Round(spring, none, cylinder, cone))
            << '\n';
  Worst path(1e-12);
  path.add(std::abs(shear_stress_after_path(
                      Series(spring, none, cone.cut_at(cylinder.strength()))) -
                    .4));
  path.add(std::abs(
    shear_stress_after_path(Round(spring, none, cylinder, cone)) + .3));
  print("0.4 and -0.3", path);
  agreement();
  stability();
  energy_balance();
  print_legend();
  check_tangent<Round, RoundCone>("Mises-Schleicher cone", cone);
  check_tangent<Other, OtherCone>("Coulomb-Mohr cone", coulomb);
  return passed ? 0 : 1;
}
