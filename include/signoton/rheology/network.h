#ifndef signoton_rheology_network_h
#define signoton_rheology_network_h

#include <signoton/rheology/scheme.h>
#include <signoton/tensors/mandel.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

namespace Signoton::Rheology
{
  /**
   * One time step of any scheme at one point: implicit Euler, solved for all
   * its elements together.
   *
   * A contact or hinge has a stress $s$ and a strain $e$ with
   * $s\in\partial h(e-e_0)$; for a metric $A$ of isotropic moduli this is
   * $s=\pi(t)$ with the *wave* $t=s+A(e-e_0)$ and the projection $\pi$ in the
   * norm of $A^{-1}$. All other elements are linear: they answer waves
   * $u=s-A(e-e_0)=2\pi(t)-t$ of the contacts and hinges by waves
   * $t^+=Nu+B\varepsilon+\dots$, with $N$ from a sweep over the tree. The step
   * is a fixed point,
   * $$ F(t)=t-t^+(2\pi(t)-t)=0, $$
   * of a map that does not expand distances in the norm of $A^{-1}$, because
   * the step minimizes a convex potential. Newton's method solves it where it
   * converges. It starts from, and returns to, minimizations of that potential
   * augmented by multipliers (Rockafellar 1976): contacts and hinges with a
   * compliance, and a stress that makes up for it; they converge from
   * everywhere, also where strains of single elements are not unique.
   *
   * One object is to be used by one thread at a time: it holds the workspace.
   */
  class Network
  {
  public:
    explicit Network(const Scheme &scheme);

    /** Elements remember strains; those in parallel share theirs. */
    unsigned int
    n_tensors() const
    {
      return n_memories;
    }

    /** Accumulated plastic shears of hinges that harden isotropically. */
    unsigned int
    n_scalars() const
    {
      return n_hardening;
    }

    /** In s; does nothing if it is the present one. */
    void
    set_time_step(const double time_step);

    /** For each component (in Mandel's order) whether the stress is given; the
     *  strain is, where it is not. Initially no stress is given. */
    void
    set_control(const std::array<bool, 6> &stress_is_given);

    /** What update() found. */
    struct Step
    {
      Vector6      strain;
      Vector6      stress;
      Matrix6      tangent;    ///< only if asked for
      double       potential;  ///< $W_n(\varepsilon)$ in J/m^3
      double       stored;     ///< of springs, hardening, cohesion, in J/m^3
      double       dissipated; ///< by dampers and hinges in the step, in J/m^3
      double       viscous;    ///< the part of it in dampers, in J/m^3
      double       scale;      ///< energy that errors are relative to, in J/m^3
      unsigned int iterations;
      double       residual; ///< relative
      bool         converged;
    };

    /**
     * Take a step.
     * @param given   strain, or stress in Pa, by component
     * @param tensors accepted strains in memory, n_tensors() of them
     * @param scalars accepted plastic shears, n_scalars() of them
     */
    const Step &
    update(const Vector6 &given,
           const Vector6 *tensors,
           const double  *scalars,
           const bool     with_tangent = true);

    /** An element after the last update(). */
    struct Element
    {
      Scheme::Kind kind;
      Vector6      strain, stress;
    };

    /** The elements in the order in which they stand in the scheme. */
    std::vector<Element>
    elements() const;

    /** Where the contacts are on their cones, the most advanced counts; if all
     *  are closed, where the hinges are on their sets. */
    Region
    region() const;

    /** Strain of the contacts of a part, or of the whole: the sum in series, and
     *  that of the first that holds a contact in parallel. */
    Vector6
    contact_strain(const unsigned int node = 0) const;

    /** Strain of the parts that hold a hinge, but no contact. */
    Vector6
    plastic_strain() const;

    /** New memory, to be accepted or not. */
    const std::vector<Vector6> &
    trial_tensors() const
    {
      return new_tensors;
    }

    const std::vector<double> &
    trial_scalars() const
    {
      return new_scalars;
    }

    /** The larger modulus of the whole, contacts and hinges taken as springs of
     *  the stiffness around them: a scale for tangents, in Pa. */
    double
    stiffness() const
    {
      return std::max(K[0], K[1]);
    }

    /** Residual, relative to the waves, below which a step has converged. */
    double tolerance = 1e-12;
    /** A residual that is accepted if round-off keeps it from the tolerance. */
    static constexpr double sufficient = 1e-10;
    /** Iterations, each with one factorization, after which a step has failed
     *  if its residual is not even sufficient. */
    unsigned int maximum_iterations = 50;

  private:
    struct Node
    {
      /** Springs and dampers; groups are not asked. */
      bool
      is_linear() const
      {
        return kind == Scheme::Kind::spring || kind == Scheme::Kind::damper;
      }

