#include "mechanics_kernel.templates.h"

namespace Signoton
{
  template class MechanicsKernel<PlaneStrain, 2>;
} // namespace Signoton
