// The step that is called stable against the largest frequency of the body,
// 2/omega, by the power method: not above it, and not far below; regular and
// distorted meshes, both degrees, all embeddings, with hanging nodes.

#include "verification.h"

#include <signoton/operators/lumped_mass.h>

using namespace Verification;
using namespace Signoton;

namespace
{
  template <int dim>
  double
  ratio(const unsigned int degree,
        const double       distortion,
        const bool         axisymmetric,
        const bool         hanging,
        const double       poisson)
  {
    SceneFile file;
    file.set({}, "Dimension", std::to_string(dim));
    file.set({}, "Analysis", "dynamics");
    if (axisymmetric)
      file.set({}, "Embedding", "axisymmetric");
    file.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
    file.set({"Geometry"},
             "Arguments",
             dim == 2 ? "6, 6 : 0, 0 : 1, 1 : true" :
                        "3, 3, 3 : 0, 0, 0 : 1, 1, 1 : true");
    if (distortion > 0.)
      file.set({"Geometry"}, "Distortion", std::to_string(distortion));
    file.set({"Discretization"}, "Degree", std::to_string(degree));
    file.set({"Materials", "rock"}, "Rheology", "elastic");
    file.set({"Materials", "rock"}, "Young modulus", "1");
    file.set({"Materials", "rock"}, "Poisson ratio", std::to_string(poisson));
    file.set({"Materials", "rock"}, "Density", "1");
    Scene<dim> scene(MPI_COMM_SELF, file);
    scene.build();
    auto &space = *scene.model.space;
    if (hanging)
      {
        for (const auto &cell : space.mesh.active_cell_iterators())
          if (cell->center()[0] < 0.4 && cell->center()[1] < 0.4)
            cell->set_refine_flag();
        space.mesh.execute_coarsening_and_refinement();
        space.distribute_dofs();
        space.update_constraints(scene.model.conditions);
      }
    auto &mechanics = *scene.model.mechanics;
    mechanics.reinit();
    const double stable = mechanics.stable_time_step();

    const VectorType mass = lumped_mass(space, scene.model.materials);
    VectorType       u, f;
    mechanics.initialize_vector(u);
    mechanics.initialize_vector(f);
    for (unsigned int i = 0; i < u.size(); ++i)
      u[i] = mass[i] > 0. ? std::sin(1. + 3. * i * i) : 0.;
    double square = 0.;
    for (unsigned int iteration = 0; iteration < 600; ++iteration)
      {
        mechanics.dynamic_force(u, f, false, -1.);
        double uu = 0., uf = 0.;
        for (unsigned int i = 0; i < u.size(); ++i)
          {
            uu += u[i] * mass[i] * u[i];
            uf += u[i] * f[i];
            u[i] = mass[i] > 0. ? f[i] / mass[i] : 0.;
          }
        square = uf / uu;
        u /= u.linfty_norm();
      }
    return stable / (2. / std::sqrt(square));
  }
} // namespace

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  Report     report;
  const auto check = [&](const std::string &name, const double found) {
    std::cout << name << ": " << found << std::endl;
    report.require(name + ", above the stable step by",
                   std::max(0., found - 1.),
                   1e-6);
    report.require(name + ", short of it by", std::max(0., 1. - found), 0.7);
  };
  for (const unsigned int degree : {1, 2})
    for (const double distortion : {0., 0.2})
      for (const double poisson : {0., 0.3, 0.45})
        {
          std::ostringstream name;
          name << "degree " << degree << ", distortion " << distortion
               << ", Poisson's ratio " << poisson;
          check("plane strain, " + name.str(),
                ratio<2>(degree, distortion, false, false, poisson));
          check("axisymmetric, " + name.str(),
                ratio<2>(degree, distortion, true, false, poisson));
          check("solid, " + name.str(),
                ratio<3>(degree, distortion, false, false, poisson));
          check("hanging nodes, " + name.str(),
                ratio<2>(degree, distortion, false, true, poisson));
        }
  return report.status();
}
