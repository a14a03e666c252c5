#ifndef signoton_operators_mechanics_assembly_templates_h
#define signoton_operators_mechanics_assembly_templates_h

#include "mechanics_kernel.h"

namespace Signoton
{
  template <typename Embedding, int degree>
  void
  MechanicsKernel<Embedding, degree>::assemble(
    TrilinosWrappers::SparseMatrix &matrix,
    const double                    regularization)
  {
    // Column by column of all cells of a batch, as MatrixFreeTools do it; in
    // debug mode those of deal.II 9.4 refuse a mesh of several materials.
    Cell               cell(data);
    const unsigned int n  = cell.dofs_per_cell;
    const auto &numbering = data.get_shape_info().lexicographic_numbering;
    std::vector<types::global_dof_index> dofs(n), sorted(n);
    std::vector<FullMatrix<double>>      of_lane(Number::size(),
                                            FullMatrix<double>(n, n));
    for (unsigned int batch = 0; batch < data.n_cell_batches(); ++batch)
      {
        const unsigned int n_lanes =
          data.n_active_entries_per_cell_batch(batch);
        cell.reinit(batch);
        for (unsigned int j = 0; j < n; ++j)
          {
            for (unsigned int i = 0; i < n; ++i)
              cell.begin_dof_values()[i] = Number(i == j ? 1. : 0.);
            tangent_operation(cell, regularization);
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int lane = 0; lane < n_lanes; ++lane)
                of_lane[lane](i, j) = cell.begin_dof_values()[i][lane];
          }
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            data.get_cell_iterator(batch, lane)->get_dof_indices(dofs);
            for (unsigned int i = 0; i < n; ++i)
              sorted[i] = dofs[numbering[i]];
            space.constraints.distribute_local_to_global(of_lane[lane],
                                                         sorted,
                                                         matrix);
          }
      }
  }
} // namespace Signoton

#endif
