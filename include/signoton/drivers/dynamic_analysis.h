#ifndef signoton_drivers_dynamic_analysis_h
#define signoton_drivers_dynamic_analysis_h

#include <signoton/discretization/wave_refinement.h>
#include <signoton/drivers/model.h>

namespace Signoton
{
  /** How dynamics goes through time. */
  struct TimeIntegration : public TimeSpan
  {
    TimeIntegration()
      : TimeSpan{"Time integration"}
    {}

    void
    add_parameters(ParameterHandler &handler);

    /** Check the entries against each other. */
    void
    check(const SceneFile &file) const;

    bool
    is_implicit() const
    {
      return scheme == "implicit";
    }

    /** Implicit steps do not grow beyond this, in s. */
    double
    longest_step() const
    {
      return maximum_step > 0. ? maximum_step : (end - start) / 50.;
    }

    std::string    scheme           = "explicit";
    double         time_step        = 0.;
    double         maximum_step     = 0.;
    double         error_tolerance  = 1e-3;
    double         spectral_radius  = 0.8;
    double         safety           = 0.9;
    ShockViscosity shock_viscosity  = {0.5, 12.};
    bool           quiet_zones      = true;
    unsigned int   statistics_every = 1;
    unsigned int   snapshots        = 20;
  };

  /** `Analysis = dynamics`: see Dynamics. */
  template <int dim>
  class DynamicAnalysis : public Analysis<dim>
  {
  public:
    DynamicAnalysis(Model<dim> &model, const std::string &scheme)
      : Analysis<dim>("dynamics, Scheme = " + scheme,
                      true,
                      scheme == "implicit")
      , model(model)
    {
      time_integration.scheme = scheme;
    }

    void
    add_parameters(ParameterHandler &handler) override;

    void
    check(const Constants &constants) override;

    TimeSpan &
    time_span() override
    {
      return time_integration;
    }

    bool
    has_shock_viscosity() const override
    {
      return bool(time_integration.shock_viscosity);
    }

    typename Analysis<dim>::Adaptivity
    adaptivity() const override
    {
      return {wave_refinement.is_on(),
              "Refinement / Follow waves",
              wave_refinement.unknowns_limit()};
    }

    std::string
    equations() const override;

    void
    validate() override;

    ExitStatus
    run(const std::string &resume_directory) override;

    TimeIntegration time_integration;
    WaveRefinement  wave_refinement;
    unsigned int    transect_samples = 200;

  private:
    void
    check_densities() const;

    Model<dim> &model;
    std::string initial_velocity = "", reference_velocity = "";
  };
} // namespace Signoton

#endif
