#include <signoton/base/exceptions.h>
#include <signoton/base/output_file.h>

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace Signoton
{
  namespace
  {
    namespace fs = std::filesystem;

    /** Whether all of a text went to a file; a full disk may say so only when
     *  the file is closed. */
    bool
    put(const std::string            &file_name,
        const std::string            &text,
        const std::ios_base::openmode mode)
    {
      std::ofstream file(file_name, mode | std::ios::binary);
      file << text << std::flush;
      file.close();
      return !file.fail();
    }

    bool
    append(const std::string &file_name, const std::string &text)
    {
      std::error_code error;
      const auto      before = fs::file_size(file_name, error);
      const bool      is_new = static_cast<bool>(error);
      if (put(file_name, text, std::ios::app))
        return true;
      fs::resize_file(file_name, is_new ? 0 : before, error);
      return false;
    }

    bool
    replace(const std::string &file_name, const std::string &text)
    {
      std::error_code   error;
      const bool        is_new = !fs::exists(file_name, error);
      const std::string part   = file_name + ".part";
      bool              ok     = put(part, text, std::ios::trunc);
      ok                       = ok && (is_new || synchronize(part));
      if (ok)
        fs::rename(part, file_name, error);
      if (ok && !error)
        return true;
      fs::remove(part, error);
      return false;
    }
  } // namespace

  bool
  synchronize(const std::string &path)
  {
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
      return false;
    const bool ok = fsync(file) == 0;
    return close(file) == 0 && ok;
  }

  void
  write_file(const MPI_Comm    &communicator,
             const std::string &file_name,
             const std::string &text,
             const bool         i_write,
             const WriteMode    mode)
  {
    const bool ok =
      !i_write || (mode == WriteMode::append ? append(file_name, text) :
                                               replace(file_name, text));
    if (Utilities::MPI::max(ok ? 0U : 1U, communicator) > 0)
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
