#ifndef signoton_drivers_checkpoint_h
#define signoton_drivers_checkpoint_h

#include <signoton/drivers/model.h>

namespace Signoton
{
  /**
   * The accepted state on disk: mesh, nodal fields, history and a few numbers,
   * in a directory that is complete or absent, whatever happens while it is
   * written. It can be read on any number of ranks.
   */
  template <int dim>
  class Checkpoint
  {
  public:
    /** All files that a checkpoint may have. */
    inline static const std::vector<std::string> files = {"numbers",
                                                          "room",
                                                          "mesh",
                                                          "mesh.info",
                                                          "mesh_fixed.data",
                                                          "mesh_variable.data"};

    /** @param directory where it is, or is to be */
    Checkpoint(Model<dim> &model, const std::string &directory);

    void
    set(const std::string &name, const double value);

    /** A number of a checkpoint that has been read. */
    double
    number(const std::string &name) const;

    /** Names of all numbers that begin with @p prefix. */
    std::vector<std::string>
    names(const std::string &prefix) const;

    /** Write the accepted state: fields of the unknowns, the displacement
     *  first, and history. */
    void
    write(const std::vector<const VectorType *> &fields);

    /** Read the numbers, and the refinement of the mesh of the scene. */
    void
    load_mesh();

    /** Read the fields in the order in which they were written, and history;
     *  unknowns must have been distributed on the mesh. */
    void
    load_fields(const std::vector<VectorType *> &fields);

  private:
    std::string
    mesh_file(const std::string &in_directory) const;

    void
    read_numbers();

    /** Exchange the old for the new. */
    void
    put_in_place(const std::string &unfinished);

    Model<dim>                   &model;
    std::string                   directory;
    std::map<std::string, double> numbers;
  };
} // namespace Signoton

#endif
