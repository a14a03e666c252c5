#ifndef signoton_tests_verdicts_h
#define signoton_tests_verdicts_h

#include <fstream>
#include <string>

/** Verdicts of a test: a line each in the file that is compared. */
class Verdicts
{
public:
  /** @param file_name on all ranks but the first a file that nobody reads */
  explicit Verdicts(const std::string &file_name = "output")
    : output(file_name)
  {}

  void
  operator()(const std::string &what, const bool good)
  {
    output << what << ": " << (good ? "ok" : "FAILED") << std::endl;
    all_good &= good;
  }

  /** What main() returns. */
  int
  status() const
  {
    return all_good ? 0 : 1;
  }

private:
  std::ofstream output;
  bool          all_good = true;
};

#endif
