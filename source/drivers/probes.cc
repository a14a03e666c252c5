#include <signoton/base/gnuplot.h>
#include <signoton/base/output_file.h>
#include <signoton/drivers/probes.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/numerics/vector_tools_evaluate.h>

#include <sstream>

namespace Signoton
{
  namespace
  {
    const std::array<std::string, 3> axes    = {{"x", "y", "z"}};
    const std::array<std::string, 6> entries = {
      {"xx", "yy", "zz", "xy", "xz", "yz"}};

    template <int dim>
    constexpr unsigned int n_entries = dim == 2 ? 4 : 6;
  } // namespace

  template <int dim>
  Probes<dim>::Probes(Model<dim> &model, OutputDirectory &directory)
    : model(model)
    , directory(directory)
    , mesh_changes(model.space->mesh.signals.any_change.connect(
        [this] { is_current = false; }))
  {
    for (unsigned int l = 0; l < model.probe_lines.size(); ++l)
      tables.emplace_back(model.communicator,
                          directory.path + "/" + file(l, ".csv"));
  }

  template <int dim>
  bool
  Probes<dim>::wants(const std::string &quantity) const
  {
    return model.output.probe_quantities.find(quantity) != std::string::npos;
  }

  template <int dim>
  void
  Probes<dim>::update()
  {
    if (is_current)
      return;
    is_current        = true;
    const auto &space = *model.space;
    const auto  look  = [&](const std::vector<Point<dim>> &where) {
      auto search = std::make_unique<Search>();
      search->reinit(where, space.mesh, space.mapping);
      return search;
    };
    points = model.probes.empty() ? nullptr : look(model.probes);
    lines.clear();
    for (const auto &line : model.probe_lines)
      lines.push_back(look(line.points()));

    surfaces.assign(model.probe_surfaces.size(), Surface());
    const QGauss<dim - 1>                quadrature(space.degree + 1);
    FEFaceValues<dim>                    values(space.mapping,
                             space.fe,
                             quadrature,
                             update_values | update_quadrature_points |
                               update_normal_vectors | update_JxW_values);
    std::vector<types::global_dof_index> dofs(space.fe.n_dofs_per_cell());
    if (!surfaces.empty())
      for (const auto &cell : space.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary())
          for (const auto f : cell->face_indices())
            for (unsigned int s = 0; s < surfaces.size(); ++s)
              {
                if (!cell->face(f)->at_boundary() ||
                    cell->face(f)->boundary_id() !=
                      model.probe_surfaces[s].second)
                  continue;
                Surface &surface = surfaces[s];
                values.reinit(cell, f);
                cell->get_dof_indices(dofs);
                Tensor<1, dim> normal;
                for (const unsigned int q : values.quadrature_point_indices())
                  {
                    const double dA =
                      values.JxW(q) * space.weight(values.quadrature_point(q));
                    surface.area += dA;
                    normal += dA * values.normal_vector(q);
                  }
                surface.cells.emplace_back(cell->active_cell_index(), normal);
                for (unsigned int i = 0; i < dofs.size(); ++i)
                  {
                    if (!space.fe.has_support_on_face(i, f))
                      continue;
                    double weight = 0.;
                    for (const unsigned int q :
                         values.quadrature_point_indices())
                      weight += values.shape_value(i, q) * values.JxW(q) *
                                space.weight(values.quadrature_point(q));
                    surface.dofs.push_back(dofs[i]);
                    surface.component.push_back(
                      space.fe.system_to_component_index(i).first);
                    surface.weight.push_back(weight);
                  }
              }
  }

  template <int dim>
  auto
  Probes<dim>::evaluate(Search           &search,
                        const VectorType &displacement,
                        const VectorType *velocity,
                        const bool        with_stress) -> Values
  {
    const auto &space = *model.space;
    Values      result;
    const auto  nodal = [&](const VectorType &field) {
      VectorType u = space.make_relevant_vector();
      u.copy_locally_owned_data_from(field);
      u.update_ghost_values();
      return VectorTools::point_values<dim>(search, space.dof_handler, u);
    };
    result.displacement = nodal(displacement);
    if (velocity != nullptr)
      result.velocity = nodal(*velocity);
    if (!with_stress)
      return result;

    const auto index = [&](const std::pair<int, int> &cell) {
      return typename Triangulation<dim>::active_cell_iterator(&space.mesh,
                                                               cell.first,
                                                               cell.second)
        ->active_cell_index();
    };
    using Stress = Tensor<1, 6>;
    std::vector<Stress> found, buffer;
    std::vector<bool>   wanted(space.mesh.n_active_cells(), false);
    // the first pass only asks which cells they are
    search.template evaluate_and_process<Stress>(
      found, buffer, [&](const ArrayView<Stress> &, const auto &data) {
        for (const auto &cell : data.cells)
          wanted[index(cell)] = true;
      });
    const auto averages = model.mechanics->cell_averages(displacement, wanted);
    search.template evaluate_and_process<Stress>(
      found, buffer, [&](const ArrayView<Stress> &values, const auto &data) {
        for (unsigned int c = 0; c < data.cells.size(); ++c)
          for (unsigned int i = data.reference_point_ptrs[c];
               i < data.reference_point_ptrs[c + 1];
               ++i)
            for (unsigned int e = 0; e < 6; ++e)
              values[i][e] = averages[index(data.cells[c])].stress[e];
      });
    // a point on a face has two cells
    const auto &begin = search.get_point_ptrs();
    for (unsigned int p = 0; p + 1 < begin.size(); ++p)
      {
        result.stress.emplace_back();
        for (unsigned int i = begin[p]; i < begin[p + 1]; ++i)
          result.stress.back() += found[i] / (begin[p + 1] - begin[p]);
      }
    return result;
  }

