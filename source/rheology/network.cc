#include <signoton/base/floating_point_traps.h>
#include <signoton/rheology/network.h>

#include <algorithm>
#include <limits>

// One step, once its local problem is solved: strains, energies, memory.
// network_scattering.cc prepares that problem, network_solver.cc solves it.

namespace Signoton::Rheology
{
  namespace
  {
    using Kind = Scheme::Kind;

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
  } // namespace

  std::vector<Network::Element>
  Network::elements() const
  {
    std::vector<Element> result;
    for (const Node &node : nodes)
      if (node.parts.empty())
        result.push_back({node.kind, node.strain, node.stress});
    return result;
  }

  Region
  Network::region() const
  {
    Region of_contacts = Region::interior, of_hinges = Region::interior;
    for (const Leaf &leaf : leaves)
      {
        Region &region =
          nodes[leaf.node].kind == Kind::contact ? of_contacts : of_hinges;
        region = std::max(region, leaf.region);
      }
    return of_contacts != Region::interior ? of_contacts : of_hinges;
  }

  Vector6
  Network::contact_strain(const unsigned int node) const
  {
    if (nodes[node].kind == Kind::contact)
      return nodes[node].strain;
    Vector6 sum{};
    for (const unsigned int c : nodes[node].parts)
      if (nodes[c].has_contact)
        {
          if (nodes[node].kind == Kind::parallel)
            return contact_strain(c);
          sum = add_scaled(sum, 1., contact_strain(c));
        }
    return sum;
  }

  Vector6
  Network::plastic_strain() const
  {
    Vector6 sum{};
    if (nodes[0].kind == Kind::series)
      for (const unsigned int c : nodes[0].parts)
        if (nodes[c].has_hinge && !nodes[c].has_contact)
          sum = add_scaled(sum, 1., nodes[c].strain);
    return sum;
  }

