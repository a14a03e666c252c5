#include <signoton/base/gnuplot.h>
#include <signoton/base/output_file.h>
#include <signoton/discretization/ghost_values.h>
#include <signoton/drivers/probes.h>

#include <deal.II/fe/fe_values.h>

#include <list>
#include <numeric>
#include <sstream>

namespace Signoton
{
  namespace
  {
    const std::array<std::string, 3> axes    = {{"x", "y", "z"}};
    const std::array<std::string, 6> entries = {
      {"xx", "yy", "zz", "xy", "xz", "yz"}};

    /** Transects have the stress in any case. */
    std::vector<std::string>
    of_transects(std::vector<std::string> wanted)
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
    , transect_quantities(point_quantities(of_transects(wanted), dim))
    , mesh_changes(model.space->mesh.signals.any_change.connect(
        [this] { surfaces_are_current = false; }))
  {
    if (model.probe_points)
      points = std::make_unique<PointValues<dim>>(*model.space,
                                                  *model.mechanics,
                                                  *model.probe_points);
    for (unsigned int l = 0; l < model.transects.size(); ++l)
      {
        transects.push_back(std::make_unique<PointValues<dim>>(
          *model.space, *model.mechanics, *model.transects[l].places));
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
  void
  Probes<dim>::add_surface(CSVTable::Row     &row,
                           const std::string &name,
                           const Surface     &surface,
                           const State       &state)
  {
    const unsigned int traction = dim * state.fields.size(),
                       area     = traction + dim;
    std::vector<double> sums(area + 1, 0.);
    sums[area] = surface.area;
    for (unsigned int f = 0; f < state.fields.size(); ++f)
      for (unsigned int i = 0; i < surface.dofs.size(); ++i)
        sums[dim * f + surface.component[i]] +=
          surface.weight[i] * (*state.fields[f].values)(surface.dofs[i]);
    if (wants("stress"))
      {
        std::vector<PointState> points;
        model.mechanics->point_states(state.displacement(),
                                      surface.cells,
                                      points);
        for (std::size_t i = 0; i < points.size(); ++i)
          {
            SymmetricTensor<2, 3> stress;
            for (unsigned int e = 0; e < 6; ++e)
              stress.access_raw_entry(e) =
                points[i].values[PointState::stress + e];
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int b = 0; b < dim; ++b)
                sums[traction + a] += stress[a][b] * surface.area_vectors[i][b];
          }
      }
    Utilities::MPI::sum(sums, model.communicator, sums);
    const auto add = [&](const std::string &quantity, const unsigned int from) {
      for (unsigned int d = 0; d < dim; ++d)
        row.emplace_back(quantity + " " + axes[d] + " at " + name,
                         sums[from + d] / sums[area]);
    };
    for (unsigned int f = 0; f < state.fields.size(); ++f)
      if (wants(state.fields[f].name))
        add(state.fields[f].name, dim * f);
    if (wants("stress"))
      add("traction", traction);
  }

  template <int dim>
  void
  Probes<dim>::add_points(CSVTable::Row &row, const State &state)
  {
    const auto values = points->evaluate(state, !quantities.empty());
    const auto at     = [](const unsigned int point) {
      return " at probe " + std::to_string(point + 1);
    };
    for (unsigned int f = 0; f < state.fields.size(); ++f)
      if (const std::string &name = state.fields[f].name; wants(name))
        for (unsigned int i = 0; i < values.nodal[f].size(); ++i)
          for (unsigned int d = 0; d < dim; ++d)
            row.emplace_back(name + " " + axes[d] + at(i),
                             values.nodal[f][i][d]);
    for (unsigned int t = 0; t < values.states.size(); ++t)
      {
        const auto &target = model.probe_points->targets[t];
        for (const auto &quantity : quantities)
          row.emplace_back(quantity.name + at(target.point) +
                             (target.material == numbers::invalid_material_id ?
                                "" :
                                " in " + material_name(target.material)),
                           quantity.value(values.states[t]));
      }
  }

  template <int dim>
  void
  Probes<dim>::add_columns(CSVTable::Row &row, const State &state)
  {
    std::list<GhostValues> ghosts;
    for (const State::Field &field : state.fields)
      ghosts.emplace_back(*field.values);
    if (points)
      add_points(row, state);
    update_surfaces();
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      add_surface(row, model.probe_surfaces[s].first, surfaces[s], state);
  }

  template <int dim>
  std::string
  Probes<dim>::file(const unsigned int transect, const std::string &ending)
  {
    return "line-" + std::to_string(transect + 1) + ending;
  }

  template <int dim>
  std::string
  Probes<dim>::file_names() const
  {
    std::string names;
    for (unsigned int l = 0; l < model.transects.size(); ++l)
      names += "|" + file(l, "\\.(csv|gp|png)");
    return names;
  }

  template <int dim>
  std::string
  Probes<dim>::write_transects(const State &state)
  {
    drawn_fields = state.fields;
    std::list<GhostValues> ghosts;
    for (const State::Field &field : state.fields)
      ghosts.emplace_back(*field.values);
    const bool      with_materials = model.materials.size() > 1;
    CSVTable::Names names          = {"time", "distance"};
    for (const State::Field &field : state.fields)
      for (unsigned int d = 0; d < dim; ++d)
        names.push_back(field.name + " " + axes[d]);
    for (const auto &quantity : transect_quantities)
      names.push_back(quantity.name);
    if (with_materials)
      names.push_back("material id");

    std::string changes;
    for (unsigned int l = 0; l < transects.size(); ++l)
      {
        const auto &transect = model.transects[l];
        const auto  at       = transect.points();
        const auto  values   = transects[l]->evaluate(state, true);
        std::vector<CSVTable::Numbers> rows;
        for (unsigned int t = 0; t < values.states.size(); ++t)
          {
            const auto       &target = transect.places->targets[t];
            CSVTable::Numbers row    = {state.time,
                                        at[target.point].distance(transect.from)};
            for (const auto &field : values.nodal)
              for (unsigned int d = 0; d < dim; ++d)
                row.push_back(field[target.point][d]);
            for (const auto &quantity : transect_quantities)
              row.push_back(quantity.value(values.states[t]));
            if (with_materials)
              row.push_back(transect.places->material(t));
            rows.push_back(row);
          }
        directory.enter({file(l, ".csv")});
        changes += tables[l].append(names, rows, true);
      }
    ++n_samples;
    return changes;
  }

  template <int dim>
  void
  Probes<dim>::write_script(const unsigned int l) const
  {
    const Tensor<1, dim> way = model.transects[l].to - model.transects[l].from;
    unsigned int         along = 0;
    for (unsigned int d = 1; d < dim; ++d)
      if (std::abs(way[d]) > std::abs(way[along]))
        along = d;
    // the last field says most: that of waves is the velocity
    const State::Field &field = drawn_fields.back();
    const unsigned int  first = 3, // behind time and distance
      n_nodal                 = dim * drawn_fields.size();
    const std::string name    = "line-" + std::to_string(l + 1);
    const auto        panel   = [&](const std::string &title,
                           const unsigned int column) {
      const std::string c    = std::to_string(column),
                        data = "'" + name + ".csv' skip 1 using ";
      return "stats " + data + c +
             " nooutput\n"
                      "m = abs(STATS_min) > abs(STATS_max) ? abs(STATS_min) : "
                      "abs(STATS_max)\n"
                      "if (m > 0) set cbrange [-m:m]\n"
                      "set title '" +
             title + "'\nsplot " + data + "2:1:" + c + " notitle\n";
    };
    write_file(
      model.communicator,
      directory.path_of(file(l, ".gp")),
      "# gnuplot " + name +
        ".gp: place to the right, time upwards\n"
        "set terminal png truecolor size 1150,480 font 'sans,11'\n"
        "set output '" +
        name +
        ".png'\nset datafile separator ','\n"
        "set xlabel 'distance (m)'\nset ylabel 't (s)' offset 1\n"
        "set palette defined (-1 '#2166ac', 0 '#f7f7f7', 1 '#b2182b')\n"
        "set pm3d map corners2color c1\n"
        "set autoscale xfix\nset autoscale yfix\n"
        "set multiplot layout 1,2\n" +
        panel(field.name + " " + axes[along] + " (" + field.unit + ")",
              first + n_nodal - dim + along) +
        panel("stress " + entries[along] + " (Pa)", first + n_nodal + along) +
        "unset multiplot\n");
  }

  template <int dim>
  bool
  Probes<dim>::draw_transects() const
  {
    bool drawn = true;
    for (unsigned int l = 0; l < model.transects.size(); ++l)
      if (!drawn_fields.empty())
        {
          write_script(l);
          directory.enter({file(l, ".png")});
          if (Utilities::MPI::this_mpi_process(model.communicator) == 0)
            drawn = drawn && run_gnuplot(directory.path, file(l, ".gp"));
        }
    return drawn;
  }

  template <int dim>
  CSVTable::Row
  Probes<dim>::place(const unsigned int l) const
  {
    const auto       &transect = model.transects[l];
    const std::string of       = " of line " + std::to_string(l + 1);
    CSVTable::Row     numbers  = {{"number of points" + of, transect.n_points}};
    for (unsigned int d = 0; d < dim; ++d)
      {
        numbers.emplace_back("begin " + axes[d] + of, transect.from[d]);
        numbers.emplace_back("end " + axes[d] + of, transect.to[d]);
      }
    return numbers;
  }

  template <int dim>
  void
  Probes<dim>::save(Checkpoint<dim> &checkpoint) const
  {
    checkpoint.set("samples of lines", n_samples);
    for (unsigned int l = 0; l < model.transects.size(); ++l)
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
