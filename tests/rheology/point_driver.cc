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
    std::ifstream csv("results/point.csv");
    std::string   line, last;
    while (std::getline(csv, line))
      last = line;
    return Utilities::string_to_double(Utilities::split_string_list(last, ','));
  }

  std::string
  program(const std::string &entries)
  {
    return "subsection Program\n" + entries + "end\n";
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

  // triaxial compression: the cone is reached, then lateral expansion
  const auto triaxial =
    last_line(granular + program("set Kind = triaxial\n"
                                 "set Strain = -6e-3 * t\n"
                                 "set Confining pressure = 1e-3\n"));
  verdict("triaxial, lateral strain", near(triaxial.at(2), 5.25253167e-3));
  verdict("triaxial, axial stress", near(triaxial.at(7), -2.21748226e-3));
  verdict("triaxial, volume strain",
          near(triaxial.at(13), 4.505063e-3) ||
            std::abs(triaxial.at(13) - 4.505063e-3) < 1e-9);

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
