// Five hundred damaged mesh files of each kind.

#include "../input/mesh_fuzz.h"

int
main()
{
  return MeshFuzz::run(500);
}
