#include <signoton/base/first_rank.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

namespace Signoton
{
  namespace
  {
    /** Any more is no scene, and may have no end. */
    constexpr std::size_t largest_file = 1 << 26;

    /** The text of a file behind a blank; a word if there is none. */
    std::string
    contents(const std::string &file_name)
    {
      std::error_code error;
      std::ifstream   file(file_name, std::ios::binary);
      if (!file || std::filesystem::is_directory(file_name, error))
        return "closed";
      std::string       text = " ";
      std::vector<char> part(1 << 16);
      while (file.read(part.data(), part.size()), file.gcount() > 0)
        {
          text.append(part.data(), file.gcount());
          if (text.size() > largest_file)
            return "endless";
        }
      return text;
    }
  } // namespace

  SceneFile
  read_scene(const MPI_Comm &communicator, const std::string &file_name)
  {
    std::string text;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      text = contents(file_name);
    text = Utilities::MPI::broadcast(communicator, text);
    if (text[0] != ' ')
      throw UserError("file '" + file_name + "'",
                      text == "closed" ? "it cannot be opened" :
                                         "more than 64 MB",
                      "a readable parameter file (.prm)",
                      "check the name and the directory; 'signoton "
                      "--template statics' prints one to start from");
    return SceneFile::parse(text.substr(1), file_name);
  }

  bool
  all_arrive(const MPI_Comm &communicator)
  {
    const double patience =
      5. + 0.5 * Utilities::MPI::this_mpi_process(communicator);
    MPI_Request request;
    int         arrived = 0;
    MPI_Ibarrier(communicator, &request);
    const auto start = std::chrono::steady_clock::now();
    while (true)
      {
        MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
        const std::chrono::duration<double> waited =
          std::chrono::steady_clock::now() - start;
        if (arrived != 0 || waited.count() > patience)
          return arrived != 0;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
  }
} // namespace Signoton
