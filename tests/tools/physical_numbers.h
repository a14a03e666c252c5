#ifndef signoton_tests_physical_numbers_h
#define signoton_tests_physical_numbers_h

#include <signoton/base/csv_table.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <map>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

/**
 * Reading the statistics of a run, and printing the physical ones in a form
 * that numdiff compares well: as mantissa and power of ten, since its absolute
 * tolerance would hide small numbers, and with round-off cut to zero.
 * Iteration counts and timings are left out.
 */
namespace PhysicalNumbers
{
  using Line = Signoton::CSVTable::Row;

  /** Whether it is a line of the statistics of statics. */
  inline bool
  is_static(const Line &line)
  {
    return std::any_of(line.begin(), line.end(), [](const auto &entry) {
      return entry.first == "transfer drift";
    });
  }

  /** All lines of a statistics.csv or another table, but for the state at the
   *  start of statics. */
  inline std::vector<Line>
  read(const std::string &file_name)
  {
    std::vector<Line> lines = Signoton::CSVTable::read(file_name);
    lines.erase(std::remove_if(lines.begin(),
                               lines.end(),
                               [](const Line &line) {
                                 return is_static(line) &&
                                        !(line[0].second > 0.);
                               }),
                lines.end());
    return lines;
  }

  inline double
  value(const Line &line, const std::string &name)
  {
    for (const auto &[key, number] : line)
      if (key == name)
        return number;
    throw std::runtime_error("no column '" + name + "'");
  }

  /** Quantities of one kind, which share a scale. */
  inline std::string
  group(const std::string &name)
  {
    if (name == "energy gap") // relative already
      return "share of";
    if (name.find("energy") != std::string::npos || name == "external work" ||
        name == "transfer drift" || name.rfind("lost by", 0) == 0)
      return "energy";
    for (const char *prefix : {"reaction",
                               "moment ",
                               "displacement",
                               "velocity",
                               "stress",
                               "traction",
                               "share of"})
      if (name.rfind(prefix, 0) == 0)
        return prefix;
    return name;
  }

  inline bool
  is_physical(const std::string &name)
  {
    for (const char *word : {"iterations",
                             "seconds",
                             "residual",
                             "memory",
                             "regularization",
                             "quiet"})
      if (name.find(word) != std::string::npos)
        return false;
    return true;
  }

  inline void
  print(std::ostream &out, const Line &line, const double noise = 1e-9)
  {
    std::map<std::string, double> scale;
    for (const auto &[name, number] : line)
      scale[group(name)] = std::max(scale[group(name)], std::abs(number));
    out << std::fixed << std::setprecision(7);
    for (const auto &[name, number] : line)
      // the gap of statics is the error of steps, or the tolerance of Newton
      if (is_physical(name) && !(name == "energy gap" && is_static(line)))
        {
          const double cut = name == "relative L2 error" ||
                                 name == "L2 error" ||
                                 group(name) == "share of" ?
                               noise :
                               noise * scale[group(name)];
          out << "  " << name << ": ";
          if (std::abs(number) <= cut)
            out << "0\n";
          else
            {
              // Mantissas between 300 and 3000: no jump near round numbers, and
              // the absolute tolerance 1e-6 of deal.II's tests is below their
              // relative one, 1e-8. A number far below others of its kind, as
              // a component across the motion, is known to a share of theirs:
              // digits below 1e-10 of the largest are round-off that grew, and
              // differ between processors.
              const auto round_log = [](const double x) {
                return static_cast<int>(
                  std::floor(std::log10(std::abs(x)) + 0.5));
              };
              const int exponent =
                std::max(round_log(number), round_log(scale[group(name)]) - 1) -
                3;
              out << number / std::pow(10., exponent) << " * 10^ " << exponent
                  << "\n";
            }
        }
  }
} // namespace PhysicalNumbers

#endif
