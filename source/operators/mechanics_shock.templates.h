#ifndef signoton_operators_mechanics_shock_templates_h
#define signoton_operators_mechanics_shock_templates_h

#include <signoton/discretization/body_box.h>
#include <signoton/rheology/classification.h>

#include "mechanics_kernel.h"

// Shock viscosity: what cells tell their neighbors, and what they resist with.

namespace Signoton
{
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
    const Moduli left = Rheology::loosened_moduli(material.scheme);
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
           materials[m].has_cone,
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
    initialize_vector(step_begin);
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
        const unsigned int cell =
          sensor.index(data.get_cell_iterator(batch, i));
        const Tensor2<> change = lane(motion.change, i),
                        stress = lane(motion.stress, i),
                        of_law = lane(motion.of_law, i);
        ShockReport<dim> report;
        for (unsigned int e = 0; e < n_tensor_entries; ++e)
          report.rate[e] =
            (e < 3 ? 1. : std::sqrt(2.)) / (n_points * time_step) *
            change.access_raw_entry(Embedding::tensor_entries[e]);
        for (unsigned int d = 0; d < dim; ++d)
          {
            Tensor<1, 3> normal;
            for (unsigned int j = 0; j < dim; ++j)
              normal[j] = sensor.axis(cell, d)[j];
            report.traction[d] = (stress * normal).norm() / n_points;
            report.of_law[d]   = (of_law * normal).norm() / n_points;
          }
        report.voids     = motion.voids[i] / n_points;
        report.viscous   = motion.viscous[i] / n_points;
        report.viscosity = shock.shear[i];
        result[i] =
          motion.volume[i] *
          Signoton::tell_neighbors(sensor,
                                   cell,
                                   shock_materials[material_of_batch[batch]],
                                   report,
                                   shock.freedom[i],
                                   cell_size[batch][i],
                                   time_step);
      }
    return result;
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
      }
    motion.of_law += response.stress;
    const Tensor2<Number> viscous = shock.stress(change);
    response.stress += viscous;
    motion.viscous += (1. / 3.) * trace(viscous);
    motion.change += change;
    motion.stress += response.stress;
    return shock.dissipation(change);
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
    data.initialize_dof_vector(of_shock);
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
} // namespace Signoton

#endif
