// First and second law of thermodynamics along random strain paths, step by
// step and in the limit of small steps.

#include "common.h"

using namespace Signoton;
using namespace Signoton::Testing;

namespace
{
  /** Straight pieces through random strains, back to the start if `closed`. */
  std::vector<Tensor2<>>
  random_path(Random &random, const unsigned int n_pieces, const bool closed)
  {
    std::vector<Tensor2<>> nodes(1);
    for (unsigned int i = 0; i < n_pieces; ++i)
      nodes.push_back(random.tensor() +
                      random.uniform() * unit_symmetric_tensor<3>());
    if (closed)
      nodes.push_back(nodes.front());
    return nodes;
  }

  /** What a path accumulates, in J/m^3. */
  struct Balance
  {
    double work        = 0.; // by the trapezoidal rule
    double stored      = 0.; // change
    double dissipation = 0.;

    double
    error() const
    {
      return work - stored - dissipation;
    }
  };

  /** Verdicts on single steps. */
  struct Checks
  {
    /** No step dissipates a negative amount. */
    Worst dissipation{1e-13};
    /** Stored energy and dissipation grow by $W_n(\varepsilon_{n+1}) -
     *  W_n(\varepsilon_n)$. */
    Worst potential{1e-12};
    /** That growth lies between $\sigma_n:\Delta\varepsilon$ and
     *  $\sigma_{n+1}:\Delta\varepsilon$: $W_n$ is convex. */
    Worst convexity{1e-12};
    /** The accepted state is in equilibrium: no strain, no change. */
    Worst repetition{1e-12};
  };

  template <typename Law>
  Balance
  follow(const Law                    &law,
         const std::vector<Tensor2<>> &nodes,
         const unsigned int            n_steps,
         Checks                       &checks)
  {
    Tensor2<>            strain  = nodes.front();
    History<Law, double> history = virgin<Law>();
    Response<double>     old     = Step<Law>(law, strain, history).response;
    const double         initial = old.stored_energy;

    Balance balance;
    for (unsigned int node = 1; node < nodes.size(); ++node)
      {
        const Tensor2<> increment = (nodes[node] - nodes[node - 1]) / n_steps;
        for (unsigned int n = 1; n <= n_steps; ++n)
          {
            const Tensor2<> next =
              n < n_steps ? nodes[node - 1] + n * increment : nodes[node];
            const Tensor2<>        change = next - strain;
            const Response<double> here =
              Step<Law>(law, strain, history).response;
            const Step<Law>         step(law, next, history);
            const Response<double> &response = step.response;

            const double growth =
              response.stored_energy - old.stored_energy + response.dissipation;
            checks.dissipation.add(-response.dissipation);
            checks.potential.add(
              std::abs(growth - (response.potential - here.potential)));
            checks.convexity.add(std::max(growth - response.stress * change,
                                          old.stress * change - growth));
            checks.repetition.add((here.stress - old.stress).norm() +
                                  std::abs(here.dissipation));

            balance.work += .5 * ((old.stress + response.stress) * change);
            balance.dissipation += response.dissipation;
            old     = response;
            history = step.history;
            strain  = next;
          }
      }
    balance.stored = old.stored_energy - initial;
    return balance;
  }

  template <typename Law>
  bool
  check_law(const std::string &name, const Law &law)
  {
    constexpr bool reversible = Law::n_tensors == 0;

    Random random(1943);
    Checks checks;
    Worst  cycles(0.), stored_is_potential(1e-12), convergence(.1);
    double dissipated = 0.;

    const std::array<unsigned int, 3> n_steps = {{20, 80, 320}};
    std::array<double, 3>             error{}; // sums over all paths
    for (unsigned int path = 0; path < 50; ++path)
      {
        const auto nodes = random_path(random, 4, false);
        for (unsigned int level = 0; level < n_steps.size(); ++level)
          {
            const Balance balance = follow(law, nodes, n_steps[level], checks);
            error[level] += std::abs(balance.error());
            dissipated += balance.dissipation;
          }

        if (reversible)
          {
            const Balance cycle =
              follow(law, random_path(random, 4, true), 20, checks);
            cycles.add(std::abs(cycle.dissipation) + std::abs(cycle.stored));
            for (const Tensor2<> &strain : nodes)
              {
                const Step<Law> step(law, strain, virgin<Law>());
                stored_is_potential.add(std::abs(step.response.stored_energy -
                                                 step.response.potential));
              }
          }
      }

    // Of second order: 1/16. The linear law has round-off alone.
    for (unsigned int level = 1; level < n_steps.size(); ++level)
      convergence.add(error[level] / (error[level - 1] + 1e-9));

    const std::vector<const Worst *> all = {&checks.dissipation,
                                            &checks.potential,
                                            &checks.convexity,
                                            &checks.repetition,
                                            &convergence,
                                            &cycles,
                                            &stored_is_potential};

    bool passed = true;
    std::cout << std::left << std::setw(36) << name;
    for (const Worst *worst : all)
      {
        const bool applies =
          reversible || (worst != &cycles && worst != &stored_is_potential);
        std::cout << std::setw(5) << (applies ? worst->verdict() : "-");
        passed &= worst->passed();
      }
    std::cout << (dissipated > 1e-3 ? "dissipates" : "-") << std::endl;
    return passed;
  }
} // namespace

int
main()
{
  std::cout
    << "D  dissipation of a step >= 0\n"
       "W  growth of stored energy and dissipation = W_n(e_n+1) - W_n(e_n)\n"
       "C  that growth between s_n:de and s_n+1:de (convexity)\n"
       "R  an accepted state repeats itself\n"
       "T  work by trapezoids converges to stored energy and dissipation\n"
       "O  closed cycles of reversible laws: nothing dissipated, nothing kept\n"
       "P  reversible laws: the stored energy is the potential\n"
    << std::setw(37) << "D" << std::setw(5) << "W" << std::setw(5) << "C"
    << std::setw(5) << "R" << std::setw(5) << "T" << std::setw(5) << "O"
    << std::setw(5) << "P" << std::endl;
  const bool passed =
    for_all_laws<false>([](const std::string &name, const auto &law) {
      return check_law(name, law);
    });
  return passed ? 0 : 1;
}
