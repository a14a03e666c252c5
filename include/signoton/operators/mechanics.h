#ifndef signoton_operators_mechanics_h
#define signoton_operators_mechanics_h

#include <signoton/operators/energy_term.h>
#include <signoton/rheology/material.h>

namespace Signoton
{
  /** Sums over the body, on all ranks. */
  struct EnergyBalance
  {
    double stored      = 0.; ///< in J
    double dissipation = 0.; ///< of the step, in J
    /** Volume in each region, as a part of the whole. */
    std::array<double, Rheology::n_regions> region_share{};
  };

  /** Viscosity that spreads shocks over some cells, see
   *  Mechanics::dynamic_force(). Numbers without unit; zero for none. */
  struct ShockViscosity
  {
    double linear = 0., quadratic = 0.;

    explicit operator bool() const
    {
      return linear > 0. || quadratic > 0.;
    }

    /** The most that a cell is damped, as a part of critical damping: steps
     *  are stable with it, whatever shocks come. */
    double
    bound() const
    {
      return quadratic > 0. ? std::max(linear, 0.5) : linear;
    }
  };

  /** Sums over the own cells of a rank. */
  struct DynamicSums
  {
    double stored      = 0.; ///< in J, if asked for
    double voids       = 0.; ///< in m^3, if energies are asked for
    double dissipated  = 0.; ///< by hinges and dampers in the step, in J
    double viscous     = 0.; ///< of that, by dampers
    double shock       = 0.; ///< by the shock viscosity in the step, in J
    double quiet_cells = 0.; ///< that were skipped
    double failed      = 0.; ///< 1 if a law had no answer, see failure()
  };

  /** Averages over a cell, in the order of the entries xx, yy, zz, xy, xz, yz.
   *  The average of admissible stresses is admissible: the set is convex. */
  struct CellAverages
  {
    std::array<double, 6> stress{};
    std::array<double, 6> contact_strain{};
    std::array<double, 6> plastic_strain{};
    double                energy_density = 0.;
    /** The most advanced region at a point of the cell, see
     *  Rheology::Region. */
    unsigned int region = 0;
    /** Whether the points of the cell are in different regions. */
    bool mixed = false;
  };

  /** What is known at a point: tensors in the order of their entries xx, yy,
   *  zz, xy, xz, yz, each from its place in one array, so that all is
   *  interpolated alike. */
  struct PointState
  {
    enum Place : unsigned int
    {
      stress         = 0,  ///< in Pa
      strain         = 6,  ///< which the law sees: with the initial one
      contact_strain = 12, ///< of rigid contacts
      plastic_strain = 18, ///< of plastic hinges
      energy_density = 24, ///< stored, in J/m^3
      region         = 25, ///< see Rheology::Region; not to be interpolated
      n_values       = 26
    };

    std::array<double, n_values> values{};
  };

  /**
   * The integrals of mechanics over the cells of a mesh: internal force,
   * incremental potential, tangent. They all come from one cell operation,
   * evaluate gradients - work at points - integrate, which exists once for
   * each embedding and degree; this class is its face towards solvers and
   * drivers, which know the dimension only.
   *
   * The virtual calls are one for a sweep over the mesh. Inside a sweep the law
   * is a template argument.
   */
  template <int dim>
  class Mechanics : public EnergyTerm<dim>
  {
  public:
    /** Set up for the current mesh and unknowns. History becomes zero. */
    virtual void
    reinit() = 0;

    /** Take laws that are other than the scene says, or go back to those. */
    virtual void
    set_scaling(const Rheology::Scaling &scaling) = 0;

    /** The time step in s, for laws with viscosity. */
    virtual void
    set_time_step(const double time_step) = 0;

    /** Strain and stress before anything moves, as functions of the point with
     *  the components xx, yy, zz, xy (, xz, yz); nullptr for none. */
    struct InitialState
    {
      const Function<dim> *strain = nullptr;
      const Function<dim> *stress = nullptr;
      std::string          where; ///< in the scene file, for messages

      explicit operator bool() const
      {
        return strain != nullptr || stress != nullptr;
      }
    };

    /** Takes effect with the next reinit(). The law sees $\varepsilon(u)+
     *  \varepsilon_0+E^{-1}:\sigma_0$. Throws there unless that state has the
     *  stress $\sigma_0$, if one is given. */
    virtual void
    set_initial_state(const InitialState &state) = 0;

    /** Of dynamic_force(); takes effect with the next reinit(). */
    virtual void
    set_shock_viscosity(const ShockViscosity &viscosity) = 0;

    /** A vector of unknowns with the ghosts that the sweeps need. */
    virtual void
    initialize_vector(VectorType &vector) const = 0;

    /** Where loads balance the initial stress but for round-off, let them
     *  balance it exactly in dynamic_force(), so that what is at rest stays
     *  there. */
    virtual void
    balance_rest(const VectorType &external) = 0;

