#include <signoton/discretization/momentum_transfer.h>
#include <signoton/discretization/stress_jumps.h>
#include <signoton/drivers/dynamics.h>
#include <signoton/drivers/mesh_change.h>
#include <signoton/operators/lumped_mass.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/grid/grid_tools.h>

// How the mesh of dynamics follows the waves.

namespace Signoton
{
  template <int dim>
  double
  Dynamics<dim>::energy_at_rest() const
  {
    if (!model.initial_strain && !model.initial_stress)
      return 0.;
    VectorType nowhere;
    nowhere.reinit(displacement);
    return model.mechanics->energy_balance(nowhere).stored;
  }

  template <int dim>
  void
  Dynamics<dim>::start()
  {
    refuse_jump();
    set_initial_motion();
    if (!analysis.wave_refinement.is_on())
      return;
    for (unsigned int level = 0; level < analysis.wave_refinement.n_levels();
         ++level)
      {
        if (!mark())
          break;
        model.space->mesh.execute_coarsening_and_refinement();
        setup();
        choose_step();
        set_initial_motion();
      }
  }

  template <int dim>
  void
  Dynamics<dim>::refuse_jump()
  {
    const double cell =
      Utilities::MPI::min(GridTools::minimal_cell_diameter(model.space->mesh),
                          model.communicator);
    VectorType there(displacement);
    supports.place(there, time);
    there -= displacement;
    const double jump = there.linfty_norm();
    if (jump > 1e-9 * cell)
      throw UserError(model.file.where({"Boundaries"}),
                      "a prescribed displacement of " + short_number(jump) +
                        " m at the start",
                      "one that begins at zero, where the body is",
                      "let it grow, such as 0.01*min(t/0.1, 1); or prescribe "
                      "a velocity");
  }

  template <int dim>
  bool
  Dynamics<dim>::mark()
  {
    const auto   timer = model.ledger.time("error estimate");
    auto        &space = *model.space;
    const double ahead = analysis.wave_refinement.interval() * time_step;
    double       speed = 0., stiffness = 0.;
    boost::container::flat_map<types::material_id, double> shear_modulus;
    for (const auto &material : model.materials)
      {
        speed                = std::max(speed, material.longitudinal_speed());
        const Moduli &moduli = material.elasticity;
        shear_modulus[material.id] = moduli.shear;
        stiffness = std::max(stiffness, moduli.bulk + 2. * moduli.shear);
      }
    // Pulses may be shorter than the time to the next look.
    constexpr unsigned int n_times = 8;
    const auto             look_at = [&](const unsigned int i) {
      return time + ahead * (i + 1) / n_times;
    };
    // Waves that are only in the velocity yet are seen in the strain of the next
    // step, which has their amplitude.
    VectorType u(displacement), v(velocity), moved_v(velocity);
    for (unsigned int i = 0; i < n_times && !supports.moving().empty(); ++i)
      {
        const double before = look_at(i) - time_step;
        supports.place(u, before);
        supports.move(u, before, time_step, moved_v);
        for (const auto &node : supports.moving())
          for (const unsigned int m : node.index)
            if (std::abs(moved_v.local_element(m)) >
                std::abs(v.local_element(m)))
              v.local_element(m) = moved_v.local_element(m);
      }
    u = displacement;
    u.add(time_step, v);
    space.mesh_constraints.distribute(u);
    model.mechanics->set_time_step(time_step);
    const auto averages = model.mechanics->cell_averages(u);
    std::vector<SymmetricTensor<2, dim>> stress(averages.size());
    double                               largest = 0.;
    for (std::size_t cell = 0; cell < stress.size(); ++cell)
      {
        for (unsigned int c = 0; c < stress[cell].n_independent_components; ++c)
          stress[cell].access_raw_entry(c) =
            averages[cell].stress[dim == 2 && c == 2 ? 3 : c];
        largest = std::max(largest, stress[cell].norm());
      }
    // of stresses, and of strains, which are small differences where a body
    // flies far
    const double round_off =
      1e-12 *
      (Utilities::MPI::max(largest, model.communicator) +
       stiffness * u.linfty_norm() /
         Utilities::MPI::min(GridTools::minimal_cell_diameter(space.mesh),
                             model.communicator));
    StressJumps<dim> jumps(
      space, stress, model.initial_stress.get(), shear_modulus, round_off);
    jumps.add_neighbors();
    for (unsigned int i = loads.vary() ? 0 : n_times - 1; i < n_times; ++i)
      {
        model.set_time(look_at(i));
        jumps.add_boundary(model.conditions);
      }
    const bool changes = analysis.wave_refinement.mark(space,
                                                       jumps.values,
                                                       speed * ahead,
                                                       largest_jump);
    model.set_time(time);
    return changes;
  }

