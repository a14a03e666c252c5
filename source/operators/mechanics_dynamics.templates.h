#ifndef signoton_operators_mechanics_dynamics_templates_h
#define signoton_operators_mechanics_dynamics_templates_h

#include "mechanics_rest.templates.h"
#include "mechanics_shock.templates.h"

#include <deal.II/base/mpi.h>

#include <limits>

// What dynamics adds to the kernel: the sweep of explicit time integration, the
// stable step.

namespace Signoton
{
  template <typename Embedding, int degree>
  template <unsigned int request, typename Law>
  void
  MechanicsKernel<Embedding, degree>::dynamic_run(
    const Law        &law,
    Cell             &cell,
    const Range      &run,
    const VectorType &displacement,
    VectorType       &force,
    DynamicSums      &sums)
  {
    const FloatingPointTraps   traps;
    Rheology::Response<Number> response;
    auto accepted = Rheology::make_history<Number>(law), next = accepted;
    // with energies, a report may follow that looks at the step once more
    constexpr bool on_trial = (request & Rheology::energies) != 0;
    // shock viscosity asks for the strain of contacts
    constexpr unsigned int with_contacts =
      std::is_same_v<Law, Rheology::General> ? Rheology::energies : request;
    const bool          at_rest = !rest_strain.empty();
    const bool          shocked = bool(shock_viscosity);
    std::optional<Cell> begin; // of the step, for shock viscosity
    if (shocked)
      begin.emplace(data);
    for (unsigned int batch = run.first; batch < run.second; ++batch)
      {
        const unsigned int n_lanes =
          data.n_active_entries_per_cell_batch(batch);
        Number stored(0.), voids(0.), dissipated(0.), viscous(0.),
          shocked_work(0.);
        cell.reinit(batch);
        cell.read_dof_values(displacement);
        if (is_quiet(cell))
          {
            if constexpr (on_trial)
              std::copy_n(history.accepted(batch, 0),
                          history.width(batch) * n_points,
                          history.trial(batch, 0));
            if (at_rest)
              {
                stored = rest_energy[batch];
                voids  = rest_voids[batch];
              }
            sums.quiet_cells += n_lanes;
          }
        else
          {
            cell.evaluate(cell_flags<Embedding>);
            ShockStress<Number> shock;
            Motion              motion;
            if (shocked)
              {
                shock = shock_of(batch);
                begin->reinit(batch);
                begin->read_dof_values(step_begin);
                begin->evaluate(cell_flags<Embedding>);
              }
            for (unsigned int q = 0; q < n_points; ++q)
              {
                const Tensor2<Number> moved = strain(cell, q);
                const Tensor2<Number> total =
                  at_rest ? moved + tensor_at(rest_strain, batch, q) : moved;
                read_history<Law>(history.accepted(batch, q), accepted);
                const bool changed = shocked ?
                                       law.template update<with_contacts>(
                                         total, accepted, next, response) :
                                       law.template update<request>(total,
                                                                    accepted,
                                                                    next,
                                                                    response);
                if constexpr (on_trial)
                  write_history<Law>(next, history.trial(batch, q));
                else if (changed)
                  write_history<Law>(next, history.accepted(batch, q));
                note_failure(law, batch, response);
                const Number w = weight(cell, q);
                if constexpr ((request & Rheology::energies) != 0)
                  {
                    stored += w * response.stored_energy;
                    voids +=
                      w * std::max(trace(response.contact_strain), Number(0.));
                  }
                if (request != Rheology::stress && changed)
                  {
                    dissipated += w * response.dissipation;
                    viscous += w * response.viscous_dissipation;
                  }
                if (shocked)
                  {
                    motion.volume += w;
                    shocked_work += w * resist<Law>(shock,
                                                    moved - strain(*begin, q),
                                                    total,
                                                    response,
                                                    motion);
                  }
                if (at_rest)
                  response.stress -= tensor_at(rest_stress, batch, q);
                submit(cell, q, response.stress);
              }
            cell.integrate(cell_flags<Embedding>);
            cell.distribute_local_to_global(force);
            if (shocked)
              shocked_work += tell_neighbors(batch, shock, motion);
          }
        for (unsigned int i = 0; i < n_lanes; ++i)
          {
            sums.stored += stored[i];
            sums.voids += voids[i];
            sums.dissipated += dissipated[i];
            sums.viscous += viscous[i];
            sums.shock += shocked_work[i];
          }
      }
  }

