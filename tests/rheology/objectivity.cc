// A rotated strain path gives rotated stress, history and tangent; region,
// energies and hardening stay as they are.

#include "common.h"

using namespace Signoton;
using namespace Signoton::Testing;

namespace
{
  template <typename Law>
  bool
  check_law(const std::string &name, const Law &law)
  {
    Random random(1687);
    Worst  stress(1e-13), tangent(1e-12), history(1e-13), scalars(1e-13);

    const double stiffness =
      3. * law.elasticity().bulk + 2. * law.elasticity().shear;
    for (unsigned int path = 0; path < 500; ++path)
      {
        const Tensor<2, 3>   r        = random.rotation();
        History<Law, double> accepted = virgin<Law>(), turned = accepted;
        for (unsigned int n = 0; n < 4; ++n)
          {
            const Tensor2<> strain =
              random.tensor() + random.uniform() * unit_symmetric_tensor<3>();
            const Step<Law>         step(law, strain, accepted);
            const Step<Law>         other(law, rotate(r, strain), turned);
            const Response<double> &a = step.response, &b = other.response;

            stress.add((b.stress - rotate(r, a.stress)).norm() / stiffness);
            history.add(
              (b.contact_strain - rotate(r, a.contact_strain)).norm());
            for (unsigned int i = 0; i < Law::n_tensors; ++i)
              history.add(
                (other.history.tensors[i] - rotate(r, step.history.tensors[i]))
                  .norm());
            for (unsigned int i = 0; i < Law::n_scalars; ++i)
              history.add(
                std::abs(other.history.scalars[i] - step.history.scalars[i]));
            for (unsigned int c = 0; c < 6; ++c)
              tangent.add((b.tangent * rotate(r, basis(c)) -
                           rotate(r, a.tangent * basis(c)))
                            .norm() /
                          stiffness);
            scalars.add((std::abs(b.potential - a.potential) +
                         std::abs(b.stored_energy - a.stored_energy) +
                         std::abs(b.dissipation - a.dissipation)) /
                          stiffness +
                        std::abs(b.region - a.region));
            accepted = step.history;
            turned   = other.history;
          }
      }
    std::cout << std::left << std::setw(36) << name;
    bool passed = true;
    for (const Worst *worst : {&stress, &tangent, &history, &scalars})
      {
        std::cout << std::setw(9) << worst->verdict();
        passed &= worst->passed();
      }
    std::cout << std::endl;
    return passed;
  }
} // namespace

int
main()
{
  std::cout << std::left << std::setw(36) << "law" << std::setw(9) << "stress"
            << std::setw(9) << "tangent" << std::setw(9) << "history"
            << "scalars" << std::endl;
  const bool passed =
    for_all_laws([](const std::string &name, const auto &law) {
      return check_law(name, law);
    });
  return passed ? 0 : 1;
}
