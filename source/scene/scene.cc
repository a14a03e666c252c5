#include <signoton/base/quoting.h>
#include <signoton/base/scene_template.h>
#include <signoton/drivers/dynamic_analysis.h>
#include <signoton/drivers/static_analysis.h>
#include <signoton/rheology/classification.h>
#include <signoton/scene/scene.h>

#include <algorithm>
#include <sstream>

namespace Signoton
{
  namespace
  {
    /** What gravity does not act on, for want of a density; nothing at all is
     *  an error. */
    template <int dim>
    std::string
    check_weight(const Model<dim> &model, const std::string &gravity)
    {
      const auto parts = Utilities::split_string_list(gravity, ';');
      if (std::all_of(parts.begin(), parts.end(), [](const auto &part) {
            return part == "0";
          }))
        return "";
      std::vector<std::string> weightless;
      for (const auto &material : model.materials)
        if (!(material.density > 0.))
          weightless.push_back(material.name);
      const std::string where = model.file.where({"Loads"}, "Gravity");
      if (weightless.size() == model.materials.size())
        throw UserError(where,
                        "gravity, and no material with a density",
                        "a density of the materials that have a weight",
                        "'set Density = 1800' in kg/m^3, for instance");
      if (!weightless.empty())
        return where + " does not act on " + join(weightless, ", ") +
               ": no density";
      return "";
    }

    /** Where linear elements are too stiff, or nothing. Under a smooth footing
     *  on 24 x 16 cells they are by 9 % at Poisson's ratio .48, 56 % at .499,
     *  and find no limit load of Tresca's clay. */
    template <int dim>
    std::string
    check_locking(const Model<dim> &model)
    {
      constexpr double         incompressible = 20.;
      std::vector<std::string> names;
      for (const auto &material : model.materials)
        {
          const Moduli moduli = material.elasticity;
          const bool   yields =
            !model.analysis->has_inertia &&
            Rheology::contains(material.scheme, Rheology::Scheme::Kind::hinge);
          if (yields || moduli.bulk > incompressible * moduli.shear)
            names.push_back("'" + material.name + "', which " +
                            (yields ? "yields" : "is nearly incompressible"));
        }
      return names.empty() ? "" :
                             "degree 1 is too stiff in " + join(names, ", ") +
                               ": 'Discretization / Degree = 2' is not";
    }

  } // namespace

  template <int dim>
  Scene<dim>::Scene(const MPI_Comm &communicator, const SceneFile &file)
    : model(communicator)
  {
    model.file = file;

    for (const auto &name : file.subsections({"Materials"}))
      materials.emplace_back(name);
    for (const auto &name : file.subsections({"Boundaries"}))
      model.conditions.emplace_back(name);
    for (const auto &name : file.subsections({"Point forces"}))
      model.point_forces.emplace_back(name);
    choose_analysis();
    add_parameters(handler);
    drop_unused();
    model.file.apply_to(handler);
    title                  = unquoted(title);
    model.output.directory = unquoted(model.output.directory);
    interpret();
  }

  template <int dim>
  void
  Scene<dim>::choose_analysis()
  {
    // other values are refused with the rest
    const SceneFile &file = model.file;
    const bool is_dynamic = file.value({}, "Analysis", analysis) == "dynamics",
               is_implicit =
                 file.value({"Time integration"}, "Scheme") == "implicit";
    std::array<std::unique_ptr<Analysis<dim>>, 3> all = {
      {std::make_unique<StaticAnalysis<dim>>(model),
       std::make_unique<DynamicAnalysis<dim>>(model, "explicit"),
       std::make_unique<DynamicAnalysis<dim>>(model, "implicit")}};
    const unsigned int chosen = !is_dynamic ? 0 : is_implicit ? 2 : 1;
    for (unsigned int i = 0; i < all.size(); ++i)
      if (i == chosen)
        model.analysis = std::move(all[i]);
      else
        others.push_back(std::move(all[i]));
  }

  template <int dim>
  void
  Scene<dim>::drop_unused()
  {
    for (auto &other : others)
      {
        ParameterHandler keys;
        other->add_parameters(keys);
        for (const std::string &place : model.file.drop(keys, handler))
          warnings.push_back(
            place + " has no effect with Analysis = " + model.analysis->name);
      }
    others.clear();
  }

