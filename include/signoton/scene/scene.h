#ifndef signoton_scene_scene_h
#define signoton_scene_scene_h

#include <signoton/drivers/model.h>
#include <signoton/rheology/material_parameters.h>

#include <iosfwd>

namespace Signoton
{
  /** What the command line asks for. */
  struct Options
  {
    enum class Action
    {
      run,
      explain,
      validate
    };

    Action                   action = Action::run;
    bool                     point  = false; ///< one material point, no body
    bool                     trust_geometry = false; ///< see mesh_geometry()
    std::string              scene_file;
    std::string              output_directory;
    std::string              resume_directory;
    std::vector<std::string> overrides;
  };

  /**
   * A scene of one dimension: declares all parameters, reads them strictly,
   * checks them against each other, builds the model.
   */
  template <int dim>
  class Scene
  {
  public:
    Scene(const MPI_Comm &communicator, const SceneFile &file);

    /** Mesh, space and mechanics; checks that need the mesh. */
    void
    build();

    /** Print all parameters of an analysis with their documentation. */
    static void
    print_template(const std::string &analysis, std::ostream &out);

    Model<dim> model;

    std::string title;
    std::string analysis = "statics";
    /** What is in the file without an effect. */
    std::vector<std::string> warnings;
    /** What there is to say of the mesh. */
    std::vector<std::string> notes;

  private:
    void
    choose_analysis();

    /** One file may switch between analyses: drop what only the others use,
     *  with a warning. */
    void
    drop_unused();

    void
    add_parameters(ParameterHandler &handler);

    /** What needs the values of several keys. */
    void
    interpret();

    void
    interpret_initial_state();
    void
    check_boundaries() const;

    void
    check_materials() const;
    void
    check_mesh() const;

    void
    check_supports() const;

    /** From the file, and the kinks of all loads and prescribed motions. */
    void
    find_times_to_meet();

    void
    interpret_probes();
    void
    check_probes();

    ParameterHandler                          handler;
    std::vector<Rheology::MaterialParameters> materials;
    /** Analyses that the file might have chosen. */
    std::vector<std::unique_ptr<Analysis<dim>>> others;
    int                                         dimension = dim;
    std::string  embedding      = dim == 2 ? "plane strain" : "solid";
    unsigned int degree         = 1;
    std::string  points_outside = "nearest";
    std::string  constants_text = "";
    std::string  gravity_text   = "";
    std::string  reference_text = "";

    std::string initial_strain_text, initial_stress_text;
    Constants   constants;
  };

  /** Read, build and run a scene as the options say. */
  ExitStatus
  run_scene(const MPI_Comm &communicator, const Options &options);

  /** Drive one material point as the options say. */
  ExitStatus
  run_point(const MPI_Comm &communicator, const Options &options);

  /** A commented parameter file for an analysis, or for a point. */
  std::string
  scene_template(const std::string &analysis);
} // namespace Signoton

#endif
