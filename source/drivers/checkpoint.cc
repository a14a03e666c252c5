#include <signoton/base/output_file.h>
#include <signoton/discretization/mesh_identity.h>
#include <signoton/drivers/checkpoint.h>

#include <deal.II/distributed/solution_transfer.h>

#include <boost/crc.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>

#include <fcntl.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace Signoton
{
  namespace
  {
    constexpr double format = 3;

    const std::string checksum = "checksum of ";

    bool
    is_root(const MPI_Comm &communicator)
    {
      return Utilities::MPI::this_mpi_process(communicator) == 0;
    }

    /** What must be the same in a scene that reads the checkpoint. */
    template <int dim>
    std::map<std::string, double>
    identity(const Model<dim> &model)
    {
      return {{"format", format},
              {"dimension", dim},
              {"degree", model.space->degree},
              {"numbers of history a point", model.mechanics->state_width()}};
    }

    /** Whether a file of so many bytes can be made. The free space of the disk
     *  does not tell: there are quotas, and limits of a process. */
    bool
    has_room(const std::string &directory, const double bytes)
    {
      const std::string trial = directory + "/room";
      std::FILE        *file  = std::fopen(trial.c_str(), "wb");
      const bool        ok =
        file != nullptr && posix_fallocate(fileno(file), 0, bytes) == 0;
      if (file != nullptr)
        std::fclose(file);
      std::error_code error;
      std::filesystem::remove(trial, error);
      return ok;
    }

    double
    checksum_of(const std::string &text)
    {
      boost::crc_32_type crc;
      crc.process_bytes(text.data(), text.size());
      return crc.checksum();
    }

    /** Of a file of any size; of none if there is no such file. */
    double
    checksum_of_file(const std::string &file_name)
    {
      boost::crc_32_type crc;
      std::ifstream      file(file_name, std::ios::binary);
      std::vector<char>  block(1 << 20);
      do
        {
          file.read(block.data(), block.size());
          crc.process_bytes(block.data(), file.gcount());
      } while (file);
      return crc.checksum();
    }

    /** Remove the files of a checkpoint; what is not of it goes to another
     *  directory, or keeps its own. */
    void
    remove_checkpoint(const std::string              &directory,
                      const std::vector<std::string> &files,
                      const std::string              &refuge)
    {
      namespace fs = std::filesystem;
      std::error_code error;
      for (const std::string &file : files)
        fs::remove(directory + "/" + file, error);
      std::vector<fs::path> foreign;
      for (const auto &entry : fs::directory_iterator(directory, error))
        foreign.push_back(entry.path());
      for (const fs::path &path : foreign)
        if (const fs::path there = fs::path(refuge) / path.filename();
            !refuge.empty() && !fs::exists(there, error))
          fs::rename(path, there, error);
      fs::remove(directory, error);
    }

    void
    check_same(const std::string &where,
               const std::string &what,
               const double       found,
               const double       expected)
    {
      if (std::abs(found - expected) > 0.5)
        throw UserError("checkpoint '" + where + "'",
                        what + " " + Utilities::to_string(found),
                        what + " " + Utilities::to_string(expected) +
                          " as in the scene",
                        "resume with the scene file that wrote the checkpoint "
                        "(resolved.prm beside it)");
    }
  } // namespace

  template <int dim>
  Checkpoint<dim>::Checkpoint(Model<dim> &model, const std::string &directory)
    : model(model)
    , directory(directory)
  {}

  template <int dim>
  void
  Checkpoint<dim>::set(const std::string &name, const double value)
  {
    numbers[name] = value;
  }

  template <int dim>
  double
  Checkpoint<dim>::number(const std::string &name) const
  {
    const auto found = numbers.find(name);
    if (found == numbers.end())
      throw UserError("checkpoint '" + directory + "'",
                      "no entry '" + name + "'",
                      "a complete checkpoint of this program",
                      "use an older checkpoint or start anew");
    return found->second;
  }

  template <int dim>
  std::vector<std::string>
  Checkpoint<dim>::names(const std::string &prefix) const
  {
    std::vector<std::string> result;
    for (const auto &entry : numbers)
      if (entry.first.rfind(prefix, 0) == 0)
        result.push_back(entry.first);
    return result;
  }

  template <int dim>
  std::string
  Checkpoint<dim>::mesh_file(const std::string &in_directory) const
  {
    return in_directory + "/mesh";
  }

  template <int dim>
  void
  Checkpoint<dim>::read_numbers()
  {
    std::string damaged;
    if (is_root(model.communicator))
      {
        // a run may have been killed while it exchanged the old for the new
        const std::string old = directory + ".old";
        if (!std::filesystem::exists(directory) && std::filesystem::exists(old))
          directory = old;
        // the last line is the checksum of the others
        std::ostringstream file;
        file << std::ifstream(directory + "/numbers", std::ios::binary).rdbuf();
        const std::string  text = file.str();
        std::istringstream lines(text);
        double             value = 0.;
        std::string        name;
        while (lines >> value && std::getline(lines >> std::ws, name))
          numbers[name] = value;
        const auto sum = numbers.find(checksum + "numbers");
        if (sum == numbers.end() ||
            sum->second !=
              checksum_of(
                text.substr(0, text.rfind('\n', text.size() - 2) + 1)))
          damaged = "numbers";
        else
          for (const auto &entry : names(checksum + "mesh"))
            {
              const std::string file = entry.substr(checksum.size());
              if (number(entry) != checksum_of_file(directory + "/" + file))
                damaged = file;
            }
      }
    damaged   = Utilities::MPI::broadcast(model.communicator, damaged);
    directory = Utilities::MPI::broadcast(model.communicator, directory);
    numbers   = Utilities::MPI::broadcast(model.communicator, numbers);
    if (!damaged.empty())
      throw UserError("checkpoint '" + directory + "'",
                      "file '" + damaged + "' is missing or damaged",
                      "a complete checkpoint, as a run with 'Output / "
                      "Checkpoint every' above 0 writes it",
                      "use an older checkpoint or start anew");
  }

  template <int dim>
  void
  Checkpoint<dim>::write(const std::vector<const VectorType *> &fields)
  {
    const auto *history_space    = model.history_space();
    namespace fs                 = std::filesystem;
    const std::string unfinished = directory + ".unfinished";
    // p4est ends the whole program if it cannot write: make sure of the space
    const double per_cell =
      64. + 8. * (fields.size() * model.space->fe.n_dofs_per_cell() +
                  (history_space ? history_space->fe.n_dofs_per_cell() : 0));
    const double estimate =
      1e5 + per_cell * model.space->mesh.n_global_active_cells();
    unsigned int problem = 0;
    if (is_root(model.communicator))
      {
        std::error_code error;
        remove_checkpoint(unfinished, files, "");
        fs::create_directories(unfinished, error);
        problem = error || !has_room(unfinished, estimate) ? 1 : 0;
      }
    if (Utilities::MPI::max(problem, model.communicator) > 0)
      throw UserError("checkpoint '" + directory + "'",
                      "it cannot be written, the disk is full or protected",
                      "about " + std::to_string(estimate / 1e6) + " MB free",
                      "free space or choose another output directory; the "
                      "last complete checkpoint is untouched",
                      ExitStatus::output_failed);

    std::vector<VectorType>         ghosted(fields.size(),
                                    model.space->make_relevant_vector());
    std::vector<const VectorType *> saved;
    for (std::size_t i = 0; i < fields.size(); ++i)
      {
        ghosted[i].copy_locally_owned_data_from(*fields[i]);
        // who follows whom at periodic corners is a matter of numbering
        model.space->mesh_constraints.distribute(ghosted[i]);
        ghosted[i].update_ghost_values();
        saved.push_back(&ghosted[i]);
      }
    parallel::distributed::SolutionTransfer<dim, VectorType> save_fields(
      model.space->dof_handler);
    save_fields.prepare_for_serialization(saved);
    VectorType history;
    std::unique_ptr<parallel::distributed::SolutionTransfer<dim, VectorType>>
      save_history;
    if (history_space)
      {
        history = history_space->make_relevant_vector();
        model.mechanics->save_history(*history_space, history);
        history.update_ghost_values();
        save_history = std::make_unique<
          parallel::distributed::SolutionTransfer<dim, VectorType>>(
          history_space->dof_handler);
        save_history->prepare_for_serialization(history);
      }
    model.space->mesh.save(mesh_file(unfinished));

    for (const auto &same : {identity(model), mesh_identity(*model.space)})
      for (const auto &[name, value] : same)
        set(name, value);
    set("active cells", model.space->mesh.n_global_active_cells());
    if (is_root(model.communicator))
      for (const std::string &file : files)
        if (fs::exists(unfinished + "/" + file))
          set(checksum + file, checksum_of_file(unfinished + "/" + file));
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    for (const auto &[name, value] : numbers)
      text << value << ' ' << name << '\n';
    const double sum = checksum_of(text.str());
    text << sum << ' ' << checksum << "numbers\n";
    write_file(model.communicator, unfinished + "/numbers", text.str());
    put_in_place(unfinished);
  }

  template <int dim>
  void
  Checkpoint<dim>::put_in_place(const std::string &unfinished)
  {
    namespace fs = std::filesystem;
    bool ok      = true;
    if (is_root(model.communicator))
      {
        const std::string old = directory + ".old";
        std::error_code   error;
        for (const std::string &file : files)
          if (fs::exists(unfinished + "/" + file, error))
            ok = synchronize(unfinished + "/" + file) && ok;
        ok = synchronize(unfinished) && ok;
        if (ok)
          {
            if (fs::exists(directory, error))
              {
                remove_checkpoint(old, files, directory);
                fs::rename(directory, old, error);
              }
            fs::rename(unfinished, directory, error);
            ok = !error;
            remove_checkpoint(old, files, directory);
          }
      }
    // nobody goes on before the checkpoint is in place
    if (Utilities::MPI::max(ok ? 0U : 1U, model.communicator) > 0)
      throw UserError("checkpoint '" + directory + "'",
                      "it cannot be brought to the disk",
                      "space and permission to write",
                      "free space; the last complete checkpoint is there, or "
                      "beside it with the ending '.old'",
                      ExitStatus::output_failed);
  }

  template <int dim>
  void
  Checkpoint<dim>::load_mesh()
  {
    read_numbers();
    model.space->mesh.coarsen_global(100);
    for (const auto &[name, value] : identity(model))
      check_same(directory, name, number(name), value);
    if (const std::string difference =
          difference_of_meshes(numbers, mesh_identity(*model.space));
        !difference.empty())
      throw UserError("checkpoint '" + directory + "'",
                      "another coarse mesh than that of the scene: they differ "
                      "in " +
                        difference,
                      "the mesh with which the run began",
                      "put the mesh file, or 'Geometry' in resolved.prm, back "
                      "as it was; for another mesh start anew");
    try
      {
        model.space->mesh.load(mesh_file(directory));
      }
    catch (const ExceptionBase &)
      {
        throw UserError("checkpoint '" + directory + "'",
                        "its mesh cannot be read",
                        "the mesh of the scene, refined",
                        "use an older checkpoint or start anew");
      }
    check_same(directory,
               "active cells",
               model.space->mesh.n_global_active_cells(),
               number("active cells"));
  }

  template <int dim>
  void
  Checkpoint<dim>::load_fields(const std::vector<VectorType *> &fields)
  {
    parallel::distributed::SolutionTransfer<dim, VectorType> load(
      model.space->dof_handler);
    std::vector<VectorType *> loaded(fields);
    load.deserialize(loaded);
    if (const auto *history_space = model.history_space())
      {
        VectorType history = history_space->make_relevant_vector();
        parallel::distributed::SolutionTransfer<dim, VectorType> load_history(
          history_space->dof_handler);
        load_history.deserialize(history);
        model.mechanics->load_history(*history_space, history);
      }
  }

  template class Checkpoint<2>;
  template class Checkpoint<3>;
} // namespace Signoton