  void
  Network::find_strain()
  {
    Vector6 missing = add_scaled(given_stress, -1., known_stress);
    for (unsigned int j = 0; j < leaves.size(); ++j)
      missing = add_scaled(missing,
                           -1.,
                           scale(C[0][j], C[1][j], leaves[j].reflected()));
    step.strain = add_scaled(known_strain, 1., compliance * missing);
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

  void
  Network::account()
  {
    for (const Leaf &leaf : leaves)
      nodes[leaf.node].offset =
        add_scaled(scale(leaf.root[0], leaf.root[1], leaf.reflected()),
                   -1.,
                   stress_of(nodes[leaf.node].stiffness, leaf.reference));
    sweep(step.strain);
    step.stress = nodes[0].stress;
    step.stored = step.dissipated = step.viscous = 0.;
    double hardening                             = 0.;
    for (const Node &node : nodes)
      if (node.kind == Kind::spring)
        step.stored += 0.5 * dot(node.stress, node.strain);
      else if (node.kind == Kind::damper)
        {
          const double work =
            dot(node.stress,
                add_scaled(node.strain, -1., accepted_tensors[node.memory]));
          step.dissipated += work;
          step.viscous += work;
          new_tensors[node.memory] = node.strain;
        }
    for (const Leaf &leaf : leaves)
      {
        const Node &node = nodes[leaf.node];
        // the strain beyond the reference, where the set is active
        const double work =
          dot(leaf.admissible, add_scaled(leaf.wave, -1., leaf.admissible));
        (node.kind == Kind::contact ? step.stored : step.dissipated) += work;
        if (node.hardening >= 0)
          {
            const auto  &set    = std::get<VonMisesCylinder<true>>(leaf.set);
            const double shear  = leaf.hardening,
                         slip   = shear - accepted_scalars[node.hardening],
                         stored = set.hardening_energy(shear),
                         spent  = set.hardening_stress(shear) * slip;
            step.stored += stored;
            step.dissipated -= spent;
            hardening += leaf.correction - stored + spent;
            new_scalars[node.hardening] = shear;
          }
      }
    step.potential =
      step.stored + step.dissipated - 0.5 * step.viscous + hardening;
    double stresses = 0.;
    for (const Leaf &leaf : leaves)
      stresses += dot(leaf.admissible, leaf.admissible);
    step.scale = std::max({step.scale, stresses, step.stored, step.dissipated});
    remember();
  }

  void
  Network::remember()
  {
    // Contacts and hinges know their strain better than the sweep does: if the
    // set is not active it is the reference, to the last digit. Otherwise rigid
    // elements in parallel would contradict each other by round-off in the next
    // step. Of several the one that moved least is right.
    for (unsigned int i = 0; i < n_memories; ++i)
      {
        double least = std::numeric_limits<double>::max();
        for (const Leaf &leaf : leaves)
          if (leaf.memory == static_cast<int>(i))
            {
              const Vector6 beyond =
                scale(1. / leaf.root[0],
                      1. / leaf.root[1],
                      add_scaled(leaf.wave, -1., leaf.admissible));
              const double size = dot(beyond, beyond);
              if (size < least)
                {
                  least          = size;
                  new_tensors[i] = add_scaled(leaf.reference, 1., beyond);
                }
            }
      }
  }

  void
  Network::find_starts()
  {
    // the network without waves from contacts and hinges
    for (Node &node : nodes)
      node.offset =
        node.kind == Kind::damper ?
          stress_of(node.stiffness,
                    scale(-1., -1., accepted_tensors[node.memory])) :
          Vector6{};
    for (Leaf &leaf : leaves)
      {
        Node &node = nodes[leaf.node];
        // a contact with a gap: shift of its strain to where it closes
        leaf.reference =
          node.kind == Kind::hinge ?
            accepted_tensors[node.memory] :
            Vector6{
              {-leaf.gap / 3., -leaf.gap / 3., -leaf.gap / 3., 0., 0., 0.}};
        node.offset =
          stress_of(node.stiffness, scale(-1., -1., leaf.reference));
      }
    sweep(known_strain);
    known_stress = nodes[0].stress;
    // strains where the stress is given move all
    const Vector6 free_strain =
      compliance * add_scaled(given_stress, -1., known_stress);
    if (dot(free_strain, free_strain) > 0.)
      sweep(add_scaled(known_strain, 1., free_strain));
    // What stresses are to be measured by: those of the linear elements, those
    // that the step would cause, and the round-off of strains.
    constexpr double round_off = 1e-10; // 1e-5 of the stress that they had
    step.scale                 = 0.;
    for (const Node &node : nodes)
      if (node.is_linear())
        step.scale += dot(node.stress, strain_of(node.stiffness, node.stress));
    for (const Leaf &leaf : leaves)
      {
        const Node &node = nodes[leaf.node];
        for (const Vector6 *strain : {&node.strain, &leaf.reference})
          step.scale +=
            round_off * dot(*strain, stress_of(node.stiffness, *strain));
      }
    for (Leaf &leaf : leaves)
      {
        const Node &node = nodes[leaf.node];
        leaf.start =
          add_scaled(scale(1. / leaf.root[0], 1. / leaf.root[1], node.stress),
                     1.,
                     scale(leaf.root[0],
                           leaf.root[1],
                           add_scaled(node.strain, -1., leaf.reference)));
        step.scale += dot(leaf.start, leaf.start);
      }
  }

  const Network::Step &
  Network::update(const Vector6 &given,
                  const Vector6 *tensors,
                  const double  *scalars,
                  const bool     with_tangent)
  {
    const FloatingPointTraps traps;
    accepted_scalars = scalars;
    for (unsigned int c = 0; c < 6; ++c)
      {
        known_strain[c] = stress_given[c] ? 0. : given[c];
        given_stress[c] = stress_given[c] ? given[c] : 0.;
      }
    accepted_tensors = tensors;
    find_starts();
    iterate();
    find_strain();
    account();
    if (with_tangent)
      find_tangent();
    return step;
  }
} // namespace Signoton::Rheology
