#ifndef signoton_drivers_output_directory_h
#define signoton_drivers_output_directory_h

#include <signoton/base/output_file.h>

#include <set>
#include <vector>

namespace Signoton
{
  /**
   * The directory that a run writes to, and the guard of all else in it.
   *
   * What runs have written is listed in the file `signoton.files` there, each
   * name before the file is made. A later run removes these files and no
   * others; it refuses a directory in which a file that is not in the list has
   * a name that it is going to use.
   *
   * The list is locked as long as a run is at work, so that a second one does
   * not mix its lines with those of the first. The lock ends with the process,
   * however that ends.
   *
   * All functions are collective, and throw on all ranks alike, a UserError
   * with the status ExitStatus::output_failed.
   */
  class OutputDirectory
  {
  public:
    /** @param path of which nothing is touched until lock() or begin() */
    OutputDirectory(const MPI_Comm &communicator, const std::string &path);
    ~OutputDirectory();
    OutputDirectory(const OutputDirectory &) = delete;

    /** Make the directory, unless it is there, and keep other runs from it. */
    void
    lock();

    /** Lock, refuse what is not ours, and remove what earlier runs have
     *  written.
     *  @param names a regular expression of all names that the run may write */
    void
    begin(const std::string &names);

    /** The path of a file, or of a directory, that the run is going to write;
     *  it enters the list. */
    std::string
    path_of(const std::string &name);

    /** Enter several names. */
    void
    enter(const std::vector<std::string> &names);

    const std::string path;

  private:
    /** Run an action on the first rank; what it complains about, all throw.
     *  @param expected and the advice of the message */
    template <typename Action>
    void
    decide(const Action      &action,
           const std::string &expected,
           const std::string &try_this) const;

    std::string
    acquire();

    /** A name that the run may write, in a directory where it is not ours. */
    std::string
    foreign_file(const std::string &names) const;

    /** Remove what is in the list, and begin a new one. */
    std::string
    remove_earlier();

    /** Append to the list; what went wrong. */
    std::string
    note(const std::string &text);

    MPI_Comm              communicator;
    int                   list = -1; ///< on the first rank, open and locked
    std::set<std::string> entered;   ///< by this run
  };
} // namespace Signoton

#endif
