#ifndef signoton_operators_mechanics_points_templates_h
#define signoton_operators_mechanics_points_templates_h

#include "mechanics_kernel.h"

#include <signoton/discretization/ghost_values.h>

// What the kernel knows at its points, without integrals over shape functions:
// energies, averages, and the way of history to other meshes.

namespace Signoton
{
  template <typename Embedding, int degree>
  template <typename Law>
  void
  MechanicsKernel<Embedding, degree>::visit_run(const Law        &law,
                                                Cell             &cell,
                                                const Range      &run,
                                                const VectorType &displacement,
                                                const Visitor    &visitor)
  {
    const FloatingPointTraps   traps;
    Rheology::Response<Number> response;
    auto accepted = Rheology::make_history<Number>(law), next = accepted;
    for (unsigned int batch = run.first; batch < run.second; ++batch)
      {
        cell.reinit(batch);
        cell.read_dof_values(displacement);
        cell.evaluate(cell_flags<Embedding>);
        for (unsigned int q = 0; q < cell.n_q_points; ++q)
          {
            const Tensor2<Number> strain = total_strain(cell, batch, q);
            read_history<Law>(history.accepted(batch, q), accepted);
            law.template update<Rheology::energies>(strain,
                                                    accepted,
                                                    next,
                                                    response);
            visitor({batch, q, weight(cell, q), strain, response});
          }
      }
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::visit_points(
    const VectorType &displacement,
    const Visitor    &visitor)
  {
    VectorType unused; // nothing is integrated
    initialize_vector(unused);
    data.template cell_loop<VectorType, VectorType>(
      [&](const auto &, auto &, const auto &src, const Range &range) {
        Cell cell(data);
        for_each_run(range, [&](const auto &law, const Range &run) {
          visit_run(law, cell, run, src, visitor);
        });
      },
      unused,
      displacement);
  }

  template <typename Embedding, int degree>
  auto
  MechanicsKernel<Embedding, degree>::element_forces(
    const VectorType &displacement) -> typename Mechanics<dim>::ElementForces
  {
    std::array<double, 2> sums{}; // of squares
    VectorType            unused;
    initialize_vector(unused);
    data.template cell_loop<VectorType, VectorType>(
      [&](const auto &, auto &, const auto &src, const Range &range) {
        Cell cell(data);
        for (unsigned int batch = range.first; batch < range.second; ++batch)
          {
            cell.reinit(batch);
            cell.read_dof_values(src);
            Number largest(0.), stiffness(0.), square(0.);
            for (unsigned int i = 0; i < Cell::static_dofs_per_cell; ++i)
              largest = std::max(largest, std::abs(cell.begin_dof_values()[i]));
            cell.evaluate(cell_flags<Embedding>);
            const Moduli &spring = elasticity[material_of_batch[batch]];
            for (unsigned int q = 0; q < n_points; ++q)
              {
                const auto J = cell.inverse_jacobian(q);
                for (unsigned int a = 0; a < dim; ++a)
                  stiffness += weight(cell, q) * (J[a] * J[a]);
                submit(cell, q, spring.stress(total_strain(cell, batch, q)));
              }
            stiffness *= spring.bulk + 4. / 3. * spring.shear;
            cell.integrate(cell_flags<Embedding>);
            for (unsigned int i = 0; i < Cell::static_dofs_per_cell; ++i)
              square += cell.begin_dof_values()[i] * cell.begin_dof_values()[i];
            stiffness *= largest;
            stiffness *= stiffness;
            for (unsigned int i = 0;
                 i < data.n_active_entries_per_cell_batch(batch);
                 ++i)
              {
                sums[0] += square[i];
                sums[1] += stiffness[i];
              }
          }
      },
      unused,
      displacement);
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        space.communicator,
                        ArrayView<double>(sums.data(), sums.size()));
    return {std::sqrt(sums[0]), std::sqrt(sums[1])};
  }

