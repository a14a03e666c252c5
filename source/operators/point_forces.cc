#include <signoton/operators/point_forces.h>

#include <cmath>
#include <limits>

namespace Signoton
{
  template <int dim>
  Point<dim>
  parse_point(const std::string &text, const std::string &where)
  {
    const auto coordinates = Utilities::split_string_list(text, ',');
    if (coordinates.size() != dim)
      throw UserError(where,
                      "'" + text + "'",
                      std::to_string(dim) + " coordinates of each point",
                      "separate coordinates by ',' and points by ';'");
    Point<dim> p;
    try
      {
        for (unsigned int d = 0; d < dim; ++d)
          p[d] = Utilities::string_to_double(coordinates[d]);
      }
    catch (const ExceptionBase &)
      {
        p[0] = std::numeric_limits<double>::quiet_NaN();
      }
    if (!std::isfinite(p.norm_square()))
      throw UserError(where,
                      "'" + text + "'",
                      "numbers",
                      "coordinates of points are no expressions");
    return p;
  }

  template <int dim>
  void
  PointForce<dim>::add_parameters(ParameterHandler &handler)
  {
    handler.add_parameter("Point",
                          place_text,
                          "Where it acts: coordinates separated by ','.");
    handler.add_parameter(
      "Force",
      force_text,
      "In N, per metre in plane strain, on the whole "
      "circle in axisymmetry: one expression or table 'time: "
      "value, ...' per direction, separated by ';'. On a plane of symmetry, "
      "the half "
      "that belongs to the modeled side.");
  }

  template <int dim>
  void
  PointForce<dim>::initialize(const SceneFile &file, const Constants &constants)
  {
    const SceneFile::Path path = {"Point forces", name};
    place = parse_point<dim>(place_text, file.where(path, "Point"));
    const std::string where = file.where(path, "Force");
    force  = make_function<dim>(split_components(force_text, dim, where),
                               constants,
                               where);
    varies = force->varies();
  }

  template <int dim>
  void
  PointForces<dim>::reinit(const Space<dim> &new_space, const List &new_list)
  {
    space = &new_space;
    list  = &new_list;
    if (list->empty())
      return;
    // one rank brings the forces, whichever has the cells
    std::vector<Point<dim>> places;
    if (Utilities::MPI::this_mpi_process(space->communicator) == 0)
      for (const auto &force : *list)
        places.push_back(force.place);
    search =
      std::make_unique<Utilities::MPI::RemotePointEvaluation<dim>>(1e-6, true);
    search->reinit(places, space->mesh, space->mapping);
  }

  template <int dim>
  void
  PointForces<dim>::add(const LoadKind                   kind,
                        const AffineConstraints<double> &constraints,
                        VectorType                      &force) const
  {
    const auto is_wanted = [&](const PointForce<dim> &point) {
      return load_kind(point.varies) == kind;
    };
    if (list == nullptr || std::none_of(list->begin(), list->end(), is_wanted))
      return;
    std::vector<Tensor<1, dim>> values, buffer;
    if (Utilities::MPI::this_mpi_process(space->communicator) == 0)
      for (const auto &point : *list)
        {
          values.emplace_back();
          if (is_wanted(point))
            for (unsigned int d = 0; d < dim; ++d)
              values.back()[d] = point.force->value(point.place, d);
        }
    const auto                          &fe = space->fe;
    Vector<double>                       cell_force(fe.n_dofs_per_cell());
    std::vector<types::global_dof_index> dofs(cell_force.size());
    search->template process_and_evaluate<Tensor<1, dim>>(
      values,
      buffer,
      [&](const ArrayView<const Tensor<1, dim>> &at_points, const auto &data) {
        for (unsigned int c = 0; c < data.cells.size(); ++c)
          {
            const typename DoFHandler<dim>::active_cell_iterator cell(
              &space->mesh,
              data.cells[c].first,
              data.cells[c].second,
              &space->dof_handler);
            cell_force = 0.;
            for (unsigned int q = data.reference_point_ptrs[c];
                 q < data.reference_point_ptrs[c + 1];
                 ++q)
              for (unsigned int i = 0; i < cell_force.size(); ++i)
                cell_force[i] +=
                  fe.shape_value(i, data.reference_point_values[q]) *
                  at_points[q][fe.system_to_component_index(i).first];
            cell->get_dof_indices(dofs);
            constraints.distribute_local_to_global(cell_force, dofs, force);
          }
      });
  }

  template class PointForce<2>;
  template class PointForce<3>;
  template class PointForces<2>;
  template class PointForces<3>;
  template Point<2>
  parse_point<2>(const std::string &, const std::string &);
  template Point<3>
  parse_point<3>(const std::string &, const std::string &);
} // namespace Signoton