  template <int dim>
  void
  Scene<dim>::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Title", title, "What the scene shows.");
    prm.add_parameter("Dimension",
                      dimension,
                      "Dimension of the mesh, 2 or 3.",
                      Patterns::Integer(2, 3));
    prm.add_parameter("Embedding",
                      embedding,
                      "How a 2D mesh sits in space: plane strain, forces per "
                      "metre; or axisymmetric with x the radius and y the "
                      "axis, forces and reactions over the full circle. The "
                      "axis needs no support.",
                      Patterns::Selection(
                        dim == 2 ? "plane strain|axisymmetric" : "solid"));
    prm.add_parameter("Analysis",
                      analysis,
                      "statics: equilibrium along a load history. dynamics: "
                      "waves, with the inertia of all materials.",
                      Patterns::Selection("statics|dynamics"));

    model.geometry.add_parameters(prm);

    prm.enter_subsection("Materials");
    for (auto &material : materials)
      {
        prm.enter_subsection(material.name);
        material.add_parameters(prm);
        prm.leave_subsection();
      }
    prm.leave_subsection();

    // names are free
    prm.enter_subsection("Schemes");
    for (const auto &name : model.file.keys({"Schemes"}))
      prm.declare_entry(name,
                        "",
                        Patterns::Anything(),
                        "A rheological scheme, or a part of one, by name.");
    prm.leave_subsection();

    prm.enter_subsection("Boundaries");
    for (auto &condition : model.conditions)
      {
        prm.enter_subsection(condition.name);
        condition.add_parameters(prm);
        prm.leave_subsection();
      }
    prm.leave_subsection();

    prm.enter_subsection("Point forces");
    for (auto &force : model.point_forces)
      {
        prm.enter_subsection(force.name);
        force.add_parameters(prm);
        prm.leave_subsection();
      }
    prm.leave_subsection();

    prm.enter_subsection("Loads");
    prm.add_parameter("Constants",
                      constants_text,
                      "Constants for all expressions of the scene: 'H = 10, "
                      "q = 1e5'.");
    prm.add_parameter("Gravity",
                      gravity_text,
                      "Acceleration in m/s^2 on all materials with a density, "
                      "one expression or table 'time: value, ...' per "
                      "direction, separated by ';'.");
    prm.leave_subsection();

    prm.enter_subsection("Initial state");
    const std::string entries =
      dim == 2 ? "xx; yy; zz; xy" : "xx; yy; zz; xy; xz; yz";
    prm.add_parameter("Strain",
                      initial_strain_text,
                      "Strain before anything moves, expressions " + entries +
                        ": where it opens a contact, the medium is loosened.");
    prm.add_parameter("Stress",
                      initial_stress_text,
                      "Stress before anything moves in Pa, expressions " +
                        entries + ".");
    prm.leave_subsection();

    prm.enter_subsection("Discretization");
    prm.add_parameter("Degree",
                      degree,
                      "Polynomial degree of the displacement.",
                      Patterns::Integer(1, 2));
    prm.add_parameter(
      "Points outside",
      points_outside,
      "Of probes and point forces, when the mesh of a curved "
      "boundary leaves them outside by less than a quarter of a "
      "coarse cell. nearest: the closest point of the body takes their "
      "place, with a line on the screen; refuse: an error.",
      Patterns::Selection("nearest|refuse"));
    prm.leave_subsection();

    model.analysis->add_parameters(prm);
    model.output.add_parameters(prm);

