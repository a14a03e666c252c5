#ifndef signoton_tests_box_scene_h
#define signoton_tests_box_scene_h

#include "verification.h"

namespace Verification
{
  using Signoton::SceneFile;

  /**
   * A unit square or cube as a scene: one cell, or @p n cells along each edge
   * with displaced inner vertices. The vertical axis is the last one: the
   * sides are left and right, in 3D front and back, then bottom and top.
   */
  inline SceneFile
  box_scene(const int dim, const unsigned int n, const unsigned int p)
  {
    SceneFile         file;
    const std::string cells = std::to_string(n);
    file.set({}, "Dimension", std::to_string(dim));
    file.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
    file.set({"Geometry"},
             "Arguments",
             dim == 2 ?
               cells + "," + cells + " : 0,0 : 1,1 : true" :
               cells + "," + cells + "," + cells + " : 0,0,0 : 1,1,1 : true");
    if (n > 1)
      file.set({"Geometry"}, "Distortion", "0.2");
    file.set({"Discretization"}, "Degree", std::to_string(p));
    file.set({"Newton"}, "Tolerance", "1e-12");
    return file;
  }

  /** A cohesionless Mises-Schleicher material; @p lambda of 0: no binder. */
  inline void
  add_sand(SceneFile   &file,
           const double bulk,
           const double shear,
           const double kappa,
           const double lambda)
  {
    const SceneFile::Path sand = {"Materials", "sand"};
    file.set(sand, "Rheology", "elastic granular");
    file.set(sand, "Admissible set", "mises schleicher");
    file.set(sand, "Bulk modulus", text(bulk));
    file.set(sand, "Shear modulus", text(shear));
    file.set(sand, "Friction parameter", text(kappa));
    if (lambda > 0.)
      {
        file.set(sand, "Binder", "proportional");
        file.set(sand, "Binder ratio", text(lambda));
      }
  }
} // namespace Verification

#endif