  template <typename Embedding, int degree>
  bool
  MechanicsKernel<Embedding, degree>::is_quiet(const Cell &cell) const
  {
    if (quiet_displacement < 0.)
      return false;
    Number largest(0.);
    for (unsigned int i = 0; i < Cell::static_dofs_per_cell; ++i)
      largest = std::max(largest, std::abs(cell.begin_dof_values()[i]));
    for (unsigned int i = 0; i < Number::size(); ++i)
      if (!(largest[i] <= quiet_displacement)) // also what is not a number
        return false;
    return true;
  }

  template <typename Embedding, int degree>
  template <unsigned int request>
  DynamicSums
  MechanicsKernel<Embedding, degree>::dynamic_sweep(
    const VectorType &displacement,
    VectorType       &force)
  {
    DynamicSums sums;
    worst_failure = {};
    if constexpr ((request & Rheology::energies) != 0)
      history.begin_trial();
    force = 0.;
    data.template cell_loop<VectorType, VectorType>(
      [&](const auto &, auto &dst, const auto &src, const Range &range) {
        Cell cell(data);
        for_each_run(range, [&](const auto &law, const Range &run) {
          dynamic_run<request>(law, cell, run, src, dst, sums);
        });
      },
      force,
      displacement);
    if (!rest_strain.empty())
      force += rest_force;
    if (shock_viscosity)
      begin_step(displacement);
    sums.failed = worst_failure.residual > 0. ? 1. : 0.;
    return sums;
  }

  template <typename Embedding, int degree>
  DynamicSums
  MechanicsKernel<Embedding, degree>::dynamic_force(
    const VectorType &displacement,
    VectorType       &force,
    const bool        with_energies,
    const double      quiet)
  {
    quiet_displacement = quiet;
    return with_energies ?
             dynamic_sweep<Rheology::energies>(displacement, force) :
           history_width() > 0 ?
             dynamic_sweep<Rheology::dissipation>(displacement, force) :
             dynamic_sweep<Rheology::stress>(displacement, force);
  }

  template <typename Embedding, int degree>
  double
  MechanicsKernel<Embedding, degree>::stable_time_step()
  {
    // The largest frequency of the body is not above that of a cell alone, 2 c
    // by the part of its size. The hoop strain of cells on an axis of rotation
    // doubles it. tests/verification/stable_step compares all that with the
    // power method.
    const double           factor       = part_of_size;
    constexpr unsigned int n_extensions = Embedding::axisymmetric ? 3 : dim;
    std::vector<double>    size(materials.size(),
                             std::numeric_limits<double>::max());
    Cell                   cell(data);
    for (unsigned int batch = 0; batch < data.n_cell_batches(); ++batch)
      {
        cell.reinit(batch);
        double &smallest = size[material_of_batch[batch]];
        for (unsigned int q = 0; q < n_points; ++q)
          {
            const auto J = cell.inverse_jacobian(q);
            for (unsigned int i = 0;
                 i < data.n_active_entries_per_cell_batch(batch);
                 ++i)
              {
                SymmetricTensor<2, dim> metric;
                for (unsigned int a = 0; a < dim; ++a)
                  for (unsigned int b = 0; b <= a; ++b)
                    for (unsigned int c = 0; c < dim; ++c)
                      metric[a][b] += J[a][c][i] * J[b][c][i];
                double h = factor / std::sqrt(eigenvalues(metric)[0]);
                if constexpr (Embedding::axisymmetric)
                  {
                    const double r =
                      data.get_cell_iterator(batch, i)->center()[0];
                    h /=
                      std::sqrt(1. + 0.75 * h * h / (factor * factor * r * r));
                  }
                smallest = std::min(smallest, h);
              }
          }
      }
    double result = std::numeric_limits<double>::max();
    for (unsigned int m = 0; m < materials.size(); ++m)
      result =
        std::min(result, materials[m].crossing_time(size[m], n_extensions));
    return Utilities::MPI::min(result, space.communicator);
  }
} // namespace Signoton

#endif
