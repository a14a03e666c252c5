#include <signoton/drivers/point_law.h>

#include <algorithm>
#include <cmath>

namespace Signoton
{
  using namespace Rheology;

  PointLaw::PointLaw(const Material &material)
    : law(make_law(material))
  {
    if (!material.has_potential)
      {
        const Moduli moduli = material.elasticity;
        elastic_stiffness   = std::max(3. * moduli.bulk, 2. * moduli.shear);
      }
    else
      network = std::make_unique<Network>(material.scheme);
  }

  void
  PointLaw::set_control(const std::array<bool, 6> &given)
  {
    stress_is_given = given;
    if (network)
      network->set_control(given);
  }

  unsigned int
  PointLaw::n_tensors() const
  {
    return network ?
             network->n_tensors() :
             std::visit([](const auto &l) { return Rheology::n_tensors(l); },
                        law);
  }

  unsigned int
  PointLaw::n_scalars() const
  {
    return network ?
             network->n_scalars() :
             std::visit([](const auto &l) { return Rheology::n_scalars(l); },
                        law);
  }

  std::string
  PointLaw::description() const
  {
    return "History: " + std::to_string(n_tensors()) + " strain tensors and " +
           std::to_string(n_scalars()) + " numbers, " +
           std::to_string(8 * (6 * n_tensors() + n_scalars())) + " bytes\n";
  }

  PointLaw::State
  PointLaw::at_rest(const double time) const
  {
    State state;
    state.time = time;
    state.tensors.resize(n_tensors(), Vector6{});
    state.scalars.resize(n_scalars(), 0.);
    return state;
  }

  Matrix6
  PointLaw::respond(const State &from, const Vector6 &strain, State &to) const
  {
    Response<double> response;
    std::visit(
      [&](const auto &l) {
        auto before = make_history<double>(l), after = before;
        for (std::size_t k = 0; k < from.tensors.size(); ++k)
          before.tensors[k] = from_mandel(from.tensors[k]);
        for (std::size_t k = 0; k < from.scalars.size(); ++k)
          before.scalars[k] = from.scalars[k];
        l.template update<Rheology::all>(from_mandel(strain),
                                         before,
                                         after,
                                         response);
        for (std::size_t k = 0; k < to.tensors.size(); ++k)
          to.tensors[k] = to_mandel(after.tensors[k]);
        for (std::size_t k = 0; k < to.scalars.size(); ++k)
          to.scalars[k] = after.scalars[k];
      },
      law);
    to.strain     = strain;
    to.stress     = to_mandel(response.stress);
    to.stored     = response.stored_energy;
    to.dissipated = from.dissipated + response.dissipation;
    to.region     = static_cast<unsigned int>(response.region);
    return to_mandel(response.tangent);
  }

  bool
  PointLaw::solve(const State &from, const Vector6 &given, State &to) const
  {
    std::vector<unsigned int> unknown;
    Vector6                   strain = from.strain;
    for (unsigned int c = 0; c < 6; ++c)
      if (stress_is_given[c])
        unknown.push_back(c);
      else
        strain[c] = given[c];
    const unsigned int n        = unknown.size();
    const auto         residual = [&]() {
      double sum = 0.;
      for (const unsigned int c : unknown)
        sum += (to.stress[c] - given[c]) * (to.stress[c] - given[c]);
      return std::sqrt(sum);
    };
    constexpr unsigned int most    = 50;
    Matrix6                tangent = respond(from, strain, to);
    double                 error   = residual();
    for (to.iterations = 1; to.iterations < most; ++to.iterations)
      {
        const double size = std::sqrt(dot(to.strain, to.strain));
        if (!std::isfinite(error) ||
            error <= 1e-12 * std::sqrt(dot(to.stress, to.stress)) ||
            error <= 0.1 * round_off(size))
          return std::isfinite(error);
        // where contacts are open there is no stiffness
        LAPACKFullMatrix<double> matrix(n, n);
        Vector<double>           change(n);
        for (unsigned int i = 0; i < n; ++i)
          {
            change[i] = given[unknown[i]] - to.stress[unknown[i]];
            for (unsigned int j = 0; j < n; ++j)
              matrix(i, j) = tangent(unknown[i], unknown[j]) +
                             (i == j ? 1e-9 * elastic_stiffness : 0.);
          }
        try
          {
            matrix.compute_lu_factorization();
          }
        catch (const ExceptionBase &)
          {
            return false; // singular
          }
        matrix.solve(change);
        const State before  = to;
        double      length  = 1.;
        bool        smaller = false;
        for (; length > 1e-4 && !smaller; length *= 0.5)
          {
            Vector6 next = before.strain;
            for (unsigned int i = 0; i < n; ++i)
              next[unknown[i]] += length * change[i];
            tangent = respond(from, next, to);
            smaller = residual() < (1. - 1e-4 * length) * error;
          }
        if (!smaller)
          return false;
        error = residual();
      }
    return false;
  }

  bool
  PointLaw::solve_scheme(const State   &from,
                         const Vector6 &given,
                         const double   time_step,
                         State         &to)
  {
    network->set_time_step(time_step);
    const Network::Step &found =
      network->update(given, from.tensors.data(), from.scalars.data(), false);
    to.strain     = found.strain;
    to.stress     = found.stress;
    to.tensors    = network->trial_tensors();
    to.scalars    = network->trial_scalars();
    to.stored     = found.stored;
    to.dissipated = from.dissipated + found.dissipated;
    to.iterations = found.iterations;
    to.region     = static_cast<unsigned int>(network->region());
    return found.converged;
  }

  std::optional<PointLaw::State>
  PointLaw::step(const State   &from,
                 const Vector6 &given,
                 const double   time_step)
  {
    State to = from;
    to.time  = from.time + time_step;
    if (!(network ? solve_scheme(from, given, time_step, to) :
                    solve(from, given, to)) ||
        !std::isfinite(dot(to.stress, to.stress)) ||
        !std::isfinite(dot(to.strain, to.strain)))
      return {};
    // by the trapezoidal rule
    const Vector6 change = add_scaled(to.strain, -1., from.strain);
    to.work += 0.5 * dot(add_scaled(to.stress, 1., from.stress), change);
    return to;
  }
} // namespace Signoton
