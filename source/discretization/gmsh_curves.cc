#include <signoton/discretization/curved_geometry.h>
#include <signoton/discretization/polynomial_manifold.h>

#include <deal.II/base/utilities.h>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Signoton
{
  namespace
  {
    /** What the model knows of its shape. */
    struct Shape
    {
      Shape()
      {
        gmsh::vectorpair entities;
        gmsh::model::getEntities(entities);
        for (const auto &[dim, tag] : entities)
          if (dim == 1 || dim == 2)
            {
              std::string type;
              gmsh::model::getType(dim, tag, type);
              // what a mesh without geometry consists of
              if (type.rfind("Discrete", 0) == 0)
                has_discrete = true;
              else if (type != "Line" && type != "Plane")
                has_curves = true;
            }
      }

      bool has_curves = false, has_discrete = false;
    };

    /** The elements of one type. */
    template <int dim>
    struct Elements
    {
      explicit Elements(const int type)
      {
        std::string         name;
        int                 dim_of_type, n_corners;
        std::vector<double> unit_points;
        gmsh::model::mesh::getElementProperties(
          type, name, dim_of_type, order, n_nodes, unit_points, n_corners);
        is_complete = dim_of_type == dim && n_corners == 1 << dim &&
                      n_nodes == int(Utilities::pow(order + 1, dim));
        if (!is_complete)
          return;
        // gmsh's unit cell reaches from -1 to 1
        for (int node = 0; node < n_nodes; ++node)
          {
            std::size_t index = 0;
            for (unsigned int d = dim; d-- > 0;)
              index =
                index * (order + 1) +
                std::lround((unit_points[dim * node + d] + 1.) / 2. * order);
            place.push_back(index);
          }
      }

      int                      order = 1, n_nodes = 0;
      bool                     is_complete; ///< blocks with all lattice points
      std::vector<std::size_t> place;       ///< of a node in the lattice
    };

    /** Coordinates of nodes by their tags. */
    struct Nodes
    {
      Nodes()
      {
        std::vector<std::size_t> tags;
        std::vector<double>      xyz, parameters;
        gmsh::model::mesh::getNodes(
          tags, xyz, parameters, -1, -1, false, false);
        for (std::size_t i = 0; i < tags.size(); ++i)
          {
            if (tags[i] >= points.size())
              points.resize(tags[i] + 1);
            points[tags[i]] =
              Point<3>(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
          }
      }

      std::vector<Point<3>> points;
    };

    std::size_t
    n_elements(const int dim)
    {
      std::vector<int>                      types;
      std::vector<std::vector<std::size_t>> tags, nodes;
      gmsh::model::mesh::getElements(types, tags, nodes, dim);
      return std::accumulate(tags.begin(),
                             tags.end(),
                             std::size_t(0),
                             [](const std::size_t n, const auto &some) {
                               return n + some.size();
                             });
    }
  } // namespace

  template <int dim>
  CurvedElements
  sample_gmsh_curves()
  {
    CurvedElements result;
    const Shape    shape;
    if (!shape.has_curves)
      {
        result.order = shape.has_discrete ? 0 : 1;
        return result;
      }
    // Fine meshes need less: the error falls with the angle of an arc along a
    // cell to the power of order + 2.
    const auto n = n_elements(dim);
    gmsh::option::setNumber("Mesh.SecondOrderLinear", 0);
    gmsh::option::setNumber("Mesh.SecondOrderIncomplete", 0);
    gmsh::option::setNumber("Mesh.HighOrderOptimize", 0);
    gmsh::model::mesh::setOrder(n <= 2000 ? 6 : n <= 20000 ? 4 : 2);

    std::vector<int>                      types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dim);
    for (std::size_t t = 0; t < types.size(); ++t)
      if (const Elements<dim> element(types[t]); element.is_complete)
        {
          const Nodes             all;
          std::vector<Point<dim>> points(element.n_nodes);
          for (std::size_t first = 0; first < nodes[t].size();
               first += element.n_nodes)
            {
              for (int node = 0; node < element.n_nodes; ++node)
                for (unsigned int d = 0; d < dim; ++d)
                  points[element.place[node]][d] =
                    all.points[nodes[t][first + node]][d];
              for (const auto &point : points)
                for (unsigned int d = 0; d < dim; ++d)
                  result.coordinates.push_back(point[d]);
            }
          result.order = element.order;
        }
    return result;
  }

  template CurvedElements
  sample_gmsh_curves<2>();
  template CurvedElements
  sample_gmsh_curves<3>();
} // namespace Signoton
