#include <signoton/discretization/momentum_transfer.h>

namespace Signoton
{
  template <int dim>
  MomentumTransfer<dim>::MomentumTransfer(Space<dim>       &space,
                                          const VectorType &velocity,
                                          const CellMass   &cell_mass)
    : space(space)
    , old_velocity(&velocity)
    , cell_mass(cell_mass)
    , handle(space.mesh.register_data_attach(
        [this](const MeshCell &cell, const Status status) {
          return pack(cell, status);
        },
        false))
  {}

  template <int dim>
  typename MomentumTransfer<dim>::CellIterator
  MomentumTransfer<dim>::with_unknowns(const MeshCell &cell) const
  {
    return {&space.mesh, cell->level(), cell->index(), &space.dof_handler};
  }

  template <int dim>
  std::vector<char>
  MomentumTransfer<dim>::pack(const MeshCell &mesh_cell,
                              const Status    status) const
  {
    const CellIterator  cell = with_unknowns(mesh_cell);
    const unsigned int  n    = space.fe.n_dofs_per_cell();
    Vector<double>      values(n);
    std::vector<double> packed(n, 0.);
    if (status != Triangulation<dim>::CELL_COARSEN)
      {
        // cells to be refined still are what they were
        cell->get_dof_values(*old_velocity, values);
        std::copy(values.begin(), values.end(), packed.begin());
        return Utilities::pack(packed, false);
      }
    // the momentum of the children at the nodes of the parent
    Vector<double> momentum(n), sum(n);
    for (unsigned int child = 0; child < cell->n_children(); ++child)
      {
        cell->child(child)->get_dof_values(*old_velocity, values);
        momentum = values;
        momentum.scale(cell_mass(cell->child(child)));
        space.fe.get_prolongation_matrix(child, cell->refinement_case())
          .Tvmult_add(sum, momentum);
      }
    std::copy(sum.begin(), sum.end(), packed.begin());
    return Utilities::pack(packed, false);
  }

  template <int dim>
  VectorType
  MomentumTransfer<dim>::missing(const VectorType &velocity)
  {
    VectorType                           result = space.make_relevant_vector();
    const unsigned int                   n      = space.fe.n_dofs_per_cell();
    Vector<double>                       old(n), now(n), expected(n);
    std::vector<types::global_dof_index> dofs(n);
    const auto add = [&](const CellIterator &cell, const Vector<double> &had) {
      cell->get_dof_values(velocity, now);
      now.scale(cell_mass(cell));
      expected = had;
      expected -= now;
      // round-off of what has not changed would wake cells at rest
      const double noise = 1e-14 * had.linfty_norm();
      for (double &value : expected)
        if (std::abs(value) <= noise)
          value = 0.;
      cell->get_dof_indices(dofs);
      space.mesh_constraints.distribute_local_to_global(expected, dofs, result);
    };
    space.mesh.notify_ready_to_unpack(
      handle,
      [&](
        const MeshCell &mesh_cell,
        const Status    status,
        const boost::iterator_range<std::vector<char>::const_iterator> &data) {
        const auto packed = Utilities::unpack<std::vector<double>>(data.begin(),
                                                                   data.end(),
                                                                   false);
        std::copy(packed.begin(), packed.end(), old.begin());
        const CellIterator cell = with_unknowns(mesh_cell);
        Vector<double>     had(n);
        if (status == Triangulation<dim>::CELL_COARSEN)
          add(cell, old);
        else if (status == Triangulation<dim>::CELL_PERSIST)
          {
            had = old;
            had.scale(cell_mass(cell));
            add(cell, had);
          }
        else
          {
            // On curved cells the children together have not quite the mass of
            // their parent at its nodes: they share what that makes.
            Vector<double> of_parent(old);
            of_parent.scale(cell_mass(cell));
            std::vector<Vector<double>> momentum;
            Tensor<1, dim>              total;
            Vector<double>              share(n);
            double                      mass = 0.;
            const auto sum = [&](const Vector<double> &m, const double sign) {
              for (unsigned int i = 0; i < n; ++i)
                total[space.fe.system_to_component_index(i).first] +=
                  sign * m[i];
            };
            sum(of_parent, 1.);
            for (unsigned int child = 0; child < cell->n_children(); ++child)
              {
                space.fe.get_prolongation_matrix(child, cell->refinement_case())
                  .vmult(had, old);
                had.scale(cell_mass(cell->child(child)));
                momentum.push_back(had);
                sum(had, -1.);
                mass += cell_mass(cell->child(child)).l1_norm() / dim;
              }
            for (unsigned int child = 0; child < cell->n_children(); ++child)
              {
                share = cell_mass(cell->child(child));
                for (unsigned int i = 0; i < n; ++i)
                  momentum[child][i] +=
                    share[i] / mass *
                    total[space.fe.system_to_component_index(i).first];
                add(cell->child(child), momentum[child]);
              }
          }
      });
    result.compress(VectorOperation::add);
    return result;
  }

  template class MomentumTransfer<2>;
  template class MomentumTransfer<3>;
} // namespace Signoton
