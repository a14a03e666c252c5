// Supports where boundaries meet, and their reactions, on any number of ranks:
// results do not change when a body is turned in space, when planes are held by
// components instead of symmetry, or with the order in the file; nodes of two
// supports fulfill both; with the loads, reactions and their moments add up to
// zero, and in dynamics to the change of momentum.

#include "support_scene.h"

using namespace Verification;

namespace
{
  /** Pressed and heavy, on planes that are all held by symmetry, or as far as
   *  possible by components. */
  SceneFile
  wedge_scene(const Kind &kind, const bool turned)
  {
    const std::pair<std::string, std::string> symmetric = {"Symmetry", "true"};
    std::vector<Section>                      sections  = {
                            {"slope", {symmetric}},
                            {"end", {{"Pressure", kind.analysis == "statics" ? "1" : "t"}}},
                            {"floor", {turned ? symmetric : std::make_pair("Displacement y", "0")}}};
    if (kind.dim == 3)
      sections.push_back(
        {"front",
         {turned ? symmetric : std::make_pair("Displacement z", "0")}});
    SceneFile   file = elastic_scene(kind, sections);
    const Wedge wedge(kind.dim, turned);
    wedge.set_geometry(file);
    file.set({"Loads"},
             "Gravity",
             vector_text(wedge.gravity(),
                         kind.dim,
                         kind.analysis == "statics" ? ";" : "*t;") +
               (kind.analysis == "statics" ? "" : "*t"));
    file.set({"Output"},
             "Probe points",
             vector_text(wedge.place(0., 0.), kind.dim, ",") + ";" +
               vector_text(wedge.place(-std::sqrt(.75), .5), kind.dim, ",") +
               ";" + vector_text(wedge.place(0., 1.), kind.dim, ","));
    return file;
  }

  /** What does not change when the body is turned. */
  std::vector<double>
  invariants(const Kind &kind, const PhysicalNumbers::Line &line)
  {
    std::vector<double> result = {value(line, "stored energy")};
    for (const std::string probe : {"2", "3"})
      result.push_back(
        vector_of(line, kind.dim, "displacement ", " at probe " + probe)
          .norm());
    for (const std::string section : {"slope", "floor"})
      result.push_back(
        vector_of(line, kind.dim, "reaction " + section + " ").norm());
    return result;
  }

  /** Sum of the reactions, or moments, of all sections. */
  Tensor<1, 3>
  sum_of(const PhysicalNumbers::Line &line,
         const int                    dim,
         const std::string           &what)
  {
    Tensor<1, 3> sum;
    for (const auto &[name, number] : line)
      if (name.rfind(what + " ", 0) == 0)
        {
          if (dim == 2 && what == "moment")
            sum[2] += number;
          else
            sum[name.back() - 'x'] += number;
        }
    return sum;
  }

  void
  turned_wedge(Report &report, Kind kind)
  {
    std::vector<double> expected;
    for (const bool reversed : {false, true})
      for (const bool turned : {false, true})
        {
          kind.reversed = reversed;
          const std::string name =
            kind.name() + (turned ? ", turned wedge" : ", wedge");
          const auto  lines = run(wedge_scene(kind, turned));
          const auto &last  = lines.back();
          report.require(
            name + ", displacement of the corner",
            vector_of(last, kind.dim, "displacement ", " at probe 1").norm(),
            1e-13);
          const auto numbers = invariants(kind, last);
          if (expected.empty())
            expected = numbers;
          for (unsigned int i = 0; i < numbers.size(); ++i)
            report.require(name + ", invariant " + std::to_string(i),
                           numbers[i] / expected[i] - 1.,
                           1e-8);
          const auto [force, moment] = Wedge(kind.dim, turned).load();
          if (kind.analysis == "statics")
            {
              report.require(
                name + ", sum of forces",
                (sum_of(last, kind.dim, "reaction") + force).norm(),
                1e-10 * force.norm());
              report.require(name + ", sum of moments",
                             (sum_of(last, kind.dim, "moment") + moment).norm(),
                             1e-10 * force.norm());
              continue;
            }
          // what supports and loads give in a step is momentum
          double worst = 0.;
          for (unsigned int i = 1; i < lines.size(); ++i)
            {
              const auto total = [&, f = force](const auto &line) {
                return sum_of(line, kind.dim, "reaction") +
                       value(line, "time") * f;
              };
              const Tensor<1, 3> gain =
                vector_of(lines[i], kind.dim, "momentum ") -
                vector_of(lines[i - 1], kind.dim, "momentum ");
              const double step =
                value(lines[i], "time") - value(lines[i - 1], "time");
              const Tensor<1, 3> given =
                0.5 * step * (total(lines[i]) + total(lines[i - 1]));
              worst = std::max(worst, (gain - given).norm());
            }
          report.require(name + ", momentum",
                         lines.size() > 2 ? worst : 1.,
                         1e-10 * force.norm());
        }
  }

