#include <signoton/rheology/classification.h>
#include <signoton/rheology/general.h>
#include <signoton/tensors/lanes.h>

#include <cmath>
#include <limits>

namespace Signoton::Rheology
{
  General::General(const Scheme &scheme)
    : network(std::make_shared<Network>(scheme))
    , spring(spring_moduli(scheme))
    , tensors(network->n_tensors())
    , scalars(network->n_scalars())
  {}

  template <unsigned int request, typename Number>
  bool
  General::update(const Tensor2<Number>          &strain,
                  const History<General, Number> &accepted,
                  History<General, Number>       &trial,
                  Response<Number>               &response) const
  {
    response.failure = 0.;
    for (unsigned int i = 0; i < n_lanes<Number>(); ++i)
      {
        for (unsigned int k = 0; k < tensors.size(); ++k)
          tensors[k] = to_mandel(lane(accepted.tensors[k], i));
        for (unsigned int k = 0; k < scalars.size(); ++k)
          scalars[k] = lane(accepted.scalars[k], i);
        const Network::Step &step = network->update(to_mandel(lane(strain, i)),
                                                    tensors.data(),
                                                    scalars.data(),
                                                    (request & tangent) != 0);
        if (!step.converged && !(step.residual < response.failure))
          {
            response.failure     = std::isfinite(step.residual) ?
                                     step.residual :
                                     std::numeric_limits<double>::max();
            response.failed_lane = i;
          }
        set_lane(response.stress, i, from_mandel(step.stress));
        set_lane(response.region, i, index(network->region()));
        for (unsigned int k = 0; k < tensors.size(); ++k)
          set_lane(trial.tensors[k],
                   i,
                   from_mandel(network->trial_tensors()[k]));
        for (unsigned int k = 0; k < scalars.size(); ++k)
          set_lane(trial.scalars[k], i, network->trial_scalars()[k]);
        if constexpr ((request & tangent) != 0)
          set_lane(response.tangent, i, from_mandel(step.tangent));
        if constexpr ((request & potential) != 0)
          set_lane(response.potential, i, step.potential);
        if constexpr ((request & (energies | dissipation)) != 0)
          {
            set_lane(response.dissipation, i, step.dissipated);
            set_lane(response.viscous_dissipation, i, step.viscous);
          }
        if constexpr ((request & energies) != 0)
          {
            set_lane(response.stored_energy, i, step.stored);
            set_lane(response.contact_strain,
                     i,
                     from_mandel(network->contact_strain()));
            set_lane(response.plastic_strain,
                     i,
                     from_mandel(network->plastic_strain()));
          }
      }
    return true;
  }

#define SIGNOTON_INSTANTIATE(request, Number)     \
  template bool General::update<request, Number>( \
    const Tensor2<Number> &,                      \
    const History<General, Number> &,             \
    History<General, Number> &,                   \
    Response<Number> &) const;
#define SIGNOTON_INSTANTIATE_REQUESTS(Number)       \
  SIGNOTON_INSTANTIATE(stress, Number)              \
  SIGNOTON_INSTANTIATE(potential, Number)           \
  SIGNOTON_INSTANTIATE(potential | tangent, Number) \
  SIGNOTON_INSTANTIATE(energies, Number)            \
  SIGNOTON_INSTANTIATE(dissipation, Number)         \
  SIGNOTON_INSTANTIATE(all, Number)
  SIGNOTON_INSTANTIATE_REQUESTS(double)
  SIGNOTON_INSTANTIATE_REQUESTS(VectorizedArray<double>)
#undef SIGNOTON_INSTANTIATE_REQUESTS
#undef SIGNOTON_INSTANTIATE
} // namespace Signoton::Rheology
