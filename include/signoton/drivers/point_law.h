#ifndef signoton_drivers_point_law_h
#define signoton_drivers_point_law_h

#include <signoton/rheology/material.h>
#include <signoton/rheology/network.h>

#include <optional>

namespace Signoton
{
  /**
   * The law of one material point under strains and stresses, component by
   * component: the local solver of its scheme, which takes both, or, for the
   * law that is no scheme (`Plastic flow = conditional`), Newton's method on
   * the strains of those components whose stress is given.
   */
  class PointLaw
  {
  public:
    explicit PointLaw(const Rheology::Material &material);

    /** For each component (in Mandel's order) whether the stress is given. */
    void
    set_control(const std::array<bool, 6> &stress_is_given);

    /** The point at one time. */
    struct State
    {
      double               time = 0.;
      std::vector<Vector6> tensors; ///< what the law remembers
      std::vector<double>  scalars;
      Vector6              strain{}, stress{};
      /** In J/m^3, since the start. */
      double       stored = 0., dissipated = 0., work = 0.;
      unsigned int iterations = 0, region = 0;
    };

    /** A state without strain and stress. */
    State
    at_rest(const double time) const;

    /**
     * Take a step; nothing if none was found.
     * @param given strain, or stress in Pa, by component
     */
    std::optional<State>
    step(const State &from, const Vector6 &given, const double time_step);

    /** Of the last step, in Pa: a scale. */
    double
    stiffness() const
    {
      return network ? network->stiffness() : elastic_stiffness;
    }

    /** A stress in Pa that is nothing but the error of a step at that strain. */
    double
    round_off(const double strain) const
    {
      return 1e-11 * stiffness() * strain;
    }

    /** What a point remembers. */
    std::string
    description() const;

    unsigned int
    n_tensors() const;
    unsigned int
    n_scalars() const;

  private:
    /** What the law answers to a strain.
     *  @return the tangent */
    Matrix6
    respond(const State &from, const Vector6 &strain, State &to) const;

    /** The step of a law that is no scheme; false if it has failed. */
    bool
    solve(const State &from, const Vector6 &given, State &to) const;

    bool
    solve_scheme(const State   &from,
                 const Vector6 &given,
                 const double   time_step,
                 State         &to);

    Rheology::Law                      law;
    std::unique_ptr<Rheology::Network> network; ///< of a scheme
    std::array<bool, 6>                stress_is_given{};
    double                             elastic_stiffness = 0.; ///< in Pa
  };
} // namespace Signoton

#endif
