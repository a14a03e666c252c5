#ifndef signoton_tests_support_scene_h
#define signoton_tests_support_scene_h

#include "box_scene.h"

#include <deal.II/base/mpi.h>
#include <deal.II/physics/transformations.h>

/** Elastic bodies on supports, solved on any number of ranks. */
namespace Verification
{
  inline const std::array<std::string, 3> axes = {{"x", "y", "z"}};

  inline Tensor<1, 3>
  vector_of(const PhysicalNumbers::Line &line,
            const int                    dim,
            const std::string           &before,
            const std::string           &behind = "")
  {
    Tensor<1, 3> result;
    for (int d = 0; d < dim; ++d)
      result[d] = value(line, before + axes[d] + behind);
    return result;
  }

  inline std::string
  vector_text(const Tensor<1, 3> &v,
              const int           dim,
              const std::string  &separator)
  {
    std::string result;
    for (int d = 0; d < dim; ++d)
      result += (d > 0 ? separator : "") + text(v[d]);
    return result;
  }

  /** How supports are written, and how the body is solved. */
  struct Kind
  {
    int          dim;
    unsigned int degree;
    std::string  analysis;         ///< statics, explicit or implicit
    bool         reversed = false; ///< the order of the sections

    std::string
    name() const
    {
      return std::to_string(dim) + "D, degree " + std::to_string(degree) +
             ", " + analysis + (reversed ? ", reversed" : "");
    }
  };

  /** All of them on one rank, half of them on more. */
  inline std::vector<Kind>
  kinds()
  {
    const bool is_serial = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
    std::vector<Kind> result;
    for (const int dim : {2, 3})
      for (const unsigned int degree : {1, 2})
        for (const std::string analysis : {"statics", "explicit", "implicit"})
          if (is_serial || (degree == 1) != (analysis == "statics"))
            result.push_back({dim, degree, analysis});
    return result;
  }

  /** A section of the boundary with its entries. */
  using Section =
    std::pair<std::string, std::vector<std::pair<std::string, std::string>>>;

  inline SceneFile
  elastic_scene(const Kind &kind, std::vector<Section> sections)
  {
    SceneFile file;
    file.set({}, "Dimension", std::to_string(kind.dim));
    file.set({},
             "Analysis",
             kind.analysis == "statics" ? "statics" : "dynamics");
    file.set({"Discretization"}, "Degree", std::to_string(kind.degree));
    const SceneFile::Path rock = {"Materials", "rock"};
    file.set(rock, "Rheology", "elastic");
    file.set(rock, "Young modulus", "1");
    file.set(rock, "Poisson ratio", "0.3");
    file.set(rock, "Density", "1.3");
    if (kind.reversed)
      std::reverse(sections.begin(), sections.end());
    for (const auto &[name, entries] : sections)
      for (const auto &[key, entry] : entries)
        file.set({"Boundaries", name}, key, entry);
    if (kind.analysis != "explicit")
      file.set({"Newton"}, "Tolerance", "1e-12");
    if (kind.analysis == "statics")
      return file;
    file.set({"Time integration"}, "Scheme", kind.analysis);
    file.set({"Time integration"}, "End time", "1");
    if (kind.analysis == "implicit")
      {
        file.set({"Time integration"}, "Time step", "0.1");
        file.set({"Time integration"}, "Spectral radius", "1");
      }
    return file;
  }

  /** An obtuse wedge with its corner at the origin, in 3D a prism, turned in
   *  space: a floor, a slope that rises 30 degrees to the other side, an end and
   *  a top. */
  class Wedge
  {
  public:
    Wedge(const int dim, const bool turned)
      : dim(dim)
    {
      turn = unit_symmetric_tensor<3>();
      if (turned)
        turn = Physics::Transformations::Rotations::rotation_matrix_3d(
          dim == 2 ? Tensor<1, 3>({0., 0., 1.}) : Tensor<1, 3>({.48, .6, .64}),
          dim == 2 ? 0.3 : 0.7);
    }

    Tensor<1, 3>
    place(const double x, const double y, const double z = 0.) const
    {
      return turn * Tensor<1, 3>({x, y, z});
    }

    void
    set_geometry(SceneFile &file) const
    {
      const std::vector<std::array<double, 2>> plane = {{{0., 0.}},
                                                        {{2., 0.}},
                                                        {{-std::sqrt(3.), 1.}},
                                                        {{1.5, 2.}}};
      std::string                              points;
      for (int layer = 0; layer < dim - 1; ++layer)
        for (const auto &p : plane)
          points += (points.empty() ? "" : "; ") +
                    vector_text(place(p[0], p[1], layer), dim, ", ");
      file.set({"Geometry"}, "Generator", "general_cell");
      file.set({"Geometry"}, "Arguments", points + " : true");
      file.set({"Geometry"},
               "Boundary names",
               std::string("slope: 0; end: 1; floor: 2; top: 3") +
                 (dim == 3 ? "; front: 4; back: 5" : ""));
      file.set({"Geometry"}, "Initial refinement", dim == 2 ? "2" : "1");
    }

    /** Force and moment of a unit pressure on the end and of a unit weight
     *  along -y, with the density of the material. */
    std::pair<Tensor<1, 3>, Tensor<1, 3>>
    load() const
    {
      const double       depth    = dim == 3 ? 0.5 : 0.;
      const Tensor<1, 3> pressure = place(-2., -0.5),
                         at       = place(1.75, 1., depth);
      // area and center of gravity of the plane, by its triangles
      const std::vector<Tensor<1, 3>> corners = {Tensor<1, 3>({0., 0., 0.}),
                                                 Tensor<1, 3>({2., 0., 0.}),
                                                 Tensor<1, 3>({1.5, 2., 0.}),
                                                 Tensor<1, 3>(
                                                   {-std::sqrt(3.), 1., 0.})};
      double                          area    = 0.;
      Tensor<1, 3>                    center;
      for (const unsigned int i : {1, 2})
        {
          const double part =
            0.5 * cross_product_3d(corners[i], corners[i + 1])[2];
          area += part;
          center += part / 3. * (corners[i] + corners[i + 1]);
        }
      center /= area;
      const Tensor<1, 3> weight = 1.3 * area * place(0., -1.);
      return {pressure + weight,
              cross_product_3d(at, pressure) +
                cross_product_3d(place(center[0], center[1], depth), weight)};
    }

    Tensor<1, 3>
    gravity() const
    {
      return place(0., -1.);
    }

  private:
    const int    dim;
    Tensor<2, 3> turn;
  };
} // namespace Verification

#endif
