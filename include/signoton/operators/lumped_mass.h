#ifndef signoton_operators_lumped_mass_h
#define signoton_operators_lumped_mass_h

#include <signoton/discretization/space.h>
#include <signoton/rheology/material.h>

#include <deal.II/fe/fe_values.h>

#include <boost/container/flat_map.hpp>

namespace Signoton
{
  /**
   * The diagonal mass of a cell at its unknowns in kg: $\int\rho\,\varphi_i$ by
   * the Gauss-Lobatto rule whose points are the nodes of the element, so that
   * the matrix is diagonal by itself and its entries are positive. In
   * axisymmetry these integrals are exact, so that plane waves along the axis
   * stay plane. Quadratic shape functions would have next to none beside the
   * axis: of these cells the mass goes to the nodes in the proportions of
   * $\int\rho\,\varphi_i^2$ (Hinton, Rock and Zienkiewicz 1976).
   */
  template <int dim>
  class CellMass
  {
  public:
    CellMass(const Space<dim>                      &space,
             const std::vector<Rheology::Material> &materials);

    /** Valid until the next call. The cell need not be active. */
    const Vector<double> &
    operator()(const typename DoFHandler<dim>::cell_iterator &cell);

  private:
    const Space<dim>                                      &space;
    FEValues<dim>                                          values;
    boost::container::flat_map<types::material_id, double> density;
    Vector<double>                                         mass, squares;
  };

  /**
   * The diagonal mass of all unknowns. Hanging and periodic nodes give their
   * mass to those that move them, in the parts in which they are moved: the
   * mass of the body is kept, and a velocity that is constant has its momentum
   * exactly. Their own entries are zero. Conditions at the boundary do not
   * count.
   */
  template <int dim>
  VectorType
  lumped_mass(const Space<dim>                      &space,
              const std::vector<Rheology::Material> &materials);
} // namespace Signoton

#endif
