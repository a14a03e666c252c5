#ifndef signoton_base_output_file_h
#define signoton_base_output_file_h

#include <deal.II/base/mpi.h>

#include <string>

namespace Signoton
{
  using namespace dealii;

  /**
   * Whether write_file() begins a file or goes on with it. A file that is
   * replaced is there as it was, or as it is to be, whatever happens: the new
   * one is written beside it, with the ending `.part`, is brought to the disk
   * and takes its name. What does not fit behind a file is cut off again.
   */
  enum class WriteMode
  {
    replace,
    append
  };

  /**
   * Write a text on the ranks for which @p i_write holds, each to its own file.
   * To be called by all ranks: if one cannot write, all throw a UserError with
   * the status ExitStatus::output_failed, and none waits for the others.
   */
  void
  write_file(const MPI_Comm    &communicator,
             const std::string &file_name,
             const std::string &text,
             const bool         i_write,
             const WriteMode    mode = WriteMode::replace);

  /** The same, on the first rank alone. */
  void
  write_file(const MPI_Comm    &communicator,
             const std::string &file_name,
             const std::string &text,
             const WriteMode    mode = WriteMode::replace);

  /** Bring a file, or the names in a directory, to the disk; whether they are
   *  there. */
  bool
  synchronize(const std::string &path);
} // namespace Signoton

#endif
