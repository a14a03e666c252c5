#ifndef signoton_drivers_static_analysis_h
#define signoton_drivers_static_analysis_h

#include <signoton/discretization/refinement.h>
#include <signoton/drivers/model.h>

namespace Signoton
{
  /** The load history. */
  struct LoadSteps : public TimeSpan
  {
    LoadSteps()
      : TimeSpan{"Load steps"}
    {}

    void
    add_parameters(ParameterHandler &handler);

    /** Check the entries against each other, and set what follows from
     *  others. */
    void
    check(const SceneFile &file);

    double       step_size         = 1.;
    double       minimum_step_size = 0.;
    double       maximum_step_size = 1e300;
    unsigned int easy_iterations   = 8;
    double       growth            = 1.;
  };

  /** `Analysis = statics`: see Statics. */
  template <int dim>
  class StaticAnalysis : public Analysis<dim>
  {
  public:
    explicit StaticAnalysis(Model<dim> &model)
      : Analysis<dim>("statics", false, true)
      , model(model)
    {}

    void
    add_parameters(ParameterHandler &handler) override;

    void
    check(const Constants &constants) override;

    TimeSpan &
    time_span() override
    {
      return load_steps;
    }

    typename Analysis<dim>::Adaptivity
    adaptivity() const override
    {
      return {refinement.cycles(1) > 0 || refinement.is_used_later(),
              "Refinement / Cycles",
              refinement.unknowns_limit()};
    }

    std::string
    equations() const override;

    ExitStatus
    run(const std::string &resume_directory) override;

    LoadSteps    load_steps;
    Refinement   refinement;
    unsigned int fields_every   = 1;
    bool         newton_history = false;

  private:
    Model<dim> &model;
  };
} // namespace Signoton

#endif
