// Where functions of time bend or jump is found to round-off, none is invented
// for smooth ones, and tables say what they are.

#include "verdicts.h"

#include <signoton/base/time_function.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>

using namespace Signoton;

namespace
{
  struct Expected
  {
    double time;
    bool   jumps;
  };

  /** Whether exactly the expected kinks are found between 0 and 2. */
  bool
  finds(const std::string           &text,
        const std::vector<Expected> &expected,
        const Constants             &constants = {{"T", 0.3}})
  {
    const TimeFunction function(text, constants, "test");
    TimesToMeet        times(0., 2.);
    times.add(function.kinks(0., 2.));
    bool   good = times.size() == expected.size();
    double time = 0.;
    for (std::size_t i = 0; good && i < expected.size(); ++i)
      {
        const double next = expected[i].time > 0. ? times.next(time) : 0.;
        good              = std::abs(next - expected[i].time) < 1e-14 &&
               (times.behind_jump(next) > next) == expected[i].jumps;
        time = next;
      }
    if (!good)
      {
        std::cout << text << ":";
        for (const Kink &kink : function.kinks(0., 2.))
          std::cout << " " << kink.before << (kink.jumps ? " (jump)" : "");
        std::cout << std::endl;
      }
    return good;
  }

  bool
  refuses(const std::string &text)
  {
    try
      {
        TimeFunction(text, {{"T", 0.3}}, "test");
      }
    catch (const UserError &)
      {
        return true;
      }
    return false;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  Verdicts                         verdict;

  verdict("turning points",
          finds("-0.05*if(t < 1, t, 2 - t)", {{1., false}}) &&
            finds("t < 1 ? t : 2 - t", {{1., false}}) &&
            finds("0.5 - abs(t - 1.25)", {{1.25, false}}) &&
            finds("min(t/T, 1)", {{.3, false}}) &&
            finds("max(0, min(t - 0.5, 1.5 - t))",
                  {{.5, false}, {1., false}, {1.5, false}}));
  verdict(
    "jumps",
    finds("1e5*(t < 1e-3)", {{1e-3, true}}) &&
      finds("1e5*(t <= 1e-3)", {{1e-3, true}}) &&
      finds("1e5*(T > t)", {{.3, true}}) &&
      finds("(t > 0.25 & t < 0.75) * 3", {{.25, true}, {.75, true}}) &&
      finds("(t > 0.25 && t < 0.75) * 3", {{.25, true}, {.75, true}}) &&
      finds("(t > 0.25) - (t > 0.75)", {{.25, true}, {.75, true}}) &&
      finds("sign(t - 0.7)", {{.7, true}}) &&
      finds("floor(2*t)", {{.5, true}, {1., true}, {1.5, true}, {2., true}}) &&
      finds("ceil(t)", {{0., true}, {1., true}}) &&
      finds("rint(t)", {{.5, true}, {1.5, true}}) &&
      finds("if(t < 1, if(t < 0.5, 1, 2), 3)", {{.5, true}, {1., true}}) &&
      finds("if(t, 1, 2)", {{.5, true}}));
  verdict("a jump at the start or the end is one, a kink there or anything "
          "outside not",
          finds("(t > 0)", {{0., true}}) && finds("(t < 2)", {{2., true}}) &&
            finds("abs(t)", {}) && finds("abs(t - 2)", {}) &&
            finds("(t > 5) + (t < -5)", {}));
  verdict(
    "saw teeth and square waves",
    finds("2*t - floor(2*t)",
          {{.5, true}, {1., true}, {1.5, true}, {2., true}}) &&
      finds("sin(2*pi*t) > 0",
            {{0., true}, {.5, true}, {1., true}, {1.5, true}},
            {{"pi", numbers::PI}}) &&
      TimeFunction("sign(sin(3000*t - 1))", {}, "test").kinks(0., 2.).size() ==
        1910);
  verdict("pulses much shorter than samples",
          finds("(t > 1) - (t > 1.0000001)", {{1., true}, {1.0000001, true}}) &&
            finds("abs(t - 0.7) < 1e-8",
                  {{.7 - 1e-8, true}, {.7, false}, {.7 + 1e-8, true}}) &&
            finds("max(0, 1 - ((t - 0.7) / 1e-6)^2)",
                  {{.7 - 1e-6, false}, {.7 + 1e-6, false}}));
  verdict("more than most_kinks",
          TimeFunction("sign(sin(1e6*t))", {}, "test").kinks(0., 2.).size() >
            most_kinks);
  verdict("smooth functions have none",
          finds("sin(30*t)*exp(-t)", {}) && finds("(t - 1)^2", {}) &&
            finds("exp(-((t - 1) / 1e-3)^2)", {}) && finds("T", {}) &&
            finds("if(T < 1, t, 0)", {}) && finds("tanh(1e3*(t - 1))", {}));

  SpaceTimeFunction<2> plane({"x*if(t < 1, t, 2 - t)", "(y < 3)*(t > 0.5)"},
                             {},
                             "test");
  const auto kinks = plane.kinks(0., 2., {Point<2>(.3, .7), Point<2>(.6, 5.)});
  verdict("in space and time: kinks in t alone",
          kinks.size() == 2 && std::abs(kinks[0].before - 1.) < 1e-14 &&
            !kinks[0].jumps && std::abs(kinks[1].before - .5) < 1e-14 &&
            kinks[1].jumps &&
            SpaceTimeFunction<2>({"max(0, t - x)"}, {}, "test")
              .kinks(0., 2., {Point<2>(.5, .5)})
              .empty());

  SpaceTimeFunction<3> table({"0", "0: 0, T: -6*T, 1: 0", "z*t"},
                             {{"T", 0.5}},
                             "test");
  table.set_time(0.75);
  verdict("a table as a component, its numbers by constants",
          std::abs(table.value(Point<3>(), 1) + 1.5) < 1e-15 &&
            std::abs(table.value(Point<3>(0, 0, 2), 2) - 1.5) < 1e-15 &&
            table.varies() &&
            finds("0: 0, T: 1, 1.5: 1", {{.3, false}, {1.5, false}}) &&
            TimeFunction("0: 1, 1: 5", {}, "test")(7.) == 5. &&
            TimeFunction("1: 3, 2: 5", {}, "test")(0.) == 3.);
  verdict("malformed tables are refused",
          refuses("0: 0, 1") && refuses("0: 0, 0: 1") &&
            refuses("1: 0, 0: 1") && refuses("0: 0, 1: a") && refuses("0: t") &&
            refuses("0: 0: 1") && refuses("0: 0, 1: inf") &&
            refuses("0:, 1: 2"));
  return verdict.status();
}
