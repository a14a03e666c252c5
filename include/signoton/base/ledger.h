#ifndef signoton_base_ledger_h
#define signoton_base_ledger_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <map>
#include <string>

namespace Signoton
{
  using namespace dealii;

  /**
   * What a run costs: seconds by phase, counts and bytes. Phases do not
   * nest, so that they add up; the rest of the wall time is "other".
   */
  class Ledger
  {
  public:
    explicit Ledger(const MPI_Comm &communicator);

    /** Counts the time until the end of the returned object's life. */
    class Scope
    {
    public:
      Scope(Ledger &ledger, const std::string &phase);
      ~Scope();
      Scope(const Scope &) = delete;

    private:
      Ledger     &ledger;
      std::string outer;
    };

    /** Time a phase; a phase begun within another one interrupts it. */
    Scope
    time(const std::string &phase)
    {
      return Scope(*this, phase);
    }

    /** Add to a count, for instance of iterations. */
    void
    count(const std::string &what, const double amount = 1.);

    /** Set the bytes of something, the sum over all ranks. */
    void
    bytes(const std::string &what, const std::size_t local_bytes);

    /** Wall seconds of a phase so far on this rank. */
    double
    seconds(const std::string &phase) const;

    /** Wall seconds since the ledger was opened. */
    double
    total_seconds() const;

    /** Peak resident memory of all ranks, in bytes. */
    double
    peak_memory() const;

    /** Write everything to a file in JSON. Collective: seconds are the
     *  maximum over the ranks. */
    void
    write(const std::string &file_name) const;

    /** The phases as a table for the end of a log. Collective. */
    std::string
    summary() const;

  private:
    /** Switch the running clock to another phase. */
    void
    enter(const std::string &phase);

    /** Seconds by phase, maximum over ranks, same keys on all. */
    std::map<std::string, double>
    gathered_seconds() const;

    MPI_Comm                      communicator;
    Timer                         total;
    Timer                         lap;
    std::string                   current;
    std::map<std::string, double> phases;
    std::map<std::string, double> counts;
    std::map<std::string, double> sizes;
  };
} // namespace Signoton

#endif
