// The schemes of chapter 2 of the monograph against their exact answers to
// ramps, steps and reversals. In pressure and volume strain, with hydrostatic
// contacts and hinges, the tensors reduce to the uniaxial laws. Rate-independent
// schemes have to be exact with any step, viscous ones of first order in it.

#include "verdicts.h"

#include <signoton/rheology/network.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <sstream>

using namespace Signoton;
using namespace Signoton::Rheology;

namespace
{
  using Function = std::function<double(double)>;

  // those of the monograph's uniaxial formulas: compliances, viscosity, strength
  constexpr double a = 1.3, b = 2.1, eta = 0.7, strength = 0.4, rate = 1.;
  constexpr double tau = a * eta;

  std::string
  text_of(const std::string &name, const double bulk)
  {
    std::ostringstream text;
    text.precision(17);
    text << name << bulk;
    return text.str();
  }

  const std::string spring = text_of("spring(shear = 1, bulk = ", 1. / a) + ")",
                    second = text_of("spring(shear = 1, bulk = ", 1. / b) + ")",
                    damper = text_of("damper(shear viscosity = 1, "
                                     "bulk viscosity = ",
                                     eta) +
                             ")",
                    hinge =
                      text_of("hinge(hydrostatic, strength = ", strength) + ")",
                    contact = "contact(hydrostatic)";

  /** Answers at the end of some of equal steps to a given volume strain, or a
   *  mean stress. */
  std::vector<double>
  run(const std::string &scheme,
      const Function    &given,
      const double       end,
      const unsigned int n_steps,
      const bool         by_stress = false)
  {
    Network network(parse_scheme(scheme, "test"));
    network.set_control(
      {{by_stress, by_stress, by_stress, false, false, false}});
    std::vector<Vector6> tensors(network.n_tensors(), Vector6{});
    std::vector<double>  scalars(network.n_scalars(), 0.), result;
    network.set_time_step(end / n_steps);
    for (unsigned int i = 1; i <= n_steps; ++i)
      {
        const double value = given(end * i / n_steps);
        const double each  = by_stress ? value : value / 3.;
        const auto  &found = network.update({{each, each, each, 0., 0., 0.}},
                                           tensors.data(),
                                           scalars.data(),
                                           false);
        if (!found.converged)
          std::cout << "not converged" << std::endl;
        const Vector6 &answer = by_stress ? found.strain : found.stress;
        result.push_back((answer[0] + answer[1] + answer[2]) /
                         (by_stress ? 1. : 3.));
        tensors = network.trial_tensors();
        scalars = network.trial_scalars();
      }
    return result;
  }

  /** The volume strain of the contacts after one step to a given one. */
  double
  contact_strain(const std::string &scheme, const double strain)
  {
    Network network(parse_scheme(scheme, "test"));
    network.set_time_step(1.);
    const std::vector<Vector6> tensors(network.n_tensors(), Vector6{});
    const std::vector<double>  scalars(network.n_scalars(), 0.);
    const double               each = strain / 3.;
    network.update({{each, each, each, 0., 0., 0.}},
                   tensors.data(),
                   scalars.data(),
                   false);
    const Vector6 open = network.contact_strain();
    return open[0] + open[1] + open[2];
  }

  /** Largest error at all steps. */
  double
  error(const std::vector<double> &found,
        const Function            &exact,
        const double               end)
  {
    double worst = 0.;
    for (std::size_t i = 0; i < found.size(); ++i)
      worst =
        std::max(worst,
                 std::abs(found[i] - exact(end * (i + 1) / found.size())));
    return worst;
  }

  void
  exact_with_any_step(Verdicts          &verdict,
                      const std::string &name,
                      const std::string &scheme,
                      const Function    &strain,
                      const Function    &stress,
                      const double       end)
  {
    double worst = 0.;
    // the reversal is at a step
    for (const unsigned int n : {30, 60})
      worst = std::max(worst, error(run(scheme, strain, end, n), stress, end));
    std::cout << name << ": " << worst << std::endl;
    verdict(name + ", exact with any step", worst < 1e-10);
  }

