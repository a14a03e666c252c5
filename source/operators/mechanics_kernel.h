#ifndef signoton_operators_mechanics_kernel_h
#define signoton_operators_mechanics_kernel_h

#include <signoton/base/floating_point_traps.h>
#include <signoton/operators/mechanics.h>
#include <signoton/operators/shock_viscosity.h>
#include <signoton/state/point_history.h>
#include <signoton/tensors/embedding.h>
#include <signoton/tensors/lanes.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>

#include <functional>
#include <optional>

namespace Signoton
{
  /** What has to be evaluated, and integrated, in a cell. */
  template <typename Embedding>
  const EvaluationFlags::EvaluationFlags cell_flags =
    Embedding::axisymmetric ?
      EvaluationFlags::values | EvaluationFlags::gradients :
      EvaluationFlags::gradients;

  /**
   * Mechanics for one embedding and degree. See Mechanics for what its
   * functions do; here is how.
   *
   * Cells of one material form runs of cell batches; std::visit picks the law
   * once a run. Quadrature is Gauss with degree+1 points a direction.
   */
  template <typename Embedding, int degree>
  class MechanicsKernel : public Mechanics<Embedding::dim>
  {
  public:
    static constexpr int dim = Embedding::dim;

    using Number = VectorizedArray<double>;
    using Cell   = FEEvaluation<dim, degree, degree + 1, dim, double>;
    using Data   = MatrixFree<dim, double>;
    using Range  = std::pair<unsigned int, unsigned int>;
    using Sensor = FrontSensor<dim>;

    MechanicsKernel(const Space<dim>                      &space,
                    const std::vector<Rheology::Material> &materials);

    void
    reinit() override;
    void
    set_scaling(const Rheology::Scaling &scaling) override;
    void
    set_time_step(const double time_step) override;
    void
    set_initial_state(
      const typename Mechanics<dim>::InitialState &state) override;
    void
    set_shock_viscosity(const ShockViscosity &viscosity) override;
    void
    initialize_vector(VectorType &vector) const override;
    void
    balance_rest(const VectorType &external) override;
    double
    evaluate(const VectorType &displacement,
             VectorType       &force,
             const bool        linearize) override;
    typename Mechanics<dim>::ElementForces
    element_forces(const VectorType &displacement) override;
    Failure<dim>
    failure() const override
    {
      return worst_failure;
    }
    double
    size_of_differences(const VectorType &displacement) override;
    bool
    is_linear() const override;
    bool
    has_potential() const override;
    double
    strain_by_stress(const VectorType &displacement) override;
    void
    binder_force(const VectorType &displacement, VectorType &force) override;
    void
    apply_tangent(const VectorType &increment,
                  VectorType       &force) const override;
    void
    assemble(TrilinosWrappers::SparseMatrix &matrix,
             const double                    regularization) override;
    DynamicSums
    dynamic_force(const VectorType &displacement,
                  VectorType       &force,
                  const bool        with_energies,
                  const double      quiet) override;
    void
    begin_step(const VectorType &displacement) override;
    void
    add_shock_force(VectorType &force) override;
    double
    stable_time_step() override;
    void
    commit() override;
    void
    discard() override;
    EnergyBalance
    energy_balance(const VectorType &displacement) override;
    std::vector<CellAverages>
    cell_averages(const VectorType &displacement) override;
    std::vector<unsigned int>
    cell_numbers(const std::vector<unsigned int> &cells) const override;
    void
    point_states(const VectorType                &displacement,
                 const std::vector<unsigned int> &cells,
                 std::vector<PointState>         &states) override;
    void
    stress_field(const VectorType      &displacement,
                 const PointSpace<dim> &points,
                 VectorType            &field) override;
    unsigned int
    history_width() const override;
    unsigned int
    state_width() const override;
    void
    save_history(const PointSpace<dim> &points, VectorType &field) override;
    void
    load_history(const PointSpace<dim> &points,
                 const VectorType      &field) override;
    typename Mechanics<dim>::Memory
    memory() const override;

  private:
    static constexpr unsigned int n_tensor_entries =
      Embedding::tensor_entries.size();
    static constexpr unsigned int n_points =
      Utilities::pow(degree + 1, dim); ///< of a cell
    /** The size of a cube whose largest frequency is 2 c by that size, as that
     *  of a cube of linear elements, whose mode is of constant strain. Quadratic
     *  elements with a diagonal mass have sqrt(24) c/h in one dimension, and up
     *  to 15 % more in three. */
    static constexpr double part_of_size =
      degree == 1 ? 1. : 1. / (1.15 * 2.449489742783178);

    /** What a sweep does with the response at each point. */
    struct PointResponse
    {
      unsigned int                      batch;
      unsigned int                      q;
      Number                            weight; ///< volume of the point in m^3
      const Tensor2<Number>            &strain;
      const Rheology::Response<Number> &response;
    };
    using Visitor = std::function<void(const PointResponse &)>;

    void
    find_materials();

    /** Unknowns of the point space on the cell in a lane of a batch. */
    void
    point_dofs(const PointSpace<dim>                &points,
               const unsigned int                    batch,
               const unsigned int                    lane,
               std::vector<types::global_dof_index> &dofs) const;

    /** Numbers of history at a point. */
    static unsigned int
    width(const Rheology::Law &law);

    template <typename Law>
    static void
    read_history(const Number *values, Rheology::History<Law, Number> &history);
    template <typename Law>
    static void
    write_history(const Rheology::History<Law, Number> &history,
                  Number                               *values);

