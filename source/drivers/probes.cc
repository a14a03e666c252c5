#include <signoton/base/gnuplot.h>
#include <signoton/base/output_file.h>
#include <signoton/discretization/ghost_values.h>
#include <signoton/drivers/probes.h>

#include <deal.II/fe/fe_values.h>

#include <numeric>
#include <sstream>

namespace Signoton
{
  namespace
  {
    const std::array<std::string, 3> axes    = {{"x", "y", "z"}};
    const std::array<std::string, 6> entries = {
      {"xx", "yy", "zz", "xy", "xz", "yz"}};

    /** Lines have the stress in any case. */
    std::vector<std::string>
    of_lines(std::vector<std::string> wanted)
    {
      if (std::find(wanted.begin(), wanted.end(), "stress") == wanted.end())
        wanted.emplace_back("stress");
      std::stable_partition(wanted.begin(), wanted.end(), [](const auto &name) {
        return name == "stress";
      });
      return wanted;
    }
  } // namespace

  template <int dim>
  Probes<dim>::Probes(Model<dim> &model, OutputDirectory &directory)
    : model(model)
    , directory(directory)
    , wanted(Utilities::split_string_list(model.output.probe_quantities, ','))
    , quantities(point_quantities(wanted, dim))
    , line_quantities(point_quantities(of_lines(wanted), dim))
    , mesh_changes(model.space->mesh.signals.any_change.connect(
        [this] { surfaces_are_current = false; }))
  {
    if (model.probe_points)
      points = std::make_unique<PointValues<dim>>(*model.space,
                                                  *model.mechanics,
                                                  *model.probe_points);
    for (unsigned int l = 0; l < model.probe_lines.size(); ++l)
      {
        lines.push_back(std::make_unique<PointValues<dim>>(
          *model.space, *model.mechanics, *model.probe_lines[l].places));
        tables.emplace_back(model.communicator,
                            directory.path + "/" + file(l, ".csv"));
      }
  }

  template <int dim>
  bool
  Probes<dim>::wants(const std::string &quantity) const
  {
    return std::find(wanted.begin(), wanted.end(), quantity) != wanted.end();
  }

  template <int dim>
  std::string
  Probes<dim>::material_name(const types::material_id id) const
  {
    for (const auto &material : model.materials)
      if (material.id == id)
        return material.name;
    return std::to_string(id);
  }

