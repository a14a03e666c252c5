#ifndef signoton_tests_rheology_common_h
#define signoton_tests_rheology_common_h

#include <signoton/rheology/laws.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <random>
#include <string>
#include <vector>

namespace Signoton::Testing
{
  using namespace Rheology;

  /** Random numbers that are the same everywhere: the standard fixes the
   *  integers of the engine, but not the algorithms of its distributions. */
  class Random
  {
  public:
    explicit Random(const std::uint64_t seed)
      : engine(seed)
    {}

    double
    uniform(const double from = -1., const double to = 1.)
    {
      return from + (to - from) * std::ldexp(double(engine() >> 11), -53);
    }

    unsigned int
    below(const unsigned int n)
    {
      return engine() % n;
    }

    /** Logarithmically uniform between two powers of ten. */
    double
    power_of_ten(const double from, const double to)
    {
      return std::pow(10., uniform(from, to));
    }

    Tensor2<>
    tensor()
    {
      Tensor2<> t;
      for (unsigned int c = 0; c < Tensor2<>::n_independent_components; ++c)
        t.access_raw_entry(c) = uniform();
      return t;
    }

    /** From a unit quaternion, uniform over all rotations. */
    Tensor<2, 3>
    rotation()
    {
      double q[4], norm;
      do
        {
          norm = 0.;
          for (double &x : q)
            {
              x = uniform();
              norm += x * x;
            }
      } while (norm > 1. || norm < 1e-2);
      for (double &x : q)
        x /= std::sqrt(norm);
      Tensor<2, 3> r;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
          r[i][i] = 1. - 2. * (q[j] * q[j] + q[k] * q[k]);
          r[i][j] = 2. * (q[i] * q[j] - q[k] * q[3]);
          r[j][i] = 2. * (q[i] * q[j] + q[k] * q[3]);
        }
      return r;
    }

