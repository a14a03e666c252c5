#include <signoton/drivers/reactions.h>

namespace Signoton
{
  namespace
  {
    /** Force and moment of a section; in 2D the moment is its last entry. */
    template <int dim>
    struct Reaction
    {
      Tensor<1, dim> force;
      Tensor<1, 3>   moment;

      void
      add(const Point<dim> &p, const Tensor<1, dim> &f)
      {
        force += f;
        moment[2] += p[0] * f[1] - p[1] * f[0];
        if (dim == 3)
          {
            constexpr unsigned int z = dim - 1;
            moment[0] += p[1] * f[z] - p[z] * f[1];
            moment[1] += p[z] * f[0] - p[0] * f[z];
          }
      }
    };

    /** By sections, over all ranks. */
    template <int dim>
    std::vector<Reaction<dim>>
    reactions(const Model<dim> &model, const VectorType &support_forces)
    {
      std::vector<Reaction<dim>> result(model.conditions.size());
      for (const auto &node : model.space->held.nodes())
        {
          if (!support_forces.in_local_range(node.dofs[0]))
            continue;
          Tensor<1, dim> force;
          for (unsigned int d = 0; d < dim; ++d)
            force[d] = support_forces(node.dofs[d]);
          const Tensor<1, dim> multipliers = force * node.inverse;
          for (unsigned int i = 0; i < node.held.size(); ++i)
            if (node.held[i].section != no_section)
              result[node.held[i].section].add(node.point,
                                               multipliers[i] *
                                                 node.held[i].direction);
        }
      for (auto &reaction : result)
        {
          reaction.force =
            Utilities::MPI::sum(reaction.force, model.communicator);
          reaction.moment =
            Utilities::MPI::sum(reaction.moment, model.communicator);
        }
      return result;
    }
  } // namespace

  template <int dim>
  CSVTable::Row
  reaction_columns(const Model<dim> &model, const VectorType &support_forces)
  {
    const std::array<std::string, 3> axes = {{" x", " y", " z"}};
    CSVTable::Row                    columns;
    const auto                       all = reactions(model, support_forces);
    for (unsigned int i = 0; i < all.size(); ++i)
      {
        if (!model.conditions[i].constrains())
          continue;
        const std::string &name = model.conditions[i].name;
        for (unsigned int d = 0; d < dim; ++d)
          columns.emplace_back("reaction " + name + axes[d], all[i].force[d]);
        for (unsigned int d = 0; dim == 3 && d < 3; ++d)
          columns.emplace_back("moment " + name + axes[d], all[i].moment[d]);
        if (dim == 2 && !model.space->axisymmetric)
          columns.emplace_back("moment " + name, all[i].moment[2]);
      }
    return columns;
  }

  template <int dim>
  CSVTable::Row
  binder_shares(const Model<dim> &model,
                const VectorType &support_forces,
                const VectorType &binder_force)
  {
    const auto all        = reactions(model, support_forces),
               of_binders = reactions(model, binder_force);
    double largest        = 0.;
    for (const auto &reaction : all)
      largest = std::max(largest, reaction.force.norm());
    CSVTable::Row result;
    for (unsigned int i = 0; i < all.size(); ++i)
      {
        const double whole = all[i].force.norm(),
                     part  = of_binders[i].force.norm();
        if (whole > 0.01 * largest && part > 0.03 * whole)
          result.emplace_back(model.conditions[i].name, part / whole);
      }
    return result;
  }

  template CSVTable::Row
  reaction_columns<2>(const Model<2> &, const VectorType &);
  template CSVTable::Row
  reaction_columns<3>(const Model<3> &, const VectorType &);
  template CSVTable::Row
  binder_shares<2>(const Model<2> &, const VectorType &, const VectorType &);
  template CSVTable::Row
  binder_shares<3>(const Model<3> &, const VectorType &, const VectorType &);
} // namespace Signoton
