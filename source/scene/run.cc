#include <signoton/base/first_rank.h>
#include <signoton/base/memory.h>
#include <signoton/base/quoting.h>

#include <signoton/drivers/point.h>

#include <signoton/scene/boundary_report.h>
#include <signoton/scene/requirements.h>
#include <signoton/scene/scene.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>

// From the options of the command line to the driver that they ask for.

namespace Signoton
{
  namespace
  {
    template <int dim>
    ExitStatus
    build_and_run(const MPI_Comm  &communicator,
                  const SceneFile &file,
                  const Options   &options)
    {
      ConditionalOStream screen(
        std::cout, Utilities::MPI::this_mpi_process(communicator) == 0);
      Scene<dim> scene(communicator, file);
      if (scene.model.output.directory.empty())
        scene.model.output.directory =
          "output/" + std::filesystem::path(options.scene_file).stem().string();
      scene.model.geometry.trust_geometry = options.trust_geometry;
      scene.build();
      const unsigned int ranks = Utilities::MPI::n_mpi_processes(communicator);
      screen << "Signoton " SIGNOTON_VERSION " on " << ranks
             << (ranks == 1 ? " rank: " : " ranks: ")
             << (scene.title.empty() ? options.scene_file : scene.title)
             << "\n";
      for (const auto &warning : scene.warnings)
        screen << "  warning: " << warning << "\n";
      for (const auto &note : scene.notes)
        screen << "  mesh: " << note << "\n";
      for (const auto &remark : boundary_remarks(scene.model))
        screen << "  note: " << remark << "\n";
      screen << "  boundary: " << boundary_parts(scene.model) << "\n";
      if (options.action != Options::Action::explain)
        require_memory(communicator,
                       memory_forecast(scene.model).total() / ranks,
                       options.scene_file,
                       "a mesh with " +
                         std::to_string(
                           scene.model.space->dof_handler.n_dofs()) +
                         " unknowns",
                       "a coarser mesh or more machines; '--explain' tells "
                       "what takes the memory");
      if (options.action != Options::Action::run)
        {
          scene.model.analysis->validate();
          if (options.action == Options::Action::explain)
            screen << "\n" << explain(scene.model);
          else
            screen << "The scene is valid.\n";
          return ExitStatus::completed;
        }
      for (const auto &effect : requirements(scene.model))
        if (effect.on)
          screen << "  " << effect.name << ": " << effect.why << "\n";
      return scene.model.analysis->run(options.resume_directory);
    }
    /** The file with what the command line overrides.
     *  @param foreign a section that only the other kind of file has
     *  @param try_command what to run such a file by */
    SceneFile
    read(const MPI_Comm    &communicator,
         const Options     &options,
         const std::string &foreign,
         const std::string &kind,
         const std::string &try_command)
    {
      SceneFile file = read_scene(communicator, options.scene_file);
      for (const auto &assignment : options.overrides)
        file.override_entry(assignment);
      const auto sections = file.subsections({});
      if (std::find(sections.begin(), sections.end(), foreign) !=
          sections.end())
        throw UserError(file.where({foreign}),
                        "the section '" + foreign + "'",
                        kind,
                        "'" + try_command + " " + options.scene_file + "'");
      return file;
    }
  } // namespace

  ExitStatus
  run_scene(const MPI_Comm &communicator, const Options &options)
  {
    SceneFile file =
      read(communicator,
           options,
           "Program",
           "a scene with a body; this file is for one material point",
           "signoton point");
    if (!options.output_directory.empty())
      file.set({"Output"}, "Directory", quoted(options.output_directory, "#"));
    const SceneFile::Path geometry = {"Geometry"};
    if (const std::string mesh = unquoted(file.value(geometry, "Mesh file"));
        !mesh.empty())
      file.set(geometry,
               "Mesh file",
               quoted(std::filesystem::absolute(
                        std::filesystem::path(file.directory()) / mesh)
                        .lexically_normal()
                        .string(),
                      "#"));

    const std::string dimension = file.value({}, "Dimension", "2");
    if (dimension == "2")
      return build_and_run<2>(communicator, file, options);
    if (dimension == "3")
      return build_and_run<3>(communicator, file, options);
    throw UserError(file.where({}, "Dimension"),
                    "'" + dimension + "'",
                    "2 or 3",
                    "2 for plane strain and axisymmetric scenes");
  }

  ExitStatus
  run_point(const MPI_Comm &communicator, const Options &options)
  {
    SceneFile file =
      read(communicator,
           options,
           "Geometry",
           "one material point; this file is a scene with a body",
           "signoton");
    PointDriver point(communicator, file);
    if (!options.output_directory.empty())
      point.directory = options.output_directory;
    if (point.directory.empty())
      point.directory =
        "output/" + std::filesystem::path(options.scene_file).stem().string();
    if (options.action == Options::Action::run)
      return point.run();
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      std::cout << (options.action == Options::Action::explain ?
                      point.explanation() :
                      "The file is valid.\n");
    return ExitStatus::completed;
  }

  std::string
  scene_template(const std::string &analysis)
  {
    std::ostringstream out;
    if (analysis == "point")
      PointDriver::print_template(out);
    else if (analysis == "statics" || analysis == "dynamics")
      Scene<2>::print_template(analysis, out);
    else
      throw UserError("command line, --template",
                      "'" + analysis + "'",
                      "one of: statics, dynamics, point",
                      "'signoton --template statics'");
    return out.str();
  }
} // namespace Signoton
