#include <signoton/operators/failure.h>

#include <sstream>

namespace Signoton
{
  template <int dim>
  std::string
  in_words(const Failure<dim> &failure, const MPI_Comm &communicator)
  {
    const double worst = Utilities::MPI::max(failure.residual, communicator);
    std::ostringstream text;
    if (worst > 0. && !(failure.residual < worst))
      text << "the material has no answer in the cell at (" << failure.place
           << "), where its local solver gave up at a residual of " << worst;
    // the rank that has it tells the others
    for (const auto &words :
         Utilities::MPI::all_gather(communicator, text.str()))
      if (!words.empty())
        return words;
    return "";
  }

  template std::string
  in_words<2>(const Failure<2> &, const MPI_Comm &);
  template std::string
  in_words<3>(const Failure<3> &, const MPI_Comm &);
} // namespace Signoton
