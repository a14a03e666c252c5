#ifndef signoton_tests_verification_h
#define signoton_tests_verification_h

#include "physical_numbers.h"

#include <signoton/base/mpi_session.h>
#include <signoton/base/number.h>
#include <signoton/scene/scene.h>

#include <deal.II/base/convergence_table.h>

#include <filesystem>
#include <functional>
#include <iostream>

/**
 * Comparing runs of scenes with exact solutions. A test writes a table to the
 * file `output`, and fails by its exit status if an accuracy is missed: the
 * comparison of the table by numdiff does not see a loss in a small error.
 */
namespace Verification
{
  using namespace dealii;
  using PhysicalNumbers::value;
  using Overrides = std::vector<std::string>;

  inline const std::string source_directory = SIGNOTON_SOURCE_DIR;

  /** Collects the requirements of a test. */
  class Report
  {
  public:
    std::ofstream out{"output"};

    /** Require that @p error, which may have a sign, is within @p bound. */
    void
    require(const std::string &what, const double error, const double bound)
    {
      ++n_requirements;
      if (std::abs(error) <= bound)
        return;
      std::ostringstream text;
      text << "FAILED: " << what << " is " << error << ", allowed is " << bound
           << '\n';
      missed += text.str();
    }

    /** Require a measured order of convergence. */
    void
    require_order(const std::string &what,
                  const double       order,
                  const double       expected)
    {
      require(what + ", order " + std::to_string(order) + " short of " +
                std::to_string(expected),
              std::max(expected - order, 0.),
              0.);
    }

    /** Print `ok` instead of a number that is pure round-off. */
    std::string
    round_off(const std::string &what, const double error, const double bound)
    {
      require(what, error, bound);
      return std::abs(error) <= bound ? "ok" : "wrong";
    }

    int
    status()
    {
      if (missed.empty())
        out << n_requirements << " requirements met" << std::endl;
      else
        out << missed << std::flush;
      return missed.empty() ? 0 : 1;
    }

  private:
    unsigned int n_requirements = 0;
    std::string  missed;
  };

  /** A number as scenes have it, with all digits. */
  inline std::string
  text(const double number)
  {
    return Signoton::number_text(number);
  }

  /** `Loads/Constants=...` with all digits. */
  inline std::string
  constants(const std::vector<std::pair<std::string, double>> &values)
  {
    std::string list;
    for (const auto &[name, number] : values)
      list += (list.empty() ? "" : ", ") + name + " = " + text(number);
    return "Loads/Constants=" + list;
  }

  /** Run a scene; how it ends. */
  inline Signoton::ExitStatus
  attempt(const std::string &scene_file, const Overrides &overrides)
  {
    Signoton::Options options;
    options.scene_file       = scene_file;
    options.output_directory = "results";
    // the others have read the last ones, and do not find them any more
    MPI_Barrier(MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::filesystem::remove_all("results");
    MPI_Barrier(MPI_COMM_WORLD);
    options.overrides = overrides;
    const bool is_dynamic =
      Signoton::SceneFile::read(scene_file).value({}, "Analysis") == "dynamics";
    options.overrides.emplace_back(is_dynamic ? "Time integration/Snapshots=0" :
                                                "Output/Fields every=0");
    return Signoton::run_scene(MPI_COMM_WORLD, options);
  }

  /** Run a scene; the statistics of all its steps. */
  inline std::vector<PhysicalNumbers::Line>
  run(const std::string &scene_file, const Overrides &overrides)
  {
    if (attempt(scene_file, overrides) != Signoton::ExitStatus::completed)
      throw std::runtime_error(scene_file + " found no equilibrium");
    return PhysicalNumbers::read("results/statistics.csv");
  }

  /** The same with a scene that the test has made, each rank for itself. */
  inline std::vector<PhysicalNumbers::Line>
  run(const Signoton::SceneFile &scene, const Overrides &overrides = {})
  {
    const std::string name =
      "scene" +
      std::to_string(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) + ".prm";
    std::ofstream(name) << scene.text();
    return run(name, overrides);
  }

  /** Bisection: the root of @p f between @p a and @p b. */
  inline double
  root(const std::function<double(double)> &f, double a, double b)
  {
    const bool rising = f(b) > f(a);
    for (unsigned int i = 0; i < 200; ++i)
      {
        const double middle                  = 0.5 * (a + b);
        ((f(middle) > 0.) == rising ? b : a) = middle;
      }
    return 0.5 * (a + b);
  }

  /** One mesh after the other, with the relative L2 error. */
  class Convergence
  {
  public:
    void
    add(const PhysicalNumbers::Line &line)
    {
      table.add_value("cells", static_cast<int>(value(line, "cells")));
      table.add_value("unknowns", static_cast<int>(value(line, "unknowns")));
      add_error("L2 error", value(line, "relative L2 error"));
      errors.push_back(value(line, "relative L2 error"));
    }

    void
    add_error(const std::string &name, const double error)
    {
      table.add_value(name, error);
      table.set_precision(name, 2);
      table.set_scientific(name, true);
    }

    void
    add_number(const std::string &name,
               const double       number,
               const unsigned int precision = 6)
    {
      table.add_value(name, number);
      table.set_precision(name, precision);
    }

    void
    print(std::ostream &out)
    {
      table.evaluate_convergence_rates("L2 error",
                                       ConvergenceTable::reduction_rate_log2);
      table.write_text(out);
      out << std::endl;
    }

    double
    last_error() const
    {
      return errors.back();
    }

    /** Order over the last @p n halvings of the mesh. */
    double
    order(const unsigned int n = 1) const
    {
      return std::log2(errors[errors.size() - 1 - n] / errors.back()) / n;
    }

    ConvergenceTable table;

  private:
    std::vector<double> errors;
  };

  inline std::string
  refinement(const unsigned int level)
  {
    return "Geometry/Initial refinement=" + std::to_string(level);
  }

  inline std::string
  degree(const unsigned int p)
  {
    return "Discretization/Degree=" + std::to_string(p);
  }

  /** Runs a test: prints what stops it, on all ranks. The first one reports. */
  inline int
  main(int argc, char **argv, const std::function<void(Report &)> &test)
  {
    Signoton::MPISession mpi(argc, argv);
    Report               report;
    const bool is_first = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    if (!is_first)
      {
        report.out.close();
        report.out.open("/dev/null");
      }
    MPI_Barrier(MPI_COMM_WORLD);
    try
      {
        test(report);
      }
    catch (const std::exception &error)
      {
        report.out << error.what() << std::endl;
        std::cerr << error.what() << std::endl;
        // the other ranks would wait for this one
        if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
          MPI_Abort(MPI_COMM_WORLD, 1);
        return 1;
      }
    return report.status();
  }
} // namespace Verification

#endif
