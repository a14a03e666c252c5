#include <signoton/drivers/nodal_fields.h>

#include <deal.II/dofs/dof_tools.h>

#include <numeric>

namespace Signoton
{
  template <int dim>
  NodalFields<dim>::NodalFields(const Model<dim> &model,
                                const VectorType &displacement)
    : dof_handler(model.space->mesh)
    , model(model)
    , displacement(displacement)
    , quantities(
        point_quantities({"stress", "pressure", "shear intensity"}, dim))
    , vertices(model.space->mesh)
  {
    dof_handler.distribute_dofs(FE_DGQ<dim>(1));
    vertices.distribute_dofs(FE_Q<dim>(1));
    const IndexSet relevant = DoFTools::extract_locally_relevant_dofs(vertices);
    hanging.reinit(relevant);
    DoFTools::make_hanging_node_constraints(vertices, hanging);
    hanging.close();
    for (VectorType &sum : sums)
      sum.reinit(vertices.locally_owned_dofs(), relevant, model.communicator);
    for (const PointQuantity &quantity : quantities)
      {
        names.push_back("nodal_" + quantity.name);
        std::replace(names.back().begin(), names.back().end(), ' ', '_');
        fields.emplace_back(dof_handler.locally_owned_dofs(),
                            model.communicator);
      }
    const FE_DGQArbitraryNodes<dim> at_points(
      QGauss<1>(model.space->degree + 1));
    for (unsigned int v = 0; v < n_vertices; ++v)
      for (unsigned int q = 0; q < at_points.n_dofs_per_cell(); ++q)
        extrapolation[v].push_back(
          at_points.shape_value(q, GeometryInfo<dim>::unit_cell_vertex(v)));
    for (const auto &material : model.materials)
      recover(material.id);
  }

  template <int dim>
  auto
  NodalFields<dim>::cells_of(const types::material_id material) const -> Cells
  {
    Cells cells;
    for (const auto &cell : model.space->mesh.active_cell_iterators())
      if (cell->is_locally_owned() && cell->material_id() == material)
        cells.push_back(cell);
    return cells;
  }

  template <int dim>
  template <typename Action>
  void
  NodalFields<dim>::for_each(const Cells &cells, const Action &action) const
  {
    std::vector<unsigned int> index, order(cells.size());
    for (const auto &cell : cells)
      index.push_back(cell->active_cell_index());
    const std::vector<unsigned int> number =
      model.mechanics->cell_numbers(index);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const auto a, const auto b) {
      return number[a] < number[b];
    });
    // in portions: all states of a large body would not fit into memory
    constexpr std::size_t     portion = 1024;
    std::vector<unsigned int> some;
    std::vector<PointState>   states;
    const unsigned int        n_q = model.space->quadrature.size();
    const std::size_t         n_portions =
      Utilities::MPI::max(order.size() / portion + 1, model.communicator);
    for (std::size_t p = 0; p < n_portions; ++p)
      {
        const std::size_t begin = std::min(p * portion, order.size()),
                          end   = std::min(begin + portion, order.size());
        some.clear();
        for (std::size_t i = begin; i < end; ++i)
          some.push_back(number[order[i]]);
        model.mechanics->point_states(displacement, some, states);
        for (std::size_t i = begin; i < end; ++i)
          action(cells[order[i]], &states[(i - begin) * n_q]);
      }
  }

  template <int dim>
  void
  NodalFields<dim>::recover(const types::material_id material)
  {
    const auto view = [](const auto &cell, const DoFHandler<dim> &dofs) {
      return typename DoFHandler<dim>::active_cell_iterator(
        &dofs.get_triangulation(), cell->level(), cell->index(), &dofs);
    };
    const Cells                          cells = cells_of(material);
    std::vector<types::global_dof_index> dofs(n_vertices);
    for (VectorType &sum : sums)
      sum = 0.;
    for_each(cells, [&](const auto &cell, const PointState *states) {
      view(cell, vertices)->get_dof_indices(dofs);
      const double volume =
        cell->measure() * model.space->weight(cell->center());
      for (unsigned int v = 0; v < n_vertices; ++v)
        {
          for (unsigned int c = 0; c < 6; ++c)
            for (unsigned int q = 0; q < extrapolation[v].size(); ++q)
              sums[c][dofs[v]] += volume * extrapolation[v][q] *
                                  states[q].values[PointState::stress + c];
          sums[6][dofs[v]] += volume;
        }
    });
    for (VectorType &sum : sums)
      sum.compress(VectorOperation::add);
    for (unsigned int i = 0; i < sums[6].locally_owned_size(); ++i)
      if (const double volume = sums[6].local_element(i); volume > 0.)
        for (unsigned int c = 0; c < 6; ++c)
          sums[c].local_element(i) /= volume;
    for (VectorType &sum : sums)
      {
        hanging.distribute(sum);
        sum.update_ghost_values();
      }

    std::vector<types::global_dof_index> own(n_vertices);
    for (const auto &cell : cells)
      {
        view(cell, vertices)->get_dof_indices(dofs);
        view(cell, dof_handler)->get_dof_indices(own);
        for (unsigned int v = 0; v < n_vertices; ++v)
          {
            PointState state;
            for (unsigned int c = 0; c < 6; ++c)
              state.values[PointState::stress + c] = sums[c][dofs[v]];
            for (unsigned int k = 0; k < quantities.size(); ++k)
              fields[k][own[v]] = quantities[k].value(state);
          }
      }
    for (VectorType &sum : sums)
      sum.zero_out_ghost_values();
  }

  template class NodalFields<2>;
  template class NodalFields<3>;
} // namespace Signoton
