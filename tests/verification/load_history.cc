// Loads that bend or jump in time: steps meet these times, whatever their size,
// in statics also after a cut; the work of loads is what the body has got;
// impulses of jumping loads are exact in dynamics.

#include "box_scene.h"
#include "verdicts.h"
#include "wave_scene.h"

using namespace Verification;
using PhysicalNumbers::value;
using Lines = std::vector<PhysicalNumbers::Line>;

namespace
{
  /** A confined elastic column under a program in time at its upper end, whose
   *  modulus is 1 + 4/3 0.75 = 2. */
  Lines
  column(const int          dim,
         const unsigned int degree,
         const std::string &key,
         const std::string &program,
         const Overrides   &overrides = {})
  {
    SceneFile file = box_scene(dim, 1, degree);
    file.set({"Materials", "rock"}, "Rheology", "elastic");
    file.set({"Materials", "rock"}, "Bulk modulus", "1");
    file.set({"Materials", "rock"}, "Shear modulus", "0.75");
    for (const std::string &side :
         dim == 2 ?
           std::vector<std::string>{"left", "right", "bottom"} :
           std::vector<std::string>{"left", "right", "front", "back", "bottom"})
      file.set({"Boundaries", side}, "Symmetry", "true");
    file.set({"Boundaries", "top"}, key, program);
    file.set({"Load steps"}, "Step size", "0.5");
    file.set({"Load steps"}, "End time", "2");
    return run(file, overrides);
  }

  /** Whether the lines are at these times, and the stored energy is that of a
   *  displacement u of the column's end there; so is the work. */
  bool
  agree(const Lines                                  &lines,
        const std::vector<std::pair<double, double>> &expected)
  {
    bool good = lines.size() == expected.size();
    for (std::size_t i = 0; i < lines.size(); ++i)
      {
        const double stored = value(lines[i], "stored energy"),
                     work   = value(lines[i], "external work");
        std::cout << value(lines[i], "time") << " " << stored << " " << work
                  << " " << value(lines[i], "energy gap") << "\n";
        if (!good)
          continue;
        const auto [time, u] = expected[i];
        good = std::abs(value(lines[i], "time") - time) < 1e-11 &&
               std::abs(stored - u * u) < 1e-9 * 1e-4 &&
               std::abs(work - stored) < 1e-9 * 1e-4 &&
               std::abs(value(lines[i], "energy gap")) < 1e-9;
      }
    std::cout << std::endl;
    return good;
  }

  void
  columns(Verdicts &verdict, const int dim, const unsigned int degree)
  {
    const std::string with =
      " (" + std::to_string(dim) + "D, degree " + std::to_string(degree) + ")";
    // the pressure p makes u = p / 2
    verdict(
      "a turning point" + with,
      agree(
        column(dim, degree, "Pressure", "2e-2*if(t < 0.7, t, 1.4 - t)"),
        {{.5, .5e-2}, {.7, .7e-2}, {1.2, .2e-2}, {1.7, -.3e-2}, {2., -.6e-2}}));
    verdict(
      "the same by a table" + with,
      agree(
        column(dim,
               degree,
               "Pressure",
               "0: 0, 0.7: p, 2: -6*p/7",
               {"Loads/Constants=p = 1.4e-2"}),
        {{.5, .5e-2}, {.7, .7e-2}, {1.2, .2e-2}, {1.7, -.3e-2}, {2., -.6e-2}}));
    const std::string zero = dim == 2 ? "0; " : "0; 0; ";
    verdict(
      "a traction that jumps" + with,
      agree(column(dim, degree, "Traction", zero + "if(t > 0.7, 1e-2, -2e-2)"),
            {{.5, 1e-2},
             {.7, 1e-2},
             {.7, .5e-2},
             {1.2, .5e-2},
             {1.7, .5e-2},
             {2., .5e-2}}));
    const std::string axis = dim == 2 ? "y" : "z";
    verdict("a prescribed displacement, without a sliver" + with,
            agree(column(dim,
                         degree,
                         "Displacement " + axis,
                         "-1e-2*min(t/0.52, 1)",
                         {"Load steps/Times=1.3, 2"}),
                  {{.26, .5e-2},
                   {.52, 1e-2},
                   {1.02, 1e-2},
                   {1.3, 1e-2},
                   {1.8, 1e-2},
                   {2., 1e-2}}));
  }

