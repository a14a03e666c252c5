#include <signoton/discretization/boundary_conditions.h>

#include <algorithm>

namespace Signoton
{
  namespace
  {
    constexpr std::array<char, 3> axis_names = {{'x', 'y', 'z'}};
  } // namespace

  template <int dim>
  void
  BoundaryCondition<dim>::add_parameters(ParameterHandler &handler)
  {
    handler.add_parameter("Symmetry",
                          symmetry,
                          "No displacement normal to the boundary, no shear "
                          "traction. Where planes meet, all are held.");
    handler.add_parameter("Kink angle",
                          kink_angle,
                          "Of symmetry, in degrees, where the mesh has facets "
                          "and no curved surface behind them: those that turn "
                          "by less at a common edge are one smooth surface "
                          "with one normal; others are planes of their own.",
                          Patterns::Double(0., 90.));
    for (unsigned int d = 0; d < dim; ++d)
      handler.add_parameter(std::string("Displacement ") + axis_names[d],
                            displacement_text[d],
                            "Prescribed component of the displacement in m, an "
                            "expression in x, y, (z,) t, or a table 'time: "
                            "value, time: value' with straight lines in "
                            "between; empty: free. Where boundaries meet and "
                            "contradict each other, the "
                            "first in the file holds.");
    for (unsigned int d = 0; d < dim; ++d)
      handler.add_parameter(
        std::string("Velocity ") + axis_names[d],
        velocity_text[d],
        "Prescribed component of the velocity in m/s, an "
        "expression or a table; for dynamics. Empty: free.");
    handler.add_parameter("Absorbing",
                          absorbing,
                          "Dashpots that let waves leave (Lysmer and "
                          "Kuhlemeyer): the traction -rho c_p v_n n - rho c_s "
                          "v_t, with the speeds of the closed medium or of the "
                          "loosened one; for dynamics.",
                          Patterns::Selection("no|closed|loosened"));
    handler.add_parameter(
      "Traction",
      traction_text,
      "Force per area in Pa, one expression or table 'time: "
      "value, ...' per direction, separated by ';'.");
    handler.add_parameter("Pressure",
                          pressure_text,
                          "Pressure against the boundary in Pa, an "
                          "expression or a table 'time: value, ...'; its "
                          "direction stays that of the "
                          "undeformed body.");
  }

  types::boundary_id
  boundary_id_of(const std::string   &name,
                 const BoundaryNames &names,
                 const std::string   &where)
  {
    const auto found = names.find(name);
    if (found != names.end())
      return found->second;
    std::vector<std::string> known;
    for (const auto &entry : names)
      known.push_back(entry.first);
    const std::string nearest = nearest_name(name, known);
    throw UserError(where,
                    "unknown boundary '" + name + "'",
                    "one of: " + join(known, ", "),
                    nearest.empty() ? "name it in 'Geometry / Boundary names'" :
                                      "did you mean '" + nearest + "'?");
  }

  template <int dim>
  void
  BoundaryCondition<dim>::initialize(const SceneFile     &file,
                                     const BoundaryNames &names,
                                     const Constants     &constants)
  {
    const SceneFile::Path path = {"Boundaries", name};
    id                         = boundary_id_of(name, names, file.where(path));

    for (unsigned int d = 0; d < dim; ++d)
      if (!displacement_text[d].empty())
        displacement[d] = make_function<dim>(
          {displacement_text[d]},
          constants,
          file.where(path, std::string("Displacement ") + axis_names[d]));
    for (unsigned int d = 0; d < dim; ++d)
      if (!velocity_text[d].empty())
        {
          const std::string key = std::string("Velocity ") + axis_names[d];
          velocity[d]           = make_function<dim>({velocity_text[d]},
                                           constants,
                                           file.where(path, key));
          if (displacement[d])
            throw UserError(file.where(path, key),
                            "a velocity and a displacement",
                            "one of them",
                            "each follows from the other");
        }
    const std::string at = file.where(path, "Traction");
    if (!traction_text.empty())
      traction = make_function<dim>(split_components(traction_text, dim, at),
                                    constants,
                                    at);
    if (!pressure_text.empty())
      pressure = make_function<dim>({pressure_text},
                                    constants,
                                    file.where(path, "Pressure"));

    unsigned int n_prescribed = 0;
    for (unsigned int d = 0; d < dim; ++d)
      n_prescribed += displacement[d] || velocity[d] ? 1 : 0;
    if (absorbs() && (symmetry || n_prescribed > 0))
      throw UserError(file.where(path, "Absorbing"),
                      "an absorbing boundary whose motion is prescribed",
                      "a boundary that is free to move",
                      "a wave is absorbed or reflected: remove 'Absorbing', or "
                      "the symmetry, displacement or velocity");
    if (symmetry && n_prescribed > 0)
      throw UserError(file.where(path, "Symmetry"),
                      "symmetry and a prescribed motion",
                      "one of them at a boundary",
                      "symmetry already sets the normal displacement to zero");
    if (symmetry && pressure)
      throw UserError(file.where(path, "Pressure"),
                      "symmetry and a pressure",
                      "one of them at a boundary",
                      "the plane of symmetry takes any pressure by itself");
    if (n_prescribed == dim && (traction || pressure))
      throw UserError(file.where(path, traction ? "Traction" : "Pressure"),
                      "a load where all components of the displacement are "
                      "prescribed",
                      "a load only where the boundary can move",
                      "remove the load or free a component");
    if (traction)
      {
        const auto parts = split_components(traction_text, dim, at);
        for (unsigned int d = 0; d < dim; ++d)
          if ((displacement[d] || velocity[d]) && parts[d] != "0")
            throw UserError(at,
                            "'" + parts[d] + "' in the direction of " +
                              axis_names[d] +
                              ", where the displacement is prescribed",
                            "0 in that direction",
                            "prescribe the traction or the displacement");
      }
  }

  template <int dim>
  void
  BoundaryCondition<dim>::set_time(const double time)
  {
    for (auto &component : displacement)
      if (component)
        component->set_time(time);
    if (traction)
      traction->set_time(time);
    if (pressure)
      pressure->set_time(time);
  }

  template <int dim>
  bool
  BoundaryCondition<dim>::constrains() const
  {
    const auto any = [](const auto &components) {
      return std::any_of(components.begin(),
                         components.end(),
                         [](const auto &c) { return c != nullptr; });
    };
    return symmetry || any(displacement) || any(velocity);
  }

  template <int dim>
  std::string
  BoundaryCondition<dim>::dynamic_key() const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (velocity[d])
        return std::string("Velocity ") + axis_names[d];
    return absorbs() ? "Absorbing" : "";
  }

  template <int dim>
  bool
  BoundaryCondition<dim>::varies() const
  {
    return (traction && traction->varies()) || (pressure && pressure->varies());
  }

  template class BoundaryCondition<2>;
  template class BoundaryCondition<3>;
} // namespace Signoton