  private:
    std::mt19937_64 engine;
  };

  inline Tensor2<>
  diagonal(const double a, const double b, const double c)
  {
    Tensor2<> t;
    t[0][0] = a;
    t[1][1] = b;
    t[2][2] = c;
    return t;
  }

  inline Tensor2<>
  rotate(const Tensor<2, 3> &r, const Tensor2<> &t)
  {
    return symmetrize(r * Tensor<2, 3>(t) * transpose(r));
  }

  /** Unit tensor number `c` of an orthonormal basis. */
  inline Tensor2<>
  basis(const unsigned int c)
  {
    Tensor2<> e;
    e.access_raw_entry(c) = c < 3 ? 1. : std::sqrt(.5);
    return e;
  }

  struct NamedLaw
  {
    std::string name;
    Law         law;
  };

  /** Every alternative of Law, with the binders and strengths that change its
   *  formulas; stresses of order one. */
  inline std::vector<NamedLaw>
  all_laws()
  {
    const Moduli spring{1.5, .7}, none{0., 0.}, proportional{.375, .175},
      own{.2, .5};
    const double degree = numbers::PI / 180.;

    const MisesSchleicherCone cone(.5, 0.), cohesive(.5, .1), cut(.5, 0., .4),
      cohesive_cut(.5, .1, .4), steep(1.2, 0.);
    const auto coulomb          = PrincipalSet::coulomb_mohr(30. * degree, 0.);
    const auto cohesive_coulomb = PrincipalSet::coulomb_mohr(30. * degree, .1);
    const auto no_tension       = PrincipalSet::no_tension(.05);
    const auto tresca           = PrincipalSet::tresca(.3);

    const VonMisesCylinder<false> mises(.3);
    const VonMisesCylinder<true>  hardening(.3, .25);

    using ContactMS = SpringAndProjection<MisesSchleicherCone, Memory::none>;
    using ContactCM = SpringAndProjection<PrincipalSet, Memory::none>;
    using Cut     = SpringAndProjection<MisesSchleicherCone, Memory::cylinder>;
    using Plastic = SpringAndProjection<VonMisesCylinder<false>, Memory::all>;
    using Hardening  = SpringAndProjection<VonMisesCylinder<true>, Memory::all>;
    using PlasticMS  = SpringAndProjection<MisesSchleicherCone, Memory::all>;
    using PlasticSet = SpringAndProjection<PrincipalSet, Memory::all>;
    using ConditionalMS =
      ConditionalPlasticity<VonMisesCylinder<false>, MisesSchleicherCone>;
    using ConditionalSet =
      ConditionalPlasticity<VonMisesCylinder<false>, PrincipalSet>;

    return {
      {"elastic", Elastic(spring)},
      {"MS contact", ContactMS(spring, none, cone)},
      {"MS contact, steep", ContactMS(spring, none, steep)},
      {"MS contact, binder", ContactMS(spring, proportional, cone)},
      {"MS contact, own binder", ContactMS(spring, own, cohesive)},
      {"Coulomb contact", ContactCM(spring, none, coulomb)},
      {"Coulomb contact, binder", ContactCM(spring, proportional, coulomb)},
      {"Coulomb contact, own binder", ContactCM(spring, own, cohesive_coulomb)},
      {"no tension", ContactCM(spring, none, no_tension)},
      {"no tension, own binder", ContactCM(spring, own, no_tension)},
      {"MS contact and cylinder", Cut(spring, none, cut)},
      {"MS contact and cylinder, own binder", Cut(spring, own, cohesive_cut)},
      {"von Mises", Plastic(spring, none, mises)},
      {"von Mises, kinematic", Plastic(spring, own, mises)},
      {"von Mises, isotropic", Hardening(spring, none, hardening)},
      {"von Mises, mixed", Hardening(spring, own, hardening)},
      {"MS plastic", PlasticMS(spring, none, cohesive)},
      {"MS plastic, cut", PlasticMS(spring, none, cohesive_cut)},
      {"MS plastic, kinematic", PlasticMS(spring, own, cohesive)},
      {"Coulomb plastic", PlasticSet(spring, none, cohesive_coulomb)},
      {"Coulomb plastic, kinematic", PlasticSet(spring, own, cohesive_coulomb)},
      {"Tresca", PlasticSet(spring, none, tresca)},
      {"Tresca, kinematic", PlasticSet(spring, own, tresca)},
      {"conditional MS", ConditionalMS(spring, none, mises, cone)},
      {"conditional Coulomb", ConditionalSet(spring, own, mises, coulomb)},
    };
  }

  /** Whether check(name, law) holds for each of all_laws(); all are tried.
   *  @tparam any false: only laws with a potential */
  template <bool any = true, typename Check>
  bool
  for_all_laws(const Check &check)
  {
    bool passed = true;
    for (const auto &entry : all_laws())
      passed &= std::visit(
        [&](const auto &law) {
          using ThisLaw = std::decay_t<decltype(law)>;
          if constexpr (std::is_same_v<ThisLaw, General>)
            return false; // has tests of its own
          else if constexpr (!any && !ThisLaw::has_potential)
            return true; // so do these
          else
            return check(entry.name, law);
        },
        entry.law);
    return passed;
  }

  template <typename Law, typename Number = double>
  History<Law, Number>
  virgin()
  {
    History<Law, Number> history;
    for (auto &tensor : history.tensors)
      tensor = Tensor2<Number>();
    for (auto &scalar : history.scalars)
      scalar = 0.;
    return history;
  }

  /** A step of a law from `accepted` on; `history` receives what a driver
   *  would accept. */
  template <typename Law>
  struct Step
  {
    Step(const Law                  &law,
         const Tensor2<>            &strain,
         const History<Law, double> &accepted)
      : history(make_history<double>(law))
    {
      law.template update<all>(strain, accepted, history, response);
    }

    History<Law, double> history;
    Response<double>     response;
  };

  /** The history after a random step beyond yield. */
  template <typename Law>
  History<Law, double>
  random_history(const Law &law, Random &random)
  {
    return Step<Law>(law, 1.5 * random.tensor(), virgin<Law>()).history;
  }

  /** A residual that is compared with a bound: only the verdict is printed,
   *  the number depends on the machine. */
  class Worst
  {
  public:
    explicit Worst(const double bound)
      : bound(bound)
    {}

    void
    add(const double residual)
    {
      // not std::max(): a residual that is not a number must fail
      if (!(residual <= worst))
        worst = residual;
    }

    bool
    passed() const
    {
      return worst <= bound;
    }

    const char *
    verdict() const
    {
      if (passed())
        return "ok";
      std::cerr << "residual " << worst << " above " << bound << std::endl;
      return "FAILED";
    }

  private:
    double bound;
    double worst = 0.;
  };

  /** Marks which regions were seen, one letter each, a dot where not. */
  class Regions
  {
  public:
    void
    add(const double region)
    {
      seen[static_cast<unsigned int>(region)] = true;
    }

    std::string
    marks() const
    {
      std::string text;
      for (unsigned int r = 0; r < n_regions; ++r)
        text += seen[r] ? "ifcevyk"[r] : '.';
      return text;
    }

  private:
    std::array<bool, n_regions> seen{};
  };

  /** What the letters of Regions mean. */
  inline void
  print_legend()
  {
    std::cout << "regions: i interior, f face, c compression edge, "
                 "e extension edge,\n         v vertex, y cylinder, k corner\n";
  }
} // namespace Signoton::Testing

#endif
