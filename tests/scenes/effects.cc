// What a scene does not call for takes no memory: the bill, and the bytes that
// are really allocated, for a scene of each rheology.

#include <signoton/base/mpi_session.h>
#include <signoton/drivers/dynamic_analysis.h>
#include <signoton/scene/requirements.h>
#include <signoton/scene/scene.h>

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

    model.mechanics->evaluate(u, force, false);
    const auto without_tangent = model.mechanics->memory();
    model.mechanics->evaluate(u, force, true);
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

  /** The same for what only dynamics has. */
  bool
  check_dynamics(const std::string &what,
                 const std::string &initial_strain,
                 const std::string &viscosity,
                 const std::string &scheme)
  {
    SceneFile file = SceneFile::parse(R"(
      set Analysis = dynamics
      subsection Materials
        subsection m
          set Bulk modulus = 1
          set Shear modulus = 0.6
          set Density = 1
          set Rheology = elastic granular
          set Admissible set = mises schleicher
          set Friction parameter = 0.5
        end
      end)",
                                      "test");
    file.set({"Time integration"}, "Scheme", scheme);
    if (!initial_strain.empty())
      file.set({"Initial state"}, "Strain", initial_strain);
    for (const char *kind : {"Linear", "Quadratic"})
      file.set({"Time integration"},
               std::string(kind) + " shock viscosity",
               viscosity);
    Scene<2> scene(MPI_COMM_SELF, file);
    auto    &model = scene.model;
    scene.build();
    model.mechanics->set_shock_viscosity(
      dynamic_cast<const DynamicAnalysis<2> &>(*model.analysis)
        .time_integration.shock_viscosity);
    model.mechanics->reinit();
    model.mechanics->set_time_step(1.);
    VectorType u, force;
    model.mechanics->initialize_vector(u);
    model.mechanics->initialize_vector(force);
    if (scheme == "implicit")
      model.mechanics->evaluate(u, force, true);
    model.mechanics->dynamic_force(u, force, false, -1.);

    const auto         memory = model.mechanics->memory();
    const unsigned int n_points =
      model.space->mesh.n_active_cells() * model.space->quadrature.size();
    std::cout << "dynamics, " << what << "\n";
    bool ok = true;
    for (const auto &effect : requirements(model))
      {
        if (effect.on)
          std::cout << "  " << effect.name << ": " << effect.bytes_per_point
                    << " bytes a point\n";
        const double billed = effect.bytes_per_point * n_points;
        const auto   is     = [&](const double bytes) {
          // a few numbers a cell are not on the bill
          ok &= effect.on ? bytes >= billed && bytes <= 1.6 * billed :
                                  !(bytes > 0.);
        };
        if (effect.name == "initial state")
          is(memory.initial_state);
        if (effect.name == "shock viscosity")
          is(memory.shock_viscosity);
        if (effect.name == "consistent tangent")
          is(memory.tangent);
        if (effect.name == "history")
          is(memory.history);
      }
    return ok;
  }
} // namespace

int
main(int argc, char **argv)
{
  MPISession        mpi(argc, argv);
  const std::string cone =
    "\nset Admissible set = mises schleicher\nset Friction parameter = 0.5";
  bool ok = check("elastic", "");
  ok &= check("elastic granular", cone + "\nset Binder = proportional");
  ok &= check("elastic plastic",
              "\nset Admissible set = von mises\nset Shear strength = 1"
              "\nset Isotropic hardening modulus = 0.1");
  ok &= check("elastic plastic granular", cone + "\nset Shear strength = 1");
  ok &= check_dynamics("bare", "", "0", "explicit");
  ok &= check_dynamics("loosened", "0.01; 0; 0; 0", "0", "explicit");
  ok &= check_dynamics("with shock viscosity", "", "1", "explicit");
  ok &= check_dynamics("implicit, all", "0.01; 0; 0; 0", "1", "implicit");
  std::cout << (ok ? "ok" : "FAILED") << std::endl;
  return ok ? 0 : 1;
}
