#include <signoton/drivers/load_watch.h>

#include <algorithm>
#include <cmath>

namespace Signoton
{
  template <int dim>
  double
  LoadWatch<dim>::bend(const double from, const double to)
  {
    constexpr unsigned int n      = 64;
    double                 result = 0.;
    for (auto &[function, largest] : watched)
      {
        const unsigned int  n_values = largest.size() * places.size();
        std::vector<double> values((n + 1) * n_values);
        for (unsigned int i = 0; i <= n; ++i)
          {
            // the ends without round-off: there may be jumps behind them
            function->set_time(i < n ? from + (to - from) * i / n : to);
            for (unsigned int c = 0; c < largest.size(); ++c)
              for (std::size_t p = 0; p < places.size(); ++p)
                {
                  const double value = function->value(places[p], c);
                  values[i * n_values + c * places.size() + p] = value;
                  if (std::isfinite(value))
                    largest[c] = std::max(largest[c], std::abs(value));
                }
          }
        for (unsigned int k = 0; k < n_values; ++k)
          for (unsigned int i = 1; i < n; ++i)
            {
              const double part = static_cast<double>(i) / n,
                           line = (1. - part) * values[k] +
                                  part * values[n * n_values + k],
                           error = std::abs(values[i * n_values + k] - line),
                           scale = largest[k / places.size()];
              if (scale > 0. && std::isfinite(error))
                result = std::max(result, error / scale);
            }
      }
    return result;
  }

  template class LoadWatch<2>;
  template class LoadWatch<3>;
} // namespace Signoton
