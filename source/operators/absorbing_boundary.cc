#include <signoton/operators/absorbing_boundary.h>

#include <signoton/rheology/classification.h>

#include <deal.II/fe/fe_values.h>

#include <boost/container/flat_map.hpp>

namespace Signoton
{
  namespace
  {
    struct Impedance
    {
      double normal, tangential; ///< in kg/(m^2 s)
    };

    Impedance
    impedance(const Rheology::Material &material, const bool loosened)
    {
      const Moduli moduli = loosened ?
                              Rheology::loosened_moduli(material.scheme) :
                              material.elasticity;
      return {std::sqrt(material.density *
                        (moduli.bulk + 4. / 3. * moduli.shear)),
              std::sqrt(material.density * moduli.shear)};
    }

    /** Add the dashpots on a face to the columns of the matrix of a cell. */
    template <int dim>
    void
    add_face(const FEFaceValues<dim>                          &values,
             const Space<dim>                                 &space,
             const std::vector<std::array<unsigned int, dim>> &nodes_of,
             const Impedance                                  &Z,
             std::vector<Vector<double>>                      &of_cell)
    {
      for (const unsigned int q : values.quadrature_point_indices())
        {
          const Tensor<1, dim> normal = values.normal_vector(q);
          const double         area =
            values.JxW(q) * space.weight(values.quadrature_point(q));
          for (const auto &node : nodes_of)
            {
              // one at its node, zero at the others
              const double share = values.shape_value(node[0], q);
              if (std::abs(share) < 1e-8)
                continue;
              for (unsigned int a = 0; a < dim; ++a)
                for (unsigned int b = 0; b < dim; ++b)
                  of_cell[b][node[a]] +=
                    area * share *
                    ((Z.normal - Z.tangential) * normal[a] * normal[b] +
                     (a == b ? Z.tangential : 0.));
            }
        }
    }
  } // namespace

  template <int dim>
  void
  AbsorbingBoundary<dim>::reinit(
    const Space<dim>                      &space,
    const std::vector<Rheology::Material> &materials,
    const BoundaryConditions<dim>         &conditions,
    const Supports<dim>                   &supports)
  {
    nodes.clear();
    if (std::any_of(conditions.begin(), conditions.end(), [](const auto &c) {
          return c.absorbs();
        }))
      collect(space, integrate(space, materials, conditions), supports);
  }

  template <int dim>
  std::vector<VectorType>
  AbsorbingBoundary<dim>::integrate(
    const Space<dim>                      &space,
    const std::vector<Rheology::Material> &materials,
    const BoundaryConditions<dim>         &conditions)
  {
    boost::container::flat_map<types::boundary_id,
                               const BoundaryCondition<dim> *>
      absorbing;
    for (const auto &condition : conditions)
      if (condition.absorbs())
        absorbing[condition.id] = &condition;
    boost::container::flat_map<types::material_id, std::array<Impedance, 2>>
      impedances; // of closed and of loosened pores
    for (const auto &material : materials)
      impedances[material.id] = {
        {impedance(material, false), impedance(material, true)}};

    std::vector<VectorType> columns(dim, space.make_relevant_vector());
    const auto              nodes_of = nodes_of_cell<dim>(space.fe);
    // lumped: points at the nodes
    FEFaceValues<dim>                    values(space.mapping,
                             space.fe,
                             QGaussLobatto<dim - 1>(space.degree + 1),
                             update_values | update_JxW_values |
                               update_quadrature_points |
                               update_normal_vectors);
    const unsigned int                   n = space.fe.n_dofs_per_cell();
    std::vector<Vector<double>>          of_cell(dim, Vector<double>(n));
    std::vector<types::global_dof_index> dofs(n);
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned() || !cell->at_boundary())
          continue;
        for (const auto f : cell->face_indices())
          {
            if (!cell->face(f)->at_boundary())
              continue;
            const auto found = absorbing.find(cell->face(f)->boundary_id());
            if (found == absorbing.end())
              continue;
            values.reinit(cell, f);
            add_face<dim>(values,
                          space,
                          nodes_of,
                          impedances[cell->material_id()]
                                    [found->second->absorbs_loosened() ? 1 : 0],
                          of_cell);
            cell->get_dof_indices(dofs);
            for (unsigned int d = 0; d < dim; ++d)
              {
                space.mesh_constraints.distribute_local_to_global(of_cell[d],
                                                                  dofs,
                                                                  columns[d]);
                of_cell[d] = 0.;
              }
          }
      }
    for (auto &column : columns)
      column.compress(VectorOperation::add);
    return columns;
  }

  template <int dim>
  void
  AbsorbingBoundary<dim>::collect(const Space<dim>              &space,
                                  const std::vector<VectorType> &columns,
                                  const Supports<dim>           &supports)
  {
    boost::container::flat_map<unsigned int, typename Supports<dim>::Node>
      supported;
    for (const auto &node : supports.nodes())
      supported[node.index[0]] = node;
    const auto        nodes_of = nodes_of_cell<dim>(space.fe);
    const IndexSet   &owned    = space.dof_handler.locally_owned_dofs();
    std::vector<bool> done(owned.n_elements(), false);
    std::vector<types::global_dof_index> dofs(space.fe.n_dofs_per_cell());
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        cell->get_dof_indices(dofs);
        for (const auto &local : nodes_of)
          {
            if (!owned.is_element(dofs[local[0]]))
              continue;
            Node node;
            for (unsigned int d = 0; d < dim; ++d)
              node.index[d] = owned.index_within_set(dofs[local[d]]);
            if (done[node.index[0]])
              continue;
            done[node.index[0]] = true;
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int b = 0; b < dim; ++b)
                node.damping[a][b] = columns[b].local_element(node.index[a]);
            if (!(node.damping.norm() > 0.))
              continue;
            const Tensor<2, dim> identity = unit_symmetric_tensor<dim>();
            const auto           support  = supported.find(node.index[0]);
            const bool           is_free  = support == supported.end();
            node.projector = is_free ? identity : support->second.projector;
            node.follow    = is_free ? identity : support->second.follow;
            nodes.push_back(node);
          }
      }
  }

  template <int dim>
  void
  AbsorbingBoundary<dim>::accelerate(const VectorType &mass,
                                     const VectorType &velocity,
                                     const double      time_step,
                                     VectorType       &acceleration) const
  {
    const Tensor<2, dim> identity = unit_symmetric_tensor<dim>();
    for (const Node &node : nodes)
      {
        const double   m = mass.local_element(node.index[0]);
        Tensor<1, dim> v, a;
        for (unsigned int d = 0; d < dim; ++d)
          {
            v[d] = velocity.local_element(node.index[d]);
            a[d] = acceleration.local_element(node.index[d]);
          }
        const Tensor<2, dim> &P = node.projector;
        a = invert(identity + 0.5 * time_step / m * P * node.damping * P) *
            (P * (a - node.damping * v / m));
        for (unsigned int d = 0; d < dim; ++d)
          acceleration.local_element(node.index[d]) = a[d];
      }
  }

  template <int dim>
  void
  AbsorbingBoundary<dim>::add_force(const VectorType &velocity,
                                    VectorType       &force) const
  {
    for (const Node &node : nodes)
      {
        Tensor<1, dim> v;
        for (unsigned int d = 0; d < dim; ++d)
          v[d] = velocity.local_element(node.index[d]);
        const Tensor<1, dim> f = node.damping * v;
        for (unsigned int d = 0; d < dim; ++d)
          force.local_element(node.index[d]) += f[d];
      }
  }

  template class AbsorbingBoundary<2>;
  template class AbsorbingBoundary<3>;
} // namespace Signoton
