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
  PointForces<dim>::reinit(const Space<dim>  &new_space,
                           const List        &new_list,
                           PointLocator<dim> *new_places)
  {
    space  = &new_space;
    list   = &new_list;
    places = new_places;
    if (places != nullptr)
      places->places(); // complains early
  }

  template <int dim>
  void
  PointForces<dim>::add(const LoadKind kind, VectorType &force) const
  {
    if (places == nullptr)
      return;
    const auto                          &fe = space->fe;
    Vector<double>                       cell_force(fe.n_dofs_per_cell());
    std::vector<types::global_dof_index> dofs(cell_force.size());
    for (const auto &place : places->places())
      {
        const PointForce<dim> &point = (*list)[place.target];
        if (load_kind(point.varies) != kind)
          continue;
        Tensor<1, dim> value;
        for (unsigned int d = 0; d < dim; ++d)
          value[d] = place.share * point.force->value(point.place, d);
        for (unsigned int i = 0; i < cell_force.size(); ++i)
          cell_force[i] = fe.shape_value(i, place.unit) *
                          value[fe.system_to_component_index(i).first];
        typename DoFHandler<dim>::active_cell_iterator(&space->mesh,
                                                       place.cell->level(),
                                                       place.cell->index(),
                                                       &space->dof_handler)
          ->get_dof_indices(dofs);
        space->mesh_constraints.distribute_local_to_global(cell_force,
                                                           dofs,
                                                           force);
      }
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