  template <int dim>
  void
  Probes<dim>::update_surfaces()
  {
    if (surfaces_are_current)
      return;
    surfaces_are_current = true;
    const auto &space    = *model.space;
    surfaces.assign(model.probe_surfaces.size(), Surface());
    if (surfaces.empty())
      return;
    const QGauss<dim - 1>           quadrature(space.degree + 1);
    const FE_DGQArbitraryNodes<dim> at_points(QGauss<1>(space.degree + 1));
    FEFaceValues<dim>               values(space.mapping,
                             space.fe,
                             quadrature,
                             update_values | update_quadrature_points |
                               update_normal_vectors | update_JxW_values);
    FEFaceValues<dim>               of_points(space.mapping,
                                at_points,
                                quadrature,
                                update_values);
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const auto f : cell->face_indices())
          for (unsigned int s = 0; s < surfaces.size(); ++s)
            if (cell->face(f)->at_boundary() &&
                cell->face(f)->boundary_id() == model.probe_surfaces[s].second)
              {
                values.reinit(cell, f);
                of_points.reinit(
                  typename Triangulation<dim>::cell_iterator(cell), f);
                surfaces[s].add(space, cell, f, values, of_points);
              }
    for (Surface &surface : surfaces)
      surface.cells = model.mechanics->cell_numbers(surface.cells);
  }

  template <int dim>
  void
  Probes<dim>::Surface::add(
    const Space<dim>                                     &space,
    const typename DoFHandler<dim>::active_cell_iterator &cell,
    const unsigned int                                    f,
    const FEFaceValues<dim>                              &values,
    const FEFaceValues<dim>                              &of_points)
  {
    std::vector<double> dA;
    for (const unsigned int q : values.quadrature_point_indices())
      dA.push_back(values.JxW(q) * space.weight(values.quadrature_point(q)));
    area += std::accumulate(dA.begin(), dA.end(), 0.);
    cells.push_back(cell->active_cell_index());
    for (unsigned int point = 0; point < space.quadrature.size(); ++point)
      {
        area_vectors.emplace_back();
        for (unsigned int q = 0; q < dA.size(); ++q)
          area_vectors.back() +=
            of_points.shape_value(point, q) * dA[q] * values.normal_vector(q);
      }
    std::vector<types::global_dof_index> of_cell(space.fe.n_dofs_per_cell());
    cell->get_dof_indices(of_cell);
    for (unsigned int i = 0; i < of_cell.size(); ++i)
      if (space.fe.has_support_on_face(i, f))
        {
          dofs.push_back(of_cell[i]);
          component.push_back(space.fe.system_to_component_index(i).first);
          weight.push_back(0.);
          for (unsigned int q = 0; q < dA.size(); ++q)
            weight.back() += values.shape_value(i, q) * dA[q];
        }
  }

  template <int dim>
  auto
  Probes<dim>::columns_of_surface(const std::string &name,
                                  const Surface     &surface,
                                  const VectorType  &displacement,
                                  const VectorType  *velocity) -> Line
  {
    std::array<double, 3 * dim + 1> sums{};
    sums[3 * dim] = surface.area;
    for (unsigned int i = 0; i < surface.dofs.size(); ++i)
      {
        const double w = surface.weight[i];
        sums[surface.component[i]] += w * displacement(surface.dofs[i]);
        if (velocity != nullptr)
          sums[dim + surface.component[i]] += w * (*velocity)(surface.dofs[i]);
      }
    if (wants("stress"))
      {
        std::vector<PointState> states;
        model.mechanics->point_states(displacement, surface.cells, states);
        for (std::size_t i = 0; i < states.size(); ++i)
          {
            SymmetricTensor<2, 3> stress;
            for (unsigned int e = 0; e < 6; ++e)
              stress.access_raw_entry(e) =
                states[i].values[PointState::stress + e];
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int b = 0; b < dim; ++b)
                sums[2 * dim + a] += stress[a][b] * surface.area_vectors[i][b];
          }
      }
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        model.communicator,
                        ArrayView<double>(sums.data(), sums.size()));
    Line       line;
    const auto add = [&](const std::string &quantity, const unsigned int from) {
      for (unsigned int d = 0; d < dim; ++d)
        line.emplace_back(quantity + " " + axes[d] + " at " + name,
                          sums[from + d] / sums[3 * dim]);
    };
    if (wants("displacement"))
      add("displacement", 0);
    if (velocity != nullptr && wants("velocity"))
      add("velocity", dim);
    if (wants("stress"))
      add("traction", 2 * dim);
    return line;
  }

  template <int dim>
  auto
  Probes<dim>::columns_of_points(const VectorType &displacement,
                                 const VectorType *velocity) -> Line
  {
    const auto values =
      points->evaluate(displacement, velocity, !quantities.empty());
    const auto at = [](const unsigned int point) {
      return " at probe " + std::to_string(point + 1);
    };
    Line       line;
    const auto add = [&](const std::string &quantity, const auto &of_points) {
      for (unsigned int i = 0; wants(quantity) && i < of_points.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          line.emplace_back(quantity + " " + axes[d] + at(i), of_points[i][d]);
    };
    add("displacement", values.displacement);
    add("velocity", values.velocity);
    for (unsigned int t = 0; t < values.states.size(); ++t)
      {
        const auto &target = model.probe_points->targets[t];
        for (const auto &quantity : quantities)
          line.emplace_back(quantity.name + at(target.point) +
                              (target.material == numbers::invalid_material_id ?
                                 "" :
                                 " in " + material_name(target.material)),
                            quantity.value(values.states[t]));
      }
    return line;
  }

  template <int dim>
  void
  Probes<dim>::add_columns(Line             &line,
                           const VectorType &displacement,
                           const VectorType *velocity)
  {
    const GhostValues ghosts(displacement),
      of_velocity(velocity != nullptr ? *velocity : displacement);
    const auto append = [&](const Line &columns) {
      line.insert(line.end(), columns.begin(), columns.end());
    };
    if (points)
      append(columns_of_points(displacement, velocity));
    update_surfaces();
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      append(columns_of_surface(
        model.probe_surfaces[s].first, surfaces[s], displacement, velocity));
  }

  template <int dim>
  std::string
  Probes<dim>::file(const unsigned int line, const std::string &ending)
  {
    return "line-" + std::to_string(line + 1) + ending;
  }

  template <int dim>
  std::string
  Probes<dim>::file_names() const
  {
    std::string names;
    for (unsigned int l = 0; l < model.probe_lines.size(); ++l)
      names += "|" + file(l, "\\.(csv|gp|png)");
    return names;
  }

  template <int dim>
  std::string
  Probes<dim>::write_lines(const double      time,
                           const VectorType &displacement,
                           const VectorType *velocity)
  {
    const GhostValues ghosts(displacement),
      of_velocity(velocity != nullptr ? *velocity : displacement);
    const bool      with_materials = model.materials.size() > 1;
    CSVTable::Names names          = {"time", "distance"};
    for (const char *quantity : {"displacement", "velocity"})
      if (quantity[0] == 'd' || velocity != nullptr)
        for (unsigned int d = 0; d < dim; ++d)
          names.push_back(quantity + (" " + axes[d]));
    for (const auto &quantity : line_quantities)
      names.push_back(quantity.name);
    if (with_materials)
      names.push_back("material id");

    std::string changes;
    for (unsigned int l = 0; l < lines.size(); ++l)
      {
        const auto &line   = model.probe_lines[l];
        const auto  at     = line.points();
        const auto  values = lines[l]->evaluate(displacement, velocity, true);
        std::vector<CSVTable::Row> rows;
        for (unsigned int t = 0; t < values.states.size(); ++t)
          {
            const auto   &target = line.places->targets[t];
            CSVTable::Row row    = {time, at[target.point].distance(line.from)};
            for (const auto *field : {&values.displacement, &values.velocity})
              for (unsigned int d = 0; !field->empty() && d < dim; ++d)
                row.push_back((*field)[target.point][d]);
            for (const auto &quantity : line_quantities)
              row.push_back(quantity.value(values.states[t]));
            if (with_materials)
              row.push_back(line.places->material(t));
            rows.push_back(row);
          }
        directory.enter({file(l, ".csv")});
        changes += tables[l].append(names, rows, true);
      }
    ++n_samples;
    return changes;
  }

  template <int dim>
  bool
  Probes<dim>::draw_lines() const
  {
    bool drawn = true;
    for (unsigned int l = 0; l < model.probe_lines.size(); ++l)
      {
        const auto          &line  = model.probe_lines[l];
        const Tensor<1, dim> way   = line.to - line.from;
        unsigned int         along = 0;
        for (unsigned int d = 1; d < dim; ++d)
          if (std::abs(way[d]) > std::abs(way[along]))
            along = d;
        const unsigned int first = 3 + along, n_fields = model.is_dynamic ?
                                                           2 * dim :
                                                           (unsigned int)(dim);
        const std::string  data =
          "'line-" + std::to_string(l + 1) + ".csv' skip 1 using ";
        const auto panel = [&](const std::string &name,
                               const unsigned int column) {
          const std::string c = std::to_string(column);
          return "stats " + data + c +
                 " nooutput\n"
                 "m = abs(STATS_min) > abs(STATS_max) ? abs(STATS_min) : "
                 "abs(STATS_max)\n"
                 "if (m > 0) set cbrange [-m:m]\n"
                 "set title '" +
                 name + "'\nsplot " + data + "2:1:" + c + " notitle\n";
        };
        write_file(
          model.communicator,
          directory.path_of(file(l, ".gp")),
          "# gnuplot line-" + std::to_string(l + 1) +
            ".gp: place to the right, time upwards\n"
            "set terminal png truecolor size 1150,480 font 'sans,11'\n"
            "set output 'line-" +
            std::to_string(l + 1) +
            ".png'\nset datafile separator ','\n"
            "set xlabel 'distance (m)'\nset ylabel 't (s)' offset 1\n"
            "set palette defined (-1 '#2166ac', 0 '#f7f7f7', 1 '#b2182b')\n"
            "set pm3d map corners2color c1\n"
            "set autoscale xfix\nset autoscale yfix\n"
            "set multiplot layout 1,2\n" +
            panel((model.is_dynamic ? "velocity " : "displacement ") +
                    axes[along] + (model.is_dynamic ? " (m/s)" : " (m)"),
                  model.is_dynamic ? first + dim : first) +
            panel("stress " + entries[along] + " (Pa)", 3 + n_fields + along) +
            "unset multiplot\n");
        directory.enter({file(l, ".png")});
        if (Utilities::MPI::this_mpi_process(model.communicator) != 0)
          continue;
        drawn = drawn && run_gnuplot(directory.path,
                                     "line-" + std::to_string(l + 1) + ".gp");
      }
    return drawn;
  }

  template <int dim>
  std::vector<std::pair<std::string, double>>
  Probes<dim>::place(const unsigned int l) const
  {
    const auto       &line = model.probe_lines[l];
    const std::string of   = " of line " + std::to_string(l + 1);
    std::vector<std::pair<std::string, double>> numbers = {
      {"number of points" + of, line.n_points}};
    for (unsigned int d = 0; d < dim; ++d)
      {
        numbers.emplace_back("begin " + axes[d] + of, line.from[d]);
        numbers.emplace_back("end " + axes[d] + of, line.to[d]);
      }
    return numbers;
  }

  template <int dim>
  void
  Probes<dim>::save(Checkpoint<dim> &checkpoint) const
  {
    checkpoint.set("samples of lines", n_samples);
    for (unsigned int l = 0; l < model.probe_lines.size(); ++l)
      for (const auto &[name, value] : place(l))
        checkpoint.set(name, value);
  }

  template <int dim>
  void
  Probes<dim>::resume(const Checkpoint<dim> &checkpoint)
  {
    n_samples = checkpoint.number("samples of lines");
    for (unsigned int l = 0; l < tables.size(); ++l)
      {
        const auto now = place(l);
        // a line that is new begins a file
        if (!checkpoint.names(now[0].first).empty())
          for (const auto &[name, value] : now)
            if (std::abs(checkpoint.number(name) - value) >
                1e-9 * std::abs(value))
              throw UserError(model.file.where({"Output"}, "Probe lines"),
                              "another " + name + " than before the restart",
                              "the lines of before; new ones follow them",
                              "add lines at the end of the list");
        tables[l].resume(n_samples, false);
      }
  }

  template class Probes<2>;
  template class Probes<3>;
} // namespace Signoton
