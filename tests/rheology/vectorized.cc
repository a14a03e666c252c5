// The laws on VectorizedArray<double> give what they give on double, lane by
// lane. Lanes are drawn independently, so wide arrays mix regions, also with
// lanes that are elastic. And a law that is asked for little, on the short way
// of explicit steps, gives what it gives when it is asked for all.

#include "common.h"

using namespace Signoton;
using namespace Signoton::Testing;

namespace
{
  using Lanes = VectorizedArray<double>;

  template <unsigned int request, typename Law>
  void
  compare_with_all(const Law                  &law,
                   const Tensor2<>            &strain,
                   const History<Law, double> &accepted,
                   const bool                  changed,
                   const History<Law, double> &trial,
                   const Response<double>     &response,
                   Worst                      &worst)
  {
    const Step<Law> complete(law, strain, accepted);
    worst.add(std::abs(response.region - complete.response.region));
    worst.add((response.stress - complete.response.stress).norm());
    if constexpr (request & (dissipation | energies))
      worst.add(std::abs(response.dissipation - complete.response.dissipation));
    for (unsigned int n = 0; n < Law::n_tensors; ++n)
      {
        worst.add((trial.tensors[n] - complete.history.tensors[n]).norm());
        if (!changed)
          worst.add((trial.tensors[n] - accepted.tensors[n]).norm());
      }
    for (unsigned int n = 0; n < Law::n_scalars; ++n)
      {
        worst.add(std::abs(trial.scalars[n] - complete.history.scalars[n]));
        if (!changed)
          worst.add(std::abs(trial.scalars[n] - accepted.scalars[n]));
      }
  }

  /** The lanes agree for every quantity that `request` asks for. */
  template <unsigned int request, typename Law>
  void
  check_request(const Law &law, Random &random, Worst &worst)
  {
    std::array<Tensor2<>, Lanes::size()>            strains;
    std::array<History<Law, double>, Lanes::size()> histories;
    Tensor2<Lanes>                                  strain;
    History<Law, Lanes> accepted = virgin<Law, Lanes>(), trial;
    for (unsigned int i = 0; i < Lanes::size(); ++i)
      {
        strains[i] =
          random.power_of_ten(-2., 0.) *
          (random.tensor() + random.uniform() * unit_symmetric_tensor<3>());
        // no strain at all: nothing may be divided by zero
        if (random.below(10) == 0)
          strains[i] = random.below(2) * unit_symmetric_tensor<3>();
        histories[i] =
          random.below(2) ? random_history(law, random) : virgin<Law>();
        set_lane(strain, i, strains[i]);
        for (unsigned int n = 0; n < Law::n_tensors; ++n)
          set_lane(accepted.tensors[n], i, histories[i].tensors[n]);
        for (unsigned int n = 0; n < Law::n_scalars; ++n)
          set_lane(accepted.scalars[n], i, histories[i].scalars[n]);
      }

    Response<Lanes> response;
    law.template update<request>(strain, accepted, trial, response);

    for (unsigned int i = 0; i < Lanes::size(); ++i)
      {
        Response<double>     expected;
        History<Law, double> after;
        const bool           changed = law.template update<request>(strains[i],
                                                          histories[i],
                                                          after,
                                                          expected);
        compare_with_all<request>(
          law, strains[i], histories[i], changed, after, expected, worst);
        const auto compare = [&](const Lanes &vectorized, const double scalar) {
          worst.add(std::abs(lane(vectorized, i) - scalar));
        };
        compare(response.region, expected.region);
        worst.add((lane(response.stress, i) - expected.stress).norm());
        if constexpr (request & tangent)
          for (unsigned int c = 0; c < Tensor4<>::n_independent_components; ++c)
            compare(response.tangent.access_raw_entry(c),
                    expected.tangent.access_raw_entry(c));
        if constexpr (request & potential)
          compare(response.potential, expected.potential);
        if constexpr (request & (dissipation | energies))
          compare(response.dissipation, expected.dissipation);
        if constexpr (request & energies)
          {
            compare(response.stored_energy, expected.stored_energy);
            worst.add(
              (lane(response.contact_strain, i) - expected.contact_strain)
                .norm());
          }
        for (unsigned int n = 0; n < Law::n_tensors; ++n)
          worst.add((lane(trial.tensors[n], i) - after.tensors[n]).norm());
        for (unsigned int n = 0; n < Law::n_scalars; ++n)
          compare(trial.scalars[n], after.scalars[n]);
      }
  }

  template <typename Law>
  bool
  check_law(const std::string &name, const Law &law)
  {
    Random random(1997);
    Worst  worst(1e-13);
    for (unsigned int i = 0; i < 2000; ++i)
      {
        check_request<Rheology::stress>(law, random, worst);
        check_request<dissipation>(law, random, worst);
        check_request<tangent>(law, random, worst);
        check_request<potential>(law, random, worst);
        check_request<energies>(law, random, worst);
        check_request<all>(law, random, worst);
      }
    std::cout << std::left << std::setw(36) << name << worst.verdict()
              << std::endl;
    return worst.passed();
  }

  /** A lane without an answer is named, and forgotten in the next step. */
  bool
  check_failure()
  {
    using Number = VectorizedArray<double>;
    General law(
      parse_scheme("series(spring(bulk = 1, shear = 1), parallel(damper(shear "
                   "viscosity = 1), contact(mises schleicher, friction = "
                   "0.5)))",
                   "test"));
    law.set_time_step(1.);
    const unsigned int last     = n_lanes<Number>() - 1;
    const auto         accepted = make_history<Number>(law);
    auto               trial    = accepted;
    Response<Number>   response;
    Tensor2<Number>    strain;
    bool               passed = true;
    for (const double entry : {0.1, std::nan(""), 0.1})
      {
        strain[0][1][last] = entry;
        law.update<stress>(strain, accepted, trial, response);
        passed &= std::isnan(entry) ?
                    response.failure > 0. && response.failed_lane == last :
                    !(response.failure > 0.);
      }
    std::cout << std::left << std::setw(36) << "failure of a local solver"
              << (passed ? "ok" : "wrong") << std::endl;
    return passed;
  }
} // namespace

int
main()
{
  const bool passed =
    for_all_laws([](const std::string &name, const auto &law) {
      return check_law(name, law);
    });
  return check_failure() && passed ? 0 : 1;
}