  template <int dim>
  void
  Probes<dim>::add_surface(Line                            &line,
                           const std::string               &name,
                           const Surface                   &surface,
                           const VectorType                &displacement,
                           const VectorType                *velocity,
                           const std::vector<CellAverages> &averages) const
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
    if (!averages.empty())
      for (const auto &[cell, normal] : surface.cells)
        {
          SymmetricTensor<2, 3> stress;
          for (unsigned int e = 0; e < 6; ++e)
            stress.access_raw_entry(e) = averages[cell].stress[e];
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = 0; b < dim; ++b)
              sums[2 * dim + a] += stress[a][b] * normal[b];
        }
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        model.communicator,
                        ArrayView<double>(sums.data(), sums.size()));
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
  }

  template <int dim>
  void
  Probes<dim>::add_columns(Line             &line,
                           const VectorType &displacement,
                           const VectorType *velocity)
  {
    update();
    if (points)
      {
        const Values values =
          evaluate(*points, displacement, velocity, wants("stress"));
        const auto add = [&](const std::string &quantity,
                             const auto        &names,
                             const auto        &columns,
                             const unsigned int n) {
          for (unsigned int i = 0; i < columns.size(); ++i)
            for (unsigned int c = 0; c < n; ++c)
              line.emplace_back(quantity + " " + names[c] + " at probe " +
                                  std::to_string(i + 1),
                                columns[i][c]);
        };
        if (wants("displacement"))
          add("displacement", axes, values.displacement, dim);
        if (wants("velocity"))
          add("velocity", axes, values.velocity, dim);
        add("stress", entries, values.stress, n_entries<dim>);
      }
    if (surfaces.empty())
      return;
    const auto ghosted = [&](const VectorType &field) {
      VectorType u = model.space->make_relevant_vector();
      u.copy_locally_owned_data_from(field);
      u.update_ghost_values();
      return u;
    };
    const VectorType          u = ghosted(displacement);
    VectorType                v;
    std::vector<CellAverages> averages;
    if (velocity != nullptr)
      v = ghosted(*velocity);
    if (wants("stress"))
      {
        std::vector<bool> wanted(model.space->mesh.n_active_cells(), false);
        for (const auto &surface : surfaces)
          for (const auto &cell : surface.cells)
            wanted[cell.first] = true;
        averages = model.mechanics->cell_averages(displacement, wanted);
      }
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      add_surface(line,
                  model.probe_surfaces[s].first,
                  surfaces[s],
                  u,
                  velocity != nullptr ? &v : nullptr,
                  averages);
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
    update();
    CSVTable::Names names = {"time", "distance"};
    for (const char *quantity : {"displacement", "velocity"})
      if (quantity[0] == 'd' || velocity != nullptr)
        for (unsigned int d = 0; d < dim; ++d)
          names.push_back(quantity + (" " + axes[d]));
    for (unsigned int e = 0; e < n_entries<dim>; ++e)
      names.push_back("stress " + entries[e]);

    std::string changes;
    for (unsigned int l = 0; l < lines.size(); ++l)
      {
        const auto  &line   = model.probe_lines[l];
        const auto   at     = line.points();
        const Values values = evaluate(*lines[l], displacement, velocity, true);
        std::vector<CSVTable::Row> rows;
        for (unsigned int i = 0; i < at.size(); ++i)
          {
            CSVTable::Row row = {time, at[i].distance(line.from)};
            for (unsigned int d = 0; d < dim; ++d)
              row.push_back(values.displacement[i][d]);
            if (velocity != nullptr)
              for (unsigned int d = 0; d < dim; ++d)
                row.push_back(values.velocity[i][d]);
            for (unsigned int e = 0; e < n_entries<dim>; ++e)
              row.push_back(values.stress[i][e]);
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
