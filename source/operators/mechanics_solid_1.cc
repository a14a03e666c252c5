#include "mechanics_kernel.templates.h"

namespace Signoton
{
  template class MechanicsKernel<Solid, 1>;
} // namespace Signoton
