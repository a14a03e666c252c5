// The driver of one material point against exact answers under mixed control,
// and what it says about wrong files.

#include "verdicts.h"

#include <signoton/base/function.h>
#include <signoton/base/mpi_session.h>
#include <signoton/drivers/point.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <fstream>
#include <iostream>

using namespace Signoton;

namespace
{
  const std::string granular = "subsection Materials\n"
                               "subsection sand\n"
                               "set Rheology = elastic granular\n"
                               "set Bulk modulus = 1\n"
                               "set Shear modulus = 0.6\n"
                               "set Admissible set = mises schleicher\n"
                               "set Friction parameter = 0.5\n"
                               "end\nend\n";

  /** The columns of all lines. */
  std::vector<std::vector<double>>
  lines_of(const std::string &file)
  {
    std::ifstream                    csv(file);
    std::vector<std::vector<double>> lines;
    std::string                      line;
    for (std::getline(csv, line); std::getline(csv, line);)
      lines.push_back(
        Utilities::string_to_double(Utilities::split_string_list(line, ',')));
    return lines;
  }

  /** The columns of the last line that a program ends with. */
  std::vector<double>
  last_line(const std::string &text, ExitStatus *status = nullptr)
  {
    PointDriver point(MPI_COMM_SELF, SceneFile::parse(text, "test.prm"));
    point.directory        = "results";
    const ExitStatus found = point.run();
    if (status != nullptr)
      *status = found;
    else if (found != ExitStatus::completed)
      return {};
    return lines_of("results/point.csv").back();
  }

  std::string
  program(const std::string &entries)
  {
    return "subsection Program\n" + entries + "end\n";
  }

  std::string
  material(const std::string &entries)
  {
    return "subsection Materials\nsubsection m\n" + entries + "end\nend\n";
  }

  bool
  near(const double a, const double b, const double tolerance)
  {
    std::cout << a << " " << b << std::endl;
    return std::abs(a - b) <= tolerance;
  }

  /** The hinge on the conditional stress s: opened, sheared beyond its
   *  strength, sheared back and closed (doc/equations.md). */
  void
  conditional_flow(Verdicts &verdict)
  {
    const auto shear = [](const std::string &flow) {
      std::string path = "set Kind = components\nset End time = 4\n"
                         "set Strain xy = 0: 0, 1: 0, 2: 1, 3: 0.5\n";
      for (const std::string axis : {"xx", "yy", "zz"})
        path += "set Strain " + axis +
                " = 0: 0, 1: 1, 3: 1, 4: -0.3333333333333333\n";
      return last_line(material("set Rheology = elastic plastic granular\n"
                                "set Plastic flow = " +
                                flow +
                                "\nset Admissible set = mises schleicher\n"
                                "set Bulk modulus = 1.5\n"
                                "set Shear modulus = 0.7\n"
                                "set Friction parameter = 0.5\n"
                                "set Shear strength = 0.4\n") +
                       program(path))
        .at(10);
    };
    verdict("conditional flow", near(shear("conditional"), -.3, 1e-8));
    verdict("flow in series", near(shear("series"), .4, 1e-8));

    // While the conditional stress stays in the cone both are the same, under
    // stresses as well: here with all but one of them given.
    const auto last = [](const std::string &flow, const std::string &kind) {
      return last_line(
        material("set Rheology = elastic plastic granular\n"
                 "set Plastic flow = " +
                 flow +
                 "\nset Admissible set = mises schleicher\n"
                 "set Friction parameter = 0.5\n"
                 "set Bulk modulus = 1\nset Shear modulus = 0.6\n"
                 "set Shear strength = 1e-3\nset Cohesion = 1e-2\n") +
        program("set Kind = " + kind +
                "\nset Confining pressure = 3e-3\n"
                "set Strain = 0: 0, 1: -4e-3, 2: -1e-3\n"));
    };
    for (const std::string kind : {"triaxial", "simple shear"})
      {
        const auto series = last("series", kind),
                   other  = last("conditional", kind);
        bool good         = series.size() > 19 && other.size() == series.size();
        for (std::size_t c = 1; good && c < 14; ++c)
          good = near(series[c], other[c], 1e-8 * 4e-3);
        verdict("conditional flow under stresses as in series, " + kind,
                good && series[19] > 1e-6 * series[17]);
      }
  }

