#ifndef signoton_drivers_nodal_fields_h
#define signoton_drivers_nodal_fields_h

#include <signoton/drivers/model.h>
#include <signoton/drivers/point_quantities.h>

namespace Signoton
{
  /**
   * The stress as a field that is continuous within each material: at a vertex,
   * what the cells of a material that meet there extrapolate to it from their
   * quadrature points, by volume; in between linear. On an interface it has a
   * value on each side. Smoother than averages over cells, and closer to the
   * stress at the surface of the body; unlike them it may be a little outside of
   * the admissible set.
   */
  template <int dim>
  class NodalFields
  {
  public:
    using Field = LinearAlgebra::distributed::Vector<float>;

    NodalFields(const Model<dim> &model, const VectorType &displacement);

    /** Discontinuous and linear, for all fields. */
    DoFHandler<dim>          dof_handler;
    std::vector<std::string> names;
    std::vector<Field>       fields;

  private:
    static constexpr unsigned int n_vertices =
      GeometryInfo<dim>::vertices_per_cell;

    using Cells =
      std::vector<typename Triangulation<dim>::active_cell_iterator>;

    /** Call `action(cell, states)` with the states at the points of cells. */
    template <typename Action>
    void
    for_each(const Cells &cells, const Action &action) const;

    /** The own cells of a material. */
    Cells
    cells_of(const types::material_id material) const;

    /** Recover the fields in a material. */
    void
    recover(const types::material_id material);

    const Model<dim>          &model;
    const VectorType          &displacement;
    std::vector<PointQuantity> quantities;
    DoFHandler<dim>            vertices;
    AffineConstraints<double>  hanging;
    /** The weight of a quadrature point at a vertex of its cell. */
    std::array<std::vector<double>, n_vertices> extrapolation;
    // of a material: stresses times volume, and the volume, at vertices
    std::array<VectorType, 7> sums;
  };
} // namespace Signoton

#endif
