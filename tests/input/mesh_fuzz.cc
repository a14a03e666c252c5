// A hundred damaged files of each kind; tests/long has more.

#include "mesh_fuzz.h"

int
main()
{
  return MeshFuzz::run(100);
}
