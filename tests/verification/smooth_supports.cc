// Curved supports on any number of ranks: bodies of revolution turn freely in a
// support around them, on curved surfaces and on facets; what is a kink and what
// is smooth follows the key; a cylinder needs no support along its axis.

#include "support_scene.h"

using namespace Verification;

namespace
{
  /** A mesh file of a ring, in 3D with a layer of cells, whose facets have
   *  different lengths. */
  void
  write_ring(const int dim)
  {
    const int     n = 24, layers = dim - 1;
    std::ofstream out("ring.msh");
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
        << 2 * n * layers << '\n'
        << std::setprecision(17);
    const auto node = [&](const int i, const int ring, const int layer) {
      return 1 + (i % n) + n * (ring + 2 * layer);
    };
    for (int layer = 0; layer < layers; ++layer)
      for (int ring = 0; ring < 2; ++ring)
        for (int i = 0; i < n; ++i)
          {
            const double angle =
              2. * numbers::PI * (i + 0.2 * std::sin(3. * i)) / n;
            out << node(i, ring, layer) << ' ' << (1 + ring) * std::cos(angle)
                << ' ' << (1 + ring) * std::sin(angle) << ' ' << layer << '\n';
          }
    const int faces = dim == 2 ? n : 3 * n;
    out << "$EndNodes\n$Elements\n" << n + faces << '\n';
    int        element = 0;
    const auto write =
      [&](const int type, const int id, std::vector<int> list) {
        out << ++element << ' ' << type << " 2 " << id << ' ' << id;
        for (const int v : list)
          out << ' ' << v;
        out << '\n';
      };
    for (int i = 0; i < n; ++i)
      if (dim == 2)
        {
          write(1, 7, {node(i, 1, 0), node(i + 1, 1, 0)});
          write(3,
                0,
                {node(i, 0, 0),
                 node(i, 1, 0),
                 node(i + 1, 1, 0),
                 node(i + 1, 0, 0)});
        }
      else
        {
          write(3,
                7,
                {node(i, 1, 0),
                 node(i + 1, 1, 0),
                 node(i + 1, 1, 1),
                 node(i, 1, 1)});
          for (const int l : {0, 1})
            write(3,
                  8,
                  {node(i, 0, l),
                   node(i, 1, l),
                   node(i + 1, 1, l),
                   node(i + 1, 0, l)});
          write(5,
                0,
                {node(i, 0, 0),
                 node(i, 1, 0),
                 node(i + 1, 1, 0),
                 node(i + 1, 0, 0),
                 node(i, 0, 1),
                 node(i, 1, 1),
                 node(i + 1, 1, 1),
                 node(i + 1, 0, 1)});
        }
    out << "$EndElements\n";
  }

  /** A ring or shell turns in the support around it. */
  void
  turning_ring(Report &report, const Kind &kind, const bool facets)
  {
    std::vector<Section> sections = {
      {facets ? "7" : "outer", {{"Symmetry", "true"}}}};
    if (facets && kind.dim == 3)
      sections.push_back({"8", {{"Symmetry", "true"}}});
    SceneFile file = elastic_scene(kind, sections);
    if (facets)
      {
        if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          write_ring(kind.dim);
        MPI_Barrier(MPI_COMM_WORLD);
        file.set({"Geometry"}, "Mesh file", "ring.msh");
        file.set({"Geometry"},
                 "Initial refinement",
                 kind.degree == 1 ? "1" : "0");
      }
    else
      {
        file.set({"Geometry"}, "Generator", "hyper_shell");
        file.set({"Geometry"},
                 "Arguments",
                 kind.dim == 2 ? "0, 0 : 1 : 2 : 8 : true" :
                                 "0, 0, 0 : 1 : 2 : 6 : true");
        file.set({"Geometry"}, "Boundary names", "inner: 0; outer: 1");
      }
    const std::string name =
      kind.name() + (facets ? ", ring of facets" : ", ring");
    if (kind.analysis == "statics")
      {
        bool is_free = false;
        try
          {
            run(file);
          }
        catch (const Signoton::UserError &error)
          {
            is_free =
              std::string(error.what()).find("rotation") != std::string::npos;
          }
        report.require(name + ", held against rotation", is_free ? 0. : 1., 0.);
        return;
      }
    file.set({"Initial state"},
             "Velocity",
             kind.dim == 2 ? "-y; x" :
             facets        ? "-y; x; 0" :
                             "0.3*z-y; x-0.2*z; 0.2*y-0.3*x");
    const auto   lines = run(file);
    const double first = value(lines.front(), "kinetic energy");
    report.require(name + ", kinetic energy",
                   value(lines.back(), "kinetic energy") / first - 1.,
                   1e-10);
    report.require(name + ", stored energy",
                   value(lines.back(), "stored energy") / first,
                   1e-20);
  }

  /** One section of two planes at 30 degrees: two, unless the key says that
   *  they are one surface. */
  void
  kink(Report &report)
  {
    for (const bool is_smooth : {false, true})
      {
        const Kind kind{2, 1, "statics"};
        SceneFile  file = elastic_scene(
          kind,
          {{"both",
             {{"Symmetry", "true"}, {"Kink angle", is_smooth ? "31" : "29"}}},
            {"end", {{"Displacement x", "0.01"}}}});
        Wedge(2, false).set_geometry(file);
        file.set({"Geometry"},
                 "Boundary names",
                 "both: y < 0.6 && x < 1.5; end: 1; top: 3");
        file.set({"Output"}, "Probe points", "0, 0");
        const auto         last = run(file).back();
        const Tensor<1, 3> u =
          vector_of(last, 2, "displacement ", " at probe 1");
        const double half =
          numbers::PI / 12.; // of the angle between the planes
        report.require("average of a kink",
                       u * Tensor<1, 3>({std::sin(half), std::cos(half), 0.}),
                       1e-13);
        if (is_smooth)
          report.require("smooth kink that moves",
                         u.norm() > 1e-3 ? 0. : 1.,
                         0.);
        else
          report.require("kink that is held", u.norm(), 1e-13);
      }
  }

  /** A cylinder under pressure without a support along its axis. */
  void
  axis(Report &report, const unsigned int degree)
  {
    const Kind kind{2, degree, "statics"};
    SceneFile  file = elastic_scene(kind,
                                   {{"bottom", {{"Symmetry", "true"}}},
                                     {"top", {{"Pressure", "0.01"}}}});
    file.set({}, "Embedding", "axisymmetric");
    file.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
    file.set({"Geometry"}, "Arguments", "3, 3 : 0, 0 : 1, 2 : true");
    file.set({"Output"}, "Probe points", "0, 1; 1, 2");
    const auto        last = run(file).back();
    const std::string name = kind.name() + ", axis";
    report.require(name, value(last, "displacement x at probe 1"), 1e-15);
    report.require(name + ", widening",
                   value(last, "displacement x at probe 2") - 0.3 * 0.01,
                   1e-12);
    report.require(name + ", force over the circle",
                   value(last, "reaction bottom y") / (0.01 * numbers::PI) - 1.,
                   1e-10);
  }
} // namespace

int
main(int argc, char **argv)
{
  return Verification::main(argc, argv, [](Report &report) {
    for (const Kind &kind : kinds())
      for (const bool facets : {false, true})
        turning_ring(report, kind, facets);
    kink(report);
    for (const unsigned int degree : {1, 2})
      axis(report, degree);
  });
}
