#ifndef signoton_scene_requirements_h
#define signoton_scene_requirements_h

#include <signoton/drivers/model.h>

namespace Signoton
{
  /** An effect that a scene may call for, and what it costs. */
  struct Effect
  {
    std::string  name;
    bool         on;
    std::string  why; ///< the ingredient that calls for it, or how to
    unsigned int bytes_per_point;
  };

  /**
   * The union of what the ingredients of a scene need: no switch turns an
   * effect on, and what is off takes no memory and no time.
   */
  template <int dim>
  std::vector<Effect>
  requirements(const Model<dim> &model);

  /** Bytes on all ranks, by what takes them. */
  struct MemoryForecast
  {
    double points, matrix, solver, vectors;

    double
    total() const
    {
      return points + matrix + solver + vectors;
    }
  };

  /** For the mesh at hand, or one with some times its unknowns; besides the
   *  mesh and some 200 MB of libraries a rank. */
  template <int dim>
  MemoryForecast
  memory_forecast(const Model<dim> &model, const double growth = 1.);

  /** The bill as a table, with a forecast of the memory for the mesh at hand
   *  in bytes on all ranks. Collective. */
  template <int dim>
  std::string
  explain(const Model<dim> &model);
} // namespace Signoton

#endif