  template <typename Embedding, int degree>
  double
  MechanicsKernel<Embedding, degree>::size_of_differences(
    const VectorType &displacement)
  {
    return element_forces(displacement).with_rigid_motion;
  }

  template <typename Embedding, int degree>
  double
  MechanicsKernel<Embedding, degree>::strain_by_stress(
    const VectorType &displacement)
  {
    std::array<double, 2> sums{};
    visit_points(displacement, [&](const PointResponse &point) {
      const Moduli &spring    = elasticity[material_of_batch[point.batch]];
      const Number  by_strain = point.weight *
                               (spring.stress(point.strain) * point.strain),
                   by_stress = point.weight *
                               spring.energy_product(point.response.stress,
                                                     point.response.stress);
      for (unsigned int i = 0;
           i < data.n_active_entries_per_cell_batch(point.batch);
           ++i)
        {
          sums[0] += by_strain[i];
          sums[1] += by_stress[i];
        }
    });
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        space.communicator,
                        ArrayView<double>(sums.data(), sums.size()));
    return std::sqrt(sums[0] /
                     std::max(sums[1], std::numeric_limits<double>::min()));
  }

  template <typename Embedding, int degree>
  EnergyBalance
  MechanicsKernel<Embedding, degree>::energy_balance(
    const VectorType &displacement)
  {
    std::array<double, 3 + Rheology::n_regions> sums{};
    visit_points(displacement, [&](const PointResponse &point) {
      for (unsigned int i = 0;
           i < data.n_active_entries_per_cell_batch(point.batch);
           ++i)
        {
          const double volume = point.weight[i];
          sums[0] += volume * point.response.stored_energy[i];
          sums[1] += volume * point.response.dissipation[i];
          sums[2] += volume;
          sums[3 + static_cast<unsigned int>(point.response.region[i])] +=
            volume;
        }
    });
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        space.communicator,
                        ArrayView<double>(sums.data(), sums.size()));
    EnergyBalance balance;
    balance.stored      = sums[0];
    balance.dissipation = sums[1];
    for (unsigned int region = 0; region < Rheology::n_regions; ++region)
      balance.region_share[region] = sums[3 + region] / sums[2];
    return balance;
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::binder_force(
    const VectorType &displacement,
    VectorType       &force)
  {
    std::vector<Moduli> binders;
    for (const auto &material : materials)
      binders.push_back(material.binder);
    AlignedVector<Tensor2<Number>> stress(data.n_cell_batches() * n_points);
    visit_points(displacement, [&](const PointResponse &point) {
      const unsigned int m      = material_of_batch[point.batch];
      Tensor2<Number>    strain = point.response.contact_strain;
      if (materials[m].has_potential) // else the hinge stands before both
        strain += point.response.plastic_strain;
      stress[point.batch * n_points + point.q] = binders[m].stress(strain);
    });
    data.initialize_dof_vector(force);
    integrate_stress(
      [&](const unsigned int batch, const unsigned int q) {
        return stress[batch * n_points + q];
      },
      force);
  }

  template <typename Embedding, int degree>
  std::vector<CellAverages>
  MechanicsKernel<Embedding, degree>::cell_averages(
    const VectorType &displacement)
  {
    std::vector<CellAverages> result(space.mesh.n_active_cells());
    std::vector<double>       volume(result.size(), 0.);
    const auto                add = [&](const PointResponse &point) {
      for (unsigned int i = 0;
           i < data.n_active_entries_per_cell_batch(point.batch);
           ++i)
        {
          const auto cell =
            data.get_cell_iterator(point.batch, i)->active_cell_index();
          CellAverages      &average = result[cell];
          const double       w       = point.weight[i];
          const unsigned int region =
            static_cast<unsigned int>(point.response.region[i]);
          for (unsigned int c = 0; c < 6; ++c)
            {
              average.stress[c] +=
                w * point.response.stress.access_raw_entry(c)[i];
              average.contact_strain[c] +=
                w * point.response.contact_strain.access_raw_entry(c)[i];
              average.plastic_strain[c] +=
                w * point.response.plastic_strain.access_raw_entry(c)[i];
            }
          average.energy_density += w * point.response.stored_energy[i];
          average.mixed |= volume[cell] > 0. && region != average.region;
          average.region = std::max(average.region, region);
          volume[cell] += w;
        }
    };
    visit_points(displacement, add);
    for (std::size_t cell = 0; cell < result.size(); ++cell)
      if (volume[cell] > 0.)
        {
          for (unsigned int c = 0; c < 6; ++c)
            {
              result[cell].stress[c] /= volume[cell];
              result[cell].contact_strain[c] /= volume[cell];
              result[cell].plastic_strain[c] /= volume[cell];
            }
          result[cell].energy_density /= volume[cell];
        }
    return result;
  }

  template <typename Embedding, int degree>
  std::vector<unsigned int>
  MechanicsKernel<Embedding, degree>::cell_numbers(
    const std::vector<unsigned int> &cells) const
  {
    std::vector<unsigned int> number_of(space.mesh.n_active_cells(),
                                        numbers::invalid_unsigned_int);
    for (unsigned int batch = 0; batch < data.n_cell_batches(); ++batch)
      for (unsigned int i = 0; i < data.n_active_entries_per_cell_batch(batch);
           ++i)
        number_of[data.get_cell_iterator(batch, i)->active_cell_index()] =
          batch * Number::size() + i;
    std::vector<unsigned int> result;
    for (const unsigned int cell : cells)
      result.push_back(number_of[cell]);
    return result;
  }

  template <typename Embedding, int degree>
  PointState
  MechanicsKernel<Embedding, degree>::state_of_lane(const PointResponse &point,
                                                    const unsigned int   lane)
  {
    PointState result;
    for (unsigned int c = 0; c < 6; ++c)
      {
        const auto entry = [&](const Tensor2<Number> &tensor) {
          return tensor.access_raw_entry(c)[lane];
        };
        result.values[PointState::stress + c] = entry(point.response.stress);
        result.values[PointState::strain + c] = entry(point.strain);
        result.values[PointState::contact_strain + c] =
          entry(point.response.contact_strain);
        result.values[PointState::plastic_strain + c] =
          entry(point.response.plastic_strain);
      }
    result.values[PointState::energy_density] =
      point.response.stored_energy[lane];
    result.values[PointState::region] = point.response.region[lane];
    return result;
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::point_states(
    const VectorType                &displacement,
    const std::vector<unsigned int> &cells,
    std::vector<PointState>         &states)
  {
    states.resize(cells.size() * n_points);
    const GhostValues ghosts(displacement);
    Cell              cell(data);
    // batches are wider than what is asked for: each is visited once for all of
    // its cells
    for (std::size_t begin = 0, end; begin < cells.size(); begin = end)
      {
        const unsigned int batch = cells[begin] / Number::size();
        for (end = begin;
             end < cells.size() && cells[end] / Number::size() == batch;)
          ++end;
        const auto keep = [&](const PointResponse &point) {
          for (std::size_t i = begin; i < end; ++i)
            states[i * n_points + point.q] =
              state_of_lane(point, cells[i] % Number::size());
        };
        std::visit(
          [&](const auto &law) {
            visit_run(law, cell, {batch, batch + 1}, displacement, keep);
          },
          laws[material_of_batch[batch]]);
      }
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::stress_field(
    const VectorType      &displacement,
    const PointSpace<dim> &points,
    VectorType            &field)
  {
    std::vector<std::vector<types::global_dof_index>> dofs(
      Number::size(),
      std::vector<types::global_dof_index>(points.fe.n_dofs_per_cell()));
    visit_points(displacement, [&](const PointResponse &point) {
      const auto stress = to_mesh<dim>(point.response.stress);
      for (unsigned int i = 0;
           i < data.n_active_entries_per_cell_batch(point.batch);
           ++i)
        {
          if (point.q == 0)
            point_dofs(points, point.batch, i, dofs[i]);
          for (unsigned int c = 0; c < points.n_components; ++c)
            field[dofs[i][points.cell_index(c, point.q)]] =
              stress.access_raw_entry(c)[i];
        }
    });
  }

  template <typename Embedding, int degree>
  unsigned int
  MechanicsKernel<Embedding, degree>::history_width() const
  {
    unsigned int result = 0;
    for (const auto &law : laws)
      result = std::max(result, width(law));
    return result;
  }

  template <typename Embedding, int degree>
  unsigned int
  MechanicsKernel<Embedding, degree>::state_width() const
  {
    return history_width() +
           (shock_viscosity ? static_cast<unsigned int>(Sensor::n_numbers) : 0);
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::point_dofs(
    const PointSpace<dim>                &points,
    const unsigned int                    batch,
    const unsigned int                    lane,
    std::vector<types::global_dof_index> &dofs) const
  {
    const auto cell = data.get_cell_iterator(batch, lane);
    typename DoFHandler<dim>::active_cell_iterator(&space.mesh,
                                                   cell->level(),
                                                   cell->index(),
                                                   &points.dof_handler)
      ->get_dof_indices(dofs);
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::save_history(
    const PointSpace<dim> &points,
    VectorType            &field)
  {
    std::vector<types::global_dof_index> dofs(points.fe.n_dofs_per_cell());
    const unsigned int first = history_width(); // of shock viscosity
    for (unsigned int batch = 0; batch < data.n_cell_batches(); ++batch)
      for (unsigned int i = 0; i < data.n_active_entries_per_cell_batch(batch);
           ++i)
        {
          point_dofs(points, batch, i, dofs);
          for (unsigned int q = 0; q < space.quadrature.size(); ++q)
            for (unsigned int c = 0; c < history.width(batch); ++c)
              field[dofs[points.cell_index(c, q)]] =
                history.accepted(batch, q)[c][i];
          if (!sensor.empty())
            {
              const double *told =
                sensor[sensor.index(data.get_cell_iterator(batch, i))];
              for (unsigned int q = 0; q < space.quadrature.size(); ++q)
                for (unsigned int c = 0; c < Sensor::n_numbers; ++c)
                  field[dofs[points.cell_index(first + c, q)]] = told[c];
            }
        }
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::load_history(
    const PointSpace<dim> &points,
    const VectorType      &field)
  {
    std::vector<types::global_dof_index> dofs(points.fe.n_dofs_per_cell());
    const unsigned int first = history_width(); // of shock viscosity
    for (unsigned int batch = 0; batch < data.n_cell_batches(); ++batch)
      {
        const unsigned int n_tensor_values = std::visit(
          [](const auto &law) {
            return Rheology::n_tensors(law) * n_tensor_entries;
          },
          laws[material_of_batch[batch]]);
        for (unsigned int i = 0;
             i < data.n_active_entries_per_cell_batch(batch);
             ++i)
          {
            point_dofs(points, batch, i, dofs);
            for (unsigned int q = 0; q < space.quadrature.size(); ++q)
              for (unsigned int c = 0; c < history.width(batch); ++c)
                {
                  const double value = field[dofs[points.cell_index(c, q)]];
                  history.accepted(batch, q)[c][i] =
                    c < n_tensor_values ? value : std::max(value, 0.);
                }
            if (!sensor.empty())
              {
                double *told =
                  sensor[sensor.index(data.get_cell_iterator(batch, i))];
                for (unsigned int c = 0; c < Sensor::n_numbers; ++c)
                  {
                    // of a cell that was coarsened, all children count
                    told[c] = 0.;
                    for (unsigned int q = 0; q < n_points; ++q)
                      told[c] +=
                        field[dofs[points.cell_index(first + c, q)]] / n_points;
                  }
              }
          }
      }
  }
} // namespace Signoton

#endif
