#ifndef signoton_discretization_geometry_h
#define signoton_discretization_geometry_h

#include <signoton/base/function.h>
#include <signoton/base/scene_file.h>

#include <deal.II/base/types.h>
#include <deal.II/distributed/tria.h>

#include <map>

namespace Signoton
{
  using namespace dealii;

  /** Boundary ids by the names the scene uses for them. */
  using BoundaryNames = std::map<std::string, types::boundary_id>;

  /** Two opposite boundaries that move alike. */
  struct PeriodicPair
  {
    types::boundary_id first, second;
    unsigned int       direction; ///< coordinate that differs between them
  };

  /** What the rest of a scene needs to know of the boundary of a mesh. Parts
   *  that nobody named are called by their number; faces of a mesh file that
   *  belong to no group are called `unnamed`. */
  struct BoundaryParts
  {
    BoundaryNames             names;
    std::vector<PeriodicPair> periodic;
  };

  /**
   * The coarse mesh of a scene: a generator of deal.II by name and arguments,
   * or a file of gmsh (`.msh`, or `.geo` which is meshed on the fly), with
   * names for the parts of its boundary.
   */
  class Geometry
  {
  public:
    void
    add_parameters(ParameterHandler &handler);

    /**
     * Create the mesh, identically on every rank.
     * @param file the scene, to resolve file names and to place complaints
     * @param constants for the expressions that select faces and cells
     * @param notes what to say of the mesh before a run is added to them
     */
    template <int dim>
    BoundaryParts
    create(const SceneFile                           &file,
           const Constants                           &constants,
           parallel::distributed::Triangulation<dim> &mesh,
           std::vector<std::string>                  &notes) const;

    unsigned int initial_refinement = 0;
    /** Whether a .geo file may execute programs and write files. */
    bool trust_geometry = false;

  private:
    template <int dim>
    void
    generate(const SceneFile &file, Triangulation<dim> &mesh) const;

    /** Read the mesh file, on the first rank alone, and make a mesh of it. */
    template <int dim>
    BoundaryNames
    read(const SceneFile          &file,
         const MPI_Comm           &communicator,
         Triangulation<dim>       &mesh,
         std::vector<std::string> &notes) const;

    template <int dim>
    void
    apply_names(const SceneFile          &file,
                const Constants          &constants,
                Triangulation<dim>       &mesh,
                BoundaryNames            &names,
                std::vector<std::string> &notes) const;

    template <int dim>
    std::vector<PeriodicPair>
    find_periodic_pairs(const SceneFile          &file,
                        const Triangulation<dim> &mesh,
                        const BoundaryNames      &names) const;

    template <int dim>
    void
    apply_material_ids(const SceneFile    &file,
                       const Constants    &constants,
                       Triangulation<dim> &mesh) const;

    std::string generator      = "hyper_cube";
    std::string arguments      = "0 : 1 : true";
    std::string mesh_file      = "";
    std::string boundary_names = "";
    std::string material_ids   = "";
    std::string periodic       = "";
    double      distortion     = 0.;
    double      meshing_time   = 60.;
    double      meshing_memory = 4.;
  };
} // namespace Signoton

#endif
