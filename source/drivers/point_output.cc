#include <signoton/base/gnuplot.h>
#include <signoton/base/output_file.h>
#include <signoton/base/scene_template.h>
#include <signoton/drivers/point.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

// The table and the diagram of a material point.

namespace Signoton
{
  using namespace Rheology;

  const std::vector<std::string> PointDriver::columns = {
    "time",         "strain xx",     "strain yy",     "strain zz",
    "strain xy",    "strain xz",     "strain yz",     "stress xx",
    "stress yy",    "stress zz",     "stress xy",     "stress xz",
    "stress yz",    "volume strain", "shear strain",  "mean stress",
    "shear stress", "work",          "stored energy", "dissipated energy",
    "iterations",   "region"};

  void
  PointDriver::record(const State &state)
  {
    const Vector6 counted = add_scaled(state.strain, -1., origin);
    strain_scale = std::max(strain_scale, std::sqrt(dot(counted, counted)));
    stress_scale =
      std::max(stress_scale, std::sqrt(dot(state.stress, state.stress)));
    const Tensor2<> strain = from_mandel(counted),
                    stress = from_mandel(state.stress);
    CSVTable::Numbers row  = {state.time};
    for (const Tensor2<> &tensor : {strain, stress})
      for (unsigned int c = 0; c < 6; ++c)
        row.push_back(tensor.access_raw_entry(c));
    row.insert(row.end(),
               {trace(strain),
                2. * shear_intensity(deviatoric_part(strain)),
                trace(stress) / 3.,
                shear_intensity(deviatoric_part(stress)),
                state.work,
                state.stored,
                state.dissipated,
                double(state.iterations),
                double(state.region)});
    rows.push_back(row);
  }

  bool
  PointDriver::write() const
  {
    CSVTable(communicator, results->path_of("point.csv")).append(columns, rows);
    return plot();
  }

  bool
  PointDriver::plot() const
  {
    const auto number = [](const std::string &column) {
      return std::to_string(std::find(columns.begin(), columns.end(), column) -
                            columns.begin() + 1);
    };
    const auto unit = [](const std::string &column) -> std::string {
      return column == "time"                           ? " (s)" :
             column.find("stress") != std::string::npos ? " (Pa)" :
             column.find("energy") != std::string::npos || column == "work" ?
                                                          " (J/m^3)" :
                                                          "";
    };
    results->enter({"point.svg"});
    write_file(communicator,
               results->path_of("point.gp"),
               "# gnuplot point.gp\n"
               "set terminal svg size 480,380 enhanced font 'sans,12' "
               "background 'white'\n"
               "set output 'point.svg'\n"
               "set datafile separator ','\n"
               "set title " +
                 gnuplot_string(title) + " noenhanced\nset xlabel " +
                 gnuplot_string(horizontal + unit(horizontal)) +
                 "\nset ylabel " + gnuplot_string(vertical + unit(vertical)) +
                 "\nset grid\nset zeroaxis lt -1\nunset key\n"
                 "set format '%g'\nset xtics rotate by -25 offset 0,-0.3\n"
                 "set offsets graph 0.03, graph 0.03, graph 0.03, graph 0.03\n"
                 "plot 'point.csv' skip 1 using " +
                 number(horizontal) + ":" + number(vertical) +
                 " with lines lw 2 lc rgb '#1f5fa8'\n");
    if (Utilities::MPI::this_mpi_process(communicator) != 0)
      return true;
    const bool drawn = run_gnuplot(results->path, "point.gp");
    if (!drawn)
      std::cout << "No picture: gnuplot is not there, or could not draw; "
                   "'gnuplot point.gp' in the directory of the results does "
                   "it.\n";
    return drawn;
  }

  void
  PointDriver::print_template(std::ostream &out)
  {
    SceneFile file;
    file.set({"Materials", "sand"}, "Rheology", "elastic plastic granular");
    file.set({"Materials", "sand"}, "Friction parameter", "0.5");
    file.set({"Materials", "sand"}, "Shear strength", "1e5");
    file.set({"Materials", "sand"}, "Bulk modulus", "1e8");
    file.set({"Materials", "sand"}, "Shear modulus", "6e7");
    file.set({"Program"}, "Kind", "triaxial");
    file.set({"Program"}, "Strain", "0: 0, 1: -5e-3, 2: -3e-3");
    file.set({"Program"}, "Confining pressure", "1e5");
    file.set({"Program"}, "End time", "2");
    PointDriver driver(MPI_COMM_SELF, file);
    Signoton::print_template(out, driver.handler, file);
  }
} // namespace Signoton
