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
    /** @param decades range of the moduli, in powers of ten; bulk and shear
     *    modulus of an element differ by a factor of 0.1 to 2
     *  @param seed of the random numbers */
    Trees(const double decades, const unsigned int seed)
      : random(seed)
      , decades(decades)
    {}

    std::string
    next()
    {
      time_step = random.power_of_ten(-2., 2.);
      while (true)
        {
          const std::string text   = node(4, random.uniform() > -0.4);
          const Scheme      scheme = parse_scheme(text, "test");
          const auto        n      = n_elements(scheme);
          if (n >= 2 && n <= 12 && is_determined(scheme))
            return text;
        }
    }

    Random random;
    /** For the tree made last. Dampers have moduli after division by it. */
    double time_step = 1.;

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
      const double       bulk     = modulus();
      const double       shear    = bulk * random.power_of_ten(-1., 0.3);
      if (kind < 3)
        text << "spring(bulk = " << bulk << ", shear = " << shear;
      else if (kind == 3)
        text << "damper(bulk viscosity = " << bulk * time_step
             << ", shear viscosity = " << shear * time_step;
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
            {
              text << "hydrostatic, ";
              if (random.below(2) == 0)
                text << "gap = " << random.power_of_ten(-4., -2.);
              else
                text << "tensile strength = " << cohesion;
            }
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

  /** What is found along the paths of many trees. */
  struct Findings
  {
    std::vector<unsigned int> iterations;
    unsigned int              failed = 0, compared = 0, at_kinks = 0;
    double residual = 0., dissipation = 0., loss = 0., balance = 0.,
           asymmetry = 0., negative = 0., tangent = 0., gradient = 0.;
  };

  /** Tangent and stress against differences of stress and potential. */
  void
  compare_with_differences(Network             &network,
                           const Network::Step &found,
                           const Vector6       &strain,
                           const double         size,
                           const Vector6       *tensors,
                           const double        *scalars,
                           const Vector6       &direction,
                           Findings            &findings)
  {
    const double  stiffness = network.stiffness(), length = norm(direction);
    const Vector6 along = found.tangent * direction;
    const auto    at    = [&](const double h) {
      return network.update(add_scaled(strain, h, direction),
                            tensors,
                            scalars,
                            false);
    };
    // rigid elements in parallel can be stiffer than what is around them
    double asymmetry = 0., largest = stiffness;
    for (unsigned int a = 0; a < 6; ++a)
      for (unsigned int b = 0; b < a; ++b)
        {
          asymmetry =
            std::max(asymmetry,
                     std::abs(found.tangent(a, b) - found.tangent(b, a)));
          largest = std::max(largest, std::abs(found.tangent(a, a)));
        }
    findings.asymmetry = std::max(findings.asymmetry, asymmetry / largest);
    findings.negative =
      std::min(findings.negative,
               dot(direction, along) / (stiffness * length * length));
    // a kink within the reach of the differences spoils some
    const double  h     = 1e-6 * size;
    const auto    there = at(h), back = at(-h);
    const Vector6 slope =
      scale(0.5 / h, 0.5 / h, add_scaled(there.stress, -1., back.stress));
    const double miss =
      norm(add_scaled(slope, -1., along)) / (stiffness * length);
    ++findings.compared;
    if (miss > 1e-4)
      ++findings.at_kinks;
    else
      findings.tangent = std::max(findings.tangent, miss);
    // the slope of the potential changes along the difference, by the
    // stiffness at most
    const double step = 1e-3 * size;
    const auto   up = at(step), down = at(-step);
    if (!up.converged || !down.converged) // no solution, nothing to compare
      return;
    const double slope_of_potential =
      (up.potential - down.potential) / (2. * step);
    findings.gradient =
      std::max(findings.gradient,
               std::abs(slope_of_potential - dot(found.stress, direction)) /
                 (stiffness * step * length * length +
                  2e-10 * found.scale / step));
  }

  Findings
  random_trees(const double decades, const unsigned int n)
  {
    Trees    trees(decades, 11);
    Random  &random = trees.random;
    Findings findings;
    for (unsigned int tree = 0; tree < n; ++tree)
      {
        Network network(parse_scheme(trees.next(), "test"));
        network.set_time_step(trees.time_step);
        std::vector<Vector6> tensors(network.n_tensors(), Vector6{});
        std::vector<double>  scalars(network.n_scalars(), 0.);
        Vector6              strain{};
        auto                 before = network.elements();
        double               stored = 0., scale_before = 0.;
        for (unsigned int step = 0; step < 4; ++step)
          {
            const double size = random.power_of_ten(-4., -1.);
            Vector6      direction, increment;
            for (unsigned int c = 0; c < 6; ++c)
              {
                increment[c] = size * random.uniform();
                direction[c] = random.uniform();
              }
            strain = add_scaled(strain, 1., increment);
            const Network::Step found =
              network.update(strain, tensors.data(), scalars.data());
            const auto new_tensors = network.trial_tensors();
            const auto new_scalars = network.trial_scalars();
            findings.iterations.push_back(found.iterations);
            if (!found.converged)
              {
                ++findings.failed;
                break;
              }
            findings.residual = std::max(findings.residual, found.residual);
            // differences of what is stored have the errors of both states
            const double energy = std::max(found.scale, scale_before);
            scale_before        = found.scale;
            findings.dissipation =
              std::min(findings.dissipation, found.dissipated / energy);

            // The power of the stress is that of all elements, and that is what
            // is stored and dissipated, and lost by the implicit rule.
            const auto after = network.elements();
            double     power = 0., lost = 0.;
            for (unsigned int i = 0; i < after.size(); ++i)
              {
                const Vector6 change =
                  add_scaled(after[i].strain, -1., before[i].strain);
                power += dot(after[i].stress, change);
                if (after[i].kind == Scheme::Kind::spring)
                  lost +=
                    0.5 *
                    dot(add_scaled(after[i].stress, -1., before[i].stress),
                        change);
              }
            const double work = dot(found.stress, increment);
            const double loss =
              work - (found.stored - stored) - found.dissipated;
            findings.balance =
              std::max(findings.balance, std::abs(work - power) / energy);
            findings.loss = std::min(findings.loss, (loss - lost) / energy);
            before        = after;
            stored        = found.stored;
            if (tree % 4 == 0)
              compare_with_differences(network,
                                       found,
                                       strain,
                                       size,
                                       tensors.data(),
                                       scalars.data(),
                                       direction,
                                       findings);
            tensors = new_tensors;
            scalars = new_scalars;
          }
      }
    std::sort(findings.iterations.begin(), findings.iterations.end());
    return findings;
  }

  void
  judge(Verdicts &verdict, const double decades, const unsigned int n)
  {
    const Findings f = random_trees(decades, n);
    const auto    &i = f.iterations;
    std::cout << "moduli over " << decades << " decades: " << i.size()
              << " steps, " << f.failed << " failed, iterations: median "
              << i[i.size() / 2] << ", 99 % up to " << i[i.size() * 99 / 100]
              << ", most " << i.back() << ", residual " << f.residual
              << "; tangent " << f.tangent << ", " << f.at_kinks << " of "
              << f.compared << " at kinks, asymmetry " << f.asymmetry
              << ", negative " << f.negative << ", gradient " << f.gradient
              << ", dissipation " << f.dissipation << ", balance " << f.balance
              << ", loss " << f.loss << std::endl;
    const std::string name =
      std::to_string(static_cast<int>(decades)) + " decades: ";
    verdict(name + "at most one step in 1000 fails",
            1000 * f.failed <= i.size());
    verdict(name + "residual", f.residual <= 1e-10);
    verdict(name + "at most 12 iterations in the median",
            i[i.size() / 2] <= 12);
    verdict(name + "at most 30 iterations in 99 %",
            i[i.size() * 99 / 100] <= 30);
    verdict(name + "no dissipation below zero", f.dissipation > -1e-10);
    verdict(name + "power of the whole and of its elements", f.balance < 1e-9);
    verdict(name + "no energy but the implicit rule's is lost",
            f.loss > -1e-10);
    verdict(name + "tangent symmetric", f.asymmetry < 1e-6);
    verdict(name + "tangent not negative", f.negative > -1e-8);
    verdict(name + "tangent by differences", f.at_kinks <= f.compared / 25);
    verdict(name + "stress by differences of the potential", f.gradient < 1.);
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
  judge(verdict, 1., 2000);
  judge(verdict, 8., 10000);
  return verdict.status();
}
