#include <signoton/discretization/front_sensor.h>
#include <signoton/scene/requirements.h>
#include <signoton/tensors/embedding.h>

#include <algorithm>
#include <functional>
#include <iomanip>
#include <sstream>

namespace Signoton
{
  namespace
  {
    template <int dim>
    unsigned int
    tangent_entries(const Space<dim> &space, const bool symmetric)
    {
      if constexpr (dim == 3)
        return n_tangent_entries<Solid>(symmetric);
      else
        return space.axisymmetric ? n_tangent_entries<Axisymmetric>(symmetric) :
                                    n_tangent_entries<PlaneStrain>(symmetric);
    }

    std::string
    names_of(const std::vector<Rheology::Material>                 &materials,
             const std::function<bool(const Rheology::Material &)> &select)
    {
      std::vector<std::string> names;
      for (const auto &material : materials)
        if (select(material))
          names.push_back(material.name);
      return join(names, ", ");
    }
  } // namespace

  template <int dim>
  std::vector<Effect>
  requirements(const Model<dim> &model)
  {
    const auto &materials = model.materials;
    const auto  inelastic =
      names_of(materials, [](const auto &m) { return !m.is_elastic; });
    const auto contact =
      names_of(materials, [](const auto &m) { return m.has_cone; });
    const auto remembering =
      names_of(materials, [](const auto &m) { return !m.is_reversible; });
    const auto viscous =
      names_of(materials, [](const auto &m) { return m.is_viscous; });
    const auto binder =
      names_of(materials, [](const auto &m) { return m.has_binder; });
    const auto heavy =
      names_of(materials, [](const auto &m) { return m.density > 0.; });
    const bool is_explicit = !model.analysis->solves_equations;
    const bool initial     = model.initial_strain || model.initial_stress;
    const bool shock       = model.analysis->has_shock_viscosity();
    // of a cell and its share of the displacement at the begin of the step
    const unsigned int shock_bytes =
      sizeof(double) * (FrontSensor<dim>::n_numbers + 3 + 3 * dim) /
      model.space->quadrature.size();
    const bool tangent = (!inelastic.empty() || shock) && !is_explicit;
    const bool symmetric =
      std::all_of(materials.begin(), materials.end(), [](const auto &m) {
        return m.has_potential;
      });
    const bool gravity  = model.gravity && !heavy.empty();
    const bool adaptive = model.analysis->adaptivity().is_on,
               inertia  = model.analysis->has_inertia;

    std::vector<std::string> with_dashpots;
    for (const auto &condition : model.conditions)
      if (condition.absorbs())
        with_dashpots.push_back(condition.name);
    const std::string absorbing = join(with_dashpots, ", ");

    const unsigned int number = sizeof(double), n_stress = dim == 2 ? 4 : 6;
    return {{"elasticity", true, "every material has a spring", 0},
            {"rigid contact (no tension)",
             !contact.empty(),
             contact.empty() ? "no granular rheology" : "materials " + contact,
             0},
            {"consistent tangent",
             tangent,
             is_explicit ? "explicit time integration needs none" :
             !tangent    ? "all materials are linear" :
             shock       ? "shock viscosity" :
                           "materials " + inelastic,
             tangent ? tangent_entries(*model.space, symmetric) * number : 0},
            {"history",
             !remembering.empty(),
             remembering.empty() ?
               "no plastic hinge, no damper: the response is reversible" :
               "plastic hinges or dampers in " + remembering,
             2 * model.mechanics->history_width() * number},
            {"viscosity",
             !viscous.empty(),
             viscous.empty() ? "no damper" : "dampers in " + viscous,
             0},
            {"elastic binder",
             !binder.empty(),
             binder.empty() ? "no binder" : "materials " + binder,
             0},
            {"gravity",
             gravity,
             gravity                  ? "Loads / Gravity on " + heavy :
             model.gravity != nullptr ? "no material has a density" :
                                        "no Loads / Gravity",
             0},
            {"adaptive mesh",
             adaptive,
             (adaptive ? "" : "no ") + model.analysis->adaptivity().key,
             0},
            {"inertia",
             inertia,
             inertia ? "Analysis = dynamics" : "Analysis = statics",
             0},
            {"initial state",
             initial,
             initial ? "Initial state / Strain or Stress" : "no Initial state",
             initial ? 2 * n_stress * number : 0},
            {"shock viscosity",
             shock,
             shock ? "Time integration / ... shock viscosity" :
                     "Analysis = statics, or zero",
             shock ? shock_bytes : 0},
            {"absorbing boundary",
             !absorbing.empty(),
             absorbing.empty() ? "no Boundaries / Absorbing" :
                                 "boundaries " + absorbing,
             0}};
  }

