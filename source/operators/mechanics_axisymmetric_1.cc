#include "mechanics_kernel.templates.h"

namespace Signoton
{
  template class MechanicsKernel<Axisymmetric, 1>;
} // namespace Signoton