  /** What steps see where stresses vanish. */
  void
  open_contacts(Verdicts &verdict)
  {
    // Kelvin-Voigt grains, of modulus k and viscosity eta, are compressed by
    // 8e-4 in a time of 1 and opened at the same rate: they open at once, for
    // eta > k, and their strain decays as exp(-k/eta (t - 1)) until the
    // boundary, which comes back from t = 3 on, meets them.
    const double k = 7e7, eta = 9e7, rate = 8e-4;
    const auto   visco = material(
      "set Rheology = series(parallel(spring(bulk = 7e7, shear = 4e7), "
        "damper(bulk viscosity = 9e7, shear viscosity = 5e7)), "
        "contact(hydrostatic))\n");
    const bool completed =
      !last_line(
         visco +
         program("set Kind = hydrostatic\n"
                 "set Strain = 0: 0, 1: -8e-4, 2: 0, 3: 0, 4: -8e-4\n") +
         "subsection Time steps\nset Tolerance = 1e-6\nend\n")
         .empty();
    double early = 3., late = 4.;
    while (late - early > 1e-12)
      {
        const double t = 0.5 * (early + late);
        (t - 3. < std::exp(-k / eta * (t - 1.)) ? early : late) = t;
      }
    double closed = 0.;
    for (const auto &line : lines_of("results/point.csv"))
      if (line[0] > 3. && !(closed > 0.) && line[15] < -1e-3 * k * rate)
        closed = line[0];
    verdict("relaxation behind an open contact is followed",
            completed && near(closed, early, 4e-4));

    // no stress at all: steps as large as they may be
    const auto steps = [](const std::string &text) {
      return last_line(text).empty() ? 1e9 :
                                       lines_of("results/point.csv").size();
    };
    verdict("no small steps at zero stress",
            steps(visco + program("set Kind = hydrostatic\n"
                                  "set Strain = 1e-3*t*t\n")) < 1000 &&
              steps(visco + program("set Kind = hydrostatic\n"
                                    "set Strain = 1e-3*sin(3*t)\n")) < 1000 &&
              steps(granular + program("set Strain = 1e-3*t\n")) < 300 &&
              steps(granular + program("set Kind = uniaxial\n"
                                       "set Strain = 1e-3*sin(6*t)\n")) < 500);
  }

  /** Steps that are long meet turning points of expressions. */
  void
  kinks(Verdicts &verdict)
  {
    last_line(material("set Rheology = elastic\nset Bulk modulus = 1\n"
                       "set Shear modulus = 0.6\n") +
              program("set Strain = 1e-3*min(t/0.37, 1)*if(t < 0.71, 1, "
                      "1.71 - t)\n") +
              "subsection Time steps\nset Tolerance = 0\nset Largest step = "
              "1\nend\n");
    std::vector<double> times;
    for (const auto &line : lines_of("results/point.csv"))
      times.push_back(line[0]);
    verdict("turning points of expressions",
            times.size() == 4 && near(times[1], .37, 1e-11) &&
              near(times[2], .71, 1e-11) && near(times[3], 1., 1e-11));
  }

