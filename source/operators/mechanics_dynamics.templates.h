#ifndef signoton_operators_mechanics_dynamics_templates_h
#define signoton_operators_mechanics_dynamics_templates_h

#include <signoton/base/function.h>
#include <signoton/discretization/body_box.h>
#include <signoton/rheology/classification.h>

#include "mechanics_kernel.h"

#include <deal.II/base/mpi.h>

#include <limits>
#include <sstream>

// What dynamics adds to the kernel: the state at rest, the sweep of explicit
// time integration, the stable step.

namespace Signoton
{
  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::set_initial_state(
    const typename Mechanics<dim>::InitialState &state)
  {
    initial_state = state;
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::set_shock_viscosity(
    const ShockViscosity &viscosity)
  {
    shock_viscosity = viscosity;
  }

  /** $\sqrt{(k+4\mu/3)/\rho}$ where all contacts are open, in m/s. */
  inline double
  loosened_speed(const Rheology::Material &material)
  {
    const Moduli left = Rheology::loosened_moduli(material.scheme());
    return std::sqrt((left.bulk + 4. / 3. * left.shear) / material.density);
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::find_shock_materials()
  {
    shock_materials.clear();
    for (unsigned int m = 0; m < materials.size(); ++m)
      {
        // Fibers are taut, contacts are closed, on one side of zero.
        const auto size_of_stress = [&](const double dilatation) {
          Rheology::Response<double> response;
          std::visit(
            [&](const auto &law) {
              const auto virgin = Rheology::make_history<double>(law);
              auto       next   = virgin;
              law.template update<Rheology::energies>(
                add_spherical(Tensor2<>(), dilatation / 3.),
                virgin,
                next,
                response);
            },
            laws[m]);
          return std::abs(trace(response.stress));
        };
        constexpr double small = 1e-9;
        const bool       stiffens =
          size_of_stress(small) > 1.01 * size_of_stress(-small);
        shock_materials.push_back(
          {materials[m].density,
           longitudinal_speed[m],
           std::sqrt(elasticity[m].shear / materials[m].density),
           loosened_speed(materials[m]),
           materials[m].has_cone(),
           stiffens ? 1. : -1.});
      }
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::find_sizes()
  {
    find_shock_materials();
    const unsigned int n_batches = data.n_cell_batches();
    cell_size.resize(n_batches);
    for (unsigned int batch = 0; batch < n_batches; ++batch)
      {
        cell_size[batch] = Number(1.);
        for (unsigned int i = 0;
             i < data.n_active_entries_per_cell_batch(batch);
             ++i)
          cell_size[batch][i] =
            part_of_size *
            data.get_cell_iterator(batch, i)->minimum_vertex_distance();
      }
    const auto box = body_box(space.mesh);
    extent         = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      extent = std::max(extent, box.side_length(d));
    sensor.reinit(space.mesh);
    initialize_mesh_vector(step_begin);
    step_begin.update_ghost_values();
  }

  template <typename Embedding, int degree>
  auto
  MechanicsKernel<Embedding, degree>::shock_of(const unsigned int batch) const
    -> ShockStress<Number>
  {
    const ShockMaterial &material = shock_materials[material_of_batch[batch]];
    ShockStress<Number>  result;
    result.rate         = 1. / time_step;
    result.size         = cell_size[batch];
    result.sign         = material.stiffening;
    result.opens        = material.opens;
    result.bulk_modulus = elasticity[material_of_batch[batch]].bulk;
    result.impedance    = material.density * material.longitudinal_speed;
    for (unsigned int i = 0; i < data.n_active_entries_per_cell_batch(batch);
         ++i)
      {
        const ShockCoefficients of_cell =
          shock_coefficients(sensor,
                             sensor.index(data.get_cell_iterator(batch, i)),
                             material,
                             shock_viscosity,
                             cell_size[batch][i],
                             extent);
        result.linear[i]    = of_cell.linear;
        result.quadratic[i] = of_cell.quadratic;
        result.cap[i]       = of_cell.cap;
        result.opening[i]   = of_cell.opening;
        result.shear[i]     = of_cell.shear;
        result.freedom[i]   = of_cell.freedom;
      }
    return result;
  }

  template <typename Embedding, int degree>
  auto
  MechanicsKernel<Embedding, degree>::tell_neighbors(
    const unsigned int         batch,
    const ShockStress<Number> &shock,
    const Motion              &motion) -> Number
  {
    Number result = 0.;
    for (unsigned int i = 0; i < data.n_active_entries_per_cell_batch(batch);
         ++i)
      {
        const Tensor2<>  change = lane(motion.change, i);
        ShockReport<dim> report;
        for (unsigned int e = 0; e < n_tensor_entries; ++e)
          report.rate[e] =
            (e < 3 ? 1. : std::sqrt(2.)) / (n_points * time_step) *
            change.access_raw_entry(Embedding::tensor_entries[e]);
        report.stress    = lane(motion.stress, i).norm() / n_points;
        report.voids     = motion.voids[i] / n_points;
        report.elastic   = motion.elastic[i] / n_points;
        report.viscous   = motion.viscous[i] / n_points;
        report.viscosity = shock.shear[i];
        result[i] =
          motion.volume[i] *
          Signoton::tell_neighbors(sensor,
                                   sensor.index(
                                     data.get_cell_iterator(batch, i)),
                                   shock_materials[material_of_batch[batch]],
                                   report,
                                   shock.freedom[i],
                                   cell_size[batch][i],
                                   time_step);
      }
    return result;
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::find_rest()
  {
    const unsigned int n_batches = data.n_cell_batches();
    const auto value = [](const Function<dim> *function, const Point<dim> &p) {
      Tensor2<> result;
      if (function != nullptr)
        for (unsigned int e = 0; e < n_tensor_entries; ++e)
          result.access_raw_entry(Embedding::tensor_entries[e]) =
            function->value(p, e);
      return result;
    };
    rest_strain.resize(n_batches * n_points * n_tensor_entries);
    rest_stress.resize(rest_strain.size());
    rest_energy.resize(n_batches);
    rest_voids.resize(n_batches);
    // What dampers bear has faded away. So their state is one after a step that
    // is long, but not beyond double precision.
    std::vector<bool>   relaxed(materials.size(), false);
    std::vector<Moduli> moduli(elasticity);
    for (unsigned int m = 0; m < materials.size(); ++m)
      if (auto *general = std::get_if<Rheology::General>(&laws[m]);
          general != nullptr && materials[m].is_viscous())
        {
          relaxed[m]        = true;
          moduli[m]         = Rheology::rest_moduli(materials[m].scheme());
          const double time = Rheology::relaxation_time(materials[m].scheme());
          general->set_time_step(1e10 * (time > 0. ? time : 1.));
        }
    Cell       cell(data, mesh_constraints);
    double     largest       = 0.; // of the differences from given stresses
    double     largest_given = 0.;
    Point<dim> place;
    for (unsigned int batch = 0; batch < n_batches; ++batch)
      {
        const unsigned int material = material_of_batch[batch];
        const unsigned int n_lanes =
          data.n_active_entries_per_cell_batch(batch);
        cell.reinit(batch);
        rest_energy[batch] = rest_voids[batch] = Number(0.);
        for (unsigned int q = 0; q < n_points; ++q)
          {
            std::array<Point<dim>, Number::size()> points;
            Tensor2<Number>                        strain, given;
            for (unsigned int i = 0; i < n_lanes; ++i)
              {
                for (unsigned int d = 0; d < dim; ++d)
                  points[i][d] = cell.quadrature_point(q)[d][i];
                const Tensor2<> stress = value(initial_state.stress, points[i]);
                set_lane(given, i, stress);
                set_lane(strain,
                         i,
                         value(initial_state.strain, points[i]) +
                           moduli[material].strain(stress));
              }
            Rheology::Response<Number> response;
            std::visit(
              [&](const auto &law) {
                using Law         = std::decay_t<decltype(law)>;
                const auto virgin = Rheology::make_history<Number>(law);
                auto       next   = virgin;
                law.template update<Rheology::energies>(strain,
                                                        virgin,
                                                        next,
                                                        response);
                // dampers have been stretched before
                if (relaxed[material])
                  write_history<Law>(next, history.accepted(batch, q));
              },
              laws[material]);
            rest_energy[batch] += weight(cell, q) * response.stored_energy;
            rest_voids[batch] +=
              weight(cell, q) *
              std::max(trace(response.contact_strain), Number(0.));
            const std::size_t first =
              (std::size_t(batch) * n_points + q) * n_tensor_entries;
            for (unsigned int e = 0; e < n_tensor_entries; ++e)
              {
                const unsigned int entry = Embedding::tensor_entries[e];
                rest_strain[first + e]   = strain.access_raw_entry(entry);
                rest_stress[first + e] =
                  response.stress.access_raw_entry(entry);
              }
            if (initial_state.stress == nullptr)
              given = response.stress; // leaves what is not finite
            for (unsigned int i = 0; i < n_lanes; ++i)
              {
                const double size = lane(given, i).norm();
                const double difference =
                  (lane(response.stress, i) - lane(given, i)).norm();
                if (std::isfinite(size))
                  largest_given = std::max(largest_given, size);
                if (!std::isfinite(difference) || difference > largest)
                  {
                    largest = std::isfinite(difference) ?
                                difference :
                                std::numeric_limits<double>::infinity();
                    place   = points[i];
                  }
              }
          }
      }
    set_time_step(time_step);
    // first what is no number: it contradicts every law
    refuse_trouble<dim>(space.communicator,
                        {initial_state.strain, initial_state.stress});
    refuse_contradiction(largest, largest_given, place);
    integrate_rest();
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::refuse_contradiction(
    const double      difference,
    const double      given,
    const Point<dim> &place)
  {
    constexpr double tolerance = 1e-8;
    const double     all = Utilities::MPI::max(difference, space.communicator);
    const double     scale = Utilities::MPI::max(given, space.communicator);
    if (all <= tolerance * scale)
      return;
    // the rank that has it tells the others where
    std::ostringstream where;
    if (!(difference < all))
      where << place;
    std::string found;
    for (const auto &text :
         Utilities::MPI::all_gather(space.communicator, where.str()))
      if (found.empty())
        found = text;
    std::ostringstream how_much;
    how_much << all << " Pa, where up to " << scale << " Pa are given";
    throw UserError(initial_state.where,
                    "at the point " + found +
                      " the material answers the initial strain and stress "
                      "with a stress that differs from the given one by " +
                      how_much.str(),
                    "a stress that the material can bear, and no strain that "
                    "changes it",
                    "give one of them only; a stress has to be inside the "
                    "cone and the yield set");
  }

  template <typename Embedding, int degree>
  template <typename Stress>
  void
  MechanicsKernel<Embedding, degree>::integrate_stress(const Stress &stress,
                                                       VectorType   &force)
  {
    VectorType unused;
    data.initialize_dof_vector(unused, mesh_constraints);
    data.template cell_loop<VectorType, VectorType>(
      [&](const auto &, auto &dst, const auto &, const Range &range) {
        Cell cell(data, mesh_constraints);
        for (unsigned int batch = range.first; batch < range.second; ++batch)
          {
            cell.reinit(batch);
            for (unsigned int q = 0; q < n_points; ++q)
              submit(cell, q, stress(batch, q));
            cell.integrate(cell_flags<Embedding>);
            cell.distribute_local_to_global(dst);
          }
      },
      force,
      unused);
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::integrate_rest()
  {
    data.initialize_dof_vector(rest_force, mesh_constraints);
    integrate_stress(
      [&](const unsigned int batch, const unsigned int q) {
        return tensor_at(rest_stress, batch, q);
      },
      rest_force);
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::balance_rest(const VectorType &external)
  {
    if (!initial_state)
      return;
    const double noise =
      1e-13 * std::max(rest_force.linfty_norm(), external.linfty_norm());
    for (unsigned int i = 0; i < rest_force.locally_owned_size(); ++i)
      if (std::abs(rest_force.local_element(i) - external.local_element(i)) <
          noise)
        rest_force.local_element(i) = external.local_element(i);
  }

  template <typename Embedding, int degree>
  template <typename Law>
  auto
  MechanicsKernel<Embedding, degree>::resist(
    const ShockStress<Number>  &shock,
    const Tensor2<Number>      &change,
    const Tensor2<Number>      &strain,
    Rheology::Response<Number> &response,
    Motion                     &motion) const -> Number
  {
    const Number zero(0.);
    if (shock.opens)
      {
        const Number of_spring =
          trace(response.stress) / (3. * shock.bulk_modulus);
        Number open = trace(strain) - of_spring;
        if constexpr (std::is_same_v<Law, Rheology::General>)
          open = trace(response.contact_strain);
        // but for round-off
        const Number noise =
          1e-12 * (std::abs(trace(strain)) + std::abs(of_spring));
        open = Number(-shock.sign) * open;
        motion.voids += compare_and_apply_mask<SIMDComparison::less_than>(noise,
                                                                          open,
                                                                          open,
                                                                          zero);
        motion.elastic += std::abs(of_spring);
      }
    const Tensor2<Number> viscous = shock.stress(change);
    response.stress += viscous;
    motion.viscous += (1. / 3.) * trace(viscous);
    motion.change += change;
    motion.stress += response.stress;
    return shock.dissipation(change);
  }

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
      begin.emplace(data, mesh_constraints);
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
    if constexpr ((request & Rheology::energies) != 0)
      history.begin_trial();
    const VectorType &source = in_layout(displacement, mesh_constraints);
    collect(force, mesh_constraints, [&](VectorType &result) {
      data.template cell_loop<VectorType, VectorType>(
        [&](const auto &, auto &dst, const auto &src, const Range &range) {
          Cell cell(data, mesh_constraints);
          for_each_run(range, [&](const auto &law, const Range &run) {
            dynamic_run<request>(law, cell, run, src, dst, sums);
          });
        },
        result,
        source);
    });
    if (!rest_strain.empty())
      force += rest_force;
    if (shock_viscosity)
      begin_step(displacement);
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
  void
  MechanicsKernel<Embedding, degree>::begin_step(const VectorType &displacement)
  {
    if (sensor.empty())
      return;
    step_begin.copy_locally_owned_data_from(displacement);
    step_begin.update_ghost_values();
    sensor.look_around();
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::add_shock_force(VectorType &force)
  {
    if (!shock_viscosity)
      return;
    VectorType of_shock;
    data.initialize_dof_vector(of_shock, mesh_constraints);
    integrate_stress(
      [&](const unsigned int batch, const unsigned int) {
        Tensor2<Number> stress;
        for (unsigned int i = 0;
             i < data.n_active_entries_per_cell_batch(batch);
             ++i)
          {
            const double *told =
              sensor[sensor.index(data.get_cell_iterator(batch, i))];
            Tensor2<> rate;
            for (unsigned int e = 0; e < n_tensor_entries; ++e)
              rate.access_raw_entry(Embedding::tensor_entries[e]) =
                told[e] / (e < 3 ? 1. : std::sqrt(2.));
            set_lane(stress,
                     i,
                     add_spherical(Tensor2<>(told[Sensor::viscosity] *
                                             deviatoric_part(rate)),
                                   told[Sensor::viscous]));
          }
        return stress;
      },
      of_shock);
    for (unsigned int i = 0; i < force.locally_owned_size(); ++i)
      force.local_element(i) += of_shock.local_element(i);
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
    Cell                   cell(data, mesh_constraints);
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