  /** A plate that is pressed into Coulomb-Mohr ground, and pulled back from
   *  t = 1 on. */
  Lines
  plate(const Overrides &overrides)
  {
    SceneFile file;
    file.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
    file.set({"Geometry"}, "Arguments", "8, 8 : 0, 0 : 1, 1 : true");
    file.set({"Geometry"}, "Boundary names", "plate: y > 0.999 && x < 0.25");
    const SceneFile::Path ground = {"Materials", "ground"};
    file.set(ground, "Rheology", "elastic plastic");
    file.set(ground, "Admissible set", "coulomb mohr");
    file.set(ground, "Friction angle", "20");
    file.set(ground, "Cohesion", "1e4");
    file.set(ground, "Young modulus", "1e7");
    file.set(ground, "Poisson ratio", "0.3");
    for (const char *side : {"left", "right"})
      file.set({"Boundaries", side}, "Symmetry", "true");
    file.set({"Boundaries", "bottom"}, "Displacement x", "0");
    file.set({"Boundaries", "bottom"}, "Displacement y", "0");
    file.set({"Boundaries", "plate"},
             "Displacement y",
             "-0.05*if(t < 1, t, 2 - t)");
    file.set({"Load steps"}, "End time", "1.5");
    file.set({"Load steps"}, "Step size", "0.5");
    return run(file, overrides);
  }

  void
  cut_steps(Verdicts &verdict)
  {
    const Lines whole = plate({});
    verdict("whole steps of plastic ground",
            whole.size() == 3 &&
              std::abs(value(whole.back(), "dissipated energy") / 2099.3 - 1) <
                1e-3 &&
              std::abs(value(whole.back(), "reaction plate y") / 4000.9 - 1) <
                1e-3);
    const Lines cut = plate({"Newton/Maximum iterations=7"});
    // all ends of whole steps, and the others in the middle of what was cut
    bool        good = cut.size() > 3;
    std::size_t met  = 0;
    double      last = 0.;
    for (const auto &line : cut)
      {
        const double time     = value(line, "time"),
                     size     = value(line, "step size"),
                     halvings = std::log2(0.5 / size);
        std::cout << time << " " << size << std::endl;
        good &= std::abs(halvings - std::round(halvings)) < 1e-9 &&
                std::abs(time - last - size) < 1e-9;
        last = time;
        met += std::abs(std::remainder(time, 0.5)) < 1e-12 ? 1 : 0;
      }
    verdict("halves of steps that are cut end where these would", //
            good && met == 3);
    // the same as with these steps from the start
    std::string times = "Load steps/Times=";
    for (const auto &line : cut)
      times += text(value(line, "time")) + ",";
    times.pop_back();
    const Lines same = plate({times});
    verdict("as if they had not been tried",
            same.size() == cut.size() &&
              std::abs(value(cut.back(), "dissipated energy") /
                         value(same.back(), "dissipated energy") -
                       1.) < 1e-7 &&
              std::abs(value(cut.back(), "reaction plate y") /
                         value(same.back(), "reaction plate y") -
                       1.) < 1e-6);
    // the work of a body with history closes up to the error of its steps
    std::vector<double> gaps;
    for (const std::string size : {"0.1", "0.05", "0.025"})
      gaps.push_back(std::abs(
        value(plate({"Load steps/Step size=" + size}).back(), "energy gap")));
    std::cout << gaps[0] << " " << gaps[1] << " " << gaps[2] << std::endl;
    verdict("the energy gap of plastic ground falls with its steps",
            gaps[0] < 0.05 && gaps[1] < 0.6 * gaps[0] &&
              gaps[2] < 0.6 * gaps[1] && gaps[2] > 0.);
  }

