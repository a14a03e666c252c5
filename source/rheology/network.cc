#include <signoton/rheology/network.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Signoton::Rheology
{
  namespace
  {
    using Kind = Scheme::Kind;

    bool
    is_linear(const Kind kind)
    {
      return kind == Kind::spring || kind == Kind::damper;
    }

    Vector6
    stress_of(const Moduli &moduli, const Vector6 &strain)
    {
      return scale(3. * moduli.bulk, 2. * moduli.shear, strain);
    }

    Vector6
    strain_of(const Moduli &moduli, const Vector6 &stress)
    {
      return scale(1. / (3. * moduli.bulk), 1. / (2. * moduli.shear), stress);
    }

    /** The spherical (0) or deviatoric (1) modulus as it acts on Mandel's
     *  components. */
    double
    part(const Moduli &moduli, const unsigned int p)
    {
      return p == 0 ? 3. * moduli.bulk : 2. * moduli.shear;
    }

    Moduli
    from_parts(const double spherical, const double deviatoric)
    {
      return {spherical / 3., deviatoric / 2.};
    }
  } // namespace

  Network::Network(const Scheme &scheme)
  {
    unsigned int n_classes = 1;
    memory_of_class        = {-1};
    add(scheme, 0, n_classes);
    new_tensors.resize(n_memories);
    new_scalars.resize(n_hardening);
    const unsigned int n = 6 * leaves.size();
    rhs.reinit(n);
    for (unsigned int p = 0; p < 2; ++p)
      {
        N[p].resize(leaves.size() * leaves.size());
        B[p].resize(leaves.size());
        C[p].resize(leaves.size());
      }
  }

  unsigned int
  Network::add(const Scheme      &scheme,
               const unsigned int strain_class,
               unsigned int      &n_classes)
  {
    const unsigned int id = nodes.size();
    nodes.emplace_back();
    nodes[id].kind   = scheme.kind;
    nodes[id].moduli = scheme.moduli;
    if (scheme.kind == Kind::damper || scheme.kind == Kind::hinge)
      {
        int &memory = memory_of_class[strain_class];
        if (memory < 0)
          memory = n_memories++;
        nodes[id].memory = memory;
      }
    if (!scheme.set.empty())
      {
        if (std::holds_alternative<VonMisesCylinder<true>>(scheme.set[0]))
          nodes[id].hardening = n_hardening++;
        leaves.emplace_back(id, scheme.set[0], scheme.gap);
      }
    for (const Scheme &one : scheme.parts)
      {
        unsigned int its_class = strain_class;
        if (scheme.kind == Kind::series)
          {
            its_class = n_classes++;
            memory_of_class.push_back(-1);
          }
        const unsigned int child = add(one, its_class, n_classes);
        nodes[id].parts.push_back(child);
      }
    return id;
  }

  void
  Network::set_time_step(const double time_step)
  {
    if (time_step == dt)
      return;
    dt = time_step;
    choose_metrics();
    scatter();
  }

  void
  Network::set_control(const std::array<bool, 6> &stress_is_given)
  {
    stress_given = stress_is_given;
    find_compliance();
  }

  void
  Network::choose_metrics()
  {
    // Springs, and dampers as springs over one step. A part without viscosity
    // gets a little, so that strains stay finite where it is alone in series.
    Moduli largest{0., 0.};
    for (Node &node : nodes)
      if (is_linear(node.kind))
        {
          const double factor = node.kind == Kind::damper ? 1. / dt : 1.;
          node.stiffness      = {factor * node.moduli.bulk,
                                 factor * node.moduli.shear};
          largest.bulk        = std::max(largest.bulk, node.stiffness.bulk);
          largest.shear       = std::max(largest.shear, node.stiffness.shear);
        }
    for (unsigned int p = 0; p < 2; ++p)
      if (!(part(largest, p) > 0.))
        (p == 0 ? largest.bulk : largest.shear) =
          p == 0 ? largest.shear : largest.bulk;
    constexpr double tiny = 1e-14;
    for (Node &node : nodes)
      if (is_linear(node.kind))
        {
          node.stiffness.bulk =
            std::max(node.stiffness.bulk, tiny * largest.bulk);
          node.stiffness.shear =
            std::max(node.stiffness.shear, tiny * largest.shear);
        }

    // The metric of a contact or hinge is the stiffness of what surrounds it:
    // with that, a single one is solved by its first projection. Other contacts
    // and hinges are left out: as rigid in series, as absent in parallel.
    constexpr double    infinite = std::numeric_limits<double>::infinity();
    std::vector<double> own(nodes.size()), around(nodes.size());
    for (unsigned int p = 0; p < 2; ++p)
      {
        constexpr double none = -1.;
        for (unsigned int i = nodes.size(); i-- > 0;)
          {
            const Node &node = nodes[i];
            own[i]     = is_linear(node.kind) ? part(node.stiffness, p) : none;
            double sum = 0.;
            for (const unsigned int c : node.parts)
              if (own[c] > 0.)
                sum += node.kind == Kind::series ? 1. / own[c] : own[c];
            if (sum > 0.)
              own[i] = node.kind == Kind::series ? 1. / sum : sum;
          }
        around[0] = infinite;
        for (unsigned int i = 0; i < nodes.size(); ++i)
          for (const unsigned int c : nodes[i].parts)
            {
              const bool series = nodes[i].kind == Kind::series;
              double     sum    = series ? 1. / around[i] : around[i];
              for (const unsigned int other : nodes[i].parts)
                if (other != c && own[other] > 0.)
                  sum += series ? 1. / own[other] : own[other];
              around[c] = series ? 1. / sum : sum;
            }
        for (const Leaf &leaf : leaves)
          {
            const double metric =
              std::isfinite(around[leaf.node]) && around[leaf.node] > 0. ?
                around[leaf.node] :
                part(largest, p);
            Moduli &stiffness = nodes[leaf.node].stiffness;
            (p == 0 ? stiffness.bulk : stiffness.shear) =
              p == 0 ? metric / 3. : metric / 2.;
          }
      }
    for (Leaf &leaf : leaves)
      leaf.root = {{std::sqrt(part(nodes[leaf.node].stiffness, 0)),
                    std::sqrt(part(nodes[leaf.node].stiffness, 1))}};

    for (unsigned int i = nodes.size(); i-- > 0;)
      if (Node &node = nodes[i]; !node.parts.empty())
        {
          std::array<double, 2> sum{};
          const bool            series = node.kind == Kind::series;
          for (unsigned int p = 0; p < 2; ++p)
            {
              for (const unsigned int c : node.parts)
                {
                  const double k = part(nodes[c].stiffness, p);
                  sum[p] += series ? 1. / k : k;
                }
              if (series)
                sum[p] = 1. / sum[p];
            }
          node.stiffness = from_parts(sum[0], sum[1]);
        }
  }

  void
  Network::scatter()
  {
    const unsigned int  m = leaves.size();
    std::vector<double> s(nodes.size()), e(nodes.size()), c(nodes.size());
    for (unsigned int p = 0; p < 2; ++p)
      // a unit wave from each contact or hinge, and a unit strain
      for (unsigned int source = 0; source <= m; ++source)
        {
          for (unsigned int i = nodes.size(); i-- > 0;)
            {
              const bool series = nodes[i].kind == Kind::series;
              c[i]              = 0.;
              for (const unsigned int k : nodes[i].parts)
                c[i] += series ? c[k] / part(nodes[k].stiffness, p) : c[k];
              if (series)
                c[i] *= part(nodes[i].stiffness, p);
              if (source < m && leaves[source].node == i)
                c[i] = leaves[source].root[p];
            }
          e[0] = source < m ? 0. : 1.;
          s[0] = c[0] + part(nodes[0].stiffness, p) * e[0];
          for (unsigned int i = 0; i < nodes.size(); ++i)
            for (const unsigned int k : nodes[i].parts)
              {
                const double stiffness = part(nodes[k].stiffness, p);
                if (nodes[i].kind == Kind::series)
                  {
                    s[k] = s[i];
                    e[k] = (s[k] - c[k]) / stiffness;
                  }
                else
                  {
                    e[k] = e[i];
                    s[k] = c[k] + stiffness * e[k];
                  }
              }
          for (unsigned int i = 0; i < m; ++i)
            {
              const unsigned int k    = leaves[i].node;
              const double       root = leaves[i].root[p];
              const double       wave = s[k] / root + root * e[k];
              (source < m ? N[p][i * m + source] : B[p][i]) = wave;
            }
          (source < m ? C[p][source] : K[p]) = s[0];
        }
    find_compliance();
  }

  void
  Network::find_compliance()
  {
    // the inverse of the block of given stresses, embedded in zeros
    compliance        = Matrix6();
    Matrix6 stiffness = Matrix6::isotropic(K[0], K[1]);
    bool    any       = false;
    for (unsigned int i = 0; i < 6; ++i)
      {
        any |= stress_given[i];
        for (unsigned int j = 0; j < 6; ++j)
          if (!stress_given[i] || !stress_given[j])
            stiffness(i, j) = i == j ? 1. : 0.;
      }
    if (!any)
      return;
    compliance = invert_positive(stiffness);
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int j = 0; j < 6; ++j)
        if (!stress_given[i] || !stress_given[j])
          compliance(i, j) = 0.;
  }

  void
  Network::sweep(const Vector6 &strain)
  {
    for (unsigned int i = nodes.size(); i-- > 0;)
      {
        Node &node = nodes[i];
        if (node.parts.empty()) // set by the caller
          continue;
        node.offset = Vector6{};
        for (const unsigned int c : node.parts)
          node.offset =
            add_scaled(node.offset,
                       1.,
                       node.kind == Kind::series ?
                         strain_of(nodes[c].stiffness, nodes[c].offset) :
                         nodes[c].offset);
        if (node.kind == Kind::series)
          node.offset = stress_of(node.stiffness, node.offset);
      }
    nodes[0].strain = strain;
    nodes[0].stress =
      add_scaled(nodes[0].offset, 1., stress_of(nodes[0].stiffness, strain));
    for (Node &node : nodes)
      for (const unsigned int c : node.parts)
        {
          Node &child = nodes[c];
          if (node.kind == Kind::parallel)
            {
              child.strain = node.strain;
              child.stress =
                add_scaled(child.offset,
                           1.,
                           stress_of(child.stiffness, child.strain));
            }
          else
            {
              child.stress = node.stress;
              child.strain =
                strain_of(child.stiffness,
                          add_scaled(child.stress, -1., child.offset));
            }
        }
  }

  template <bool with_tangent>
  void
  Network::project()
  {
    for (Leaf &leaf : leaves)
      {
        const Node     &node = nodes[leaf.node];
        const Tensor2<> trial =
          from_mandel(scale(leaf.root[0], leaf.root[1], leaf.wave));
        Projection<double> projection;
        projection.hardening =
          node.hardening < 0 ? 0. : accepted_scalars[node.hardening];
        std::visit(
          [&](const auto &set) {
            set.template project<with_tangent>(trial,
                                               node.stiffness,
                                               projection);
          },
          leaf.set);
        leaf.admissible = scale(1. / leaf.root[0],
                                1. / leaf.root[1],
                                to_mandel(projection.stress));
        leaf.hardening  = projection.hardening;
        leaf.correction = projection.potential_correction;
        if constexpr (with_tangent)
          {
            // scaled to eigenvalues between -1 and 1, and symmetric
            const IsotropicScaling half{1. / leaf.root[0], 1. / leaf.root[1]};
            const Matrix6 J = to_mandel(half.both_sides(projection.tangent));
            for (unsigned int i = 0; i < 6; ++i)
              for (unsigned int j = 0; j < 6; ++j)
                leaf.reflection(i, j) = J(i, j) + J(j, i) - (i == j ? 1. : 0.);
          }
      }
  }

  double
  Network::evaluate()
  {
    const unsigned int m = leaves.size();
    project<false>();
    // strain where the stress is given: the rest of the network is linear
    Vector6 missing = given_stress;
    missing         = add_scaled(missing, -1., known_stress);
    for (unsigned int j = 0; j < m; ++j)
      missing = add_scaled(missing,
                           -1.,
                           scale(C[0][j], C[1][j], leaves[j].reflected()));
    const Vector6 free_strain = compliance * missing;
    step.strain               = add_scaled(known_strain, 1., free_strain);

    double residual = 0., size = wave_scale;
    for (unsigned int i = 0; i < m; ++i)
      {
        Leaf   &leaf = leaves[i];
        Vector6 back =
          add_scaled(leaf.start, 1., scale(B[0][i], B[1][i], free_strain));
        for (unsigned int j = 0; j < m; ++j)
          back = add_scaled(back,
                            1.,
                            scale(N[0][i * m + j],
                                  N[1][i * m + j],
                                  leaves[j].reflected()));
        leaf.defect = add_scaled(back, -1., leaf.wave);
        residual += dot(leaf.defect, leaf.defect);
        size += dot(leaf.wave, leaf.wave);
      }
    return residual > 0. ? std::sqrt(residual / size) : 0.;
  }

  void
  Network::factorize(const double shift)
  {
    const unsigned int m = leaves.size(), n = 6 * m;
    project<true>();
    matrix.reinit(n);
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
        {
          Matrix6 block =
            Matrix6::isotropic(-N[0][i * m + j], -N[1][i * m + j]);
          if (stress_given != std::array<bool, 6>{})
            {
              const Matrix6 b = Matrix6::isotropic(B[0][i], B[1][i]),
                            c = Matrix6::isotropic(C[0][j], C[1][j]);
              block += b * (compliance * c);
            }
          block = block * leaves[j].reflection;
          for (unsigned int a = 0; a < 6; ++a)
            for (unsigned int b = 0; b < 6; ++b)
              matrix(6 * i + a, 6 * j + b) =
                block(a, b) + (i == j && a == b ? 1. + shift : 0.);
        }
    matrix.compute_lu_factorization();
  }

  void
  Network::iterate()
  {
    // shortest shift: the matrix stays regular where strains are not unique
    constexpr double least = 1e-12, most = 0.3;
    constexpr double sufficient = 1e-10;
    double           boost      = 1.;
    step.residual               = evaluate();
    double       best           = step.residual;
    unsigned int in_vain        = 0;
    for (Leaf &leaf : leaves)
      leaf.best_wave = leaf.wave;
    for (step.iterations = 0;
         step.residual > tolerance && step.iterations < maximum_iterations;
         ++step.iterations)
      {
        const double before = step.residual;
        const double shift  = std::clamp(boost * before, least, most);
        factorize(shift);
        for (unsigned int i = 0; i < leaves.size(); ++i)
          {
            leaves[i].old_wave   = leaves[i].wave;
            leaves[i].old_defect = leaves[i].defect;
            std::copy(leaves[i].defect.begin(),
                      leaves[i].defect.end(),
                      rhs.begin() + 6 * i);
          }
        matrix.solve(rhs);

        double length = 1.;
        bool   moved  = false;
        for (unsigned int trial = 0; trial < 12 && !moved;
             ++trial, length *= moved ? 1. : 0.25)
          {
            double along = 0., squared = 0., defects = 0.;
            for (unsigned int i = 0; i < leaves.size(); ++i)
              for (unsigned int c = 0; c < 6; ++c)
                leaves[i].wave[c] =
                  leaves[i].old_wave[c] + length * rhs[6 * i + c];
            step.residual = evaluate();
            if (step.residual <= (1. - std::min(0.1 * length, 0.05)) * before ||
                step.residual <= tolerance)
              {
                moved = true;
                break;
              }
            // The plane through the trial point with its defect as normal
            // separates the present point from all solutions: go there.
            for (unsigned int i = 0; i < leaves.size(); ++i)
              for (unsigned int c = 0; c < 6; ++c)
                {
                  const double d = rhs[6 * i + c], f = leaves[i].defect[c];
                  along += f * d;
                  squared += d * d;
                  defects += f * f;
                }
            if (along >= 0.1 * shift * squared)
              {
                for (Leaf &leaf : leaves)
                  leaf.wave = add_scaled(leaf.old_wave,
                                         length * along / defects,
                                         leaf.defect);
                step.residual = evaluate();
                moved         = true;
              }
          }
        if (!moved)
          {
            for (Leaf &leaf : leaves)
              leaf.wave = add_scaled(leaf.old_wave, 0.5, leaf.old_defect);
            step.residual = evaluate();
          }
        // Near round-off steps and planes no longer help, or lead astray: the
        // best point of all is kept, and a few more are tried.
        if (step.residual < 0.5 * best)
          {
            best    = step.residual;
            in_vain = 0;
            for (Leaf &leaf : leaves)
              leaf.best_wave = leaf.wave;
          }
        else if (best <= sufficient && ++in_vain == 6)
          break;
        boost = !moved || length < 0.2 ? std::min(100. * boost, 1e8) :
                length > 0.9           ? std::max(0.1 * boost, 1.) :
                                         boost;
      }
    if (step.residual > best)
      {
        for (Leaf &leaf : leaves)
          leaf.wave = leaf.best_wave;
        step.residual = evaluate();
      }
    step.converged = step.residual <= std::max(tolerance, sufficient);
  }

  void
  Network::find_tangent()
  {
    // dt = N R dt + B de, dsigma = K de + C R dt; a small shift picks one of
    // many strains of elements, all with the same stress of the whole
    step.tangent = Matrix6::isotropic(K[0], K[1]);
    if (leaves.empty())
      return;
    const Matrix6 kept = compliance;
    compliance         = Matrix6();
    factorize(1e-12);
    compliance = kept;
    for (unsigned int column = 0; column < 6; ++column)
      {
        Vector6 unit{};
        unit[column] = 1.;
        for (unsigned int i = 0; i < leaves.size(); ++i)
          {
            const Vector6 wave = scale(B[0][i], B[1][i], unit);
            std::copy(wave.begin(), wave.end(), rhs.begin() + 6 * i);
          }
        matrix.solve(rhs);
        for (unsigned int i = 0; i < leaves.size(); ++i)
          {
            Vector6 wave;
            std::copy(rhs.begin() + 6 * i,
                      rhs.begin() + 6 * i + 6,
                      wave.begin());
            const Vector6 stress =
              scale(C[0][i], C[1][i], leaves[i].reflection * wave);
            for (unsigned int row = 0; row < 6; ++row)
              step.tangent(row, column) += stress[row];
          }
      }
  }

  void
  Network::account(const Vector6 *tensors)
  {
    for (const Leaf &leaf : leaves)
      nodes[leaf.node].offset =
        add_scaled(scale(leaf.root[0], leaf.root[1], leaf.reflected()),
                   -1.,
                   stress_of(nodes[leaf.node].stiffness, leaf.reference));
    sweep(step.strain);
    step.stress    = nodes[0].stress;
    step.potential = step.stored = step.dissipated = 0.;
    for (const Node &node : nodes)
      if (node.kind == Kind::spring)
        step.stored += 0.5 * dot(node.stress, node.strain);
      else if (node.kind == Kind::damper)
        {
          const double work =
            dot(node.stress,
                add_scaled(node.strain, -1., tensors[node.memory]));
          step.dissipated += work;
          step.potential += 0.5 * work;
          new_tensors[node.memory] = node.strain;
        }
    for (const Leaf &leaf : leaves)
      {
        const Node &node = nodes[leaf.node];
        // the strain beyond the reference, where the set is active
        const double work =
          dot(leaf.admissible, add_scaled(leaf.wave, -1., leaf.admissible));
        if (node.kind == Kind::contact)
          step.stored += work;
        else
          {
            step.dissipated += work;
            step.potential += work + leaf.correction;
            new_tensors[node.memory] = node.strain;
          }
        if (node.hardening >= 0)
          {
            const auto  &set   = std::get<VonMisesCylinder<true>>(leaf.set);
            const double shear = leaf.hardening,
                         slip  = shear - accepted_scalars[node.hardening];
            step.stored += set.hardening_energy(shear);
            step.dissipated -= set.hardening_stress(shear) * slip;
            new_scalars[node.hardening] = shear;
          }
      }
    for (const Node &node : nodes)
      if (node.kind == Kind::spring)
        step.potential += 0.5 * dot(node.stress, node.strain);
    for (const Leaf &leaf : leaves)
      if (nodes[leaf.node].kind == Kind::contact)
        step.potential +=
          dot(leaf.admissible, add_scaled(leaf.wave, -1., leaf.admissible));
  }

  const Network::Step &
  Network::update(const Vector6 &given,
                  const Vector6 *tensors,
                  const double  *scalars,
                  const bool     with_tangent)
  {
    accepted_scalars = scalars;
    for (unsigned int c = 0; c < 6; ++c)
      {
        known_strain[c] = stress_given[c] ? 0. : given[c];
        given_stress[c] = stress_given[c] ? given[c] : 0.;
      }
    // the network without waves from contacts and hinges
    for (Node &node : nodes)
      node.offset =
        node.kind == Kind::damper ?
          stress_of(node.stiffness, scale(-1., -1., tensors[node.memory])) :
          Vector6{};
    for (Leaf &leaf : leaves)
      {
        Node &node = nodes[leaf.node];
        // a contact with a gap: shift of its strain to where it closes
        leaf.reference =
          node.kind == Kind::hinge ?
            tensors[node.memory] :
            Vector6{
              {-leaf.gap / 3., -leaf.gap / 3., -leaf.gap / 3., 0., 0., 0.}};
        node.offset =
          stress_of(node.stiffness, scale(-1., -1., leaf.reference));
      }
    sweep(known_strain);
    known_stress = nodes[0].stress;
    wave_scale   = 0.;
    for (const Node &node : nodes)
      if (is_linear(node.kind))
        wave_scale += dot(node.stress, strain_of(node.stiffness, node.stress));
    for (Leaf &leaf : leaves)
      {
        const Node &node = nodes[leaf.node];
        leaf.start =
          add_scaled(scale(1. / leaf.root[0], 1. / leaf.root[1], node.stress),
                     1.,
                     scale(leaf.root[0],
                           leaf.root[1],
                           add_scaled(node.strain, -1., leaf.reference)));
        leaf.wave = leaf.start;
      }
    iterate();
    account(tensors);
    if (with_tangent)
      find_tangent();
    return step;
  }
} // namespace Signoton::Rheology
