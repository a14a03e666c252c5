// Tables: the format that they are written in, and what becomes of them after a
// restart, with other columns too, and on a full disk.

#include "verdicts.h"

#include <signoton/base/csv_table.h>
#include <signoton/base/exceptions.h>
#include <signoton/base/mpi_session.h>

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <sstream>

using namespace Signoton;

namespace
{
  std::string
  contents(const std::string &file_name)
  {
    std::ostringstream text;
    text << std::ifstream(file_name).rdbuf();
    return text.str();
  }

  /** Whether an action fails as output does while no file may have more bytes
   *  than these. */
  bool
  fails_on_disk(const rlim_t bytes, const std::function<void()> &action)
  {
    rlimit before;
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    bool failed = false;
    try
      {
        action();
      }
    catch (const UserError &error)
      {
        failed = error.status == ExitStatus::output_failed;
      }
    setrlimit(RLIMIT_FSIZE, &before);
    return failed;
  }
} // namespace

int
main(int argc, char **argv)
{
  const MPISession mpi(argc, argv);
  Verdicts         verdict;
  std::signal(SIGXFSZ, SIG_IGN);
  const std::string file = "table.csv";
  std::filesystem::remove(file);

  {
    CSVTable table(MPI_COMM_WORLD, file);
    table.append({"time", "a \"b\", c"}, {{0., 1. / 3.}});
    table.append({"time", "a \"b\", c"}, {{1e-3, -2e20}});
    table.append({"time", "a \"b\", c"}, {{2., 5.}});
  }
  verdict("names in quotes, numbers with twelve digits",
          contents(file) == "\"time\",\"a \"\"b\"\", c\"\n0,0.333333333333\n"
                            "0.001,-2e+20\n2,5\n");
  {
    CSVTable table(MPI_COMM_WORLD, file);
    table.resume(2, true);
    verdict("the same columns are gone on with without a word",
            table.append({"time", "a \"b\", c"}, {{3., 6.}}).empty());
  }
  verdict("rows beyond a restart are dropped",
          contents(file) == "\"time\",\"a \"\"b\"\", c\"\n0,0.333333333333\n"
                            "0.001,-2e+20\n3,6\n");
  {
    CSVTable table(MPI_COMM_WORLD, file);
    table.resume(2, true);
    const std::string said =
      table.append({"new", "time", "other"}, {{7., 8., 9.}});
    verdict("columns that come and go are named",
            said.find("new 'new', 'other'") != std::string::npos &&
              said.find("no longer 'a \"b\", c'") != std::string::npos);
    table.append({"new", "time", "other"}, {{17., 18., 19.}});
  }
  verdict("numbers go below their names",
          contents(file) == "\"new\",\"time\",\"other\",\"a \"\"b\"\", c\"\n"
                            ",0,,0.333333333333\n,0.001,,-2e+20\n"
                            "7,8,9,\n17,18,19,\n");
  {
    CSVTable table(MPI_COMM_WORLD, file);
    table.resume(4, true);
    table.append({"time", "a \"b\", c", "new", "other"}, {{1., 2., 3., 4.}});
  }
  verdict("columns that come back in another order",
          contents(file) == "\"time\",\"a \"\"b\"\", c\",\"new\",\"other\"\n"
                            "0,0.333333333333,,\n0.001,-2e+20,,\n"
                            "8,,7,9\n18,,17,19\n1,2,3,4\n");

  std::filesystem::remove(file);
  {
    CSVTable table(MPI_COMM_WORLD, file);
    for (unsigned int scan = 0; scan < 3; ++scan)
      table.append({"t", "x"}, {{scan * 1., 0.}, {scan * 1., 1.}}, true);
  }
  {
    CSVTable table(MPI_COMM_WORLD, file);
    table.resume(1, false);
    table.append({"t", "x", "y"}, {{5., 0., 2.}, {5., 1., 3.}}, true);
  }
  verdict("scans end with an empty line, and are counted by it",
          contents(file) ==
            "\"t\",\"x\",\"y\"\n0,0,\n0,1,\n\n5,0,2\n5,1,3\n\n");

  const std::string before = contents(file);
  {
    CSVTable table(MPI_COMM_WORLD, file);
    table.resume(2, false);
    verdict("no room to rewrite the table", fails_on_disk(10, [&] {
              table.append({"t", "z"}, {{1., 2.}});
            }));
  }
  verdict("then it is as it was, and nothing is beside it",
          contents(file) == before && !std::filesystem::exists(file + ".part"));
  {
    CSVTable table(MPI_COMM_WORLD, file);
    table.resume(2, false);
    table.append({"t", "x", "y"}, {{6., 0., 1.}});
    const std::string complete = contents(file);
    verdict("no room for the whole of a row",
            fails_on_disk(complete.size() + 3, [&] {
              table.append({"t", "x", "y"}, {{7., 0.25, 0.125}});
            }));
    verdict("then no part of it is left", contents(file) == complete);
  }
  return verdict.status();
}
