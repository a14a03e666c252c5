#include <signoton/rheology/library.h>

#include <algorithm>

namespace Signoton::Rheology
{
  const std::vector<ReadyScheme> &
  ready_schemes()
  {
    static const std::vector<ReadyScheme> schemes = {
      {"elastic", "2.1", "{spring}"},
      {"elastic granular", "2.3a, 2.10b", "series({spring}, {bound contact})"},
      {"elastic plastic", "", "series({spring}, {hinge on set})"},
      {"elastic plastic granular",
       "2.6",
       "series({spring}, {bound cone and hinge})"},
      {"maxwell granular", "2.3b", "series({spring}, {damper}, {contact})"},
      {"kelvin voigt granular",
       "2.3c",
       "series(parallel({spring}, {damper}), {contact})"},
      {"hardening granular",
       "2.9a",
       "series({spring}, {contact}, parallel({hinge}, {second spring}))"},
      {"schwedoff bingham granular",
       "2.9b",
       "series({spring}, {contact}, parallel({hinge}, {damper}))"},
      // the monograph names 2.9c a regularized variant of 2.9b: the spring
      // across the contact is a reading of that
      {"regularized schwedoff bingham granular",
       "2.9c",
       "series({spring}, parallel({contact}, {second spring}), "
       "parallel({hinge}, {damper}))"},
      {"rigid granular with elastic binder",
       "2.10a",
       "parallel({contact}, {second spring})"},
      {"elastic granular with elastic binder",
       "2.10b",
       "series({spring}, parallel({contact}, {second spring}))"},
      {"rigid granular with viscous binder",
       "2.11a",
       "parallel({contact}, {damper})"},
      {"elastic granular with viscous binder",
       "2.11b",
       "series({spring}, parallel({contact}, {damper}))"},
      {"rigid granular with plastic binder",
       "2.12a",
       "parallel({contact}, {cohesive hinge})"},
      {"elastic granular with plastic binder",
       "2.12b",
       "series({spring}, parallel({contact}, series({second spring}, "
       "{cohesive hinge})))"},
      {"fiber composite",
       "",
       "parallel({spring}, series({second spring}, contact(no compression)))"},
      {"porous",
       "",
       "parallel(series({spring}, {hinge on set}), series({second spring}, "
       "{contact with gap}))"},
      {"complex",
       "",
       "series({spring}, parallel({contact}, series({second spring}, "
       "{cohesive hinge})), "
       "parallel({hinge}, {damper}))"}};
    return schemes;
  }

  const ReadyScheme *
  ready_scheme(const std::string &name)
  {
    const auto &all = ready_schemes();
    const auto  found =
      std::find_if(all.begin(), all.end(), [&name](const auto &scheme) {
        return scheme.name == name;
      });
    return found == all.end() ? nullptr : &*found;
  }
} // namespace Signoton::Rheology
