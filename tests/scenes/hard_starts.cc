// What a first step may begin with: supports that are already displaced at the
// start time, materials without any stiffness left, and binders of ratio zero.

#include "physical_numbers.h"
#include "verdicts.h"

#include <signoton/base/mpi_session.h>
#include <signoton/scene/scene.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace Signoton;

namespace
{
  using Overrides = std::vector<std::string>;

  /** A block between symmetry planes. */
  const std::string block = R"(
set Dimension = 2
subsection Geometry
  set Generator          = hyper_cube
  set Arguments          = 0 : 1 : true
  set Initial refinement = 2
end
subsection Boundaries
  subsection left
    set Symmetry = true
  end
  subsection bottom
    set Symmetry = true
  end
  subsection top
    set Displacement y = 0
  end
  subsection right
    set Displacement x = 0
  end
end
subsection Load steps
  set Step size = 0.5
end
subsection Output
  set Fields every = 0
end
subsection Materials
  subsection m
    set Bulk modulus  = 1
    set Shear modulus = 0.6
)";

  std::vector<PhysicalNumbers::Line>
  run(const std::string &material, const Overrides &overrides)
  {
    {
      std::ofstream scene("block.prm");
      scene << block << material << "  end\nend\n";
    }
    Options options;
    options.scene_file       = "block.prm";
    options.output_directory = "results";
    std::filesystem::remove_all("results");
    options.overrides = overrides;
    if (run_scene(MPI_COMM_WORLD, options) != ExitStatus::completed)
      return {};
    return PhysicalNumbers::read("results/statistics.csv");
  }

  bool
  same(const double a, const double b, const double scale)
  {
    return std::abs(a - b) <= 1e-9 * scale;
  }
} // namespace

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  Verdicts   verdict;
  using PhysicalNumbers::value;

  // uniaxial strain far below the yield stress: elastic in closed form
  {
    const std::string steel = "set Rheology = elastic plastic\n"
                              "set Admissible set = von mises\n"
                              "set Shear strength = 0.01\n";
    bool              good  = true;
    for (const std::string top : {"-0.005", "-0.005*if(t > 0, 1, 0)"})
      {
        const auto   lines  = run(steel,
                               {"Boundaries/top/Displacement y=" + top,
                                   "Refinement/Cycles in first step=1"});
        const double stress = -0.005 * (1. + 4. / 3. * 0.6);
        good &= !lines.empty();
        for (const auto &line : lines)
          good &= same(value(line, "reaction top y"), stress, 0.01) &&
                  same(value(line, "dissipated energy"), 0., 1e-5) &&
                  same(value(line, "transfer drift"), 0., 1e-5) &&
                  same(value(line, "stored energy"), 0.0025 * -stress, 1e-5) &&
                  same(value(line, "external work"), 0.0025 * -stress, 1e-5);
      }
    verdict("displaced at the start", good);
  }

  // all of the body at the vertex: no stress, and no stiffness
  for (const std::string method : {"direct", "cg"})
    {
      const Overrides   apart = {"Linear solver/Method=" + method,
                                 "Boundaries/top/Displacement y=0.01*t",
                                 "Boundaries/right/Displacement x="
                                   "0.01*t + 0.001*sin(9*y)*t"};
      const std::string cone =
        "set Admissible set = mises schleicher\nset Friction parameter = 0.5\n";
      for (const std::string rheology :
           {"set Rheology = elastic plastic\n",
            "set Rheology = elastic granular\n",
            "set Rheology = elastic granular\nset Binder = proportional\n"
            "set Binder ratio = 0\n",
            "set Rheology = elastic granular\nset Binder = moduli\n"
            "set Binder bulk modulus = 0\nset Binder shear modulus = 0.1\n",
            "set Rheology = elastic plastic\nset Cohesion = 0.001\n"})
        {
          const auto  lines = run(rheology + cone, apart);
          std::string name  = rheology.substr(0, rheology.size() - 1);
          for (char &c : name)
            c = c == '\n' ? ',' : c;
          verdict(name + " pulled apart, " + method, lines.size() == 2);
        }
    }
  return verdict.status();
}
