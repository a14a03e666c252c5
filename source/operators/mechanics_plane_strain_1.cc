#include "mechanics_kernel.templates.h"

namespace Signoton
{
  template class MechanicsKernel<PlaneStrain, 1>;
} // namespace Signoton