  /** Hanging nodes on slopes. */
  void
  refined_wedge(Report &report, const Kind &kind)
  {
    SceneFile file = wedge_scene(kind, true);
    file.set({"Refinement"}, "Cycles in first step", "2");
    file.set({"Refinement"}, "Refine fraction", "0.1");
    const Wedge  wedge(kind.dim, true);
    std::string  probes;
    const double n = 7.;
    for (unsigned int i = 0; i <= n; ++i)
      probes += (i > 0 ? ";" : "") +
                vector_text(wedge.place(-std::sqrt(3.) * i / n, i / n, 0.4),
                            kind.dim,
                            ",");
    if (kind.dim == 2)
      {
        file.set({"Output"}, "Probe points", probes);
        const auto last = run(file).back();
        for (unsigned int i = 0; i <= n; ++i)
          {
            const Tensor<1, 3> u = vector_of(
              last, 2, "displacement ", " at probe " + std::to_string(i + 1));
            report.require(kind.name() + ", normal displacement of the slope",
                           u * wedge.place(0.5, std::sqrt(.75)),
                           1e-13 + 1e-11 * u.norm()); // of 12 digits
          }
      }
    const auto last            = run(file).back();
    const auto [force, moment] = wedge.load();
    report.require(kind.name() + ", forces of a refined wedge",
                   (sum_of(last, kind.dim, "reaction") + force).norm(),
                   1e-10 * force.norm());
    report.require(kind.name() + ", moments of a refined wedge",
                   (sum_of(last, kind.dim, "moment") + moment).norm(),
                   1e-10 * force.norm());
  }

  /** A component that is prescribed, and a slope: the other one follows. */
  void
  pushed_wedge(Report &report, Kind kind)
  {
    for (const bool reversed : {false, true})
      {
        kind.reversed                 = reversed;
        std::vector<Section> sections = {
          {"slope", {{"Symmetry", "true"}}},
          {"floor",
           {{"Displacement x",
             kind.analysis == "statics" ? "0.01*t" : "0.01*t^2"}}}};
        if (kind.dim == 3)
          sections.push_back({"front", {{"Symmetry", "true"}}});
        SceneFile file = elastic_scene(kind, sections);
        Wedge(kind.dim, false).set_geometry(file);
        file.set({"Output"},
                 "Probe points",
                 kind.dim == 2 ? "0, 0" : "0, 0, 0");
        const auto         last = run(file).back();
        const Tensor<1, 3> u =
          vector_of(last, kind.dim, "displacement ", " at probe 1");
        const Tensor<1, 3> expected({0.01, -0.01 / std::sqrt(3.), 0.});
        report.require(kind.name() + ", corner of a wedge that is pushed",
                       (u - expected).norm(),
                       1e-12);
        if (kind.analysis == "explicit")
          report.require(kind.name() + ", energy gap of it",
                         value(last, "energy gap"),
                         1e-12);
      }
  }

  /** Planes that meet at re-entrant edges and corners, against components. */
  void
  reentrant(Report &report, const Kind &kind, const std::string &cycles)
  {
    std::array<PhysicalNumbers::Line, 2> last;
    for (const bool by_components : {true, false})
      {
        std::vector<Section> sections;
        std::string          names;
        for (int d = 0; d < kind.dim; ++d)
          {
            const std::string name = "inner" + axes[d];
            sections.push_back(
              {name,
               {by_components ?
                  std::make_pair("Displacement " + axes[d], "0") :
                  std::make_pair(std::string("Symmetry"), "true")}});
            names += name + ": abs(" + axes[d] + ") < 1e-3; ";
          }
        const std::string ramp =
          kind.analysis == "statics" ? "0.01*t" : "0.01*t^2";
        sections.push_back(
          {"left", {{"Displacement x", ramp}, {"Displacement y", "0"}}});
        sections.push_back({"base", {{"Displacement y", ramp}}});
        SceneFile file = elastic_scene(kind, sections);
        file.set({"Geometry"}, "Generator", "hyper_L");
        file.set({"Geometry"}, "Arguments", "-1 : 1 : false");
        file.set({"Geometry"},
                 "Boundary names",
                 names + "left: x < -0.999; base: y < -0.999");
        file.set({"Geometry"}, "Initial refinement", "1");
        file.set({"Output"},
                 "Probe points",
                 kind.dim == 2 ? "0, 0; -1, -1" : "0, 0, 0; -1, -1, -0.5");
        if (!cycles.empty())
          {
            file.set({"Refinement"}, "Cycles in first step", cycles);
            file.set({"Refinement"}, "Refine fraction", "0.1");
          }
        last[by_components] = run(file).back();
      }
    const std::string name = kind.name() + ", re-entrant";
    report.require(
      name + ", displacement of the corner",
      vector_of(last[0], kind.dim, "displacement ", " at probe 1").norm(),
      1e-13);
    report.require(name + ", first value of two",
                   value(last[0], "displacement y at probe 2"),
                   1e-13);
    double scale = 0.;
    for (const auto &[column, number] : last[1])
      if (column.rfind("reaction", 0) == 0)
        scale = std::max(scale, std::abs(number));
    for (const auto &[column, number] : last[1])
      if (column.rfind("reaction", 0) == 0 || column.rfind("moment ", 0) == 0)
        report.require(name + ", " + column,
                       value(last[0], column) - number,
                       1e-8 * scale);
    report.require(name + ", cells",
                   value(last[0], "cells") - value(last[1], "cells"),
                   0.);
  }
} // namespace

int
main(int argc, char **argv)
{
  return Verification::main(argc, argv, [](Report &report) {
    for (const Kind &kind : kinds())
      {
        turned_wedge(report, kind);
        pushed_wedge(report, kind);
        reentrant(report, kind, "");
        if (kind.analysis == "statics")
          {
            refined_wedge(report, kind);
            reentrant(report, kind, "2");
          }
      }
  });
}
