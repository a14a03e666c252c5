#include <signoton/base/number.h>
#include <signoton/drivers/run_checks.h>

#include <algorithm>
#include <cmath>

namespace Signoton
{
  void
  OutputParameters::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection("Output");
    handler.add_parameter("Directory",
                          directory,
                          "Where results go; empty: output/ and the name of "
                          "the scene.");
    handler.add_parameter("Nodal stress",
                          nodal_stress,
                          "Write the stress at nodes beside its averages over "
                          "cells: better at surfaces, and about as many "
                          "numbers again.");
    handler.add_parameter("Checkpoint every",
                          checkpoint_every,
                          "Write a checkpoint every n-th step and after the "
                          "last; 0: never.",
                          Patterns::Integer(0));
    handler.add_parameter("Probe points",
                          probe_text,
                          "Points with columns in the statistics: 'x, y; x, y' "
                          "in 2D.");
    handler.add_parameter("Probe surfaces",
                          surface_text,
                          "Boundaries with columns in the statistics, by name: "
                          "means of displacement, velocity and, for stress, "
                          "traction. 'top, plate'; names with a ',' in double "
                          "quotes.");
    handler.add_parameter(
      "Probe quantities",
      probe_quantities,
      "Columns of points and surfaces (of these displacement, velocity and, "
      "for "
      "stress, traction); lines have displacement, velocity and stress in any "
      "case. On an interface there is a column for each material, 'stress xx "
      "at probe 1 in sand', and in lines a row for each. Strain is what the "
      "material sees, with the initial one; "
      "principal stresses begin with the largest, tension is positive; region "
      "is a number, see README.",
      Patterns::MultipleSelection(
        "displacement|velocity|stress|strain|contact strain|plastic strain|"
        "principal stress|pressure|shear intensity|energy density|region"));
    handler.add_parameter("Probe lines",
                          transect_text,
                          "Lines with files of their own, and pictures over "
                          "place and time: 'from : to : number of points; "
                          "...', for instance '0, 0 : 1, 0 : 200'.");
    handler.leave_subsection();
  }
} // namespace Signoton
