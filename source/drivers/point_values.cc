#include <signoton/drivers/point_values.h>

namespace Signoton
{
  template <int dim>
  PointValues<dim>::PointValues(const Space<dim>  &space,
                                Mechanics<dim>    &mechanics,
                                PointLocator<dim> &locator)
    : space(space)
    , mechanics(mechanics)
    , locator(locator)
    , n_points(locator.targets.empty() ? 0 : locator.targets.back().point + 1)
    , mesh_changes(
        space.mesh.signals.any_change.connect([this] { is_current = false; }))
  {}

  template <int dim>
  void
  PointValues<dim>::update()
  {
    if (is_current)
      return;
    is_current                       = true;
    const auto               &places = locator.places();
    std::vector<unsigned int> n_targets(n_points), indices;
    for (const auto &target : locator.targets)
      ++n_targets[target.point];
    for (const auto &place : places)
      indices.push_back(place.cell->active_cell_index());
    const std::vector<unsigned int> number = mechanics.cell_numbers(indices);
    cells                                  = number;
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());

    const FE_DGQArbitraryNodes<dim> at_points(QGauss<1>(space.degree + 1));
    stencils.clear();
    for (unsigned int i = 0; i < places.size(); ++i)
      {
        const auto &place = places[i];
        Stencil     stencil;
        stencil.target = place.target;
        stencil.point  = locator.targets[place.target].point;
        stencil.cell = std::lower_bound(cells.begin(), cells.end(), number[i]) -
                       cells.begin();
        stencil.share_of_target = place.share;
        stencil.share_of_point  = place.share / n_targets[stencil.point];
        stencil.dofs.resize(space.fe.n_dofs_per_cell());
        typename DoFHandler<dim>::active_cell_iterator(&space.mesh,
                                                       place.cell->level(),
                                                       place.cell->index(),
                                                       &space.dof_handler)
          ->get_dof_indices(stencil.dofs);
        for (unsigned int k = 0; k < stencil.dofs.size(); ++k)
          stencil.shape.push_back(space.fe.shape_value(k, place.unit));
        double smallest = std::numeric_limits<double>::max();
        for (unsigned int q = 0; q < at_points.n_dofs_per_cell(); ++q)
          {
            stencil.weight.push_back(at_points.shape_value(q, place.unit));
            smallest = std::min(smallest,
                                place.unit.distance(space.quadrature.point(q)));
          }
        for (unsigned int q = 0; q < at_points.n_dofs_per_cell(); ++q)
          if (place.unit.distance(space.quadrature.point(q)) < smallest + 1e-6)
            stencil.closest.push_back(q);
        stencils.push_back(stencil);
      }
  }

  template <int dim>
  void
  PointValues<dim>::add_states(const std::vector<PointState> &at_points,
                               Values                        &values) const
  {
    const unsigned int n_q = space.quadrature.size();
    values.states.resize(locator.targets.size());
    for (const Stencil &stencil : stencils)
      {
        const PointState *const of_cell = &at_points[stencil.cell * n_q];
        auto                   &numbers = values.states[stencil.target].values;
        for (unsigned int c = 0; c < PointState::region; ++c)
          for (unsigned int q = 0; q < n_q; ++q)
            numbers[c] += stencil.share_of_target * stencil.weight[q] *
                          of_cell[q].values[c];
        for (const unsigned int q : stencil.closest)
          numbers[PointState::region] =
            std::max(numbers[PointState::region],
                     of_cell[q].values[PointState::region]);
      }
  }

  template <int dim>
  auto
  PointValues<dim>::evaluate(const State &state, const bool with_states)
    -> Values
  {
    update();
    Values result;
    for (const State::Field &field : state.fields)
      {
        std::vector<Tensor<1, dim>> values(n_points);
        for (const Stencil &stencil : stencils)
          for (unsigned int k = 0; k < stencil.dofs.size(); ++k)
            values[stencil.point]
                  [space.fe.system_to_component_index(k).first] +=
              stencil.share_of_point * stencil.shape[k] *
              (*field.values)(stencil.dofs[k]);
        result.nodal.push_back(values);
      }
    if (with_states)
      {
        std::vector<PointState> at_points;
        mechanics.point_states(state.displacement(), cells, at_points);
        add_states(at_points, result);
      }

    std::vector<double> sums, regions;
    const auto          exchange = [&](const auto &move) {
      for (auto &field : result.nodal)
        for (auto &value : field)
          for (unsigned int d = 0; d < dim; ++d)
            move(sums, value[d]);
      for (auto &point : result.states)
        for (unsigned int c = 0; c < PointState::n_values; ++c)
          move(c == PointState::region ? regions : sums, point.values[c]);
    };
    exchange([](std::vector<double> &list, const double value) {
      list.push_back(value);
    });
    Utilities::MPI::sum(sums, space.communicator, sums);
    if (with_states)
      Utilities::MPI::max(regions, space.communicator, regions);
    auto sum = sums.cbegin(), region = regions.cbegin();
    exchange([&](const std::vector<double> &list, double &value) {
      value = &list == &sums ? *sum++ : *region++;
    });
    return result;
  }

  template class PointValues<2>;
  template class PointValues<3>;
} // namespace Signoton
