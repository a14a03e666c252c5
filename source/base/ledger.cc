#include <signoton/base/exceptions.h>
#include <signoton/base/ledger.h>
#include <signoton/base/output_file.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>

#include <iomanip>
#include <regex>
#include <sstream>

namespace Signoton
{
  Ledger::Scope::Scope(Ledger &ledger, const std::string &phase)
    : ledger(ledger)
    , outer(ledger.current)
  {
    ledger.enter(phase);
  }

  Ledger::Scope::~Scope()
  {
    ledger.enter(outer);
  }

  Ledger::Ledger(const MPI_Comm &communicator)
    : communicator(communicator)
    , current("other")
  {}

  void
  Ledger::enter(const std::string &phase)
  {
    phases[current] += lap.wall_time();
    lap.restart();
    current = phase;
  }

  void
  Ledger::count(const std::string &what, const double amount)
  {
    counts[what] += amount;
  }

  void
  Ledger::bytes(const std::string &what, const std::size_t local_bytes)
  {
    sizes[what] =
      Utilities::MPI::sum(static_cast<double>(local_bytes), communicator);
  }

  double
  Ledger::seconds(const std::string &phase) const
  {
    const auto found = phases.find(phase);
    return (found == phases.end() ? 0. : found->second) +
           (phase == current ? lap.wall_time() : 0.);
  }

  double
  Ledger::total_seconds() const
  {
    return total.wall_time();
  }

  double
  Ledger::peak_memory() const
  {
    Utilities::System::MemoryStats stats;
    Utilities::System::get_memory_stats(stats);
    return Utilities::MPI::sum(static_cast<double>(stats.VmHWM), communicator) *
           1024.;
  }

  std::map<std::string, double>
  Ledger::gathered_seconds() const
  {
    std::map<std::string, double> local, result;
    for (const auto &[phase, time] : phases)
      local[phase] = seconds(phase);
    local[current] = seconds(current);
    for (const auto &rank : Utilities::MPI::all_gather(communicator, local))
      for (const auto &[phase, time] : rank)
        result[phase] = std::max(result[phase], time);
    return result;
  }

  std::string
  Ledger::summary() const
  {
    const auto         all = gathered_seconds();
    std::ostringstream text;
    double             sum = 0.;
    for (const auto &[phase, time] : all)
      sum += time;
    text << std::fixed;
    for (const auto &[phase, time] : all)
      text << "  " << std::left << std::setw(24) << phase << std::right
           << std::setw(10) << std::setprecision(2) << time << " s"
           << std::setw(7) << std::setprecision(1)
           << 100. * time / std::max(sum, 1e-12) << " %\n";
    return text.str();
  }

  void
  Ledger::write(const std::string &file_name) const
  {
    const auto                  all  = gathered_seconds();
    const double                peak = peak_memory();
    boost::property_tree::ptree tree;
    const auto                  put = [&](const std::string &section,
                         const std::string &key,
                         const double       value) {
      tree.put(boost::property_tree::ptree::path_type(section + "|" + key, '|'),
               value);
    };
    put("run", "ranks", Utilities::MPI::n_mpi_processes(communicator));
    put("run", "wall seconds", total_seconds());
    put("run", "peak memory bytes", peak);
    for (const auto &[phase, time] : all)
      put("seconds", phase, time);
    for (const auto &[what, amount] : counts)
      put("counts", what, amount);
    for (const auto &[what, amount] : sizes)
      put("bytes", what, amount);
    std::ostringstream text;
    boost::property_tree::write_json(text, tree);
    // property trees know strings only
    write_file(communicator,
               file_name,
               std::regex_replace(text.str(),
                                  std::regex(": \"([^\"]*)\""),
                                  ": $1"));
  }
} // namespace Signoton
