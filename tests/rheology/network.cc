// The local solver for any scheme: the closed forms where there are some, and
// random trees, where every step has to converge, to balance its energies and
// to have the tangent and the stress of its potential.

#include "common.h"
#include "verdicts.h"

#include <signoton/rheology/network.h>

#include <sstream>

using namespace Signoton;
using namespace Signoton::Testing;

namespace
{
  /** Largest difference of stress and tangent along a random path. */
  template <typename Law>
  double
  difference(const Law &law, const std::string &scheme)
  {
    Network network(parse_scheme(scheme, "test"));
    network.set_time_step(1.);
    std::vector<Vector6> tensors(network.n_tensors(), Vector6{});
    std::vector<double>  scalars(network.n_scalars(), 0.);
    History<Law, double> accepted{}, trial{};
    Response<double>     response;
    Random               random(3);
    double               worst = 0.;
    for (unsigned int path = 0; path < 200; ++path)
      {
        std::fill(tensors.begin(), tensors.end(), Vector6{});
        std::fill(scalars.begin(), scalars.end(), 0.);
        accepted = {};
        Tensor2<> strain;
        for (unsigned int step = 0; step < 5; ++step)
          {
            strain += random.power_of_ten(-2., 0.5) * random.tensor();
            law.template update<all>(strain, accepted, trial, response);
            accepted = trial;
            const auto &found =
              network.update(to_mandel(strain), tensors.data(), scalars.data());
            tensors = network.trial_tensors();
            scalars = network.trial_scalars();
            worst =
              std::max({worst,
                        (from_mandel(found.stress) - response.stress).norm(),
                        (from_mandel(found.tangent) - response.tangent).norm(),
                        std::abs(found.potential - response.potential),
                        std::abs(found.stored - response.stored_energy),
                        std::abs(found.dissipated - response.dissipation)});
          }
      }
    return worst;
  }

  /** Random schemes whose stress follows from the strain. */
  class Trees
  {
  public:
    /** @param decades range of the moduli, in powers of ten */
    explicit Trees(const double decades)
      : decades(decades)
    {}

    std::string
    next()
    {
      while (true)
        {
          const std::string text   = node(4, random.uniform() > -0.4);
          const Scheme      scheme = parse_scheme(text, "test");
          const auto        n      = n_elements(scheme);
          if (n >= 2 && n <= 12 && is_determined(scheme))
            return text;
        }
    }

    Random random{11};

  private:
    double
    modulus()
    {
      return random.power_of_ten(0., decades);
    }

    std::string
    element()
    {
      std::ostringstream text;
      const double       strength = modulus() * random.power_of_ten(-4., -1.);
      const double       cohesion = random.below(2) * strength;
      const double       friction = random.uniform(.2, 1.);
      const double       angle    = random.uniform(10., 40.);
      const unsigned int kind     = random.below(10);
      const unsigned int set      = random.below(5);
      if (kind < 3)
        text << "spring(bulk = " << modulus() << ", shear = " << modulus();
      else if (kind == 3)
        text << "damper(bulk viscosity = " << modulus()
             << ", shear viscosity = " << modulus();
      else
        {
          const bool hinge = kind < 7;
          text << (hinge ? "hinge(" : "contact(");
          if (set == 0)
            text << "mises schleicher, friction = " << friction
                 << ", cohesion = " << (hinge ? strength : cohesion);
          else if (set == 1)
            text << "coulomb mohr, friction angle = " << angle
                 << ", cohesion = " << (hinge ? strength : cohesion);
          else if (set == 2 && hinge)
            text << "tresca, strength = " << strength;
          else if (set == 3 && hinge)
            text << "von mises, strength = " << strength
                 << ", isotropic hardening = " << random.below(2) * modulus();
          else if (hinge)
            text << "hydrostatic, strength = " << strength;
          else if (set == 2)
            text << "no tension, tensile strength = " << cohesion;
          else
            text << "hydrostatic, "
                 << (random.below(2) == 0 ? "gap = " : "tensile strength = ")
                 << 1e-2 * cohesion;
        }
      return text.str() + ")";
    }

    std::string
    node(const unsigned int depth, const bool series)
    {
      if (depth == 0 || random.below(10) < 3)
        return element();
      std::string        text = series ? "series(" : "parallel(";
      const unsigned int n    = 2 + random.below(5) / 3;
      for (unsigned int i = 0; i < n; ++i)
        text += (i > 0 ? ", " : "") + node(depth - 1, !series);
      return text + ")";
    }

