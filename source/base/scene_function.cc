#include <signoton/base/scene_function.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <sstream>

namespace Signoton
{
  template <int dim>
  double
  SceneFunction<dim>::value(const Point<dim>  &p,
                            const unsigned int component) const
  {
    const double value = FunctionParser<dim>::value(p, component);
    if (!std::isfinite(value) && found.empty())
      {
        std::ostringstream text;
        text << value << " at t = " << this->get_time() << " in the point "
             << p;
        found = text.str();
      }
    return value;
  }

  template <int dim>
  void
  refuse_trouble(const MPI_Comm                           &communicator,
                 const std::vector<const Function<dim> *> &functions)
  {
    std::string trouble; // where and what, in two lines
    for (const auto *function : functions)
      if (const auto *scene =
            dynamic_cast<const SceneFunction<dim> *>(function);
          scene != nullptr && !scene->trouble().empty() && trouble.empty())
        trouble = scene->where + '\n' + scene->trouble();
    for (const auto &rank : Utilities::MPI::all_gather(communicator, trouble))
      if (const auto end = rank.find('\n'); end != std::string::npos)
        throw UserError(rank.substr(0, end),
                        rank.substr(end + 1),
                        "an expression that is finite at all points and times "
                        "that it is asked for",
                        "look for divisions by zero, roots and logarithms of "
                        "negative numbers; what was written before is "
                        "complete");
  }

  template class SceneFunction<1>;
  template class SceneFunction<2>;
  template class SceneFunction<3>;
  template void
  refuse_trouble<2>(const MPI_Comm &, const std::vector<const Function<2> *> &);
  template void
  refuse_trouble<3>(const MPI_Comm &, const std::vector<const Function<3> *> &);
} // namespace Signoton