    /** The symmetric gradient of what the cell has read. */
    Tensor2<Number>
    strain(const Cell &cell, const unsigned int q) const;
    /** The same and the initial strain. */
    Tensor2<Number>
    total_strain(const Cell        &cell,
                 const unsigned int batch,
                 const unsigned int q) const;
    /** A tensor of the current batch in an array of rest values. */
    static Tensor2<Number>
    tensor_at(const AlignedVector<Number> &values,
              const unsigned int           batch,
              const unsigned int           q);
    void
    submit(Cell                  &cell,
           const unsigned int     q,
           const Tensor2<Number> &stress) const;
    Number
    weight(const Cell &cell, const unsigned int q) const;

    /** Call `action(law, run)` for every run of cells of one material. */
    template <typename Action>
    void
    for_each_run(const Range &range, const Action &action) const;

    /** The nonlinear cell operation: evaluate, update, integrate. Adds to the
     *  force; the energy is that of own cells. */
    template <unsigned int request>
    double
    sweep(const VectorType &displacement, VectorType &force);
    template <unsigned int request, typename Law>
    double
    update_run(const Law        &law,
               Cell             &cell,
               const Range      &run,
               const VectorType &displacement,
               VectorType       &force);

    /** Remember where a law has failed, if that is worse than before. */
    template <typename Law>
    void
    note_failure(const Law                        &law,
                 const unsigned int                batch,
                 const Rheology::Response<Number> &response);

    /** Everything a law knows, point by point, without integration. */
    void
    visit_points(const VectorType &displacement, const Visitor &visitor);
    template <typename Law>
    void
    visit_run(const Law        &law,
              Cell             &cell,
              const Range      &run,
              const VectorType &displacement,
              const Visitor    &visitor);
    static PointState
    state_of_lane(const PointResponse &point, const unsigned int lane);

    // mechanics_shock.templates.h
    /** The viscous stress of a batch in the step. */
    ShockStress<Number>
    shock_of(const unsigned int batch) const;
    /** What materials, and how large cells, are to shock viscosity. */
    void
    find_shock_materials();
    void
    find_sizes();
    /** What a point tells of its cell, summed up over the cell. */
    struct Motion
    {
      Tensor2<Number> change, ///< of strain in the step
        of_law, stress;       ///< without and with the viscous stress
      Number voids = 0., viscous = 0., volume = 0.;
    };
    /** Add the viscous stress at a point to that of the law, and note what is
     *  to be told of the cell.
     *  @param change of the strain in the step
     *  @return the dissipation in J/m^3 */
    template <typename Law>
    Number
    resist(const ShockStress<Number>  &shock,
           const Tensor2<Number>      &change,
           const Tensor2<Number>      &strain,
           Rheology::Response<Number> &response,
           Motion                     &motion) const;
    /** Let the cells of a batch tell their neighbors about the step.
     *  @return what is to be added to the dissipation in J */
    Number
    tell_neighbors(const unsigned int         batch,
                   const ShockStress<Number> &shock,
                   const Motion              &motion);

    // mechanics_rest.templates.h
    /** Strains, stresses and energies of the initial state. */
    void
    find_rest();
    void
    integrate_rest();
    /** Add the force of what stress(batch, point) returns. */
    template <typename Stress>
    void
    integrate_stress(const Stress &stress, VectorType &force);
    void
    refuse_contradiction(const double      difference,
                         const double      given,
                         const Point<dim> &where);

    // mechanics_dynamics.templates.h
    /** Whether no unknown that the cell has read exceeds the displacement of
     *  quiet cells. */
    bool
    is_quiet(const Cell &cell) const;
    template <unsigned int request>
    DynamicSums
    dynamic_sweep(const VectorType &displacement, VectorType &force);
    template <unsigned int request, typename Law>
    void
    dynamic_run(const Law        &law,
                Cell             &cell,
                const Range      &run,
                const VectorType &displacement,
                VectorType       &force,
                DynamicSums      &sums);

    /** The linear cell operation on values that have been read. */
    void
    tangent_operation(Cell &cell, const double regularization) const;

    const Space<dim>                      &space;
    const std::vector<Rheology::Material> &materials;
    // by material, as to find them a scheme is read
    std::vector<Rheology::Law>            laws;
    std::vector<Moduli>                   elasticity;
    std::vector<double>                   longitudinal_speed; ///< in m/s
    double                                time_step = 1.;
    typename Mechanics<dim>::InitialState initial_state;
    ShockViscosity                        shock_viscosity;
    double                                quiet_displacement = -1.; ///< in m
    std::vector<unsigned int>             material_of_id;

    Data                      data;
    std::vector<unsigned int> material_of_batch;
    /** Elastic tangents by material: regularization, and what linear
     *  materials have instead of a tangent at every point. */
    std::vector<std::array<Number, n_tangent_entries<Embedding>(true)>>
      elastic_tangents;
    // Empty unless there is an initial state: tensors by batch and point, and
    // by batch the energy in J and the voids in m^3.
    AlignedVector<Number> rest_strain, rest_stress, rest_energy, rest_voids;
    VectorType            rest_force;
    // Empty unless there is shock viscosity.
    AlignedVector<Number>      cell_size;   ///< by batch, in m
    double                     extent = 0.; ///< of the body, in m
    VectorType                 step_begin;  ///< the displacement there
    FrontSensor<dim>           sensor;
    std::vector<ShockMaterial> shock_materials;

    PointHistory             history;
    Failure<dim>             worst_failure; ///< of the last sweep
    AlignedVector<Number>    tangents;
    std::vector<std::size_t> tangent_offset;
  };
} // namespace Signoton

#endif
