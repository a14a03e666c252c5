#include <signoton/discretization/refinement.h>
#include <signoton/discretization/traction_jumps.h>

#include <deal.II/fe/fe_values.h>

namespace Signoton
{
  namespace
  {
    const UpdateFlags flags = update_values | update_quadrature_points |
                              update_JxW_values | update_normal_vectors;

    /** One side of a face: whichever of a whole face or a part of it was looked
     *  at last. */
    template <int dim>
    class Side
    {
    public:
      Side(const Space<dim>      &space,
           const PointSpace<dim> &points,
           const VectorType      &stress)
        : whole(space.mapping,
                points.fe,
                QGauss<dim - 1>(space.degree + 1),
                flags)
        , part(space.mapping,
               points.fe,
               QGauss<dim - 1>(space.degree + 1),
               flags)
        , tractions(whole.n_quadrature_points)
        , stress(stress)
        , raw(tractions.size(), Vector<double>(points.n_components))
      {}

      template <typename Cell>
      void
      look_at(const Cell &cell, const unsigned int f)
      {
        whole.reinit(cell, f);
        values = &whole;
      }

      template <typename Cell>
      void
      look_at(const Cell        &cell,
              const unsigned int f,
              const unsigned int subface)
      {
        part.reinit(cell, f, subface);
        values = &part;
      }

      /** Of the interpolated stress, by the normals of this or the other side.
       */
      const std::vector<Tensor<1, dim>> &
      evaluate(const std::vector<Tensor<1, dim>> &normals)
      {
        values->get_function_values(stress, raw);
        for (unsigned int q = 0; q < tractions.size(); ++q)
          {
            SymmetricTensor<2, dim> sigma;
            for (unsigned int c = 0; c < raw[q].size(); ++c)
              sigma.access_raw_entry(c) = raw[q][c];
            tractions[q] = sigma * normals[q];
          }
        return tractions;
      }

      const FEFaceValuesBase<dim> &
      operator*() const
      {
        return *values;
      }

    private:
      FEFaceValues<dim>            whole;
      FESubfaceValues<dim>         part;
      const FEFaceValuesBase<dim> *values = nullptr;
      std::vector<Tensor<1, dim>>  tractions;
      const VectorType            &stress;
      std::vector<Vector<double>>  raw;
    };

    /** For each point of a face the one that is there on the other side of a
     *  periodic body, where faces may be turned. */
    template <int dim>
    std::vector<unsigned int>
    partners(const std::vector<Point<dim>> &here,
             const std::vector<Point<dim>> &there)
    {
      Tensor<1, dim> shift;
      for (unsigned int q = 0; q < here.size(); ++q)
        shift += (1. / here.size()) * (here[q] - there[q]);
      std::vector<unsigned int> result;
      for (const Point<dim> &p : here)
        {
          const auto closest =
            std::min_element(there.begin(),
                             there.end(),
                             [&](const Point<dim> &a, const Point<dim> &b) {
                               return (a + shift).distance_square(p) <
                                      (b + shift).distance_square(p);
                             });
          result.push_back(closest - there.begin());
        }
      return result;
    }

    template <int dim>
    class TractionJumps
    {
    public:
      using Cell = typename DoFHandler<dim>::cell_iterator;

      TractionJumps(const Space<dim>              &space,
                    const PointSpace<dim>         &points,
                    const VectorType              &stress,
                    const BoundaryConditions<dim> &conditions)
        : space(space)
        , here(space, points, stress)
        , there(space, points, stress)
      {
        for (const auto &condition : conditions)
          condition_of[condition.id] = &condition;
      }

      /** The integral over a face, in Pa^2 m^2. */
      double
      over_face(const Cell &cell, const unsigned int f)
      {
        const bool is_periodic = cell->has_periodic_neighbor(f);
        if (cell->at_boundary(f) && !is_periodic)
          return at_boundary(cell, f);
        const Cell neighbor   = cell->neighbor_or_periodic_neighbor(f);
        const auto other_face = [&] {
          return is_periodic ? cell->periodic_neighbor_face_no(f) :
                               cell->neighbor_face_no(f);
        };
        double sum = 0.;
        if (neighbor->has_children())
          for (unsigned int s = 0; s < GeometryInfo<dim>::max_children_per_face;
               ++s)
            {
              here.look_at(cell, f, s);
              there.look_at(is_periodic ?
                              cell->periodic_neighbor_child_on_subface(f, s) :
                              cell->neighbor_child_on_subface(f, s),
                            other_face());
              sum += jump(is_periodic);
            }
        else
          {
            here.look_at(cell, f);
            if (is_periodic ? cell->periodic_neighbor_is_coarser(f) :
                              cell->neighbor_is_coarser(f))
              {
                const auto [face, subface] =
                  is_periodic ?
                    cell->periodic_neighbor_of_coarser_periodic_neighbor(f) :
                    cell->neighbor_of_coarser_neighbor(f);
                there.look_at(neighbor, face, subface);
              }
            else
              there.look_at(neighbor, other_face());
            sum = jump(is_periodic);
          }
        return 0.5 * sum;
      }