    static unsigned int
    n_elements(const Scheme &scheme)
    {
      unsigned int n = scheme.parts.empty() ? 1 : 0;
      for (const auto &one : scheme.parts)
        n += n_elements(one);
      return n;
    }

    /** Series: a part whose stress follows from its strain is enough. */
    static bool
    is_determined(const Scheme &scheme)
    {
      if (!scheme.is_group())
        return scheme.kind == Scheme::Kind::spring ||
               scheme.kind == Scheme::Kind::damper;
      return scheme.kind == Scheme::Kind::series ?
               std::any_of(scheme.parts.begin(),
                           scheme.parts.end(),
                           is_determined) :
               std::all_of(scheme.parts.begin(),
                           scheme.parts.end(),
                           is_determined);
    }

    double decades;
  };

  double
  norm(const Vector6 &v)
  {
    return std::sqrt(dot(v, v));
  }

  void
  random_trees(Verdicts &verdict, const double decades, const unsigned int n)
  {
    Trees                     trees(decades);
    Random                   &random = trees.random;
    std::vector<unsigned int> iterations;
    unsigned int              failed = 0;
    double       least_dissipation = 0., asymmetry = 0., negative = 0.;
    double       gradient = 0., tangent = 0.;
    unsigned int compared = 0, off = 0;
    for (unsigned int tree = 0; tree < n; ++tree)
      {
        Network network(parse_scheme(trees.next(), "test"));
        network.set_time_step(random.power_of_ten(-2., 2.));
        std::vector<Vector6> tensors(network.n_tensors(), Vector6{});
        std::vector<double>  scalars(network.n_scalars(), 0.);
        Vector6              strain{};
        for (unsigned int step = 0; step < 4; ++step)
          {
            const double size = random.power_of_ten(-4., -1.);
            Vector6      direction;
            for (unsigned int c = 0; c < 6; ++c)
              {
                strain[c] += size * random.uniform();
                direction[c] = random.uniform();
              }
            const auto found =
              network.update(strain, tensors.data(), scalars.data());
            const auto new_tensors = network.trial_tensors();
            const auto new_scalars = network.trial_scalars();
            iterations.push_back(found.iterations);
            if (!found.converged)
              {
                ++failed;
                continue;
              }
            // of the elastic solid, as there may be no stress at all
            const double stiffness = network.stiffness();
            least_dissipation =
              std::min(least_dissipation,
                       found.dissipated / (stiffness * dot(strain, strain)));
            const Vector6 along = found.tangent * direction;
            for (unsigned int a = 0; a < 6; ++a)
              for (unsigned int b = 0; b < a; ++b)
                asymmetry =
                  std::max(asymmetry,
                           std::abs(found.tangent(a, b) - found.tangent(b, a)) /
                             stiffness);
            negative = std::min(negative,
                                dot(direction, along) /
                                  (stiffness * dot(direction, direction)));

            // differences; a kink within their reach spoils some
            const double h   = 1e-6 * size;
            const auto there = network.update(add_scaled(strain, h, direction),
                                              tensors.data(),
                                              scalars.data(),
                                              false);
            const auto back  = network.update(add_scaled(strain, -h, direction),
                                             tensors.data(),
                                             scalars.data(),
                                             false);
            const Vector6 slope =
              scale(0.5 / h,
                    0.5 / h,
                    add_scaled(there.stress, -1., back.stress));
            const double miss = norm(add_scaled(slope, -1., along)) /
                                (stiffness * norm(direction));
            ++compared;
            if (miss > 1e-4)
              ++off;
            else
              tangent = std::max(tangent, miss);
            // The potential has the stress as its slope; the slope itself
            // changes along the difference, by the stiffness at most.
            const double length = 1e-3 * size * norm(direction);
            const double high =
              network
                .update(add_scaled(strain, 1e-3 * size, direction),
                        tensors.data(),
                        scalars.data(),
                        false)
                .potential;
            const double low =
              network
                .update(add_scaled(strain, -1e-3 * size, direction),
                        tensors.data(),
                        scalars.data(),
                        false)
                .potential;
            gradient = std::max(gradient,
                                std::abs((high - low) / (2. * length) -
                                         dot(found.stress, direction) /
                                           norm(direction)) /
                                  (stiffness * length));
            tensors  = new_tensors;
            scalars  = new_scalars;
          }
      }
    std::sort(iterations.begin(), iterations.end());
    std::cout << "moduli over " << decades << " decades: " << iterations.size()
              << " steps, " << failed << " failed, iterations: median "
              << iterations[iterations.size() / 2] << ", 99 % below "
              << iterations[iterations.size() * 99 / 100] << ", most "
              << iterations.back() << "; tangent " << tangent << ", " << off
              << " of " << compared << " at kinks, asymmetry " << asymmetry
              << ", gradient " << gradient << ", dissipation "
              << least_dissipation << ", negative " << negative << std::endl;
    const std::string name =
      std::to_string(static_cast<int>(decades)) + " decades: ";
    verdict(name + "converged", failed == 0);
    verdict(name + "at most 12 iterations in the median",
            iterations[iterations.size() / 2] <= 12);
    verdict(name + "no dissipation below zero", least_dissipation > -1e-10);
    verdict(name + "tangent symmetric", asymmetry < 1e-8);
    verdict(name + "tangent not negative", negative > -1e-8);
    verdict(name + "tangent by differences", off <= compared / 50);
    verdict(name + "stress by differences of the potential", gradient < 1.);
  }
} // namespace