  template <int dim>
  void
  Dynamics<dim>::transfer()
  {
    const auto  &mechanics   = model.mechanics;
    auto        &space       = *model.space;
    const double rest_before = rest_energy;
    const double before      = receipt.kinetic + receipt.stored - rest_before;

    CellMass<dim>         cell_mass(space, model.materials);
    MeshChange<dim>       change(model, {&displacement, &velocity});
    MomentumTransfer<dim> momentum(space, change.old(1), std::ref(cell_mass));
    change.execute();
    setup();
    change.finish({&displacement, &velocity});
    supports.place(displacement, time);
    supports.stop(velocity);
    VectorType v = space.make_relevant_vector();
    v.copy_locally_owned_data_from(velocity);
    space.mesh_constraints.distribute(v);
    v.update_ghost_values();
    const VectorType missing = momentum.missing(v);
    for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
      if (!(mass.local_element(i) > 0.)) // follows others
        displacement.local_element(i) = velocity.local_element(i) = 0.;

    // Back to the admissible set, at fixed strain and in no time: dampers in
    // series stand still. Those in parallel take up the interpolated strain in
    // the first turn, against what would be a huge rate, and rest in the second.
    mechanics->set_shock_viscosity({});
    mechanics->set_time_step(1e-6 * time_step);
    DynamicSums own;
    for (unsigned int turn = 0; turn < 2; ++turn)
      {
        own = mechanics->dynamic_force(displacement, internal, true, -1.);
        own.failed = sum<1>({{own.failed}})[0];
        refuse_failure(own);
        mechanics->commit();
      }
    // the new points see the initial state anew
    receipt.initial += rest_energy - rest_before;
    receipt.stored = sum<1>({{own.stored}})[0];
    balance_transfer(missing, before);

    resist_motion();
    evaluate_dashpots();
    accelerate(0.);
    choose_step();
  }

  template <int dim>
  void
  Dynamics<dim>::resist_motion()
  {
    const auto &mechanics = model.mechanics;
    if (std::any_of(model.materials.begin(),
                    model.materials.end(),
                    [](const auto &m) { return m.is_viscous; }))
      {
        // A step that is short, but not too short for differences of strain.
        const double moment = 1e-3 * time_step;
        VectorType   ahead(displacement);
        ahead.add(moment, velocity);
        supports.place(ahead, time + moment);
        mechanics->set_time_step(moment);
        mechanics->dynamic_force(ahead, internal, true, -1.);
        mechanics->discard();
      }
    mechanics->set_time_step(time_step);
    mechanics->set_shock_viscosity(analysis.time_integration.shock_viscosity);
    mechanics->begin_step(displacement);
    mechanics->add_shock_force(internal);
  }

  template <int dim>
  bool
  Dynamics<dim>::slow_down(const std::vector<bool> &wanted, const double energy)
  {
    const auto                 &dofs  = model.space->dof_handler;
    const IndexSet             &owned = dofs.locally_owned_dofs();
    const std::vector<IndexSet> components =
      DoFTools::locally_owned_dofs_per_component(dofs);
    const auto for_each = [&](const auto &action) {
      for (unsigned int c = 0; c < dim; ++c)
        for (const auto dof : components[c])
          if (const unsigned int i = owned.index_within_set(dof); wanted[i])
            action(c, mass.local_element(i), velocity.local_element(i));
    };
    std::array<double, 2 * dim + 1> sums{};
    for_each([&](const unsigned int c, const double m, const double v) {
      sums[c] += m;
      sums[dim + c] += m * v;
      sums[2 * dim] += 0.5 * m * v * v;
    });
    sums = sum(sums);
    std::array<double, dim> mean{};
    double                  relative = sums[2 * dim];
    for (unsigned int c = 0; c < dim; ++c)
      if (sums[c] > 0.)
        {
          mean[c] = sums[dim + c] / sums[c];
          relative -= 0.5 * sums[dim + c] * mean[c];
        }
    if (relative < energy)
      return false;
    const double factor = std::sqrt(1. - energy / relative);
    for_each([&](const unsigned int c, const double, double &v) {
      v = mean[c] + factor * (v - mean[c]);
    });
    return true;
  }

  template <int dim>
  void
  Dynamics<dim>::balance_transfer(VectorType missing, const double before)
  {
    supports.project(missing);
    const unsigned int n = velocity.locally_owned_size();
    std::vector<bool>  is_free(n), has_changed(n), moves(n);
    for (unsigned int i = 0; i < n; ++i)
      is_free[i] = mass.local_element(i) > 0.;
    for (const auto &node : supports.nodes())
      for (const unsigned int i : node.index)
        is_free[i] = false;
    for (unsigned int i = 0; i < n; ++i)
      {
        velocity.local_element(i) +=
          missing.local_element(i) * inverse_mass.local_element(i);
        has_changed[i] = is_free[i] && std::abs(missing.local_element(i)) > 0.;
        moves[i]       = is_free[i] && std::abs(velocity.local_element(i)) > 0.;
      }
    receipt.kinetic   = kinetic_energy();
    const double gain = receipt.kinetic + receipt.stored - rest_energy - before;
    // Interpolation may stretch the body a little: the nodes that changed pay
    // for it by their motion relative to each other, or else all that move.
    if (gain > 0. && !slow_down(has_changed, gain))
      slow_down(moves, gain);
    receipt.kinetic = kinetic_energy();
    receipt.transfer -= receipt.kinetic + receipt.stored - rest_energy - before;
  }

#define INSTANTIATE(dim)                                                     \
  template double Dynamics<dim>::energy_at_rest() const;                     \
  template void   Dynamics<dim>::start();                                    \
  template void   Dynamics<dim>::refuse_jump();                              \
  template bool   Dynamics<dim>::mark();                                     \
  template void   Dynamics<dim>::transfer();                                 \
  template void   Dynamics<dim>::resist_motion();                            \
  template void   Dynamics<dim>::balance_transfer(VectorType, const double); \
  template bool   Dynamics<dim>::slow_down(const std::vector<bool> &,        \
                                         const double);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
