#include <signoton/base/exceptions.h>
#include <signoton/base/output_file.h>

#include <fstream>

namespace Signoton
{
  void
  write_file(const MPI_Comm    &communicator,
             const std::string &file_name,
             const std::string &text,
             const bool         i_write,
             const WriteMode    mode)
  {
    std::ofstream file;
    if (i_write)
      {
        file.open(file_name,
                  mode == WriteMode::append ? std::ios::app : std::ios::out);
        file << text << std::flush;
      }
    if (Utilities::MPI::max(file ? 0U : 1U, communicator) > 0)
      throw UserError("file '" + file_name + "'",
                      "it cannot be written, the disk is full or protected",
                      "space and permission to write",
                      "free space or choose another 'Output / Directory'; "
                      "what was written before is complete",
                      ExitStatus::output_failed);
  }

  void
  write_file(const MPI_Comm    &communicator,
             const std::string &file_name,
             const std::string &text,
             const WriteMode    mode)
  {
    write_file(communicator,
               file_name,
               text,
               Utilities::MPI::this_mpi_process(communicator) == 0,
               mode);
  }
} // namespace Signoton