int
main()
{
  Verdicts     verdict;
  const Moduli spring{1.5, .7}, none{0., 0.}, binder{.2, .5};
  const double degree = numbers::PI / 180.;
  const auto   compare =
    [&](const std::string &name, const auto &law, const std::string &scheme) {
      const double worst = difference(law, scheme);
      std::cout << name << ": " << worst << std::endl;
      verdict(name, worst < 1e-10);
    };
  const std::string s = "spring(bulk = 1.5, shear = 0.7)",
                    b = "spring(bulk = 0.2, shear = 0.5)";
  using ContactMS     = SpringAndProjection<MisesSchleicherCone, Memory::none>;
  using Contact       = SpringAndProjection<PrincipalSet, Memory::none>;
  using Cut       = SpringAndProjection<MisesSchleicherCone, Memory::cylinder>;
  using PlasticMS = SpringAndProjection<MisesSchleicherCone, Memory::all>;
  using Plastic   = SpringAndProjection<PrincipalSet, Memory::all>;
  using Mises     = SpringAndProjection<VonMisesCylinder<false>, Memory::all>;
  using Hardening = SpringAndProjection<VonMisesCylinder<true>, Memory::all>;
  compare("elastic", Elastic(spring), s);
  compare("contact, Mises-Schleicher",
          ContactMS(spring, none, MisesSchleicherCone(.5, .2)),
          "series(" + s +
            ", contact(mises schleicher, friction = 0.5, cohesion = 0.1))");
  compare("contact with binder, Mises-Schleicher",
          ContactMS(spring, binder, MisesSchleicherCone(.5, 0.)),
          "series(" + s + ", parallel(" + b +
            ", contact(mises schleicher, friction = 0.5)))");
  compare("contact with binder, Coulomb-Mohr",
          Contact(spring, binder, PrincipalSet::coulomb_mohr(30. * degree, 0.)),
          "series(" + s + ", parallel(" + b +
            ", contact(coulomb mohr, friction angle = 30)))");
  compare("contact, no tension",
          Contact(spring, none, PrincipalSet::no_tension(.05)),
          "series(contact(no tension, tensile strength = 0.05), " + s + ")");
  compare("hinge, von Mises",
          Mises(spring, none, VonMisesCylinder<false>(.3)),
          "series(" + s + ", hinge(von mises, strength = 0.3))");
  compare("hinge, von Mises, kinematic hardening",
          Mises(spring, binder, VonMisesCylinder<false>(.3)),
          "series(" + s + ", parallel(" + b +
            ", hinge(von mises, strength = 0.3)))");
  compare("hinge, von Mises, isotropic hardening",
          Hardening(spring, none, VonMisesCylinder<true>(.3, .25)),
          "series(" + s +
            ", hinge(von mises, strength = 0.3, isotropic hardening = 0.25))");
  compare("hinge, Tresca",
          Plastic(spring, none, PrincipalSet::tresca(.3)),
          "series(" + s + ", hinge(tresca, strength = 0.3))");
  compare("hinge, Mises-Schleicher",
          PlasticMS(spring, none, MisesSchleicherCone(.5, .2)),
          "series(" + s +
            ", hinge(mises schleicher, friction = 0.5, cohesion = 0.1))");
  compare("contact and hinge",
          Cut(spring, none, MisesSchleicherCone(.5, .2, .4)),
          "series(" + s +
            ", contact(mises schleicher, friction = 0.5, cohesion = 0.1), "
            "hinge(von mises, strength = 0.4))");
  random_trees(verdict, 1., 300);
  return verdict.status();
}
