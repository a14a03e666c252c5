#ifndef signoton_operators_energy_term_h
#define signoton_operators_energy_term_h

#include <signoton/discretization/space.h>
#include <signoton/operators/failure.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace Signoton
{
  /**
   * One term of the energy $J(u)$ that an equilibrium, or an implicit step of
   * the equation of motion, minimizes: the material, inertia, dashpots.
   *
   * Forces are those of the mesh: hanging and periodic nodes hand theirs on to
   * the nodes that they follow, while supported unknowns are as free as others.
   * What the supports take is taken away once, from the sum of all terms; it is
   * the reactions.
   */
  template <int dim>
  class EnergyTerm
  {
  public:
    virtual ~EnergyTerm() = default;

    /**
     * Add the gradient of the term at @p u, in N, to @p force.
     * @param linearize also keep what the tangent needs
     * @return the energy in J of the part of the body that this rank has
     */
    virtual double
    evaluate(const VectorType &u, VectorType &force, const bool linearize) = 0;

    /** Of the last evaluation, on this rank. */
    virtual Failure<dim>
    failure() const
    {
      return {};
    }

    /** Add the product of the kept tangent and an increment that may be
     *  anything where the displacement is prescribed. */
    virtual void
    apply_tangent(const VectorType &increment, VectorType &force) const = 0;

    /**
     * Add the kept tangent, condensed by all constraints of the space. The
     * caller compresses.
     * @param regularization multiple of the elastic tangent that is added,
     *   to keep loosened or flowing zones solvable; residuals never have it
     */
    virtual void
    assemble(TrilinosWrappers::SparseMatrix &matrix,
             const double                    regularization) = 0;

    /** Norm in N of the forces that the gradient at @p u is a difference of:
     *  what is small beside them is round-off. */
    virtual double
    size_of_differences(const VectorType &u) = 0;

    /** Norm in N of what the term last added, as far as it stands beside loads
     *  and reactions in the balance of forces. */
    virtual double
    outer_force() const
    {
      return 0.;
    }

    /** Whether the gradient is linear. */
    virtual bool
    is_linear() const
    {
      return true;
    }

    /** Whether there is an energy at all; if not, the tangent is not symmetric,
     *  and evaluate() returns nothing of use. */
    virtual bool
    has_potential() const
    {
      return true;
    }
  };
} // namespace Signoton

#endif
