#ifndef signoton_rheology_general_h
#define signoton_rheology_general_h

#include <signoton/rheology/law.h>
#include <signoton/rheology/network.h>

#include <memory>

namespace Signoton::Rheology
{
  class General;

  /** History whose size only the scheme knows. */
  template <typename Number>
  struct History<General, Number>
  {
    std::vector<Tensor2<Number>> tensors;
    std::vector<Number>          scalars;
  };

  /**
   * The law of any scheme: the local solver of Network, lane by lane. It has
   * the functions of the closed laws, but tells only at run time what it
   * remembers, and depends on the time step if there are dampers.
   *
   * A point whose solve fails says so in Response::failure, beside a stress that
   * is of no use.
   */
  class General
  {
  public:
    static constexpr bool has_potential = true;

    explicit General(const Scheme &scheme);

    unsigned int
    n_tensors() const
    {
      return network->n_tensors();
    }

    unsigned int
    n_scalars() const
    {
      return network->n_scalars();
    }

    /** In s. */
    void
    set_time_step(const double time_step)
    {
      network->set_time_step(time_step);
    }

    /** Always true: dampers move inside the sets, too. */
    template <unsigned int request, typename Number>
    bool
    update(const Tensor2<Number>          &strain,
           const History<General, Number> &accepted,
           History<General, Number>       &trial,
           Response<Number>               &response) const;

    /** Moduli of the springs, see spring_moduli(). */
    const Moduli &
    elasticity() const
    {
      return spring;
    }

  private:
    std::shared_ptr<Network> network; ///< workspace: one thread at a time
    Moduli                   spring;
    // of a lane
    mutable std::vector<Vector6> tensors;
    mutable std::vector<double>  scalars;
  };
} // namespace Signoton::Rheology

#endif
