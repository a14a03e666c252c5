#include <signoton/discretization/face_conditions.h>

#include <deal.II/base/mpi.h>

namespace Signoton
{
  namespace
  {
    /** Directions at a smaller angle than this one, in radian, are the same:
     *  coordinates in mesh files are rounded, and to hold a body by the
     *  difference would be to hold it by the round-off. */
    constexpr double same_direction = 0.01;

    /** Keep those directions that depend on none before them. */
    template <int dim>
    void
    select(const std::vector<HeldDirection<dim>> &directions,
           HeldNode<dim>                         &node,
           std::vector<HeldDirection<dim>>       &superfluous)
    {
      std::vector<Tensor<1, dim>> basis;
      for (const auto &candidate : directions)
        {
          Tensor<1, dim> rest = candidate.direction;
          for (const auto &other : basis)
            rest -= (rest * other) * other;
          if (basis.size() < dim && rest.norm() > same_direction)
            {
              basis.push_back(rest / rest.norm());
              node.held.push_back(candidate);
            }
          else
            superfluous.push_back(candidate);
        }
    }

    /**
     * Brings nodes from their owners to all ranks that have them on ghost cells,
     * as vectors of unknowns: a component of a node is an entry at the unknown
     * of this component.
     */
    template <int dim>
    class Exchange
    {
    public:
      explicit Exchange(const Space<dim> &space)
        : points(space.make_relevant_vector())
        , codes(points)
        , directions(dim, points)
      {}

      void
      send(const HeldNode<dim> &node)
      {
        for (unsigned int d = 0; d < dim; ++d)
          points(node.dofs[d]) = node.point[d];
        for (unsigned int i = 0; i < node.held.size(); ++i)
          {
            const auto &[direction, section, component] = node.held[i];
            // zero is for none, and one for the axis of revolution
            const double number =
              section == no_section ? 1. : 2. + static_cast<double>(section);
            codes(node.dofs[i]) = number * (dim + 1) + component;
            for (unsigned int d = 0; d < dim; ++d)
              directions[i](node.dofs[d]) = direction[d];
          }
      }

      void
      update()
      {
        points.update_ghost_values();
        codes.update_ghost_values();
        for (auto &direction : directions)
          direction.update_ghost_values();
      }

      /** The node of some unknowns; without directions if it is free. */
      HeldNode<dim>
      receive(const std::array<types::global_dof_index, dim> &dofs) const
      {
        HeldNode<dim> node;
        node.dofs = dofs;
        for (unsigned int i = 0; i < dim && codes(dofs[i]) > 0.; ++i)
          {
            const unsigned int code   = std::lround(codes(dofs[i])),
                               number = code / (dim + 1);
            node.held.push_back({Tensor<1, dim>(),
                                 number == 1 ? no_section : number - 2,
                                 code % (dim + 1)});
            for (unsigned int d = 0; d < dim; ++d)
              node.held[i].direction[d] = directions[i](dofs[d]);
          }
        if (!node.held.empty())
          for (unsigned int d = 0; d < dim; ++d)
            node.point[d] = points(dofs[d]);
        return node;
      }

    private:
      VectorType              points, codes;
      std::vector<VectorType> directions;
    };

    /** All nodes of own and ghost cells that are not free. */
    template <int dim>
    std::vector<HeldNode<dim>>
    receive_all(const Space<dim> &space, const Exchange<dim> &exchange)
    {
      std::vector<HeldNode<dim>> result;
      const auto                 nodes = nodes_of_cell<dim>(space.fe);
      std::vector<bool>          done(space.relevant_dofs.n_elements());
      std::vector<types::global_dof_index> dofs(space.fe.n_dofs_per_cell());
      for (const auto &cell : space.dof_handler.active_cell_iterators())
        {
          if (cell->is_artificial())
            continue;
          cell->get_dof_indices(dofs);
          for (const auto &node : nodes)
            {
              const auto i =
                space.relevant_dofs.index_within_set(dofs[node[0]]);
              if (done[i])
                continue;
              done[i] = true;
              std::array<types::global_dof_index, dim> global;
              for (unsigned int d = 0; d < dim; ++d)
                global[d] = dofs[node[d]];
              HeldNode<dim> held = exchange.receive(global);
              if (held.held.empty())
                continue;
              held.finish();
              result.push_back(held);
            }
        }
      return result;
    }
  } // namespace

