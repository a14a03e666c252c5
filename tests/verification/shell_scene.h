#ifndef signoton_tests_shell_scene_h
#define signoton_tests_shell_scene_h

#include "verification.h"

namespace Verification
{
  /** A quarter of an elastic ring between two radii in m, three coarse cells
   *  along the arc, on the supports of its symmetry. */
  inline Signoton::SceneFile
  quarter_shell(const std::string &radii, const unsigned int degree)
  {
    Signoton::SceneFile file;
    file.set({}, "Dimension", "2");
    file.set({"Geometry"}, "Generator", "quarter_hyper_shell");
    file.set({"Geometry"}, "Arguments", "0, 0 : " + radii + " : 3 : true");
    const Signoton::SceneFile::Path steel = {"Materials", "steel"};
    file.set(steel, "Rheology", "elastic");
    file.set(steel, "Young modulus", "1000");
    file.set(steel, "Poisson ratio", "0.3");
    for (const std::string side : {"plane x", "plane y"})
      file.set({"Boundaries", side}, "Symmetry", "true");
    file.set({"Discretization"}, "Degree", std::to_string(degree));
    return file;
  }
} // namespace Verification

#endif
