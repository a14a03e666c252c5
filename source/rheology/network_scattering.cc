#include <signoton/rheology/network.h>

#include <algorithm>
#include <cmath>
#include <limits>

// The linear elements of a Network, which depend on the scheme, the time step
// and the control, not on strains: metrics and the map of waves.

namespace Signoton::Rheology
{
  namespace
  {
    using Kind = Scheme::Kind;

    /** The spherical (0) or deviatoric (1) modulus as it acts on Mandel's
     *  components. */
    double
    part(const Moduli &moduli, const unsigned int p)
    {
      return p == 0 ? 3. * moduli.bulk : 2. * moduli.shear;
    }

    void
    set_block(FullMatrix<double> &map,
              const unsigned int  i,
              const unsigned int  j,
              const Matrix6      &block)
    {
      for (unsigned int a = 0; a < 6; ++a)
        for (unsigned int b = 0; b < 6; ++b)
          map(6 * i + a, 6 * j + b) = block(a, b);
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
    for (Leaf &leaf : leaves)
      leaf.memory = memory_of_class[leaf.strain_class];
    const unsigned int n = 6 * leaves.size();
    for (auto *table : {&scattering, &controlled, &modes})
      table->reinit(n, n);
    for (auto *vector : {&rhs, &stiff_part, &work})
      vector->reinit(n);
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
    nodes[id].kind        = scheme.kind;
    nodes[id].moduli      = scheme.moduli;
    nodes[id].has_contact = scheme.kind == Kind::contact;
    nodes[id].has_hinge   = scheme.kind == Kind::hinge;
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
        leaves.emplace_back(id, strain_class, scheme.set[0], scheme.gap);
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
        nodes[id].has_contact |= nodes[child].has_contact;
        nodes[id].has_hinge |= nodes[child].has_hinge;
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
    if (stress_is_given == stress_given)
      return;
    stress_given = stress_is_given;
    if (dt > 0.)
      close_control();
  }

  void
  Network::choose_metrics()
  {
    // Springs, and dampers as springs over one step. A part without viscosity
    // gets a little, so that strains stay finite where it is alone in series.
    Moduli largest{0., 0.};
    for (Node &node : nodes)
      if (node.is_linear())
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
    constexpr double tiny = 1e-11;
    for (Node &node : nodes)
      if (node.is_linear())
        {
          node.stiffness.bulk =
            std::max(node.stiffness.bulk, tiny * largest.bulk);
          node.stiffness.shear =
            std::max(node.stiffness.shear, tiny * largest.shear);
        }

    for (unsigned int p = 0; p < 2; ++p)
      match_metrics(p);
  }

  void
  Network::match_metrics(const unsigned int p)
  {
    // The metric of a contact or hinge should be the stiffness of what
    // surrounds it, as an electrical line is closed by its own impedance: then
    // it hears no echo of the waves that it sends. The others take part with
    // their metrics, so this is a fixed point; it need not be found exactly,
    // and it is kept between the softest and the stiffest element.
    double softest = std::numeric_limits<double>::max(), stiffest = 0.;
    for (const Node &node : nodes)
      if (node.is_linear())
        {
          const double k = part(node.stiffness, p);
          stiffest       = std::max(stiffest, k);
          if (part(node.moduli, p) > 0.)
            softest = std::min(softest, k);
        }
    if (!(stiffest > 0.)) // rigid elements alone: any metric will do
      softest = stiffest = 1.;
    softest           = std::min(softest, stiffest);
    const auto assign = [p](Node &node, const double k) {
      (p == 0 ? node.stiffness.bulk : node.stiffness.shear) =
        p == 0 ? k / 3. : k / 2.;
    };
    for (const Leaf &leaf : leaves)
      assign(nodes[leaf.node], std::sqrt(softest * stiffest));
    std::vector<double> around(nodes.size());
    for (unsigned int repetition = 0; repetition < 30; ++repetition)
      {
        for (unsigned int i = nodes.size(); i-- > 0;)
          if (!nodes[i].parts.empty())
            assign(nodes[i], stiffness_of_parts(nodes[i], p));
        around[0] = std::numeric_limits<double>::infinity();
        for (unsigned int i = 0; i < nodes.size(); ++i)
          for (const unsigned int c : nodes[i].parts)
            {
              const bool series = nodes[i].kind == Kind::series;
              double     sum    = series ? 1. / around[i] : around[i];
              for (const unsigned int other : nodes[i].parts)
                if (other != c)
                  {
                    const double k = part(nodes[other].stiffness, p);
                    sum += series ? 1. / k : k;
                  }
              around[c] = series ? 1. / sum : sum;
            }
        for (const Leaf &leaf : leaves)
          {
            Node        &node = nodes[leaf.node];
            const double wanted =
              std::clamp(around[leaf.node], softest, stiffest);
            // by half on a scale of powers, as one may follow another
            assign(node, std::sqrt(wanted * part(node.stiffness, p)));
          }
      }
  }

  double
  Network::stiffness_of_parts(const Node &node, const unsigned int p) const
  {
    const bool series = node.kind == Kind::series;
    double     sum    = 0.;
    for (const unsigned int c : node.parts)
      {
        const double k = part(nodes[c].stiffness, p);
        sum += series ? 1. / k : k;
      }
    return series ? 1. / sum : sum;
  }

  void
  Network::scatter()
  {
    for (unsigned int i = nodes.size(); i-- > 0;)
      if (!nodes[i].parts.empty())
        nodes[i].stiffness = from_parts(stiffness_of_parts(nodes[i], 0),
                                        stiffness_of_parts(nodes[i], 1));
    for (Leaf &leaf : leaves)
      leaf.root = {{std::sqrt(part(nodes[leaf.node].stiffness, 0)),
                    std::sqrt(part(nodes[leaf.node].stiffness, 1))}};

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
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
        set_block(scattering,
                  i,
                  j,
                  Matrix6::isotropic(N[0][i * m + j], N[1][i * m + j]));
    close_control();
  }

  void
  Network::close_control()
  {
    // the inverse of the block of given stresses, embedded in zeros
    const unsigned int m = leaves.size();
    compliance           = Matrix6();
    controlled           = scattering;
    if (stress_given != std::array<bool, 6>{})
      {
        Matrix6 stiffness = Matrix6::isotropic(K[0], K[1]);
        for (unsigned int i = 0; i < 6; ++i)
          for (unsigned int j = 0; j < 6; ++j)
            if (!stress_given[i] || !stress_given[j])
              stiffness(i, j) = i == j ? 1. : 0.;
        compliance = invert_positive(stiffness);
        for (unsigned int i = 0; i < 6; ++i)
          for (unsigned int j = 0; j < 6; ++j)
            if (!stress_given[i] || !stress_given[j])
              compliance(i, j) = 0.;
        // strains that keep the given stresses carry waves, too
        for (unsigned int i = 0; i < m; ++i)
          for (unsigned int j = 0; j < m; ++j)
            {
              const Matrix6 b = Matrix6::isotropic(B[0][i], B[1][i]),
                            c = Matrix6::isotropic(-C[0][j], -C[1][j]);
              Matrix6 block   = b * (compliance * c);
              block += Matrix6::isotropic(N[0][i * m + j], N[1][i * m + j]);
              set_block(controlled, i, j, block);
            }
      }
    find_modes();
  }
} // namespace Signoton::Rheology
