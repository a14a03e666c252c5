#ifndef signoton_base_scene_template_h
#define signoton_base_scene_template_h

#include <signoton/base/scene_file.h>

#include <ostream>

namespace Signoton
{
  /**
   * Print all parameters of a handler with their descriptions. In @p section,
   * and those within, entries that @p file does not give are comments: not
   * every key goes with every other one.
   */
  void
  print_template(std::ostream          &out,
                 ParameterHandler      &handler,
                 const SceneFile       &file,
                 const SceneFile::Path &section = {});
} // namespace Signoton

#endif
