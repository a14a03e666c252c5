#ifndef signoton_scene_boundary_report_h
#define signoton_scene_boundary_report_h

#include <signoton/drivers/model.h>

namespace Signoton
{
  /** Names of the parts of the boundary with their lengths or areas: they were
   *  selected by the faces of a coarse mesh. */
  template <int dim>
  std::string
  boundary_parts(const Model<dim> &model);

  /**
   * What a user should know of the conditions at the boundary, a line each:
   * sections that contradict each other, loads that go straight into supports,
   * facets that are taken as a smooth surface or as kinks, supports where none
   * is needed. Looks at several times of the run; the time of the model is then
   * the start.
   */
  template <int dim>
  std::vector<std::string>
  boundary_remarks(Model<dim> &model);
} // namespace Signoton

#endif
