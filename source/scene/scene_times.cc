#include <signoton/base/number.h>
#include <signoton/discretization/body_box.h>
#include <signoton/scene/scene.h>

#include <cmath>

// The times that the steps of a scene have to meet.

namespace Signoton
{
  namespace
  {
    /** Some places in the body's bounding box and on its sides, the same on all
     *  ranks, where no function is likely to vanish by symmetry. */
    template <int dim>
    std::vector<Point<dim>>
    sample_places(const BoundingBox<dim> &box)
    {
      std::vector<Point<dim>> places(35);
      for (unsigned int i = 0; i < places.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int side = i % (2 * dim + 1);
            const double       part =
              side == 2 * d     ? 0. :
                    side == 2 * d + 1 ? 1. :
                                        std::fmod(0.31 + (0.618 + 0.131 * d) * i, 1.);
            places[i][d] = box.lower_bound(d) + part * box.side_length(d);
          }
      return places;
    }
  } // namespace

  template <int dim>
  void
  Scene<dim>::find_times_to_meet()
  {
    const SceneFile &file  = model.file;
    TimeSpan        &span  = model.analysis->time_span();
    const double     start = span.start, end = span.end;
    model.times_to_meet     = TimesToMeet(start, end);
    const std::string where = file.where({span.section}, "Times");
    for (const double time : read_times(span.times, where))
      {
        if (time < start || time > end)
          throw UserError(where,
                          number_text(time),
                          "times from 'Start time' to 'End time', " +
                            number_text(start) + " to " + number_text(end),
                          "other times are not met");
        model.times_to_meet.add(time);
      }

    const auto places = sample_places(body_box(model.space->mesh));
    const bool watches =
      model.analysis->has_inertia && model.analysis->solves_equations;
    if (watches)
      model.load_watch.places = places;
    const auto look = [&](const std::unique_ptr<SpaceTimeFunction<dim>> &f,
                          const std::string                             &at) {
      std::vector<Kink> kinks;
      if (f && f->varies())
        {
          kinks = f->kinks(start, end, places);
          if (watches)
            model.load_watch.add(*f, start, end);
        }
      if (kinks.size() > most_kinks)
        {
          warnings.push_back(at + " has more than " +
                             std::to_string(most_kinks) +
                             " kinks in time: steps do not meet them");
          kinks.clear();
        }
      model.times_to_meet.add(kinks);
      return kinks;
    };
    const char axes[] = {'x', 'y', 'z'};
    for (auto &condition : model.conditions)
      {
        const SceneFile::Path path = {"Boundaries", condition.name};
        for (unsigned int d = 0; d < dim; ++d)
          {
            const std::string at =
              file.where(path, std::string("Displacement ") + axes[d]);
            for (const Kink &kink : look(condition.displacement[d], at))
              if (model.analysis->has_inertia && kink.jumps)
                throw UserError(at,
                                "a displacement that jumps at t = " +
                                  number_text(kink.after),
                                "one that is continuous in time: a jump is an "
                                "impact of any strength",
                                "let it change in a short time, or prescribe "
                                "a velocity");
            look(condition.velocity[d],
                 file.where(path, std::string("Velocity ") + axes[d]));
          }
        look(condition.traction, file.where(path, "Traction"));
        look(condition.pressure, file.where(path, "Pressure"));
      }
    for (auto &point : model.point_forces)
      look(point.force, file.where({"Point forces", point.name}, "Force"));
    look(model.gravity, file.where({"Loads"}, "Gravity"));
    // the state of a body with mass knows nothing of a jump in no time
    if (model.analysis->has_inertia)
      span.end = model.times_to_meet.end_before_jump();
  }

#define INSTANTIATE(dim) template void Scene<dim>::find_times_to_meet();

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
