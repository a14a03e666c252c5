#ifndef signoton_discretization_space_h
#define signoton_discretization_space_h

#include <signoton/discretization/held_nodes.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/la_parallel_vector.h>

namespace Signoton
{
  using VectorType = LinearAlgebra::distributed::Vector<double>;

  /**
   * Mesh, finite element space of the displacement and its constraints.
   */
  template <int dim>
  class Space
  {
  public:
    Space(const MPI_Comm    &communicator,
          const unsigned int degree,
          const bool         axisymmetric);

    /** Number the unknowns of the current mesh. */
    void
    distribute_dofs();

    /** Collect hanging nodes, periodicity and the conditions at the boundary
     *  with the values at the time last set. */
    void
    update_constraints(const BoundaryConditions<dim> &conditions);

    /** A vector that can be read at all dofs of the own and ghost cells. */
    VectorType
    make_relevant_vector() const;

    /** Volume of the body as it is in space: an area times one metre in plane
     *  strain, swept around the axis in axisymmetry. */
    double
    weight(const Point<dim> &p) const
    {
      return axisymmetric ? 2. * numbers::PI * p[0] : 1.;
    }

    const unsigned int degree;
    const bool         axisymmetric;

    MPI_Comm                                  communicator;
    parallel::distributed::Triangulation<dim> mesh;
    BoundaryParts                             boundary;
    FESystem<dim>                             fe;
    MappingQ<dim>                             mapping;
    QGauss<dim>                               quadrature;
    DoFHandler<dim>                           dof_handler;
    IndexSet                                  relevant_dofs;
    /** Nodes with conditions at the boundary, of the present mesh. */
    HeldNodes<dim> held;
    /** Everything that restricts the displacement. */
    AffineConstraints<double> constraints;
    /** The same for increments: with zero right hand sides. */
    AffineConstraints<double> increment_constraints;
    /** Hanging nodes and periodicity only: residuals of these are reactions. */
    AffineConstraints<double> mesh_constraints;
  };

  /**
   * Discontinuous fields whose nodes are the quadrature points, so that a
   * value at a point is a degree of freedom: the form in which point data is
   * transferred between meshes, saved, and differentiated.
   */
  template <int dim>
  class PointSpace
  {
  public:
    PointSpace(const Space<dim> &space, const unsigned int n_components);

    /** Number the degrees of freedom, unless the mesh is still the same. */
    void
    update();

    /** With ghost values of neighbor cells, not yet filled. */
    VectorType
    make_relevant_vector() const;

    /** Degree of freedom on a cell of a component at a point. */
    unsigned int
    cell_index(const unsigned int component, const unsigned int point) const
    {
      return fe.component_to_system_index(component, point);
    }

    const unsigned int n_components;
    FESystem<dim>      fe;
    DoFHandler<dim>    dof_handler;

  private:
    bool                               is_current = false;
    boost::signals2::scoped_connection mesh_changes;
  };
} // namespace Signoton

#endif
