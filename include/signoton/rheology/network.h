#ifndef signoton_rheology_network_h
#define signoton_rheology_network_h

#include <signoton/rheology/scheme.h>
#include <signoton/tensors/mandel.h>

#include <deal.II/lac/lapack_full_matrix.h>

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
   * the step minimizes a convex potential: so $F$ is monotone. It is solved by
   * a semismooth Newton method whose matrix is shifted by a part of the
   * residual, with the projection onto a hyperplane of Solodov and Svaiter
   * (1998) where a Newton step does not help; this converges from everywhere,
   * also where strains of single elements are not unique.
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
    /** Iterations after which a step has failed, if still above 1e-10. */
    unsigned int maximum_iterations = 50;

  private:
    struct Node
    {
      Scheme::Kind              kind;
      std::vector<unsigned int> parts;
      Moduli                    moduli; ///< as in Scheme
      /** In this time step; the metric of contacts and hinges. */
      Moduli stiffness;
      /** Which remembered strain and scalar, or none. */
      int     memory = -1, hardening = -1;
      Vector6 strain, stress;
      Vector6 offset; ///< stress at zero strain
    };

    /** A contact or hinge. Waves are scaled by the root of its metric. */
    struct Leaf
    {
      Leaf(const unsigned int node, const AdmissibleSet &set, const double gap)
        : node(node)
        , set(set)
        , gap(gap)
      {}

      /** The wave that it sends back. */
      Vector6
      reflected() const
      {
        Vector6 result;
        for (unsigned int c = 0; c < 6; ++c)
          result[c] = 2. * admissible[c] - wave[c];
        return result;
      }

      unsigned int          node;
      AdmissibleSet         set;
      double                gap;
      std::array<double, 2> root; ///< of the spherical and deviatoric metric
      Vector6               reference; ///< strain $e_0$
      Vector6               start;  ///< wave if no contact or hinge sends any
      Vector6               wave;   ///< $t$
      Vector6               defect; ///< $-F(t)$
      Vector6               admissible; ///< $\pi(t)$
      Vector6               old_wave, old_defect, best_wave;
      Matrix6               reflection; ///< $2\,d\pi/dt-1$
      double                hardening;  ///< new plastic shear
      double                correction; ///< of the potential by hardening
    };

    /** Append a subtree; its elements share strains by class. */
    unsigned int
    add(const Scheme      &scheme,
        const unsigned int strain_class,
        unsigned int      &n_classes);
    void
    choose_metrics();
    /** The linear map of waves, by a sweep for each contact and hinge. */
    void
    scatter();
    void
    find_compliance();
    /** Strains and stresses of all nodes, from the offsets of the elements. */
    void
    sweep(const Vector6 &strain);
    template <bool with_tangent>
    void
    project();
    /** Defects of the present waves; the relative residual. */
    double
    evaluate();
    void
    factorize(const double shift);
    void
    iterate();
    void
    find_tangent();
    /** Energies and new memory. */
    void
    account(const Vector6 *tensors);

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

    Vector6                  known_strain, known_stress, given_stress;
    const double            *accepted_scalars = nullptr;
    double                   wave_scale       = 0.;
    LAPACKFullMatrix<double> matrix;
    Vector<double>           rhs;
    std::vector<Vector6>     new_tensors;
    std::vector<double>      new_scalars;
    Step                     step;
  };
} // namespace Signoton::Rheology

#endif
