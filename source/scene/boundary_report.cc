#include <signoton/operators/boundary_integrals.h>
#include <signoton/scene/boundary_report.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Signoton
{
  namespace
  {
    std::string
    number(const double value)
    {
      std::ostringstream text;
      text.precision(4);
      text << value;
      return text.str();
    }

    /** Times of the run, at no even part of it, where periodic functions may
     *  vanish. */
    template <int dim>
    std::vector<double>
    sample_times(const Model<dim> &model)
    {
      constexpr unsigned int n                = 17;
      const auto [section, start, end, times] = model.analysis->time_span();
      std::vector<double> samples             = {start};
      for (unsigned int i = 1; i <= n; ++i)
        samples.push_back(start + i * (end - start) / n);
      return samples;
    }

    /** Two sections that want different values at a point; of several points
     *  the first by its coordinates. */
    template <int dim>
    struct Contradiction
    {
      unsigned int first, second; ///< sections; the first one holds
      Point<dim>   point;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &first &second &point;
      }
    };

    /** Finds the contradictions among what nodes are wanted to do. */
    template <int dim>
    class ContradictionSearch
    {
    public:
      explicit ContradictionSearch(Model<dim> &model)
        : model(model)
      {}

      /** Over all ranks. */
      std::vector<Contradiction<dim>>
      find()
      {
        std::vector<Contradiction<dim>> found;
        const auto                     &held = model.space->held;
        for (const auto &overruled : held.overruled())
          {
            const auto &node = held.nodes()[overruled.node];
            if (contradicts(node, overruled.condition))
              found.push_back({strongest(node, overruled.condition),
                               overruled.condition.section,
                               node.point});
          }
        std::vector<Contradiction<dim>> all;
        for (const auto &part :
             Utilities::MPI::all_gather(model.communicator, found))
          for (const auto &item : part)
            enter(item, all);
        return all;
      }

    private:
      /** The value that a condition wants at a time: the velocity if one of
       *  those compared is prescribed, otherwise the displacement. */
      double
      value(const HeldDirection<dim> &condition,
            const Point<dim>         &p,
            const double              time,
            const bool                of_velocity) const
      {
        if (auto *velocity = condition.velocity(model.conditions))
          {
            velocity->set_time(time);
            return velocity->value(p);
          }
        auto *displacement = condition.displacement(model.conditions);
        if (displacement == nullptr)
          return 0.;
        const auto at = [&](const double t) {
          displacement->set_time(t);
          return displacement->value(p);
        };
        if (!of_velocity)
          return at(time);
        const auto [section, start, end, times] = model.analysis->time_span();
        const double step                       = 1e-5 * (end - start);
        return (at(time + step) - at(time - step)) / (2. * step);
      }

      bool
      contradicts(const HeldNode<dim>      &node,
                  const HeldDirection<dim> &condition) const
      {
        bool of_velocity = condition.velocity(model.conditions) != nullptr;
        bool is_same     = false; // not only up to the rounding of a mesh file
        for (const auto &other : node.held)
          {
            of_velocity |= other.velocity(model.conditions) != nullptr;
            is_same |=
              std::abs(other.direction * condition.direction) > 1. - 1e-14;
          }
        double most = 0., difference = 0.;
        for (const double time : sample_times(model))
          {
            const auto wanted = [&](const HeldDirection<dim> &other) {
              const double v = value(other, node.point, time, of_velocity);
              most           = std::max(most, std::abs(v));
              return v;
            };
            const Tensor<1, dim> motion = node.motion(wanted);
            difference                  = std::max(difference,
                                  std::abs(wanted(condition) -
                                           motion * condition.direction));
          }
        return difference > (of_velocity || !is_same ? 1e-3 : 1e-9) * most;
      }

      /** The section that has most to do with a direction. */
      unsigned int
      strongest(const HeldNode<dim>      &node,
                const HeldDirection<dim> &condition) const
      {
        const Tensor<1, dim> parts = condition.direction * node.inverse;
        unsigned int         most  = 0;
        for (unsigned int i = 1; i < node.held.size(); ++i)
          if (std::abs(parts[i]) > std::abs(parts[most]) + 1e-8)
            most = i;
        return node.held[most].section;
      }

      /** Keep one for each pair of sections. */
      void
      enter(const Contradiction<dim>        &item,
            std::vector<Contradiction<dim>> &all) const
      {
        const auto same =
          std::find_if(all.begin(), all.end(), [&](auto &other) {
            return other.first == item.first && other.second == item.second;
          });
        if (same == all.end())
          {
            all.push_back(item);
            return;
          }
        for (unsigned int d = 0; d < dim; ++d)
          if (const double difference = item.point[d] - same->point[d];
              std::abs(difference) > 1e-9 * (1. + same->point.norm()))
            {
              if (difference < 0.)
                same->point = item.point;
              return;
            }
      }

      Model<dim> &model;
    };

    template <int dim>
    void
    add_contradictions(Model<dim> &model, std::vector<std::string> &remarks)
    {
      for (const auto &found : ContradictionSearch<dim>(model).find())
        {
          std::string place;
          for (unsigned int d = 0; d < dim; ++d)
            place +=
              (d > 0 ? ", " : "") +
              number(std::abs(found.point[d]) < 1e-12 ? 0. : found.point[d]);
          const std::string first = model.conditions[found.first].name;
          const std::string second =
            found.second == no_section ?
              "the axis of revolution" :
              "'" + model.conditions[found.second].name + "'";
          remarks.push_back(model.file.where({"Boundaries", first}) + " and " +
                            second + " want different motions at (" + place +
                            "), and maybe at other points they share; there '" +
                            first + "' holds, the first in the file");
        }
    }

    template <int dim>
    void
    add_lost_loads(Model<dim> &model, std::vector<std::string> &remarks)
    {
      for (const auto &condition : model.conditions)
        {
          if (!condition.constrains() ||
              !(condition.traction || condition.pressure))
            continue;
          LoadOnSupport most{0., 0.};
          for (const double time : sample_times(model))
            {
              model.set_time(time);
              const auto load = load_on_support(*model.space, condition);
              if (load.held > most.held)
                most = load;
            }
          if (!(most.held > 1e-6 * most.all))
            continue;
          const std::string what =
            condition.symmetry ? "the part along the normal" :
                                 "the part in directions that it prescribes";
          remarks.push_back(
            model.file.where({"Boundaries", condition.name},
                             condition.traction ? "Traction" : "Pressure") +
            ": " + what + ", up to " + number(most.held) + " of " +
            number(most.all) +
            (dim == 2 && !model.space->axisymmetric ? " N per metre" : " N") +
            ", goes straight into the support of the boundary and loads "
            "nothing else");
        }
    }

    template <int dim>
    void
    add_facets(const Model<dim> &model, std::vector<std::string> &remarks)
    {
      for (unsigned int i = 0; i < model.conditions.size(); ++i)
        {
          const auto       &angles = model.space->held.facet_angles()[i];
          const std::string where =
            model.file.where({"Boundaries", model.conditions[i].name},
                             "Symmetry") +
            ": facets of the mesh that meet at ";
          // what is clear needs no words: planes, and corners
          if (angles.largest_smooth > 5.)
            remarks.push_back(where + "up to " + number(angles.largest_smooth) +
                              " degrees are taken as one smooth surface (by "
                              "'Kink angle')");
          if (angles.smallest_kink < 44.)
            remarks.push_back(where + number(angles.smallest_kink) +
                              " degrees or more are held both, as planes with "
                              "a kink (by 'Kink angle')");
        }
    }

    /** Supports of the radial displacement on the axis of revolution. */
    template <int dim>
    void
    add_axis(const Model<dim> &model, std::vector<std::string> &remarks)
    {
      if (!model.space->axisymmetric)
        return;
      for (const auto &condition : model.conditions)
        {
          if (!condition.symmetry &&
              !(condition.displacement[0] && !condition.displacement[1]))
            continue;
          double farthest = 0.;
          for (const auto &cell : model.space->mesh.active_cell_iterators())
            if (cell->is_locally_owned())
              for (const auto &face : cell->face_iterators())
                if (face->at_boundary() && face->boundary_id() == condition.id)
                  farthest =
                    std::max(farthest,
                             std::abs(face->center()[0]) / face->diameter());
          if (Utilities::MPI::max(farthest, model.communicator) < 1e-9)
            remarks.push_back(
              model.file.where({"Boundaries", condition.name}) +
              ": the axis of revolution needs no support, its points stay on "
              "it anyway");
        }
    }
  } // namespace

  template <int dim>
  std::string
  boundary_parts(const Model<dim> &model)
  {
    std::string text;
    const auto  sizes = boundary_sizes(*model.space);
    for (const auto &[name, id] : model.space->boundary.names)
      text += (text.empty() ? "" : ", ") + name + " " + number(sizes.at(id)) +
              (dim == 3 || model.space->axisymmetric ? " m^2" : " m");
    return text;
  }

  template <int dim>
  std::vector<std::string>
  boundary_remarks(Model<dim> &model)
  {
    std::vector<std::string> remarks;
    add_contradictions(model, remarks);
    add_lost_loads(model, remarks);
    add_facets(model, remarks);
    add_axis(model, remarks);
    model.set_time(model.analysis->time_span().start);
    return remarks;
  }

#define INSTANTIATE(dim)                                             \
  template std::string boundary_parts<dim>(const Model<dim> &model); \
  template std::vector<std::string> boundary_remarks<dim>(Model<dim> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
