#ifndef signoton_discretization_msh_file_h
#define signoton_discretization_msh_file_h

#include <deal.II/base/point.h>

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace Signoton
{
  using namespace dealii;

  /** Why a mesh cannot be used: what was found in it, and what to try. */
  class MeshError : public std::runtime_error
  {
  public:
    MeshError(const std::string &found, const std::string &try_this)
      : std::runtime_error(found)
      , try_this(try_this)
    {}

    const std::string try_this;
  };

  /** A kind of elements in files of gmsh. */
  struct ElementType
  {
    int          number; ///< that of gmsh
    const char  *plural;
    unsigned int dim, n_nodes, order;
  };

  /**
   * What stands in a .msh file, in ASCII of version 2 or 4.1, that a mesh is
   * made of. The text may be anything: it is read token by token, every number
   * is checked, and nothing is allocated that the text does not have.
   * Everything that is not as it must be is a MeshError that names the line.
   */
  struct MshFile
  {
    struct Element
    {
      const ElementType *type;
      int                group;      ///< its physical group, 0 for none
      std::size_t        first_node; ///< its place in element_nodes
      std::size_t        line;       ///< of the file
    };

    explicit MshFile(const std::string &text);

    std::vector<Point<3>>     nodes;
    std::vector<Element>      elements;
    std::vector<unsigned int> element_nodes; ///< indices of all elements
    /** Names of physical groups by dimension and number, byte by byte. */
    std::map<std::pair<int, int>, std::string> names;
  };
} // namespace Signoton

#endif
