// Schemes as text: what is understood, and what is refused with a mark under
// the place.

#include "common.h"

#include <signoton/base/exceptions.h>
#include <signoton/rheology/scheme.h>

using namespace Signoton;
using namespace Signoton::Rheology;

namespace
{
  void
  print(const Scheme &scheme, const unsigned int depth)
  {
    const char *const names[] = {
      "series", "parallel", "spring", "damper", "hinge", "contact"};
    std::cout << std::string(2 * depth, ' ')
              << names[static_cast<unsigned int>(scheme.kind)];
    if (scheme.moduli.bulk > 0. || scheme.moduli.shear > 0.)
      std::cout << " " << scheme.moduli.bulk << " " << scheme.moduli.shear;
    if (!scheme.set.empty())
      std::cout << " on set " << scheme.set[0].index();
    if (scheme.gap > 0.)
      std::cout << " with gap " << scheme.gap;
    std::cout << "\n";
    for (const auto &one : scheme.parts)
      print(one, depth + 1);
  }

  const std::map<std::string, std::string> definitions = {
    {"grains", "spring(bulk = 2, shear = 1)"},
    {"glue", "parallel(contact(no tension), spring(bulk = 1, shear = 1))"},
    {"loop", "series(grains, other loop)"},
    {"other loop", "parallel(loop, glue)"},
    {"twice 1", "series(grains, grains)"},
    {"twice 2", "series(twice 1, twice 1)"},
    {"twice 3", "series(twice 2, twice 2)"},
    {"twice 4", "series(twice 3, twice 3)"},
    {"twice 5", "series(twice 4, twice 4)"},
    {"twice 6", "series(twice 5, twice 5)"},
    {"twice 7", "series(twice 6, twice 6)"},
    {"twice 8", "series(twice 7, twice 7)"},
    {"twice 9", "series(twice 8, twice 8)"},
    {"twice 10", "series(twice 9, twice 9)"}};

  void
  read(const std::string &text)
  {
    std::cout << text << "\n";
    try
      {
        print(parse_scheme(text, "scene.prm, line 7", definitions), 1);
      }
    catch (const UserError &error)
      {
        std::cout << error.what();
      }
    std::cout << std::endl;
  }
} // namespace

int
main()
{
  const std::string spring = "spring(bulk = 2, shear = 1)";
  read(spring);
  read("spring(young = 9, poisson = 0.125)");
  read("  series ( grains ,glue,\n  damper( shear  viscosity=3 ) )");
  read("series(grains, parallel(contact(coulomb mohr, friction angle = 30), "
       "hinge(von mises, strength = 2, isotropic hardening = 1)), "
       "contact(hydrostatic, gap = 0.01))");

  read("");
  read("sprong(bulk = 2)");
  read("series(spring(bulk = 2, shear = 1)");
  read("series(spring(bulk = 2, shear = 1))");
  read(spring + " and more");
  read("spring(bulk = 2, sheer = 1)");
  read("spring(bulk = 2)");
  read("spring(bulk = 2, shear = 1, young = 3)");
  read("spring(bulk = -2, shear = 1)");
  read("spring(bulk = 2, bulk = 3, shear = 1)");
  read("spring(bulk = two, shear = 1)");
  read("spring(bulk, shear = 1)");
  read("damper()");
  read("hinge(no tension)");
  read("contact(von mises, strength = 1)");
  read("contact(coulomb mohr, friction angle = 0.5)");
  read("contact(no tension, tensile strength = 1, gap = 0.1)");
  read(
    "series(grains, contact(mises schleicher, friction = 0.5), hinge(tresca, "
    "strength = 1), damper(bulk viscosity = 1, shear = 2), glue)");
  read("series(loop, glue)");
  read("series(grains, = 7, glue)");
  read("series(grains, contact(hydrostatic = 3))");
  read("series(grains, contact(hydrostatic,))");
  read("contact(no compression, gap = 0.1)");
  read("twice 10");
  return 0;
}
