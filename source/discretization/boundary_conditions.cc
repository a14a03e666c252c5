#include <signoton/discretization/boundary_conditions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/numerics/vector_tools_boundary.h>
#include <deal.II/numerics/vector_tools_constraints.h>

namespace Signoton
{
  namespace
  {
    constexpr std::array<char, 3> axis_names = {{'x', 'y', 'z'}};

    /** One scalar function in one component of a vector of functions. */
    template <int dim>
    class OneComponent : public Function<dim>
    {
    public:
      OneComponent(const Function<dim> &scalar, const unsigned int component)
        : Function<dim>(dim)
        , scalar(scalar)
        , component(component)
      {}

      double
      value(const Point<dim> &p, const unsigned int c) const override
      {
        return c == component ? scalar.value(p) : 0.;
      }

    private:
      const Function<dim> &scalar;
      const unsigned int   component;
    };

    std::vector<std::string>
    motion_names(const int dim, const bool axisymmetric)
    {
      if (axisymmetric)
        return {"translation y (along the axis)"};
      if (dim == 2)
        return {"translation x", "translation y", "rotation in the plane"};
      return {"translation x",
              "translation y",
              "translation z",
              "rotation about x",
              "rotation about y",
              "rotation about z"};
    }
  } // namespace

  template <int dim>
  void
  BoundaryCondition<dim>::add_parameters(ParameterHandler &handler)
  {
    handler.add_parameter("Symmetry",
                          symmetry,
                          "No displacement normal to the boundary, no shear "
                          "traction.");
    for (unsigned int d = 0; d < dim; ++d)
      handler.add_parameter(std::string("Displacement ") + axis_names[d],
                            displacement_text[d],
                            "Prescribed component of the displacement in m, an "
                            "expression in x, y, (z,) t, or a table 'time: "
                            "value, time: value' with straight lines in "
                            "between; empty: free. Where boundaries meet, the "
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

  template <int dim>
  void
  constrain_displacement(const Mapping<dim>            &mapping,
                         const DoFHandler<dim>         &dof_handler,
                         const BoundaryConditions<dim> &conditions,
                         AffineConstraints<double>     &constraints)
  {
    for (const auto &condition : conditions)
      for (unsigned int d = 0; d < dim; ++d)
        {
          // the value of a velocity does not matter: what integrates in time
          // knows the displacement
          const auto *function = condition.displacement[d] ?
                                   condition.displacement[d].get() :
                                   condition.velocity[d].get();
          if (function == nullptr)
            continue;
          ComponentMask mask(dim, false);
          mask.set(d, true);
          VectorTools::interpolate_boundary_values(mapping,
                                                   dof_handler,
                                                   condition.id,
                                                   OneComponent<dim>(*function,
                                                                     d),
                                                   constraints,
                                                   mask);
        }
    std::set<types::boundary_id> symmetric;
    for (const auto &condition : conditions)
      if (condition.symmetry)
        symmetric.insert(condition.id);
    if (!symmetric.empty())
      VectorTools::compute_no_normal_flux_constraints(
        dof_handler, 0, symmetric, constraints, mapping);
  }

  template <int dim>
  std::vector<std::vector<double>>
  rigid_motions(const Mapping<dim>    &mapping,
                const DoFHandler<dim> &dof_handler,
                const IndexSet        &dofs,
                const bool             axisymmetric)
  {
    std::map<types::global_dof_index, Point<dim>> points;
    DoFTools::map_dofs_to_support_points(mapping, dof_handler, points);
    const auto box =
      GridTools::compute_bounding_box(dof_handler.get_triangulation());
    const MPI_Comm communicator = dof_handler.get_communicator();
    Point<dim>     center;
    double         size = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double low =
                       Utilities::MPI::min(box.get_boundary_points().first[d],
                                           communicator),
                     high =
                       Utilities::MPI::max(box.get_boundary_points().second[d],
                                           communicator);
        center[d] = 0.5 * (low + high);
        size      = std::max(size, 0.5 * (high - low));
      }

    const unsigned int n_modes = motion_names(dim, axisymmetric).size();
    std::vector<std::vector<double>> modes(
      n_modes, std::vector<double>(dofs.n_elements(), 0.));
    const auto                          &fe = dof_handler.get_fe();
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < indices.size(); ++i)
            if (dofs.is_element(indices[i]))
              {
                const auto row = dofs.index_within_set(indices[i]);
                const auto c   = fe.system_to_component_index(i).first;
                if (axisymmetric)
                  {
                    modes[0][row] = c == 1 ? 1. : 0.;
                    continue;
                  }
                modes[c][row] = 1.;
                const Tensor<1, dim> arm =
                  (points.at(indices[i]) - center) / size;
                if (dim == 2)
                  modes[2][row] = c == 0 ? -arm[1] : arm[0];
                else
                  for (unsigned int axis = 0; axis < 3; ++axis)
                    {
                      const unsigned int next = (axis + 1) % 3,
                                         last = (axis + 2) % 3;
                      modes[3 + axis][row]    = c == next ? -arm[last % dim] :
                                                c == last ? arm[next % dim] :
                                                            0.;
                    }
              }
        }
    return modes;
  }

  template <int dim>
  std::vector<std::string>
  free_rigid_motions(const Mapping<dim>              &mapping,
                     const DoFHandler<dim>           &dof_handler,
                     const AffineConstraints<double> &constraints,
                     const bool                       axisymmetric)
  {
    // A motion is free if it satisfies all constraints: the null space of the
    // Gram matrix of the amounts by which motions violate them.
    const IndexSet &owned = dof_handler.locally_owned_dofs();
    IndexSet        relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    const auto modes =
      rigid_motions(mapping, dof_handler, relevant, axisymmetric);
    const auto         names = motion_names(dim, axisymmetric);
    const unsigned int n     = modes.size();

    std::vector<double> gram(n * n, 0.);
    std::vector<double> violation(n);
    for (const auto dof : owned)
      if (constraints.is_constrained(dof))
        {
          for (unsigned int a = 0; a < n; ++a)
            {
              violation[a] = modes[a][relevant.index_within_set(dof)];
              for (const auto &[other, weight] :
                   *constraints.get_constraint_entries(dof))
                violation[a] -=
                  weight * modes[a][relevant.index_within_set(other)];
            }
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
              gram[a * n + b] += violation[a] * violation[b];
        }
    Utilities::MPI::sum(gram, dof_handler.get_communicator(), gram);

    LAPACKFullMatrix<double> matrix(n, n);
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = 0; b < n; ++b)
        matrix(a, b) = gram[a * n + b];
    Vector<double>     eigenvalues(n);
    FullMatrix<double> directions(n, n);
    const double       scale = std::max(matrix.frobenius_norm(), 1.);
    matrix.compute_eigenvalues_symmetric(
      -scale, 1e-10 * scale, 0., eigenvalues, directions);

    // Name a free motion by the basic motions that take part in it.
    std::vector<std::string> result;
    for (unsigned int i = 0; i < directions.n(); ++i)
      {
        std::vector<std::string> parts;
        for (unsigned int a = 0; a < n; ++a)
          if (std::abs(directions(a, i)) > 1e-5)
            parts.push_back(names[a]);
        result.push_back(join(parts, " with "));
      }
    return result;
  }

#define INSTANTIATE(dim)                                                     \
  template class BoundaryCondition<dim>;                                     \
  template void constrain_displacement<dim>(const Mapping<dim> &,            \
                                            const DoFHandler<dim> &,         \
                                            const BoundaryConditions<dim> &, \
                                            AffineConstraints<double> &);    \
  template std::vector<std::string> free_rigid_motions<dim>(                 \
    const Mapping<dim> &,                                                    \
    const DoFHandler<dim> &,                                                 \
    const AffineConstraints<double> &,                                       \
    const bool);                                                             \
  template std::vector<std::vector<double>> rigid_motions<dim>(              \
    const Mapping<dim> &,                                                    \
    const DoFHandler<dim> &,                                                 \
    const IndexSet &,                                                        \
    const bool);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