    prm.enter_subsection("Reference solution");
    prm.add_parameter("Displacement",
                      reference_text,
                      "Exact displacement in m to measure the error against, "
                      "one expression per direction separated by ';'.");
    prm.leave_subsection();
  }

  template <int dim>
  void
  Scene<dim>::interpret()
  {
    const SceneFile &file = model.file;
    constants =
      parse_constants(constants_text, file.where({"Loads"}, "Constants"));
    const auto vector_function = [&](const std::string &text,
                                     const std::string &where) {
      return make_function<dim>(split_components(text, dim, where),
                                constants,
                                where);
    };
    if (materials.empty())
      throw UserError(file.where({"Materials"}),
                      "no material",
                      "a subsection with the name of a material",
                      "'subsection Materials', 'subsection sand', 'set "
                      "Rheology = elastic', ...");
    for (auto &material : materials)
      {
        model.materials.push_back(material.make(file));
        Rheology::require_stress_from_strain(model.materials.back().scheme,
                                             model.materials.back().where);
      }
    if (!gravity_text.empty())
      model.gravity =
        vector_function(gravity_text, file.where({"Loads"}, "Gravity"));
    if (!reference_text.empty())
      model.reference =
        vector_function(reference_text,
                        file.where({"Reference solution"}, "Displacement"));
    if (const std::string weightless = check_weight(model, gravity_text);
        !weightless.empty())
      warnings.push_back(weightless);
    if (degree == 1)
      if (const std::string locking = check_locking(model); !locking.empty())
        warnings.push_back(locking);
    interpret_initial_state();
    for (auto &force : model.point_forces)
      force.initialize(file, constants);
    interpret_probes();
    model.analysis->check(constants);
    model.space = std::make_unique<Space<dim>>(model.communicator,
                                               degree,
                                               embedding == "axisymmetric");
    std::ostringstream all;
    handler.print_parameters(all, ParameterHandler::ShortText);
    model.resolved_scene =
      file.text() + "\n# All parameters, defaults included:\n#\n";
    std::istringstream lines(all.str());
    for (std::string line; std::getline(lines, line);)
      model.resolved_scene += "# " + line + "\n";
  }

  template <int dim>
  void
  Scene<dim>::interpret_initial_state()
  {
    const SceneFile      &file = model.file;
    const SceneFile::Path path = {"Initial state"};
    const auto function = [&](const std::string &key, const std::string &text) {
      constexpr unsigned int n_entries = dim == 2 ? 4 : 6;
      const std::string      where     = file.where(path, key);
      return text.empty() ?
               nullptr :
               make_function<dim>(split_components(text, n_entries, where),
                                  constants,
                                  where);
    };
    model.initial_strain = function("Strain", initial_strain_text);
    model.initial_stress = function("Stress", initial_stress_text);
    if (!model.initial_strain && !model.initial_stress)
      return;
    for (const auto &material : model.materials)
      if (const Moduli left = Rheology::rest_moduli(material.scheme);
          material.is_viscous && !(left.bulk > 0. && left.shear > 0.))
        throw UserError(file.where(path),
                        "an initial strain or stress, and a damper in series "
                        "in the material '" +
                          material.name + "'",
                        "dampers with a spring in parallel: stress that a "
                        "damper bears fades away, and an initial state is one "
                        "of rest",
                        "let the load grow from zero instead");
  }

  template <int dim>
  void
  Scene<dim>::build()
  {
    auto &space = *model.space;
    {
      const auto timer = model.ledger.time("setup");
      space.boundary =
        model.geometry.create(model.file, constants, space.mesh, notes);
    }
    check_materials();
    for (auto &condition : model.conditions)
      condition.initialize(model.file, space.boundary.names, constants);
    check_boundaries();
    check_mesh();
    check_probes();
    find_times_to_meet();
    model.mechanics = make_mechanics(space, model.materials);

    const auto timer = model.ledger.time("setup");
    model.set_time(model.analysis->time_span().start);
    space.distribute_dofs();
    space.update_constraints(model.conditions);
    model.mechanics->set_initial_state({model.initial_strain.get(),
                                        model.initial_stress.get(),
                                        model.file.where({"Initial state"})});
    if (model.analysis->has_inertia)
      return;
    check_supports();
    for (const auto &material : model.materials)
      if (material.may_lose_stiffness && !(model.newton.regularization > 0.))
        model.newton.regularization = 1e-6;
  }

  template <int dim>
  void
  Scene<dim>::print_template(const std::string &analysis, std::ostream &out)
  {
    SceneFile file;
    file.set({}, "Analysis", analysis);
    if (analysis == "dynamics")
      file.set({"Materials", "sand"}, "Density", "1800");
    file.set({"Materials", "sand"}, "Rheology", "elastic granular");
    file.set({"Materials", "sand"}, "Admissible set", "mises schleicher");
    file.set({"Materials", "sand"}, "Friction parameter", "0.5");
    file.set({"Materials", "sand"}, "Bulk modulus", "1e8");
    file.set({"Materials", "sand"}, "Shear modulus", "6e7");
    file.set({"Materials", "sand"}, "Binder", "proportional");
    file.set({"Boundaries", "bottom"}, "Symmetry", "true");
    file.set({"Boundaries", "left"}, "Symmetry", "true");
    file.set({"Boundaries", "top"},
             "Pressure",
             analysis == "dynamics" ? "1e5*(t < 1e-3)" : "1e5*t");
    if (analysis == "dynamics")
      file.set({"Time integration"}, "End time", "2e-3");
    Scene scene(MPI_COMM_SELF, file);
    Signoton::print_template(out, scene.handler, file, {"Materials", "sand"});
  }

  template class Scene<2>;
  template class Scene<3>;
} // namespace Signoton
