#include <signoton/base/scene_file.h>
#include <signoton/discretization/body_box.h>
#include <signoton/discretization/rigid_motions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe.h>
#include <deal.II/lac/lapack_full_matrix.h>

namespace Signoton
{
  namespace
  {
    std::vector<std::string>
    motion_names(const int dim, const bool axisymmetric)
    {
      if (axisymmetric)
        return {"translation y (along the axis)"};
      if (dim == 2)
        return {"translation x", "translation y", "rotation in the plane"};
      return {"translation x",
              "translation y",
              "translation z",
              "rotation about x",
              "rotation about y",
              "rotation about z"};
    }
  } // namespace

  template <int dim>
  std::vector<std::vector<double>>
  rigid_motions(const Mapping<dim>    &mapping,
                const DoFHandler<dim> &dof_handler,
                const IndexSet        &dofs,
                const bool             axisymmetric)
  {
    std::map<types::global_dof_index, Point<dim>> points;
    DoFTools::map_dofs_to_support_points(mapping, dof_handler, points);
    const auto box    = body_box(dof_handler.get_triangulation());
    const auto center = box.center();
    double     size   = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      size = std::max(size, 0.5 * box.side_length(d));

    const unsigned int n_modes = motion_names(dim, axisymmetric).size();
    std::vector<std::vector<double>> modes(
      n_modes, std::vector<double>(dofs.n_elements(), 0.));
    const auto                          &fe = dof_handler.get_fe();
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < indices.size(); ++i)
            if (dofs.is_element(indices[i]))
              {
                const auto row = dofs.index_within_set(indices[i]);
                const auto c   = fe.system_to_component_index(i).first;
                if (axisymmetric)
                  {
                    modes[0][row] = c == 1 ? 1. : 0.;
                    continue;
                  }
                modes[c][row] = 1.;
                const Tensor<1, dim> arm =
                  (points.at(indices[i]) - center) / size;
                if (dim == 2)
                  modes[2][row] = c == 0 ? -arm[1] : arm[0];
                else
                  for (unsigned int axis = 0; axis < 3; ++axis)
                    {
                      const unsigned int next = (axis + 1) % 3,
                                         last = (axis + 2) % 3;
                      modes[3 + axis][row]    = c == next ? -arm[last % dim] :
                                                c == last ? arm[next % dim] :
                                                            0.;
                    }
              }
        }
    return modes;
  }

  template <int dim>
  std::vector<std::string>
  free_rigid_motions(const Mapping<dim>              &mapping,
                     const DoFHandler<dim>           &dof_handler,
                     const AffineConstraints<double> &constraints,
                     const bool                       axisymmetric)
  {
    // A motion is free if it satisfies all constraints: the null space of the
    // Gram matrix of the amounts by which motions violate them.
    const IndexSet &owned = dof_handler.locally_owned_dofs();
    IndexSet        relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    const auto modes =
      rigid_motions(mapping, dof_handler, relevant, axisymmetric);
    const auto         names = motion_names(dim, axisymmetric);
    const unsigned int n     = modes.size();

    std::vector<double> gram(n * n, 0.);
    std::vector<double> violation(n);
    for (const auto dof : owned)
      if (constraints.is_constrained(dof))
        {
          for (unsigned int a = 0; a < n; ++a)
            {
              violation[a] = modes[a][relevant.index_within_set(dof)];
              for (const auto &[other, weight] :
                   *constraints.get_constraint_entries(dof))
                violation[a] -=
                  weight * modes[a][relevant.index_within_set(other)];
            }
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
              gram[a * n + b] += violation[a] * violation[b];
        }
    Utilities::MPI::sum(gram, dof_handler.get_communicator(), gram);

    LAPACKFullMatrix<double> matrix(n, n);
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = 0; b < n; ++b)
        matrix(a, b) = gram[a * n + b];
    Vector<double>     eigenvalues(n);
    FullMatrix<double> directions(n, n);
    const double       scale = std::max(matrix.frobenius_norm(), 1.);
    matrix.compute_eigenvalues_symmetric(
      -scale, 1e-10 * scale, 0., eigenvalues, directions);

    // Name a free motion by the basic motions that take part in it.
    std::vector<std::string> result;
    for (unsigned int i = 0; i < directions.n(); ++i)
      {
        std::vector<std::string> parts;
        for (unsigned int a = 0; a < n; ++a)
          if (std::abs(directions(a, i)) > 1e-5)
            parts.push_back(names[a]);
        result.push_back(join(parts, " with "));
      }
    return result;
  }

#define INSTANTIATE(dim)                                        \
  template std::vector<std::string> free_rigid_motions<dim>(    \
    const Mapping<dim> &,                                       \
    const DoFHandler<dim> &,                                    \
    const AffineConstraints<double> &,                          \
    const bool);                                                \
  template std::vector<std::vector<double>> rigid_motions<dim>( \
    const Mapping<dim> &,                                       \
    const DoFHandler<dim> &,                                    \
    const IndexSet &,                                           \
    const bool);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