  void
  complain(std::ofstream     &output,
           const std::string &what,
           const std::string &text)
  {
    output << what << ":\n";
    try
      {
        PointDriver(MPI_COMM_SELF, SceneFile::parse(text, "test.prm"));
        output << "no complaint\n";
      }
    catch (const UserError &error)
      {
        output << error.what();
      }
    output << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  Verdicts   verdict;
  const auto near = [](const double a, const double b) {
    std::cout << a << " " << b << std::endl;
    return std::abs(a - b) <= 1e-8 * std::abs(b);
  };

  // triaxial compression: the cone is reached, then lateral expansion. Strains
  // count from the isotropic state, which is at -p / (3 k).
  const double pressed = -1e-3 / 3.;
  const auto   triaxial =
    last_line(granular + program("set Kind = triaxial\n"
                                 "set Strain = -(6e-3 - 1e-3 / 3) * t\n"
                                 "set Confining pressure = 1e-3\n"));
  verdict("triaxial, lateral strain",
          near(triaxial.at(2) + pressed, 5.25253167e-3));
  verdict("triaxial, axial stress", near(triaxial.at(7), -2.21748226e-3));
  verdict("triaxial, volume strain",
          near(triaxial.at(13) + 3. * pressed, 4.505063e-3) ||
            std::abs(triaxial.at(13) + 3. * pressed - 4.505063e-3) < 1e-9);
  const auto first = lines_of("results/point.csv").at(0);
  verdict("triaxial, isotropic at the start",
          near(first.at(7), -1e-3) && near(first.at(8), -1e-3) &&
            near(first.at(9), -1e-3) && std::abs(first.at(1)) < 1e-15 &&
            std::abs(first.at(2)) < 1e-15);

  // simple shear under constant normal stress, by its parameter psi
  const double kappa = 0.5, k = 1., mu = 0.6, N = 1e-3, psi = 2.,
               D = mu + kappa * kappa * k, c = std::cos(psi),
               slope = 1. + 2. * kappa / std::sqrt(3.) * c,
               R     = N * D / (mu * k * (kappa + std::sqrt(0.75) * c) * slope);
  std::ostringstream entries;
  entries.precision(17);
  entries << "set Kind = simple shear\nset Strain = " << R * std::sin(psi) / 2.
          << " * t\nset Confining pressure = 1e-3\n";
  const auto shear = last_line(granular + program(entries.str()));
  verdict("simple shear, shear stress",
          near(shear.at(10), N * kappa * std::sin(psi) / slope));
  verdict("simple shear, normal strain",
          near(shear.at(2), -std::sqrt(0.75) * R * c));

  // creep: 1 - exp(-t) of the final strain
  const auto creep = last_line(
    "subsection Materials\nsubsection m\nset Rheology = parallel("
    "spring(bulk = 1, shear = 0.5), damper(bulk viscosity = 1, "
    "shear viscosity = 0.5))\nend\nend\n" +
    program("set Kind = uniaxial\nset Stress = 1e-3\nset End time = 3\n"));
  const double young = 9. * 0.5 / 3.5;
  verdict("creep",
          std::abs(creep.at(1) * young / 1e-3 - (1. - std::exp(-3.))) < 2e-3);
  const double spent = creep.at(18) + creep.at(19);
  verdict("work is stored, dissipated, and little lost by the time steps",
          spent < creep.at(17) && spent > 0.99 * creep.at(17));

  // a stress slightly above the strength, which strains cannot meet
  const std::string hinge =
    "subsection Materials\nsubsection m\nset Rheology = series(spring("
    "bulk = 1, shear = 0.6), hinge(von mises, strength = 1e-3))\nend\nend\n";
  ExitStatus end_status;
  const auto unbearable =
    last_line(hinge +
                program("set Kind = uniaxial\nset Stress = 1.7321e-3 * t\n"),
              &end_status);
  verdict("no state above the strength",
          end_status == ExitStatus::no_equilibrium);
  verdict("the last state is at the strength",
          near(unbearable.at(7), std::sqrt(3.) * 1e-3));
  const auto constant_steps =
    last_line(hinge +
                program(
                  "set Strain = 0: 0, 0.5: 1e-2, 0.5000000001: 0, 1: 5e-3\n") +
                "subsection Time steps\nset Tolerance = 0\nset Largest step = "
                "1e30\nend\n",
              &end_status);
  verdict("a jump, in the largest steps there are",
          end_status == ExitStatus::completed &&
            std::abs(constant_steps.at(0) - 1.) < 1e-8);

  conditional_flow(verdict);
  open_contacts(verdict);
  kinks(verdict);

  std::ofstream output("output", std::ios::app);
  complain(output, "no program", granular);
  complain(output,
           "both",
           granular + program("set Strain = t\nset Stress = t\n"));
  complain(output,
           "a table out of order",
           granular + program("set Strain = 0: 0, 2: 1, 1: 0\n"));
  complain(output,
           "space in an expression",
           granular + program("set Strain = x * t\n"));
  complain(output,
           "component with another kind",
           granular + program("set Strain xx = t\n"));
  complain(output,
           "useless pressure",
           granular + program("set Strain = t\nset Confining pressure = 1\n"));
  complain(output,
           "a spring in series with the hinge",
           "subsection Materials\nsubsection m\nset Rheology = series(spring("
           "bulk = 1, shear = 1), parallel(spring(bulk = 1, shear = 1), "
           "hinge(von mises, strength = 1)))\nend\nend\n" +
             program("set Strain = t\n"));
  complain(output,
           "ill-posed scheme by strain",
           "subsection Materials\nsubsection m\nset Rheology = parallel(spring("
           "bulk = 1, shear = 1), hinge(von mises, strength = 1))\nend\nend\n" +
             program("set Strain = t\n"));
  complain(output,
           "scheme by a wrong name",
           "subsection Materials\nsubsection m\nset Rheology = maxwell "
           "granulat\nend\nend\n" +
             program("set Strain = t\n"));
  complain(output,
           "scheme with an error",
           "subsection Materials\nsubsection m\nset Rheology = series(spring("
           "bulk = 1, shear = 1), contact(coulomb mohr, friction = 30))\n"
           "end\nend\n" +
             program("set Strain = t\n"));
  complain(output,
           "no number in a table",
           granular + program("set Strain = 0: 0, 1: nan\n"));
  complain(output,
           "a damper that flows freely",
           "subsection Materials\nsubsection m\nset Rheology = series(spring("
           "bulk = 1, shear = 1), damper(shear viscosity = 1))\nend\nend\n" +
             program("set Stress = t\n"));
  complain(output,
           "a scheme with the name of a ready one",
           "subsection Schemes\nset elastic = spring(bulk = 1, shear = 1)\n"
           "end\n" +
             granular + program("set Strain = t\n"));
  return verdict.status();
}
