#include <signoton/discretization/mesh_reader.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/utilities.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace Signoton
{
  namespace
  {
    const std::string in_gmsh =
      "in gmsh use 'Recombine Surface', transfinite or extruded meshes, and "
      "physical groups for the body and its boundaries";

    template <int dim>
    std::string
    in_words(const Point<dim> &point)
    {
      std::ostringstream text;
      text << '(';
      for (unsigned int d = 0; d < dim; ++d)
        text << (d > 0 ? ", " : "") << point[d] + 0.; // no -0
      text << ')';
      return text.str();
    }

    std::string
    in_words(const ElementType &type, const std::size_t number)
    {
      return std::string(type.plural) + " (" + std::to_string(number) + ")";
    }

    /** The sign that the determinant of the map to a cell has, or 0 if it has
     *  not the same everywhere, or is as good as zero. In 2D the determinant is linear, and has its
     *  extremes at the corners; in 3D points between them are looked at too.
     *  @param corners in lexicographic order */
    template <int dim>
    int
    orientation(const std::array<Point<dim>, 1 << dim> &corners)
    {
      constexpr unsigned int n_points    = dim == 2 ? 2 : 3; // in a direction
      bool                   is_positive = true, is_negative = true;
      for (unsigned int p = 0; p < Utilities::pow(n_points, dim); ++p)
        {
          Point<dim> place;
          for (unsigned int d = 0, rest = p; d < dim; ++d, rest /= n_points)
            place[d] = (rest % n_points) / (n_points - 1.);
          Tensor<2, dim> jacobian;
          for (unsigned int c = 0; c < corners.size(); ++c)
            jacobian += outer_product(
              GeometryInfo<dim>::d_linear_shape_function_gradient(place, c),
              Tensor<1, dim>(corners[c] - corners[0]));
          double round_off = 1e-10;
          for (unsigned int d = 0; d < dim; ++d)
            round_off *= jacobian[d].norm();
          const double size = determinant(jacobian);
          is_positive &= size > round_off;
          is_negative &= size < -round_off;
        }
      return is_positive ? 1 : is_negative ? -1 : 0;
    }

    /** A face of a cell, such that the two cells that share it find each other
     *  by its sorted vertices. */
    template <int dim>
    struct Face
    {
      static constexpr unsigned int n = 1 << (dim - 1);

      std::array<unsigned int, n> vertices; ///< sorted
      /** The vertex opposite to the smallest one, and whether the next one in
       *  the sense of the cell is smaller than the one before. */
      unsigned int opposite  = 0;
      bool         direction = false;
      unsigned int cell      = 0;

      bool
      operator<(const Face &other) const
      {
        return vertices < other.vertices;
      }
    };

    /** Corners of a cell around each face, so that the normal points outwards,
     *  or inwards at all of them; lexicographic numbers of the corners. */
    template <int dim>
    std::array<unsigned int, Face<dim>::n>
    around_face(const unsigned int face)
    {
      const unsigned int d = face / 2, side = (face % 2) << d;
      if constexpr (dim == 2)
        {
          const unsigned int other = 1U << (1 - d);
          return (face == 0 || face == 3) ?
                   std::array<unsigned int, 2>{{side + other, side}} :
                   std::array<unsigned int, 2>{{side, side + other}};
        }
      else
        {
          const unsigned int a = 1U << ((d + 1) % 3), b = 1U << ((d + 2) % 3);
          return face % 2 == 1 ?
                   std::array<unsigned int, 4>{
                     {side, side + a, side + a + b, side + b}} :
                   std::array<unsigned int, 4>{
                     {side, side + b, side + a + b, side + a}};
        }
    }

    template <int dim>
    Face<dim>
    make_face(const std::array<unsigned int, Face<dim>::n> &around,
              const unsigned int                            cell)
    {
      constexpr unsigned int n = Face<dim>::n;
      Face<dim>              face;
      face.vertices = around;
      face.cell     = cell;
      std::sort(face.vertices.begin(), face.vertices.end());
      const unsigned int first =
        std::min_element(around.begin(), around.end()) - around.begin();
      const unsigned int next   = around[(first + 1) % n],
                         before = around[(first + n - 1) % n];
      face.opposite             = around[(first + n / 2) % n];
      face.direction            = dim == 2 ? first == 0 : next < before;
      return face;
    }

    /** The steps from a file to a mesh. */
    template <int dim>
    class Maker
    {
    public:
      Maker(const MshFile &file, const bool with_lines)
        : file(file)
        , with_lines(with_lines)
        , vertex_of(file.nodes.size(), numbers::invalid_unsigned_int)
      {}

      BoundaryGroups
      make(Triangulation<dim> &mesh)
      {
        check_types();
        for (const auto &element : file.elements)
          if (element.type->dim == dim)
            add_cell(element);
        find_faces();
        for (const auto &element : file.elements)
          if (element.type->dim == dim - 1 && element.group != 0)
            add_boundary_face(element);
        create(mesh);
        return groups();
      }

    private:
      using Element = MshFile::Element;

      /** Where an element is. */
      std::string
      place(const Element &element) const
      {
        Point<dim> center;
        for (unsigned int i = 0; i < element.type->n_nodes; ++i)
          center += node(element, i) / element.type->n_nodes;
        return (with_lines ? "line " + std::to_string(element.line) + ", " :
                             "") +
               "around " + in_words(center);
      }

      unsigned int
      index(const Element &element, const unsigned int i) const
      {
        return file.element_nodes[element.first_node + i];
      }

      Point<dim>
      node(const Element &element, const unsigned int i) const
      {
        Point<dim> point;
        for (unsigned int d = 0; d < dim; ++d)
          point[d] = file.nodes[index(element, i)][d];
        return point;
      }

      std::string
      group_name(const unsigned int element_dim, const int group) const
      {
        const auto name = file.names.find({element_dim, group});
        return name != file.names.end() ? "'" + name->second + "'" :
               group == 0               ? "no group" :
                                          "group " + std::to_string(group);
      }

      /** Refuse what is no mesh of quadrilaterals or hexahedra. */
      void
      check_types() const
      {
        std::map<const ElementType *, std::size_t> n;
        for (const auto &element : file.elements)
          ++n[element.type];
        std::size_t n_cells = 0;
        for (const auto &[type, number] : n)
          {
            const std::string these = in_words(*type, number);
            if (type->dim > dim)
              throw MeshError(these + ", in a scene with Dimension = " +
                                std::to_string(dim),
                              "'set Dimension = 3'");
            if (type->dim == dim && type->order == 1 &&
                type->n_nodes != GeometryInfo<dim>::vertices_per_cell)
              throw MeshError(these, in_gmsh);
            if (type->dim + 1 >= dim && type->order > 1)
              throw MeshError(these + ", of second order",
                              "elements of first order: "
                              "'Mesh.ElementOrder = 1'");
            n_cells += type->dim == dim ? number : 0;
          }
        if (n_cells > 0)
          return;
        std::string others;
        for (const auto &[type, number] : n)
          others += (others.empty() ? "" : ", ") + in_words(*type, number);
        throw MeshError(others.empty() ? "no cells, nothing is meshed in it" :
                                         others + " alone",
                        dim == 3 && others.find("quad") != std::string::npos ?
                          "'set Dimension = 2', or a mesh of the volume" :
                          in_gmsh);
      }

      void
      add_cell(const Element &element)
      {
        // gmsh goes around the faces of a cell
        constexpr unsigned int around[] = {0, 1, 3, 2, 4, 5, 7, 6};
        constexpr unsigned int n        = GeometryInfo<dim>::vertices_per_cell;

        std::array<Point<dim>, n>   corners;
        std::array<unsigned int, n> nodes;
        for (unsigned int i = 0; i < n; ++i)
          {
            corners[i] = node(element, around[i]);
            nodes[i]   = index(element, around[i]);
          }
        if (dim == 2)
          check_plane(element);
        const int sign = orientation<dim>(corners);
        if (sign == 0)
          throw MeshError("a folded or flat cell, " + place(element),
                          "a mesh of cells whose corners are convex");
        if (sign < 0) // count in another direction
          for (unsigned int i = 0; i < n; i += 2)
            std::swap(nodes[i], nodes[i + 1]);

        CellData<dim> cell(n);
        for (unsigned int i = 0; i < n; ++i)
          {
            unsigned int &vertex = vertex_of[nodes[i]];
            if (vertex == numbers::invalid_unsigned_int)
              {
                vertex = points.size();
                points.push_back(corners[sign < 0 ? i ^ 1U : i]);
              }
            cell.vertices[i] = vertex;
          }
        cell.material_id = element.group;
        cells.push_back(cell);
        cell_elements.push_back(&element);
      }

      /** Refuse a surface that is not in a plane z = constant. */
      void
      check_plane(const Element &element) const
      {
        const Element &first =
          cell_elements.empty() ? element : *cell_elements.front();
        const double    z      = file.nodes[index(first, 0)][2];
        const Point<3> &corner = file.nodes[index(element, 0)];
        const double diagonal  = corner.distance(file.nodes[index(element, 2)]);
        for (unsigned int i = 0; i < element.type->n_nodes; ++i)
          if (std::abs(file.nodes[index(element, i)][2] - z) > 1e-6 * diagonal)
            throw MeshError("a cell out of the plane of x and y, " +
                              place(element),
                            "a surface with z = constant, or 'set Dimension "
                            "= 3' and a volume");
      }

      /** Sort the faces of all cells; refuse what no body has. */
      void
      find_faces()
      {
        faces.reserve(cells.size() * 2 * dim);
        for (unsigned int c = 0; c < cells.size(); ++c)
          for (unsigned int f = 0; f < 2 * dim; ++f)
            {
              auto corners = around_face<dim>(f);
              for (auto &corner : corners)
                corner = cells[c].vertices[corner];
              faces.push_back(make_face<dim>(corners, c));
            }
        std::stable_sort(faces.begin(), faces.end());
        for (std::size_t i = 0; i + 1 < faces.size(); ++i)
          {
            const auto &face = faces[i], &next = faces[i + 1];
            if (face.vertices != next.vertices)
              continue;
            const Element &first  = *cell_elements[face.cell],
                          &second = *cell_elements[next.cell];
            check_twice(first, second);
            if (i + 2 < faces.size() && faces[i + 2].vertices == face.vertices)
              throw MeshError("a third cell at one face, " +
                                place(*cell_elements[faces[i + 2].cell]),
                              "a mesh without overlapping cells");
            if (face.opposite != next.opposite ||
                face.direction == next.direction)
              throw MeshError("two cells that overlap, " + place(second),
                              "a mesh without overlapping cells");
          }
      }

      /** Refuse a cell that is there twice: gmsh writes one for each of its
       *  physical groups. */
      void
      check_twice(const Element &first, const Element &second) const
      {
        std::array<unsigned int, GeometryInfo<dim>::vertices_per_cell> a, b;
        for (unsigned int i = 0; i < a.size(); ++i)
          {
            a[i] = index(first, i);
            b[i] = index(second, i);
          }
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        if (a == b)
          throw MeshError("a cell that is in " + group_name(dim, first.group) +
                            " and in " + group_name(dim, second.group) + ", " +
                            place(second),
                          "each cell once, in one physical group");
      }

      void
      add_boundary_face(const Element &element)
      {
        Face<dim>  face;
        const auto refuse = [&](const std::string &what) {
          throw MeshError(std::string(dim == 2 ? "an edge" : "a face") +
                            " of " + group_name(dim - 1, element.group) + what +
                            ", " + place(element),
                          dim == 2 ? "physical groups of boundary curves" :
                                     "physical groups of boundary surfaces");
        };
        for (unsigned int i = 0; i < face.n; ++i)
          {
            face.vertices[i] = vertex_of[index(element, i)];
          }
        std::sort(face.vertices.begin(), face.vertices.end());
        const auto [begin, end] =
          std::equal_range(faces.begin(), faces.end(), face);
        if (begin == end)
          refuse(" that no cell has");
        auto &[n_inside, n_all] = inside[element.group];
        ++n_all;
        if (end - begin == 2)
          {
            ++n_inside;
            return;
          }
        const auto [known, is_new] =
          id_of.emplace(face.vertices, element.group);
        if (!is_new && known->second != static_cast<unsigned>(element.group))
          refuse(" that is in " + group_name(dim - 1, known->second) +
                 " as well, where only one name can be used");
      }

      void
      create(Triangulation<dim> &mesh)
      {
        try
          {
            GridTools::consistently_order_cells(cells);
            mesh.create_triangulation(points, cells, SubCellData());
          }
        catch (const std::exception &)
          {
            throw MeshError("cells that deal.II cannot join to a body",
                            in_gmsh);
          }
        for (const auto &cell : mesh.active_cell_iterators())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
              {
                std::array<unsigned int, Face<dim>::n> vertices;
                for (unsigned int i = 0; i < vertices.size(); ++i)
                  vertices[i] = face->vertex_index(i);
                std::sort(vertices.begin(), vertices.end());
                if (const auto id = id_of.find(vertices); id != id_of.end())
                  face->set_boundary_id(id->second);
              }
      }

      BoundaryGroups
      groups() const
      {
        BoundaryGroups result;
        for (const auto &[key, name] : file.names)
          if (const auto counts = inside.find(key.second);
              key.first == dim - 1 && counts != inside.end())
            {
              const auto [n_inside, n_all] = counts->second;
              if (n_inside > 0)
                result.inside[name] = counts->second;
              if (n_inside < n_all)
                result.names[name] = key.second;
            }
        return result;
      }

      const MshFile &file;
      const bool     with_lines;

      std::vector<Point<dim>>      points;
      std::vector<CellData<dim>>   cells;
      std::vector<const Element *> cell_elements;
      std::vector<unsigned int>    vertex_of; ///< by node
      std::vector<Face<dim>>       faces;     ///< sorted
      /** Groups of boundary faces by their vertices. */
      std::map<std::array<unsigned int, Face<dim>::n>, types::boundary_id>
        id_of;
      /** Numbers of faces inside the body, and of all, by group. */
      std::map<int, std::pair<unsigned int, unsigned int>> inside;
    };
  } // namespace

  template <int dim>
  BoundaryGroups
  make_mesh(const MshFile      &file,
            const bool          with_lines,
            Triangulation<dim> &mesh)
  {
    return Maker<dim>(file, with_lines).make(mesh);
  }

  template <int dim>
  std::string
  folded_cell(const Triangulation<dim> &mesh)
  {
    for (const auto &cell : mesh.active_cell_iterators())
      {
        std::array<Point<dim>, GeometryInfo<dim>::vertices_per_cell> corners;
        for (unsigned int i = 0; i < corners.size(); ++i)
          corners[i] = cell->vertex(i);
        if (orientation<dim>(corners) <= 0)
          return in_words(cell->center());
      }
    return "";
  }

#define INSTANTIATE(dim)                                        \
  template BoundaryGroups make_mesh<dim>(const MshFile &,       \
                                         const bool,            \
                                         Triangulation<dim> &); \
  template std::string    folded_cell<dim>(const Triangulation<dim> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
