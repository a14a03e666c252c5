#ifndef signoton_operators_mechanics_rest_templates_h
#define signoton_operators_mechanics_rest_templates_h

#include <signoton/base/function.h>
#include <signoton/rheology/classification.h>

#include "mechanics_kernel.h"

#include <deal.II/base/mpi.h>

#include <limits>
#include <sstream>

// The state at rest: strains, stresses and energies before anything moves.

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
          general != nullptr && materials[m].is_viscous)
        {
          relaxed[m]        = true;
          moduli[m]         = Rheology::rest_moduli(materials[m].scheme);
          const double time = Rheology::relaxation_time(materials[m].scheme);
          general->set_time_step(1e10 * (time > 0. ? time : 1.));
        }
    Cell       cell(data);
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
                const bool is_answer =
                  std::isfinite(difference) &&
                  !(response.failure > 0. && response.failed_lane == i);
                if (std::isfinite(size))
                  largest_given = std::max(largest_given, size);
                if (!is_answer || difference > largest)
                  {
                    largest = is_answer ?
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
    data.initialize_dof_vector(unused);
    data.template cell_loop<VectorType, VectorType>(
      [&](const auto &, auto &dst, const auto &, const Range &range) {
        Cell cell(data);
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
    data.initialize_dof_vector(rest_force);
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
} // namespace Signoton

#endif