    private:
      double
      dA(const unsigned int q) const
      {
        return space.weight((*here).quadrature_point(q)) * (*here).JxW(q);
      }

      double
      at_boundary(const Cell &cell, const unsigned int f)
      {
        here.look_at(cell, f);
        const auto &traction = here.evaluate((*here).get_normal_vectors());
        const auto  found    = condition_of.find(cell->face(f)->boundary_id());
        double      sum      = 0.;
        for (unsigned int q = 0; q < traction.size(); ++q)
          sum += missing_traction(found == condition_of.end() ? nullptr :
                                                                found->second,
                                  (*here).quadrature_point(q),
                                  (*here).normal_vector(q),
                                  traction[q])
                   .norm_square() *
                 dA(q);
        return sum;
      }

      double
      jump(const bool is_periodic)
      {
        const auto &normals = (*here).get_normal_vectors();
        const auto &mine    = here.evaluate(normals);
        const auto &other   = there.evaluate(normals);
        const auto  partner = is_periodic ?
                                partners((*here).get_quadrature_points(),
                                        (*there).get_quadrature_points()) :
                                std::vector<unsigned int>();
        double      sum     = 0.;
        for (unsigned int q = 0; q < mine.size(); ++q)
          sum += (mine[q] - other[is_periodic ? partner[q] : q]).norm_square() *
                 dA(q);
        return sum;
      }

      const Space<dim> &space;
      Side<dim>         here, there;
      boost::container::flat_map<types::boundary_id,
                                 const BoundaryCondition<dim> *>
        condition_of;
    };
  } // namespace

  template <int dim>
  Vector<float>
  traction_jumps(const Space<dim>              &space,
                 const PointSpace<dim>         &points,
                 const VectorType              &stress,
                 const BoundaryConditions<dim> &conditions,
                 const ByMaterial              &shear_modulus)
  {
    TractionJumps<dim> jumps(space, points, stress, conditions);
    Vector<float>      indicators(space.mesh.n_active_cells());
    for (const auto &cell : points.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          double sum = 0.;
          for (const auto f : cell->face_indices())
            sum += cell->face(f)->diameter() * jumps.over_face(cell, f);
          indicators[cell->active_cell_index()] =
            0.5 * sum / shear_modulus.at(cell->material_id());
        }
    return indicators;
  }

  template <int dim>
  void
  drop_round_off(const Space<dim> &space,
                 const VectorType &stress,
                 const VectorType &displacement,
                 const ByMaterial &shear_modulus,
                 const ByMaterial &stiffness,
                 Vector<float>    &indicators)
  {
    constexpr double of_stress = 1e-8, of_displacement = 1e-12;
    const double     largest = stress.linfty_norm();
    Vector<double>   u(space.fe.n_dofs_per_cell());
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_values(displacement, u);
          const double noise =
            of_stress * largest +
            of_displacement * stiffness.at(cell->material_id()) *
              u.linfty_norm() / cell->minimum_vertex_distance();
          double faces = 0.; // in m^3
          for (const auto f : cell->face_indices())
            faces += cell->face(f)->diameter() * cell->face(f)->measure() *
                     space.weight(cell->face(f)->center());
          float &indicator = indicators[cell->active_cell_index()];
          if (indicator <= 0.5 * faces * noise * noise /
                             shear_modulus.at(cell->material_id()))
            indicator = 0.f;
        }
  }

#define INSTANTIATE(dim)                                                      \
  template Vector<float> traction_jumps<dim>(const Space<dim> &,              \
                                             const PointSpace<dim> &,         \
                                             const VectorType &,              \
                                             const BoundaryConditions<dim> &, \
                                             const ByMaterial &);             \
  template void          drop_round_off<dim>(const Space<dim> &,              \
                                    const VectorType &,              \
                                    const VectorType &,              \
                                    const ByMaterial &,              \
                                    const ByMaterial &,              \
                                    Vector<float> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
