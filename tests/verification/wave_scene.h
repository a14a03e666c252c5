#ifndef signoton_tests_wave_scene_h
#define signoton_tests_wave_scene_h

#include "verification.h"

namespace Verification
{
  /**
   * A dynamic scene: a box with one material, without boundary conditions.
   * @param arguments of the generator subdivided_hyper_rectangle
   * @param rheology elastic, elastic granular, elastic plastic granular, or a
   *   scheme in brackets that has its own numbers
   */
  inline Signoton::SceneFile
  wave_box(const int          dim,
           const unsigned int degree,
           const std::string &arguments,
           const std::string &rheology)
  {
    Signoton::SceneFile file;
    file.set({}, "Dimension", std::to_string(dim));
    file.set({}, "Analysis", "dynamics");
    file.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
    file.set({"Geometry"}, "Arguments", arguments);
    file.set({"Discretization"}, "Degree", std::to_string(degree));
    const Signoton::SceneFile::Path sand = {"Materials", "sand"};
    file.set(sand, "Rheology", rheology);
    file.set(sand, "Density", "1");
    if (rheology.find('(') == std::string::npos)
      {
        file.set(sand, "Bulk modulus", "1");
        file.set(sand, "Shear modulus", "0.6");
      }
    if (rheology.find("granular") != std::string::npos)
      {
        file.set(sand, "Friction parameter", "0.6");
        file.set(sand, "Binder", "proportional");
        file.set(sand, "Binder ratio", "0.01");
        if (rheology == "elastic granular")
          file.set(sand, "Admissible set", "mises schleicher");
        else
          file.set(sand, "Shear strength", "0.01");
      }
    return file;
  }
} // namespace Verification

#endif
