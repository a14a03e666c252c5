#ifndef signoton_drivers_state_h
#define signoton_drivers_state_h

#include <signoton/discretization/space.h>

#include <string>
#include <vector>

namespace Signoton
{
  /** The body at a time, as output and probes see it: fields at the nodes, by
   *  name, whatever analysis they come from. */
  struct State
  {
    struct Field
    {
      std::string       name;
      std::string       unit;
      const VectorType *values; ///< with hanging nodes set
    };

    double       time = 0.;
    unsigned int step = 0;
    /** The displacement, which the material sees, comes first. */
    std::vector<Field> fields;

    const VectorType &
    displacement() const
    {
      return *fields[0].values;
    }

    /** A field by its name; nullptr if there is none. */
    const VectorType *
    find(const std::string &name) const
    {
      for (const Field &field : fields)
        if (field.name == name)
          return field.values;
      return nullptr;
    }
  };
} // namespace Signoton

#endif