    /**
     * The internal force $\int\sigma_{n+1}:\varepsilon(v)$, the incremental
     * potential of the body, and with them the trial history. Shock viscosity
     * is in it, with rates since the begin of the step.
     */
    double
    evaluate(const VectorType &displacement,
             VectorType       &force,
             const bool        linearize) override = 0;

    /** Norms of forces of elements, in N. */
    struct ElementForces
    {
      /** Of the conditional stress $E:\varepsilon$, that of closed contacts and
       *  hinges that hold. */
      double conditional = 0.;
      /** What elements would bear if the displacements of their nodes did not
       *  cancel: the forces of elements are differences of these. */
      double with_rigid_motion = 0.;
    };

    virtual ElementForces
    element_forces(const VectorType &displacement) = 0;

    /** How far the strain exceeds that of the stress if all contacts were closed
     *  and all hinges held: $\sqrt{\int\varepsilon:E:\varepsilon\,/
     *  \int\sigma:E^{-1}:\sigma}$, one for elastic bodies, the inverse of the
     *  ratio of a binder that bears alone. */
    virtual double
    strain_by_stress(const VectorType &displacement) = 0;

    /** The part of the internal force that the binders in parallel with contacts
     *  bear: that of $B:x$ with the strain x of what they bridge, in the
     *  accepted state. */
    virtual void
    binder_force(const VectorType &displacement, VectorType &force) = 0;

    /**
     * Internal force, in place of what @p force had, and trial history of
     * explicit time integration. Fronts are spread by a viscous stress
     * (after von Neumann and Richtmyer 1950, by the speed of the front; see
     * shock_coefficients()).
     * @param with_energies if not, only what is dissipated is summed up, and
     *   the step is accepted at once, without commit()
     * @param quiet cells are skipped, as being at rest, if no unknown of theirs
     *   exceeds this displacement in m; none are if it is negative
     */
    virtual DynamicSums
    dynamic_force(const VectorType &displacement,
                  VectorType       &force,
                  const bool        with_energies,
                  const double      quiet) = 0;

    /** Shock viscosity takes rates since @p displacement in the next sweep. */
    virtual void
    begin_step(const VectorType &displacement) = 0;

    /** Add the force of shock viscosity in the step before, as cells tell it:
     *  on a new mesh there is no step that it could be taken from. */
    virtual void
    add_shock_force(VectorType &force) = 0;

    /** A bound of the stable step of central differences in s, without safety:
     *  about the time in which the fastest wave of the closed medium crosses
     *  the smallest cell, with the diagonal mass. On all ranks. */
    virtual double
    stable_time_step() = 0;

    /** Accept the trial history. */
    virtual void
    commit() = 0;

    /** Forget the trial history. */
    virtual void
    discard() = 0;

    virtual EnergyBalance
    energy_balance(const VectorType &displacement) = 0;

    /** Averages for the locally owned active cells, by active cell index. */
    virtual std::vector<CellAverages>
    cell_averages(const VectorType &displacement) = 0;

    /** The numbers under which the sweeps know own cells.
     *  @param cells active cell indices */
    virtual std::vector<unsigned int>
    cell_numbers(const std::vector<unsigned int> &cells) const = 0;

    /** What is known at the quadrature points of some own cells, which may be
     *  none: their points one after the other. On all ranks.
     *  @param cells as cell_numbers() has them; fast if sorted */
    virtual void
    point_states(const VectorType                &displacement,
                 const std::vector<unsigned int> &cells,
                 std::vector<PointState>         &states) = 0;

    /** The in-plane entries of the stress as a field of points, in the order
     *  of the raw entries of a SymmetricTensor<2,dim>. */
    virtual void
    stress_field(const VectorType      &displacement,
                 const PointSpace<dim> &points,
                 VectorType            &field) = 0;

    /** Numbers of history that the largest law keeps at a point. */
    virtual unsigned int
    history_width() const = 0;

    /** Numbers that a point takes along to another mesh or to a checkpoint: the
     *  history, and what shock viscosity knows of its cell. */
    virtual unsigned int
    state_width() const = 0;

    /** Accepted history as a field of points, and back. Interpolation may
     *  push accumulated scalars below zero: they are cut off there. To bring
     *  the stress back to the admissible set as well, evaluate the internal
     *  force and commit: points outside flow, at fixed strain, until inside. */
    virtual void
    save_history(const PointSpace<dim> &points, VectorType &field) = 0;

    virtual void
    load_history(const PointSpace<dim> &points, const VectorType &field) = 0;

    /** Bytes on this rank by purpose. */
    struct Memory
    {
      std::size_t history = 0, tangent = 0, initial_state = 0,
                  shock_viscosity = 0, mesh_data = 0;
    };

    virtual Memory
    memory() const = 0;
  };

  /** The mechanics of a space: chooses the instantiation for its degree (1 or
   *  2) and embedding. Both arguments must outlive the result. */
  template <int dim>
  std::unique_ptr<Mechanics<dim>>
  make_mechanics(const Space<dim>                      &space,
                 const std::vector<Rheology::Material> &materials);
} // namespace Signoton

#endif