      Scheme::Kind              kind;
      std::vector<unsigned int> parts;
      Moduli                    moduli; ///< as in Scheme
      /** In this time step; the metric of contacts and hinges. */
      Moduli stiffness;
      bool   has_contact = false, has_hinge = false; ///< in its subtree
      /** Which remembered strain and scalar, or none. */
      int     memory = -1, hardening = -1;
      Vector6 strain{}, stress{};
      Vector6 offset; ///< stress at zero strain
    };

    /** A contact or hinge. Its stresses, strains and waves are scaled by the
     *  root of its metric, so that $t=s+e$. */
    struct Leaf
    {
      Leaf(const unsigned int   node,
           const unsigned int   strain_class,
           const AdmissibleSet &set,
           const double         gap)
        : node(node)
        , strain_class(strain_class)
        , set(set)
        , gap(gap)
      {}

      /** A component of the wave that it sends back. */
      double
      reflected(const unsigned int c) const
      {
        return 2. * admissible[c] - wave[c];
      }

      Vector6
      reflected() const
      {
        return add_scaled(scale(-1., -1., wave), 2., admissible);
      }

      unsigned int          node, strain_class;
      int                   memory = -1; ///< of what is in parallel, or none
      AdmissibleSet         set;
      double                gap;
      std::array<double, 2> root; ///< of the spherical and deviatoric metric
      Vector6               reference;  ///< strain $e_0$, not scaled
      Vector6               start;      ///< wave if none sends any
      Vector6               wave;       ///< $t$
      Vector6               admissible; ///< $\pi(t)$
      Matrix6               slope;      ///< $d\pi/dt$, symmetric
      Region                region;
      double                hardening;  ///< new plastic shear
      double                correction; ///< of the potential by hardening
      Vector6               defect;     ///< $-F(t)$
      Vector6               best_wave;
      // of the minimizations
      double  penalty;    ///< stiffness of the contact, of the metric
      Vector6 multiplier; ///< the stress that makes up for the compliance
      Vector6 strain, old_strain, direction;
    };

    /** Append a subtree; its elements share strains by class. */
    unsigned int
    add(const Scheme      &scheme,
        const unsigned int strain_class,
        unsigned int      &n_classes);
    void
    choose_metrics();
    void
    match_metrics(const unsigned int part);
    double
    stiffness_of_parts(const Node &node, const unsigned int part) const;
    /** The linear map of waves, by a sweep for each contact and hinge. */
    void
    scatter();
    /** What the given stresses change in it. */
    void
    close_control();
    void
    find_modes();
    /** Strains and stresses of all nodes, from the offsets of the elements. */
    void
    sweep(const Vector6 &strain);
    void
    find_strain();
    /** The waves that reach contacts and hinges if none sends any. */
    void
    find_starts();
    /** Energies and new memory. */
    void
    account();
    void
    remember();

    // network_solver.cc
    template <bool with_slope>
    void
    project(const bool penalized);
    double
    evaluate();
    double
    evaluate_augmented();
    double
    relative_defect() const;
    double
    slope_along_direction();
    void
    solve_augmented();
    bool
    search_line();
    void
    minimize(const double tolerance);
    void
    raise_penalties();
    void
    factorize(const FullMatrix<double> &map, const double shift);
    void
    newton();
    void
    keep_best();
    bool
    is_finished() const;
    void
    iterate();
    void
    find_tangent();

    std::vector<Node>   nodes; ///< each before its parts
    std::vector<Leaf>   leaves;
    std::vector<int>    memory_of_class;
    unsigned int        n_memories  = 0;
    unsigned int        n_hardening = 0;
    double              dt          = 0.;
    std::array<bool, 6> stress_given{};

    // Spherical and deviatoric parts: waves from each contact and hinge to
    // each, from the strain of the whole, to the stress of the whole, and the
    // stiffness of the whole.
    std::array<std::vector<double>, 2> N, B, C;
    std::array<double, 2>              K;
    /** Inverse of K on the components with given stress. */
    Matrix6 compliance;
    /** N in all components, and with the stresses that are given. */
    FullMatrix<double> scattering, controlled;
    /** Eigenvectors of the latter by rows, and one less its eigenvalues. */
    FullMatrix<double> modes;
    Vector<double>     stiff_part;

    Vector6                  known_strain, known_stress, given_stress;
    const Vector6           *accepted_tensors = nullptr;
    const double            *accepted_scalars = nullptr;
    LAPACKFullMatrix<double> matrix;
    Vector<double>           rhs, work;
    double                   best_residual = 0.;
    unsigned int             best_at       = 0;
    std::vector<Vector6>     new_tensors;
    std::vector<double>      new_scalars;
    Step                     step;
  };
} // namespace Signoton::Rheology

#endif
