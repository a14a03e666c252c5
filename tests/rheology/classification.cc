// What is known of a scheme before it runs: whether stress and strain follow
// from each other, its closed form, what a point remembers, and, for schemes
// that are ill-posed, the element that cures them.

#include "common.h"

#include <signoton/base/exceptions.h>
#include <signoton/rheology/classification.h>

using namespace Signoton;
using namespace Signoton::Testing;

namespace
{
  const std::map<std::string, std::string> elements = {
    {"first", "spring(bulk = 2, shear = 1)"},
    {"second", "spring(bulk = 0.5, shear = 0.3)"},
    {"viscous", "damper(bulk viscosity = 2, shear viscosity = 1)"},
    {"viscous shear", "damper(shear viscosity = 1)"},
    {"cone", "contact(mises schleicher, friction = 0.6)"},
    {"coulomb", "contact(coulomb mohr, friction angle = 30)"},
    {"gap", "contact(hydrostatic, gap = 0.1)"},
    {"mises", "hinge(von mises, strength = 0.3)"},
    {"hardening", "hinge(von mises, strength = 0.3, isotropic hardening = 1)"},
    {"tresca", "hinge(tresca, strength = 0.3)"}};

  void
  classify(const std::string &text)
  {
    std::cout << text << "\n";
    const Scheme scheme = parse_scheme(text, "test", elements);
    std::cout << "  " << classification(scheme) << "\n";
    try
      {
        require_stress_from_strain(scheme, "test");
      }
    catch (const UserError &error)
      {
        std::cout << error.what() << std::endl;
        return;
      }
    const auto    closed = closed_form(scheme);
    const General general(scheme);
    const auto    bytes = [](const auto &law) {
      return (6 * n_tensors(law) + n_scalars(law)) * sizeof(double);
    };
    std::cout << "  bytes a point: ";
    if (closed)
      std::cout << std::visit(bytes, *closed) << " in closed form, ";
    std::cout << bytes(general) << " in general" << std::endl;
  }
} // namespace

int
main()
{
  // with closed forms, also where parts are to be merged
  classify("first");
  classify("series(first, second)");
  classify("series(first, cone)");
  classify("series(first, series(second, coulomb))");
  classify("series(first, parallel(cone, second))");
  classify("series(first, parallel(second, cone, second))");
  classify("series(first, mises)");
  classify("series(first, hardening)");
  classify("series(first, parallel(tresca, second))");
  classify("series(mises, cone, first)");
  classify("series(first, parallel(series(mises, cone), second))");
  // without
  classify("series(first, gap)");
  classify("series(first, viscous)");
  classify("parallel(first, viscous)");
  classify("series(first, cone, coulomb)");
  classify("series(first, cone, tresca)");
  classify("series(first, cone, parallel(mises, viscous))");
  classify("parallel(series(first, mises), series(second, cone))");
  classify("series(first, parallel(cone, series(second, mises)), "
           "parallel(tresca, viscous))");
  // ill-posed
  classify("cone");
  classify("parallel(first, cone)");
  classify("parallel(first, series(second, mises), tresca)");
  classify("series(cone, mises)");
  classify("series(cone, viscous shear)");
  classify("series(parallel(cone, first), parallel(mises, viscous))");
}
