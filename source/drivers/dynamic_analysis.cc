#include <signoton/base/number.h>
#include <signoton/drivers/dynamic_analysis.h>
#include <signoton/drivers/explicit_dynamics.h>
#include <signoton/drivers/implicit_dynamics.h>
#include <signoton/drivers/run_checks.h>

#include <algorithm>

namespace Signoton
{
  void
  TimeIntegration::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection("Time integration");
    handler.add_parameter("Scheme",
                          scheme,
                          "explicit: central differences, in steps shorter "
                          "than the time in which a wave crosses a cell. "
                          "implicit: generalized alpha, in steps of any size, "
                          "each a Newton iteration as in statics; for motions "
                          "that are slow beside waves.",
                          Patterns::Selection("explicit|implicit"));
    handler.add_parameter("Start time", start, "In s.", time_pattern);
    handler.add_parameter("End time", end, "In s.", time_pattern);
    handler.add_parameter("Time step",
                          time_step,
                          "In s; 0: the stable one by 'Safety', or implicit "
                          "steps by 'Error tolerance'.",
                          length_pattern);
    handler.add_parameter(
      "Safety",
      safety,
      "Explicit: the step as a part of the stable one, in which the "
      "fastest wave crosses the smallest cell.",
      Patterns::Double(0.01, 1.));
    handler.add_parameter("Error tolerance",
                          error_tolerance,
                          "Implicit: local error of a step, relative to the "
                          "largest displacement, by which steps are chosen.",
                          Patterns::Double(1e-12, 1.));
    handler.add_parameter("Maximum time step",
                          maximum_step,
                          "Implicit: in s; 0: a fiftieth of the run.",
                          length_pattern);
    handler.add_parameter("Spectral radius",
                          spectral_radius,
                          "Implicit: what is left after a step of an "
                          "oscillation that is much faster; 1: all, 0: "
                          "nothing.",
                          Patterns::Double(0., 1.));
    handler.add_parameter(
      "Linear shock viscosity",
      shock_viscosity.linear,
      "Without unit; as a part of the impedance of the "
      "closed medium, what damps oscillations behind fronts "
      "and stops contacts that close. By default zero if "
      "all materials are elastic.",
      Patterns::Double(0., 2.));
    handler.add_parameter(
      "Quadratic shock viscosity",
      shock_viscosity.quadratic,
      "Without unit; spreads fronts that close contacts over "
      "twice to three times its root in cells. By default "
      "zero if all materials are elastic.",
      Patterns::Double(0., 100.));
    handler.add_parameter("Quiet zones",
                          quiet_zones,
                          "Explicit: skip cells that no wave has reached.");
    handler.add_parameter("Times",
                          times,
                          "In s, separated by commas, that steps have to meet "
                          "besides the end. Times at which loads or prescribed "
                          "motions bend or jump by 'if', '?:', comparisons, "
                          "min, max, abs, floor and the like, or by a table, "
                          "are met anyway.");
    handler.add_parameter("Statistics every",
                          statistics_every,
                          "A line of statistics every n-th step and after the "
                          "last.",
                          Patterns::Integer(1));
    handler.add_parameter("Snapshots",
                          snapshots,
                          "Fields for ParaView at the start and as often as "
                          "this, evenly over the run; 0: never.",
                          Patterns::Integer(0, 100000));
    handler.leave_subsection();
  }

  void
  TimeIntegration::check(const SceneFile &file) const
  {
    if (!(end > start))
      throw UserError(file.where({"Time integration"}, "End time"),
                      number_text(end),
                      "a time after the start at " + number_text(start),
                      "set it");
    if (!is_implicit())
      return; // when the mesh is there
    const bool   is_fixed = time_step > 0.;
    const double step     = is_fixed ? time_step : longest_step();
    check_steps(file.where({"Time integration"},
                           is_fixed ? "Time step" : "Maximum time step"),
                step,
                start,
                end,
                (end - start) / step,
                (end - start) / step / statistics_every,
                "take longer steps");
  }

  namespace
  {
    template <int dim>
    std::unique_ptr<Dynamics<dim>>
    make_driver(Model<dim> &model, const DynamicAnalysis<dim> &analysis)
    {
      if (analysis.solves_equations)
        return std::make_unique<ImplicitDynamics<dim>>(model, analysis);
      return std::make_unique<ExplicitDynamics<dim>>(model, analysis);
    }
  } // namespace

  template <int dim>
  void
  DynamicAnalysis<dim>::add_parameters(ParameterHandler &handler)
  {
    time_integration.add_parameters(handler);
    wave_refinement.add_parameters(handler);
    if (this->solves_equations)
      {
        model.newton.add_parameters(handler);
        model.linear_solver.add_parameters(handler);
      }
    handler.enter_subsection("Initial state");
    handler.add_parameter("Velocity",
                          initial_velocity,
                          "In m/s, one expression per direction separated by "
                          "';'.");
    handler.leave_subsection();
    handler.enter_subsection("Output");
    handler.add_parameter("Probe line samples",
                          transect_samples,
                          "How often lines are written, evenly over the "
                          "run. In statics it is every step.",
                          Patterns::Integer(1, 1000000));
    handler.leave_subsection();
    handler.enter_subsection("Reference solution");
    handler.add_parameter("Velocity",
                          reference_velocity,
                          "Exact velocity in m/s, in the same way; its error "
                          "is measured in the L1 norm.");
    handler.leave_subsection();
  }

  template <int dim>
  void
  DynamicAnalysis<dim>::check(const Constants &constants)
  {
    const SceneFile &file = model.file;
    time_integration.check(file);
    check_densities();
    const bool linear    = std::all_of(model.materials.begin(),
                                    model.materials.end(),
                                    [](const auto &m) { return m.is_elastic; });
    auto      &viscosity = time_integration.shock_viscosity;
    if (linear && !file.has({"Time integration"}, "Linear shock viscosity"))
      viscosity.linear = 0.;
    if (linear && !file.has({"Time integration"}, "Quadratic shock viscosity"))
      viscosity.quadratic = 0.;
    if (!file.has({"Refinement"}, "Minimum level"))
      wave_refinement.set_minimum_level(model.geometry.initial_refinement);
    wave_refinement.check(file);

    const auto function = [&](const std::string &text,
                              const std::string &section) {
      const std::string where = file.where({section}, "Velocity");
      return text.empty() ?
               nullptr :
               make_function<dim>(split_components(text, dim, where),
                                  constants,
                                  where);
    };
    model.initial_velocity = function(initial_velocity, "Initial state");
    model.reference_velocity =
      function(reference_velocity, "Reference solution");

    double n_points = 0.;
    for (const auto &transect : model.transects)
      n_points += transect.n_points;
    if (n_points * transect_samples > 1e8)
      throw UserError(file.where({"Output"}, "Probe line samples"),
                      number_text(n_points) + " points, " +
                        std::to_string(transect_samples) + " times",
                      "at most 1e8 rows in the files of lines",
                      "fewer samples or fewer points");
  }

  template <int dim>
  void
  DynamicAnalysis<dim>::check_densities() const
  {
    const SceneFile &file = model.file;
    for (const auto &material : model.materials)
      if (!(material.density > 0.))
        throw UserError(file.where({"Materials", material.name}, "Density"),
                        file.has({"Materials", material.name}, "Density") ?
                          "density zero" :
                          "no density",
                        "a positive number in kg/m^3: waves need inertia",
                        "set Density = 1800, for instance");
  }

  template <int dim>
  std::string
  DynamicAnalysis<dim>::equations() const
  {
    return "density * acceleration = div stress + load,\n"
           "  stress by the material from strain = sym grad u and history;\n"
           "  " +
           std::string(this->solves_equations ? "generalized alpha" :
                                                "central differences") +
           " in time, diagonal mass";
  }

  template <int dim>
  void
  DynamicAnalysis<dim>::validate()
  {
    make_driver(model, *this)->validate();
  }

  template <int dim>
  ExitStatus
  DynamicAnalysis<dim>::run(const std::string &resume_directory)
  {
    return make_driver(model, *this)->run(resume_directory);
  }

  template class DynamicAnalysis<2>;
  template class DynamicAnalysis<3>;
} // namespace Signoton
