#ifndef signoton_discretization_held_nodes_h
#define signoton_discretization_held_nodes_h

#include <signoton/discretization/boundary_conditions.h>

#include <deal.II/fe/fe.h>
#include <deal.II/lac/affine_constraints.h>

#include <boost/container/static_vector.hpp>

namespace Signoton
{
  template <int dim>
  class Space;

  /** Stands for the axis of revolution, which is in no section of the file. */
  constexpr unsigned int no_section = numbers::invalid_unsigned_int;

  /** One condition on the displacement of a node: $d\cdot u=v$. */
  template <int dim>
  struct HeldDirection
  {
    Tensor<1, dim> direction; ///< the unit vector d
    unsigned int   section;   ///< in the order of the file, or no_section
    unsigned int   component; ///< that is prescribed; dim for normals: v = 0

    /** The prescribed displacement, or else velocity; nullptr: v = 0. */
    SpaceTimeFunction<dim> *
    displacement(const BoundaryConditions<dim> &conditions) const
    {
      return component < dim ?
               conditions[section].displacement[component].get() :
               nullptr;
    }
    SpaceTimeFunction<dim> *
    velocity(const BoundaryConditions<dim> &conditions) const
    {
      return component < dim ? conditions[section].velocity[component].get() :
                               nullptr;
    }
  };

  /**
   * A node with all its conditions $Du=v$, the rows of D being independent
   * unit vectors: $u=D^+v+Pu$ with the pseudo-inverse $D^+=D^T(DD^T)^{-1}$ and
   * the projector $P=I-D^+D$ to what is left free. Since all components of a
   * node have the same mass, P is orthogonal in the norm of the kinetic energy
   * as well. The multipliers of the conditions are $\lambda=(D^+)^TR$ for the
   * force R of the supports.
   */
  template <int dim>
  class HeldNode
  {
  public:
    /** Compute what follows from the directions. */
    void
    finish();

    /** The displacement by the conditions, with nothing in the free
     *  directions: $D^+v$. */
    template <typename Value>
    Tensor<1, dim>
    motion(const Value &value) const
    {
      Tensor<1, dim> u;
      for (unsigned int i = 0; i < held.size(); ++i)
        {
          const double v = value(held[i]);
          for (unsigned int d = 0; d < dim; ++d)
            u[d] += inverse[d][i] * v;
        }
      return u;
    }

    std::array<types::global_dof_index, dim>                 dofs;
    Point<dim>                                               point;
    boost::container::static_vector<HeldDirection<dim>, dim> held;

    Tensor<2, dim> inverse;   ///< $D^+$, a column a direction
    Tensor<2, dim> projector; ///< P
    /** How all components follow those that are left free in constraints,
     *  $u=Tu_\text{free}$, with zero columns for the others. Those left free
     *  are chosen such that no entry is larger than one. */
    Tensor<2, dim> follow;
  };

  /** How facets of a plane mesh meet in a section with symmetry, in degrees:
   *  where they are taken as one smooth surface, and where as kinks. */
  struct FacetAngles
  {
    double largest_smooth = 0., smallest_kink = 180.;
  };

  /**
   * The nodes that boundary conditions hold. All conditions of a node are
   * collected before any is imposed, from all its faces, whatever sections and
   * ranks they belong to:
   *
   * - Normals of one smooth surface give one direction, those of different ones
   *   each its own. Where the mesh knows a curved surface, the normal is that
   *   of the surface; facets are averaged with the weights of N. Max (Journal
   *   of Graphics Tools 4, 1999), exact on circles, cylinders and spheres, so
   *   that these turn freely. Facets of one section that meet at less than its
   *   'Kink angle' are one surface.
   * - In the order of the file, directions that depend on others before them
   *   add nothing: the first holds. If they want another value, it is a
   *   contradiction.
   * - Hanging nodes go with those that move them, and hand their conditions on
   *   to a node at the same place or at the same place of another period.
   */
  template <int dim>
  class HeldNodes
  {
  public:
    /** A condition that others have made superfluous, or contradict. */
    struct Overruled
    {
      std::size_t        node; ///< number in nodes()
      HeldDirection<dim> condition;
    };

    /** Collect the nodes of the current mesh. */
    void
    reinit(const Space<dim> &space, const BoundaryConditions<dim> &conditions);

    void
    clear();

    bool
    is_current() const
    {
      return current;
    }

    /** Add lines with the values at the time last set. */
    void
    constrain(const BoundaryConditions<dim> &conditions,
              AffineConstraints<double>     &constraints) const;

    /** Those on own and ghost cells. */
    const std::vector<HeldNode<dim>> &
    nodes() const
    {
      return held_nodes;
    }

    /** Conditions at own nodes that were not needed. */
    const std::vector<Overruled> &
    overruled() const
    {
      return superfluous;
    }

    /** For each condition, over all ranks. */
    const std::vector<FacetAngles> &
    facet_angles() const
    {
      return angles;
    }

  private:
    std::vector<HeldNode<dim>> held_nodes;
    std::vector<Overruled>     superfluous;
    std::vector<FacetAngles>   angles;
    bool                       current = false;
  };

  /** Unknowns of the nodes of a cell: entry d of node n is the number in the
   *  cell of component d. */
  template <int dim>
  std::vector<std::array<unsigned int, dim>>
  nodes_of_cell(const FiniteElement<dim> &fe);
} // namespace Signoton

#endif
