// What an update of one material point costs, from the spring to a scheme that
// needs the general solver. Without arguments: seconds, the best of several
// turns, for all schemes in turn. With a number of a scheme and "stress" or
// "tangent": that alone, for update.sh to count its instructions.

#include "../rheology/common.h"

#include <signoton/rheology/classification.h>

#include <chrono>
#include <cstring>
#include <limits>

using namespace Signoton;
using namespace Signoton::Testing;

namespace
{
  struct Case
  {
    const char *name, *scheme;
    bool        general; // even if there is a closed form
  };

  const char *const granular =
    "series(spring(bulk = 2, shear = 1), contact(mises schleicher, "
    "friction = 0.6))";
  const char *const elastic_plastic_granular =
    "series(spring(bulk = 2, shear = 1), contact(mises schleicher, "
    "friction = 0.6), hinge(von mises, strength = 0.3))";

  const Case cases[] = {
    {"elastic", "spring(bulk = 2, shear = 1)", false},
    {"granular", granular, false},
    {"elastic plastic granular", elastic_plastic_granular, false},
    {"granular, general solver", granular, true},
    {"elastic plastic granular, general solver",
     elastic_plastic_granular,
     true},
    {"without a closed form",
     "series(spring(bulk = 2, shear = 1), parallel(contact(mises schleicher, "
     "friction = 0.6), series(spring(bulk = 0.5, shear = 0.3), hinge(von "
     "mises, strength = 0.2))), parallel(hinge(tresca, strength = 0.3), "
     "damper(bulk viscosity = 1, shear viscosity = 1)))",
     true}};

  Law
  law_of(const Case &one)
  {
    const Scheme scheme = parse_scheme(one.scheme, one.name);
    if (one.general)
      {
        General law(scheme);
        law.set_time_step(1.);
        return law;
      }
    return closed_form(scheme).value();
  }

  /** Strains that visit all regions; a point in four stays elastic. */
  std::vector<Tensor2<>>
  strains()
  {
    Random                 random(11);
    std::vector<Tensor2<>> result(512);
    for (unsigned int i = 0; i < result.size(); ++i)
      result[i] = (i % 4 == 0 ? 0.05 : 0.5) * random.tensor() -
                  (i % 4 == 0 ? 0.2 : 0.) * unit_symmetric_tensor<3>();
    return result;
  }

  /** Outlined, so that callgrind can tell it from the preparations. */
  template <unsigned int request, typename Law>
  __attribute__((noinline)) double
  update_points(const Law &law, const std::vector<Tensor2<>> &strains)
  {
    const History<Law, double> accepted = make_history<double>(law);
    History<Law, double>       trial    = make_history<double>(law);
    Response<double>           response;
    double                     sum = 0.;
    for (const Tensor2<> &strain : strains)
      {
        law.template update<request>(strain, accepted, trial, response);
        sum += response.stress[0][1];
        if constexpr (request & tangent)
          sum += response.tangent[0][0][1][1];
      }
    return sum;
  }

  double
  update_points(const Law                    &law,
                const bool                    with_tangent,
                const std::vector<Tensor2<>> &strains)
  {
    return std::visit(
      [&](const auto &law) {
        return with_tangent ? update_points<potential | tangent>(law, strains) :
                              update_points<Rheology::stress>(law, strains);
      },
      law);
  }

  unsigned int
  bytes(const Law &law)
  {
    return std::visit(
      [](const auto &law) {
        return (6 * n_tensors(law) + n_scalars(law)) * sizeof(double);
      },
      law);
  }
} // namespace

int
main(const int n_arguments, const char *const *arguments)
{
  const auto      points = strains();
  volatile double unused;
  if (n_arguments > 2)
    {
      unused = update_points(law_of(cases[std::stoi(arguments[1])]),
                             std::strcmp(arguments[2], "tangent") == 0,
                             points);
      std::cout << points.size() << std::endl;
      return unused == unused ? 0 : 1;
    }

  constexpr unsigned int n_cases = std::size(cases), n_turns = 7;
  std::vector<Law>       laws;
  for (const Case &one : cases)
    laws.push_back(law_of(one));
  std::array<std::array<double, 2>, n_cases> best;
  for (auto &times : best)
    times.fill(std::numeric_limits<double>::max());
  for (unsigned int turn = 0; turn < n_turns; ++turn)
    for (unsigned int c = 0; c < n_cases; ++c)
      for (unsigned int t = 0; t < 2; ++t)
        {
          const unsigned int n_repetitions = cases[c].general ? 1 : 200;
          const auto         start         = std::chrono::steady_clock::now();
          for (unsigned int i = 0; i < n_repetitions; ++i)
            unused = update_points(laws[c], t == 1, points);
          const std::chrono::duration<double> passed =
            std::chrono::steady_clock::now() - start;
          best[c][t] = std::min(best[c][t],
                                passed.count() / n_repetitions / points.size());
        }
  for (unsigned int c = 0; c < n_cases; ++c)
    std::cout << c << "|" << cases[c].name << "|" << bytes(laws[c]) << "|"
              << 1e9 * best[c][0] << "|" << 1e9 * best[c][1] << "|"
              << best[c][0] / best[0][0] << "|" << best[c][1] / best[0][1]
              << std::endl;
}