  /** A free block under a pressure: momentum at the end. */
  double
  impulse(const int          dim,
          const std::string &pressure,
          const double       end,
          const Overrides   &overrides)
  {
    SceneFile file = wave_box(dim,
                              1,
                              dim == 2 ? "2, 2 : 0, 0 : 1, 1 : true" :
                                         "1, 1, 1 : 0, 0, 0 : 1, 1, 1 : true",
                              "elastic");
    file.set({"Boundaries", "top"}, "Pressure", pressure);
    file.set({"Time integration"}, "End time", text(end));
    const auto   last = run(file, overrides).back();
    const double p    = value(last, dim == 2 ? "momentum y" : "momentum z");
    std::cout << pressure << ": " << p << ", gap " << value(last, "energy gap")
              << ", steps " << value(last, "step") << std::endl;
    return std::abs(value(last, "energy gap")) < 1e-9 ? -p : 1e300;
  }

  void
  impulses(Verdicts &verdict)
  {
    const auto near = [](const double a, const double b) {
      return std::abs(a / b - 1.) < 1e-9;
    };
    for (const int dim : {2, 3})
      for (const Overrides &scheme :
           {Overrides{},
            Overrides{"Time integration/Scheme=implicit"},
            Overrides{"Time integration/Scheme=implicit",
                      "Time integration/Time step=0.17",
                      "Time integration/Spectral radius=0.5"}})
        {
          const std::string with =
            " (" + std::to_string(dim) + "D, " +
            (scheme.empty()     ? "explicit)" :
             scheme.size() == 1 ? "implicit)" :
                                  "implicit, fixed steps)");
          verdict(
            "a rectangular pulse" + with,
            near(impulse(dim, "1e-2*(t > 0.123 & t < 1.0456)", 2., scheme),
                 .9226e-2));
          verdict("from the start" + with,
                  near(impulse(dim, "1e-2*(t > 0 & t <= 0.31)", 1., scheme),
                       .31e-2));
          verdict(
            "much shorter than steps" + with,
            near(impulse(dim, "10*(abs(t - 5.0005) < 0.0005)", 10., scheme),
                 1e-2));
        }
    // smooth pulses: the integrals are sqrt(pi) 1e-2 and 2e-2/pi
    for (const std::string pulse :
         {"1*exp(-((t - 5) / 1e-2)^2)",
          "1*(t > 5 & t < 5.01)*sin(pi*(t - 5)/0.01)"})
      {
        const double found =
          impulse(2, pulse, 10., {"Time integration/Scheme=implicit"});
        const double exact =
          pulse[2] == 'e' ? 1e-2 * std::sqrt(M_PI) : 2e-2 / M_PI;
        verdict("a smooth pulse much shorter than steps",
                std::abs(found / exact - 1.) < 0.05);
      }
    // straight lines between times that are met: the trapezoidal rule is exact
    verdict("a triangular pulse by a table",
            near(impulse(2, "0.2: 0, 0.5: 1e-2, 1.3: 0", 1.5, {}), .55e-2));
    verdict("a saw tooth",
            near(impulse(2, "1e-2*(3*t - floor(3*t))", 2., {}), 1e-2));

    SceneFile file = wave_box(2, 1, "1, 1 : 0, 0 : 1, 1 : true", "elastic");
    file.set({"Boundaries", "bottom"}, "Velocity y", "0.1*(t < 1.05)");
    file.set({"Time integration"}, "End time", "2");
    file.set({"Output"}, "Probe points", "0.5, 0");
    const double moved = value(run(file).back(), "displacement y at probe 1");
    verdict("a motion that stops", near(moved, .105));
  }
} // namespace

int
main(int argc, char **argv)
{
  Signoton::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  Verdicts                                   verdict;
  for (const int dim : {2, 3})
    for (const unsigned int degree : {1, 2})
      columns(verdict, dim, degree);
  cut_steps(verdict);
  impulses(verdict);
  return verdict.status();
}