  /** Values at the end, extrapolated from two step sizes, and the order. */
  void
  first_order(Verdicts          &verdict,
              const std::string &name,
              const std::string &scheme,
              const Function    &given,
              const double       exact,
              const double       end,
              const bool         by_stress = false)
  {
    std::array<double, 3> value{};
    for (unsigned int i = 0; i < 3; ++i)
      value[i] = run(scheme, given, end, 2000 << i, by_stress).back();
    const double order =
                   std::log2(std::abs((value[0] - exact) / (value[1] - exact))),
                 limit = 2. * value[2] - value[1];
    std::cout << name << ": " << value[2] << ", extrapolated error "
              << limit - exact << ", order " << order << std::endl;
    verdict(name + ", limit", std::abs(limit - exact) < 1e-6);
    verdict(name + ", first order or exact",
            std::abs(order - 1.) < 0.05 || std::abs(value[0] - exact) < 1e-9);
  }
} // namespace

int
main()
{
  Verdicts     verdict;
  const double t1 = 2.;
  // down to t1, then up
  const Function ramp = [&](const double t) {
    return rate * (t < t1 ? -t : t - 2. * t1);
  };
  const Function mirrored = [&](const double t) { return -ramp(t); };
  const auto     series   = [](const std::string &parts) {
    return "series(" + parts + ")";
  };
  const auto parallel = [](const std::string &parts) {
    return "parallel(" + parts + ")";
  };
  const std::string c = ", ";

  exact_with_any_step(
    verdict,
    "2.3a",
    series(spring + c + contact),
    ramp,
    [&](double t) { return std::min(ramp(t), 0.) / a; },
    5.);
  const Function elastic_plastic = [&](const double t) {
    const double plastic = -(rate * t1 - a * strength);
    return t < t1 ? std::max(ramp(t) / a, -strength) :
                    std::min(0., (ramp(t) - plastic) / a);
  };
  exact_with_any_step(verdict,
                      "2.6",
                      series(spring + c + hinge + c + contact),
                      ramp,
                      elastic_plastic,
                      6.);
  const Function hardening = [&](const double t) {
    const auto loading = [&](const double strain) {
      return strain < a * strength ?
               strain / a :
               strength + (strain - a * strength) / (a + b);
    };
    const double peak = loading(rate * t1), down = rate * (t - t1);
    if (t < t1)
      return -loading(rate * t);
    // back along the spring, and then reversed flow of the hinge
    const double reversed = 2. * strength;
    const double stress   = down < a * reversed ?
                              -peak + down / a :
                              -peak + reversed + (down - a * reversed) / (a + b);
    return std::min(stress, 0.);
  };
  exact_with_any_step(verdict,
                      "2.9a",
                      series(spring + c + contact + c +
                             parallel(hinge + c + second)),
                      ramp,
                      hardening,
                      6.);
  exact_with_any_step(
    verdict,
    "2.10b",
    series(spring + c + parallel(contact + c + second)),
    ramp,
    [&](double t) {
      const double e = ramp(t);
      return e < 0. ? e / a : e / (a + b);
    },
    6.);
  const Function plastic_binder = [&](const double t) {
    const double e = mirrored(t), up = rate * t1;
    if (t < t1)
      return std::min(e / (a + b), strength);
    const double back = strength - (up - e) / (a + b);
    // the hinge flows back, or the contact closes first
    const double lowest = std::min(strength, (up - (a + b) * strength) / b);
    return e > -a * lowest ? std::max(back, -lowest) : e / a;
  };
  exact_with_any_step(
    verdict,
    "2.12b",
    series(spring + c + parallel(contact + c + series(second + c + hinge))),
    mirrored,
    plastic_binder,
    6.);
  exact_with_any_step(
    verdict,
    "fiber composite",
    parallel(spring + c + series(second + c + "contact(no compression)")),
    ramp,
    [&](double t) { return ramp(t) / a + std::max(ramp(t), 0.) / b; },
    6.);
  exact_with_any_step(
    verdict,
    "porous",
    parallel(series(spring + c + hinge) + c +
             series(second + c + "contact(hydrostatic, gap = 1.2)")),
    ramp,
    [&](double t) {
      return std::max(ramp(t) / a, -strength) + std::min(ramp(t) + 1.2, 0.) / b;
    },
    t1);

  const double e1 = std::exp(-t1 / tau);
  first_order(verdict,
              "2.3b at the reversal",
              series(spring + c + damper + c + contact),
              ramp,
              -eta * rate * (1. - e1),
              t1);
  first_order(verdict,
              "2.3b after it",
              series(spring + c + damper + c + contact),
              ramp,
              eta * rate * (1. - (2. - e1) * std::exp(-0.4 / tau)),
              2.4);
  first_order(verdict,
              "2.3b open",
              series(spring + c + damper + c + contact),
              ramp,
              0.,
              4.);
  first_order(
    verdict,
    "2.3b held",
    series(spring + c + damper + c + contact),
    [](double) { return -1.; },
    -std::exp(-1. / tau) / a,
    1.);
  first_order(verdict,
              "2.3c closed",
              series(parallel(spring + c + damper) + c + contact),
              ramp,
              -(rate * 1. / a + eta * rate),
              1.);
  first_order(verdict,
              "2.3c after the reversal",
              series(parallel(spring + c + damper) + c + contact),
              ramp,
              -(2. * t1 - 2.5) / a + eta,
              2.5);
  first_order(verdict,
              "2.9b",
              series(spring + c + contact + c + parallel(hinge + c + damper)),
              ramp,
              -strength -
                eta * rate * (1. - std::exp(-(t1 - a * strength) / tau)),
              t1);
  first_order(
    verdict,
    "2.9b held",
    series(spring + c + contact + c + parallel(hinge + c + damper)),
    [](double) { return -1.; },
    -strength - (1. / a - strength) * std::exp(-1. / tau),
    1.);
  const double stress1 = eta * rate * (1. - e1);
  first_order(verdict,
              "2.11b, tension",
              series(spring + c + parallel(contact + c + damper)),
              mirrored,
              stress1,
              t1);
  first_order(verdict,
              "2.11b, before it closes",
              series(spring + c + parallel(contact + c + damper)),
              mirrored,
              -eta * rate + (stress1 + eta * rate) * std::exp(-1. / tau),
              t1 + 1.);
  first_order(verdict,
              "2.11b, closed",
              series(spring + c + parallel(contact + c + damper)),
              mirrored,
              -rate * (5.5 - 2. * t1) / a,
              5.5);

  // by stress
  const Function two_signs = [](const double t) { return t < 1. ? 0.3 : -0.2; };
  first_order(verdict,
              "2.10a",
              parallel(contact + c + second),
              two_signs,
              b * 0.3,
              1. - 1e-9,
              true);
  first_order(verdict,
              "2.10a, closed",
              parallel(contact + c + second),
              two_signs,
              0.,
              2.,
              true);
  first_order(verdict,
              "2.11a",
              parallel(contact + c + damper),
              two_signs,
              (0.3 * 1. - 0.2 * 0.6) / eta,
              1.6,
              true);
  first_order(verdict,
              "2.11a, closed",
              parallel(contact + c + damper),
              two_signs,
              0.,
              3.,
              true);
  first_order(verdict,
              "2.12a, below its strength",
              parallel(contact + c + hinge),
              two_signs,
              0.,
              3.,
              true);
  // contacts in series with springs and in parallel to others
  const std::string branch = series(second + c + contact),
                    grains = parallel(spring + c + branch),
                    nested = series(spring + c + grains);
  const auto is_near       = [](const double x, const double y) {
    return std::abs(x - y) < 1e-12;
  };
  verdict("strain of contacts, in series",
          is_near(contact_strain(branch, 0.3), 0.3));
  verdict("strain of contacts, in a parallel group",
          is_near(contact_strain(grains, 0.3), 0.3));
  // two equal springs in series share the strain
  verdict("strain of contacts, in a group of a group",
          is_near(contact_strain(nested, 0.3), 0.15));
  verdict("strain of contacts, closed",
          is_near(contact_strain(nested, -0.3), 0.));
  return verdict.status();
}
