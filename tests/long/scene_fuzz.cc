// Five hundred mutated scenes: refused in words, or valid.

#include "../input/scene_fuzz.h"

#include <signoton/base/mpi_session.h>

int
main(int argc, char **argv)
{
  Signoton::MPISession mpi(argc, argv);
  return SceneFuzz::run(500);
}
