// What a scene does not call for takes no memory: the bill, and the bytes that
// are really allocated, for a scene of each rheology.

#include <signoton/scene/requirements.h>
#include <signoton/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <iostream>

using namespace Signoton;

namespace
{
  bool
  check(const std::string &rheology, const std::string &constants)
  {
    SceneFile file = SceneFile::parse(R"(
      subsection Materials
        subsection m
          set Bulk modulus = 1
          set Shear modulus = 0.6
          set Rheology = )" + rheology + constants +
                                        R"(
        end
      end
      subsection Boundaries
        subsection bottom
          set Symmetry = true
        end
        subsection left
          set Symmetry = true
        end
      end)",
                                      "test");
    Scene<2>  scene(MPI_COMM_SELF, file);
    auto     &model = scene.model;
    scene.build();
    model.mechanics->reinit();
    VectorType u, force;
    model.mechanics->initialize_vector(u);
    model.mechanics->initialize_vector(force);

    model.mechanics->internal_force(u, force, false);
    const auto without_tangent = model.mechanics->memory();
    model.mechanics->internal_force(u, force, true);
    const auto with_tangent = model.mechanics->memory();

    std::cout << rheology << "\n";
    unsigned int history = 0, tangent = 0;
    for (const auto &effect : requirements(model))
      {
        std::cout << "  " << effect.name << ": " << (effect.on ? "on" : "off")
                  << ", " << effect.bytes_per_point << " bytes a point\n";
        if (effect.name == "history")
          history = effect.bytes_per_point;
        if (effect.name == "consistent tangent")
          tangent = effect.bytes_per_point;
        if (!effect.on && effect.bytes_per_point != 0)
          return false;
      }
    const unsigned int n_points =
      model.space->mesh.n_active_cells() * model.space->quadrature.size();
    std::cout << "  allocated for history: " << with_tangent.history / n_points
              << ", for tangents: " << with_tangent.tangent / n_points
              << " bytes a point\n";
    // the bill is what is allocated; tangents only once one is asked for
    return with_tangent.history == history * n_points &&
           with_tangent.tangent == tangent * n_points &&
           without_tangent.tangent == 0;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                cone =
    "\nset Admissible set = mises schleicher\nset Friction parameter = 0.5";
  bool ok = check("elastic", "");
  ok &= check("elastic granular", cone + "\nset Binder = proportional");
  ok &= check("elastic plastic",
              "\nset Admissible set = von mises\nset Shear strength = 1"
              "\nset Isotropic hardening modulus = 0.1");
  ok &= check("elastic plastic granular", cone + "\nset Shear strength = 1");
  std::cout << (ok ? "ok" : "FAILED") << std::endl;
  return ok ? 0 : 1;
}
