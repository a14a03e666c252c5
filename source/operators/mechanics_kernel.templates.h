#ifndef signoton_operators_mechanics_kernel_templates_h
#define signoton_operators_mechanics_kernel_templates_h

#include "mechanics_assembly.templates.h"
#include "mechanics_dynamics.templates.h"
#include "mechanics_kernel.h"
#include "mechanics_points.templates.h"

namespace Signoton
{
  template <typename Embedding, int degree>
  MechanicsKernel<Embedding, degree>::MechanicsKernel(
    const Space<dim>                      &space,
    const std::vector<Rheology::Material> &materials)
    : space(space)
    , materials(materials)
  {
    set_scaling({});
    for (unsigned int m = 0; m < materials.size(); ++m)
      {
        if (materials[m].id >= material_of_id.size())
          material_of_id.resize(materials[m].id + 1,
                                numbers::invalid_unsigned_int);
        material_of_id[materials[m].id] = m;
        elasticity.push_back(materials[m].elasticity);
        longitudinal_speed.push_back(materials[m].longitudinal_speed());
        elastic_tangents.emplace_back();
        pack_tangent<Embedding, true>(
          elasticity.back().template tensor<Number>(),
          elastic_tangents.back().data());
      }
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::set_scaling(
    const Rheology::Scaling &scaling)
  {
    laws.clear();
    for (const auto &material : materials)
      laws.push_back(Rheology::make_law(material, scaling));
    set_time_step(time_step);
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::set_time_step(const double new_time_step)
  {
    time_step = new_time_step;
    for (auto &law : laws)
      if (auto *general = std::get_if<Rheology::General>(&law))
        general->set_time_step(time_step);
  }

  template <typename Embedding, int degree>
  unsigned int
  MechanicsKernel<Embedding, degree>::width(const Rheology::Law &law)
  {
    return std::visit(
      [](const auto &l) {
        return Rheology::n_tensors(l) * n_tensor_entries +
               Rheology::n_scalars(l);
      },
      law);
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::reinit()
  {
    typename Data::AdditionalData options;
    options.tasks_parallel_scheme = Data::AdditionalData::none;
    options.mapping_update_flags  = update_gradients | update_JxW_values;
    if (Embedding::axisymmetric || initial_state)
      options.mapping_update_flags |= update_values | update_quadrature_points;
    // lanes of a batch share a material
    options.cell_vectorization_categories_strict = true;
    options.cell_vectorization_category.resize(space.mesh.n_active_cells(), 0);
    for (const auto &cell : space.mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        options.cell_vectorization_category[cell->active_cell_index()] =
          material_of_id[cell->material_id()];
    data.reinit(space.mapping,
                space.dof_handler,
                space.mesh_constraints,
                QGauss<1>(degree + 1),
                options);
    find_materials();
    if (initial_state)
      find_rest();
    if (shock_viscosity)
      find_sizes();
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::find_materials()
  {
    const unsigned int        n_batches = data.n_cell_batches();
    std::vector<unsigned int> widths(n_batches);
    material_of_batch.resize(n_batches);
    tangent_offset.assign(n_batches + 1, 0);
    for (unsigned int batch = 0; batch < n_batches; ++batch)
      {
        const unsigned int material =
          material_of_id[data.get_cell_iterator(batch, 0)->material_id()];
        material_of_batch[batch] = material;
        widths[batch]            = width(laws[material]);
        const bool linear =
          std::holds_alternative<Rheology::Elastic>(laws[material]) &&
          !shock_viscosity;
        tangent_offset[batch + 1] =
          tangent_offset[batch] +
          (linear ? 0 :
                    n_points * n_tangent_entries<Embedding>(
                                 Rheology::has_potential(laws[material])));
      }
    history.reinit(widths, n_points);
    tangents.resize(0);
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::initialize_vector(
    VectorType &vector) const
  {
    data.initialize_dof_vector(vector);
  }

  template <typename Embedding, int degree>
  template <typename Law>
  void
  MechanicsKernel<Embedding, degree>::read_history(
    const Number                   *values,
    Rheology::History<Law, Number> &state)
  {
    for (auto &tensor : state.tensors)
      for (const unsigned int entry : Embedding::tensor_entries)
        tensor.access_raw_entry(entry) = *values++;
    for (auto &scalar : state.scalars)
      scalar = *values++;
  }

  template <typename Embedding, int degree>
  template <typename Law>
  void
  MechanicsKernel<Embedding, degree>::write_history(
    const Rheology::History<Law, Number> &state,
    Number                               *values)
  {
    for (const auto &tensor : state.tensors)
      for (const unsigned int entry : Embedding::tensor_entries)
        *values++ = tensor.access_raw_entry(entry);
    for (const auto &scalar : state.scalars)
      *values++ = scalar;
  }

  template <typename Embedding, int degree>
  inline DEAL_II_ALWAYS_INLINE
    Tensor2<typename MechanicsKernel<Embedding, degree>::Number>
    MechanicsKernel<Embedding, degree>::strain(const Cell        &cell,
                                               const unsigned int q) const
  {
    const auto      gradient = cell.get_gradient(q);
    Tensor2<Number> result;
    for (unsigned int i = 0; i < dim; ++i)
      {
        result[i][i] = gradient[i][i];
        for (unsigned int j = 0; j < i; ++j)
          result[i][j] = 0.5 * (gradient[i][j] + gradient[j][i]);
      }
    if constexpr (Embedding::axisymmetric)
      result.access_raw_entry(2) =
        cell.get_value(q)[0] / cell.quadrature_point(q)[0];
    return result;
  }

  template <typename Embedding, int degree>
  Tensor2<typename MechanicsKernel<Embedding, degree>::Number>
  MechanicsKernel<Embedding, degree>::total_strain(const Cell        &cell,
                                                   const unsigned int batch,
                                                   const unsigned int q) const
  {
    if (rest_strain.empty())
      return strain(cell, q);
    return strain(cell, q) + tensor_at(rest_strain, batch, q);
  }

  template <typename Embedding, int degree>
  Tensor2<typename MechanicsKernel<Embedding, degree>::Number>
  MechanicsKernel<Embedding, degree>::tensor_at(
    const AlignedVector<Number> &values,
    const unsigned int           batch,
    const unsigned int           q)
  {
    Tensor2<Number>   result;
    const std::size_t first =
      (std::size_t(batch) * n_points + q) * n_tensor_entries;
    for (unsigned int e = 0; e < n_tensor_entries; ++e)
      result.access_raw_entry(Embedding::tensor_entries[e]) = values[first + e];
    return result;
  }

  template <typename Embedding, int degree>
  inline DEAL_II_ALWAYS_INLINE void
  MechanicsKernel<Embedding, degree>::submit(
    Cell                  &cell,
    const unsigned int     q,
    const Tensor2<Number> &stress) const
  {
    if constexpr (Embedding::axisymmetric)
      {
        const Number around = 2. * numbers::PI * cell.quadrature_point(q)[0];
        Tensor<1, 2, Number> hoop;
        hoop[0] = 2. * numbers::PI * stress.access_raw_entry(2);
        cell.submit_value(hoop, q);
        cell.submit_symmetric_gradient(around * to_mesh<dim>(stress), q);
      }
    else
      cell.submit_symmetric_gradient(to_mesh<dim>(stress), q);
  }

  template <typename Embedding, int degree>
  typename MechanicsKernel<Embedding, degree>::Number
  MechanicsKernel<Embedding, degree>::weight(const Cell        &cell,
                                             const unsigned int q) const
  {
    if constexpr (Embedding::axisymmetric)
      return 2. * numbers::PI * cell.quadrature_point(q)[0] * cell.JxW(q);
    else
      return cell.JxW(q);
  }

  template <typename Embedding, int degree>
  template <typename Action>
  void
  MechanicsKernel<Embedding, degree>::for_each_run(const Range  &range,
                                                   const Action &action) const
  {
    unsigned int begin = range.first;
    while (begin < range.second)
      {
        unsigned int end = begin + 1;
        while (end < range.second &&
               material_of_batch[end] == material_of_batch[begin])
          ++end;
        std::visit([&](const auto &law) { action(law, Range(begin, end)); },
                   laws[material_of_batch[begin]]);
        begin = end;
      }
  }

  template <typename Embedding, int degree>
  template <unsigned int request>
  double
  MechanicsKernel<Embedding, degree>::sweep(const VectorType &displacement,
                                            VectorType       &force)
  {
    double sum    = 0.;
    worst_failure = {};
    history.begin_trial();
    data.template cell_loop<VectorType, VectorType>(
      [&](const auto &, auto &dst, const auto &src, const Range &range) {
        Cell cell(data);
        for_each_run(range, [&](const auto &law, const Range &run) {
          sum += update_run<request>(law, cell, run, src, dst);
        });
      },
      force,
      displacement);
    return sum;
  }

  template <typename Embedding, int degree>
  template <unsigned int request, typename Law>
  double
  MechanicsKernel<Embedding, degree>::update_run(const Law        &law,
                                                 Cell             &cell,
                                                 const Range      &run,
                                                 const VectorType &displacement,
                                                 VectorType       &force)
  {
    constexpr bool         symmetric = Law::has_potential;
    constexpr unsigned int n_tangent = n_tangent_entries<Embedding>(symmetric);
    const FloatingPointTraps traps;
    const bool               with_tangent =
      tangent_offset[run.second] > tangent_offset[run.first];
    const bool          shocked = bool(shock_viscosity);
    std::optional<Cell> begin; // of the step, for shock viscosity
    if (shocked)
      begin.emplace(data);
    Rheology::Response<Number> response;
    auto   accepted = Rheology::make_history<Number>(law), next = accepted;
    double sum = 0.;
    for (unsigned int batch = run.first; batch < run.second; ++batch)
      {
        cell.reinit(batch);
        cell.read_dof_values(displacement);
        cell.evaluate(cell_flags<Embedding>);
        ShockStress<Number> shock;
        if (shocked)
          {
            shock = shock_of(batch);
            begin->reinit(batch);
            begin->read_dof_values(step_begin);
            begin->evaluate(cell_flags<Embedding>);
          }
        Number potential = 0.;
        for (unsigned int q = 0; q < cell.n_q_points; ++q)
          {
            read_history<Law>(history.accepted(batch, q), accepted);
            law.template update<request>(total_strain(cell, batch, q),
                                         accepted,
                                         next,
                                         response);
            write_history<Law>(next, history.trial(batch, q));
            note_failure(law, batch, response);
            if (shocked)
              {
                const Tensor2<Number> change =
                  strain(cell, q) - strain(*begin, q);
                response.stress += shock.stress(change);
                if constexpr (request & Rheology::potential)
                  response.potential += shock.potential(change);
                if constexpr (request & Rheology::tangent)
                  response.tangent += shock.tangent(change);
              }
            if constexpr (request & Rheology::tangent)
              if (with_tangent)
                pack_tangent<Embedding, symmetric>(response.tangent,
                                                   tangents.data() +
                                                     tangent_offset[batch] +
                                                     q * n_tangent);
            if constexpr (request & Rheology::potential)
              potential += weight(cell, q) * response.potential;
            submit(cell, q, response.stress);
          }
        cell.integrate(cell_flags<Embedding>);
        cell.distribute_local_to_global(force);
        if constexpr (request & Rheology::potential)
          for (unsigned int i = 0;
               i < data.n_active_entries_per_cell_batch(batch);
               ++i)
            sum += potential[i];
      }
    return sum;
  }

  template <typename Embedding, int degree>
  template <typename Law>
  inline DEAL_II_ALWAYS_INLINE void
  MechanicsKernel<Embedding, degree>::note_failure(
    const Law &,
    const unsigned int                batch,
    const Rheology::Response<Number> &response)
  {
    // the others do not fail
    if constexpr (std::is_same_v<Law, Rheology::General>)
      if (response.failure > worst_failure.residual)
        worst_failure = {
          response.failure,
          data.get_cell_iterator(batch, response.failed_lane)->center()};
  }

  template <typename Embedding, int degree>
  double
  MechanicsKernel<Embedding, degree>::evaluate(const VectorType &displacement,
                                               VectorType       &force,
                                               const bool        linearize)
  {
    if (!linearize)
      return sweep<Rheology::potential>(displacement, force);
    if (tangents.size() != tangent_offset.back())
      tangents.resize(tangent_offset.back());
    return sweep<Rheology::potential | Rheology::tangent>(displacement, force);
  }

  template <typename Embedding, int degree>
  bool
  MechanicsKernel<Embedding, degree>::is_linear() const
  {
    return !shock_viscosity &&
           std::all_of(materials.begin(), materials.end(), [](const auto &m) {
             return m.is_elastic;
           });
  }

  template <typename Embedding, int degree>
  bool
  MechanicsKernel<Embedding, degree>::has_potential() const
  {
    return std::all_of(materials.begin(), materials.end(), [](const auto &m) {
      return m.has_potential;
    });
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::tangent_operation(
    Cell        &cell,
    const double regularization) const
  {
    const FloatingPointTraps traps;
    const unsigned int       batch = cell.get_current_cell_index();
    const auto &elastic            = elastic_tangents[material_of_batch[batch]];
    // linear materials have no tangent at every point
    const unsigned int n_kept =
      (tangent_offset[batch + 1] - tangent_offset[batch]) / n_points;
    const bool symmetric = n_kept <= n_tangent_entries<Embedding>(true);
    cell.evaluate(cell_flags<Embedding>);
    for (unsigned int q = 0; q < cell.n_q_points; ++q)
      {
        const Tensor2<Number> increment = strain(cell, q);
        const Number         *packed =
          n_kept == 0 ? elastic.data() :
                                tangents.data() + tangent_offset[batch] + q * n_kept;
        Tensor2<Number> stress =
          symmetric ? apply_packed_tangent<Embedding, true>(packed, increment) :
                      apply_packed_tangent<Embedding, false>(packed, increment);
        if (regularization > 0.)
          stress +=
            Number(regularization) *
            apply_packed_tangent<Embedding, true>(elastic.data(), increment);
        submit(cell, q, stress);
      }
    cell.integrate(cell_flags<Embedding>);
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::apply_tangent(const VectorType &increment,
                                                    VectorType &force) const
  {
    data.template cell_loop<VectorType, VectorType>(
      [&](const auto &, auto &dst, const auto &src, const Range &range) {
        Cell cell(data);
        for (unsigned int batch = range.first; batch < range.second; ++batch)
          {
            cell.reinit(batch);
            cell.read_dof_values(src);
            tangent_operation(cell, 0.);
            cell.distribute_local_to_global(dst);
          }
      },
      force,
      increment);
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::commit()
  {
    history.commit();
  }

  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::discard()
  {
    history.discard();
  }

  template <typename Embedding, int degree>
  auto
  MechanicsKernel<Embedding, degree>::memory() const ->
    typename Mechanics<dim>::Memory
  {
    return {history.memory_consumption(),
            tangents.size() * sizeof(Number),
            (rest_strain.size() + rest_stress.size() + rest_energy.size() +
             rest_voids.size()) *
              sizeof(Number),
            cell_size.size() * sizeof(Number) +
              (sensor.empty() ?
                 0 :
                 sensor.memory_consumption() +
                   sizeof(double) * step_begin.locally_owned_size()),
            data.memory_consumption()};
  }
} // namespace Signoton

#endif