  template <int dim>
  void
  HeldNode<dim>::finish()
  {
    const unsigned int n    = held.size();
    Tensor<2, dim>     gram = unit_symmetric_tensor<dim>();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        gram[i][j] = held[i].direction * held[j].direction;
    gram      = invert(gram);
    inverse   = Tensor<2, dim>();
    projector = Tensor<2, dim>();
    follow    = Tensor<2, dim>();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int d = 0; d < dim; ++d)
          inverse[d][i] += held[j].direction[d] * gram[j][i];
    if (n == dim)
      return;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int e = 0; e < dim; ++e)
        {
          double entry = d == e ? 1. : 0.;
          for (unsigned int i = 0; i < n; ++i)
            entry -= inverse[d][i] * held[i].direction[e];
          projector[d][e] = std::abs(entry) < 1e-14 ? 0. : entry;
        }
    // What has the largest, or smallest, part in the free directions; the first
    // of equal ones up to round-off, whatever the ranks.
    unsigned int most = 0, least = 0;
    for (unsigned int d = 1; d < dim; ++d)
      {
        if (projector[d][d] > projector[most][most] + 1e-8)
          most = d;
        if (projector[d][d] < projector[least][least] - 1e-8)
          least = d;
      }
    if (n + 1 == dim)
      for (unsigned int d = 0; d < dim; ++d)
        follow[d][most] = projector[d][most] / projector[most][most];
    else
      for (unsigned int f = 0; f < dim; ++f)
        if (f != least)
          {
            follow[f][f] = 1.;
            follow[least][f] =
              projector[least][f] / (1. - projector[least][least]);
          }
  }

  template <int dim>
  void
  HeldNodes<dim>::clear()
  {
    held_nodes.clear();
    superfluous.clear();
    angles.clear();
    current = false;
  }

  template <int dim>
  void
  HeldNodes<dim>::reinit(const Space<dim>              &space,
                         const BoundaryConditions<dim> &conditions)
  {
    clear();
    current = true;
    const FacetNormals<dim> facets(space.mesh, conditions);
    angles = facets.angles();
    Exchange<dim> exchange(space);
    std::map<types::global_dof_index, std::vector<HeldDirection<dim>>>
      not_needed;
    for (const auto &[first, collected] :
         collect_face_conditions(space, conditions, facets))
      {
        HeldNode<dim> node;
        node.dofs  = collected.dofs;
        node.point = collected.point;
        std::vector<HeldDirection<dim>> others;
        select<dim>(collected.directions(conditions), node, others);
        exchange.send(node);
        if (!others.empty())
          not_needed.emplace(first, others);
      }
    exchange.update();
    held_nodes = receive_all(space, exchange);
    for (std::size_t i = 0; i < held_nodes.size(); ++i)
      if (const auto found = not_needed.find(held_nodes[i].dofs[0]);
          found != not_needed.end())
        for (const auto &condition : found->second)
          superfluous.push_back({i, condition});
  }

  template <int dim>
  void
  HeldNodes<dim>::constrain(const BoundaryConditions<dim> &conditions,
                            AffineConstraints<double>     &constraints) const
  {
    for (const auto &node : held_nodes)
      {
        // the value of a velocity does not matter: what integrates in time
        // knows the displacement
        const Tensor<1, dim> motion = node.motion([&](const auto &condition) {
          auto *function = condition.displacement(conditions);
          return function != nullptr ? function->value(node.point) : 0.;
        });
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (node.follow[d][d] > 0.5) // left free
              continue;
            constraints.add_line(node.dofs[d]);
            double rest = motion[d];
            for (unsigned int f = 0; f < dim; ++f)
              if (const double factor = node.follow[d][f];
                  std::abs(factor) > 1e-14)
                {
                  constraints.add_entry(node.dofs[d], node.dofs[f], factor);
                  rest -= factor * motion[f];
                }
            constraints.set_inhomogeneity(node.dofs[d], rest);
          }
      }
  }

  template <int dim>
  std::vector<std::array<unsigned int, dim>>
  nodes_of_cell(const FiniteElement<dim> &fe)
  {
    std::vector<std::array<unsigned int, dim>> nodes(fe.n_dofs_per_cell() /
                                                     dim);
    for (unsigned int n = 0; n < nodes.size(); ++n)
      for (unsigned int d = 0; d < dim; ++d)
        nodes[n][d] = fe.component_to_system_index(d, n);
    return nodes;
  }

  template class HeldNode<2>;
  template class HeldNode<3>;
  template class HeldNodes<2>;
  template class HeldNodes<3>;
  template std::vector<std::array<unsigned int, 2>>
  nodes_of_cell<2>(const FiniteElement<2> &);
  template std::vector<std::array<unsigned int, 3>>
  nodes_of_cell<3>(const FiniteElement<3> &);
} // namespace Signoton