  template <int dim>
  MemoryForecast
  memory_forecast(const Model<dim> &model, const double growth)
  {
    const bool   is_explicit = !model.analysis->solves_equations;
    unsigned int bytes       = 0;
    for (const auto &effect : requirements(model))
      bytes += effect.bytes_per_point;
    const double points = growth * model.space->mesh.n_global_active_cells() *
                          model.space->quadrature.size();
    const double n = growth * model.space->dof_handler.n_dofs();
    // a row couples with the unknowns of the patch around a node, on average
    const double row = dim * std::pow(model.space->degree == 1 ? 3. : 4., dim);
    const double matrix = is_explicit ? 0. : 12. * n * row;
    // Multigrid takes about the matrix again; factors fill up like n log n in
    // the plane, and more than anyone should wait for in space.
    const double solver = model.linear_solver.is_direct(n, dim) ?
                            matrix * std::log2(n) :
                            1.5 * matrix;
    return {points * bytes, matrix, solver, (is_explicit ? 12. : 30.) * 8. * n};
  }

  template <int dim>
  std::string
  explain(const Model<dim> &model)
  {
    std::ostringstream out;
    out << "Equations: " << model.analysis->equations()
        << (dim == 3 ? ", in three dimensions" :
            model.space->axisymmetric ?
                       ", rotationally symmetric about x = 0" :
                       ", plane strain (the out-of-plane stress is computed)")
        << ".\n\nMaterials:\n";
    for (const auto &material : model.materials)
      out << "  " << material.name << " (id " << material.id
          << "): " << material.description() << "\n";

    out << "\nEffect                      on   bytes/point  why\n";
    for (const auto &effect : requirements(model))
      out << std::left << std::setw(28) << effect.name << std::setw(5)
          << (effect.on ? "yes" : "no") << std::right << std::setw(11)
          << effect.bytes_per_point << "  " << effect.why << "\n";
    const double cells    = model.space->mesh.n_global_active_cells();
    const double points   = cells * model.space->quadrature.size();
    const double n        = model.space->dof_handler.n_dofs();
    const auto   forecast = [&](const std::string &when, const double growth) {
      const MemoryForecast memory = memory_forecast(model, growth);
      out << "  " << std::left << std::setw(20) << when << std::right
          << std::fixed << std::setprecision(1);
      for (const double part :
           {memory.points, memory.matrix, memory.solver, memory.vectors})
        out << std::setw(10) << part / 1e6;
      out << "\n";
    };
    out << "\nUnknowns " << n << ", cells " << cells << ", points " << points
        << "\nMemory forecast in MB, besides some 200 MB of libraries a rank:\n"
           "                          points    matrix    solver   vectors\n";
    forecast("at the start", 1.);
    if (model.analysis->adaptivity().is_on)
      forecast("at Maximum unknowns",
               std::max(1., model.analysis->adaptivity().unknowns_limit / n));
    return out.str();
  }

  template std::vector<Effect>
  requirements<2>(const Model<2> &);
  template std::vector<Effect>
  requirements<3>(const Model<3> &);
  template MemoryForecast
  memory_forecast<2>(const Model<2> &, const double);
  template MemoryForecast
  memory_forecast<3>(const Model<3> &, const double);
  template std::string
  explain<2>(const Model<2> &);
  template std::string
  explain<3>(const Model<3> &);
} // namespace Signoton
