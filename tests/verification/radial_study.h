#ifndef signoton_tests_radial_study_h
#define signoton_tests_radial_study_h

#include "verification.h"

namespace Verification
{
  /** Exact numbers of a thick sphere or ring between radii @p a and @p b. */
  struct RadialSolution
  {
    double a, b;
    double u_a, u_b;
    /** Radius of the zone that is not elastic; @p a without one. */
    double                                      c;
    std::vector<std::pair<std::string, double>> constants;
    /** The radius c to which a displacement u(b) of the outer surface belongs:
     *  the elastic zone depends on nothing else. May be empty. */
    std::function<double(double)> radius_of = {};
  };

  /**
   * The convergence of a scene with the displacements at the inner and outer
   * surface as first and second probe, x along the radius. The radius c
   * follows from the volume of the zone that is not elastic,
   * $(c^d-a^d)/(b^d-a^d)$ of the whole, as the quadrature points see it; they
   * are h/(degree + 1) apart, which is as sharp as c can be.
   *
   * Where the outer zone is elastic, c also follows from the displacement of
   * its outer surface, and this radius converges with it.
   *
   * The second derivative of the displacement jumps at c. If c is on a mesh
   * line the order is degree + 1; else the error depends on where c cuts its
   * cells, falls with order 2 on the whole, and the order from one mesh to the
   * next is anything around it.
   */
  class RadialStudy
  {
  public:
    std::string scene;
    Overrides   overrides;
    /** Dimension of space: 3 for a sphere, 2 for a ring. */
    unsigned int space_dimension = 3;
    /** Edge of the coarse cells along the radius. */
    double coarse_edge = 1.;
    /** Coarsest and finest level for each degree. */
    std::array<std::pair<unsigned int, unsigned int>, 2> levels;
    std::vector<unsigned int>                            degrees = {1, 2};
    /** Requirements on the finest mesh. */
    std::array<double, 2> allowed_error = {{1e-3, 1e-3}};
    /** Over all meshes. */
    std::array<double, 2> expected_order = {{1.5, 1.2}};

    void
    operator()(Report               &report,
               const std::string    &title,
               const RadialSolution &exact) const
    {
      for (const unsigned int p : degrees)
        {
          Convergence study;
          report.out << title << ", degree " << p
                     << ": u(a) = " << std::scientific << std::setprecision(8)
                     << exact.u_a << ", u(b) = " << exact.u_b;
          if (exact.c > exact.a)
            report.out << std::fixed << ", c = " << exact.c;
          report.out << std::endl;
          const auto [first, last] = levels[p - 1];
          for (unsigned int level = first; level <= last; ++level)
            add_level(report, title, exact, p, level, level == last, study);
          study.print(report.out);
          report.require(title + ", L2 error",
                         study.last_error(),
                         allowed_error[p - 1]);
          report.require_order(title,
                               study.order(last - first),
                               expected_order[p - 1]);
        }
    }

  private:
    double
    radius(const double share, const RadialSolution &exact) const
    {
      const double d = space_dimension;
      return std::pow(std::pow(exact.a, d) +
                        share * (std::pow(exact.b, d) - std::pow(exact.a, d)),
                      1. / d);
    }

    void
    add_level(Report               &report,
              const std::string    &title,
              const RadialSolution &exact,
              const unsigned int    p,
              const unsigned int    level,
              const bool            is_last,
              Convergence          &study) const
    {
      Overrides all(overrides);
      all.push_back(refinement(level));
      all.push_back(degree(p));
      if (!exact.constants.empty())
        all.push_back(constants(exact.constants));
      const auto line = run(scene, all).back();
      study.add(line);
      // relative to the larger of both displacements
      const double size = std::max(std::abs(exact.u_a), std::abs(exact.u_b));
      const double error_a =
        (value(line, "displacement x at probe 1") - exact.u_a) / size;
      const double u_b     = value(line, "displacement x at probe 2");
      const double error_b = (u_b - exact.u_b) / size;
      study.add_error("error of u(a)", error_a);
      study.add_error("error of u(b)", error_b);
      if (exact.radius_of)
        study.add_error("error of c", exact.radius_of(u_b) / exact.c - 1.);
      const double c = radius(1. - value(line, "share of interior"), exact);
      if (exact.c > exact.a)
        study.add_number("c", c, 4);
      if (is_last)
        {
          const double h = coarse_edge / std::pow(2., level);
          report.require(title + ", radius c", c - exact.c, 1.25 * h / (p + 1));
          report.require(title + ", u(a)", error_a, allowed_error[p - 1]);
          report.require(title + ", u(b)", error_b, allowed_error[p - 1]);
          if (exact.radius_of)
            report.require(title + ", radius c from u(b)",
                           exact.radius_of(u_b) / exact.c - 1.,
                           allowed_error[p - 1]);
        }
    }
  };
} // namespace Verification

#endif
