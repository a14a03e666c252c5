#include <signoton/drivers/load_watch.h>

#include <algorithm>
#include <cmath>

namespace Signoton
{
  template <int dim>
  std::vector<double>
  LoadWatch<dim>::values(SpaceTimeFunction<dim> &function,
                         const double            time) const
  {
    std::vector<double> result;
    function.set_time(time);
    for (unsigned int c = 0; c < function.n_components; ++c)
      for (const Point<dim> &place : places)
        result.push_back(function.sample(place, c));
    return result;
  }

  template <int dim>
  void
  LoadWatch<dim>::add(SpaceTimeFunction<dim> &function,
                      const double            start,
                      const double            end)
  {
    constexpr unsigned int n = 1000;
    Watched new_one{&function, std::vector<double>(function.n_components)};
    for (unsigned int i = 0; i <= n; ++i)
      {
        const auto now = values(function, start + (end - start) * i / n);
        for (std::size_t k = 0; k < now.size(); ++k)
          if (std::isfinite(now[k]))
            {
              double &largest = new_one.largest[k / places.size()];
              largest         = std::max(largest, std::abs(now[k]));
            }
      }
    watched.push_back(new_one);
  }

  template <int dim>
  double
  LoadWatch<dim>::bend(const double from, const double to)
  {
    constexpr unsigned int n      = 64;
    double                 result = 0.;
    for (const auto &[function, largest] : watched)
      {
        const auto first = values(*function, from),
                   last  = values(*function, to);
        for (unsigned int i = 1; i < n; ++i)
          {
            const double part = static_cast<double>(i) / n;
            const auto   now  = values(*function, from + part * (to - from));
            for (std::size_t k = 0; k < now.size(); ++k)
              {
                const double error =
                  std::abs(now[k] - (1. - part) * first[k] - part * last[k]);
                const double scale =
                  std::max(largest[k / places.size()], std::abs(now[k]));
                if (scale > 0. && std::isfinite(error))
                  result = std::max(result, error / scale);
              }
          }
      }
    return result;
  }

  template class LoadWatch<2>;
  template class LoadWatch<3>;
} // namespace Signoton
