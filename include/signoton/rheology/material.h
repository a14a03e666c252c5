#ifndef signoton_rheology_material_h
#define signoton_rheology_material_h

#include <signoton/rheology/laws.h>
#include <signoton/rheology/scheme.h>

#include <functional>

namespace Signoton::Rheology
{
  /** A material, made once by MaterialParameters: its scheme, and what others
   *  want to know of it. */
  struct Material
  {
    std::string  name; ///< the subsection of `Materials` it stands in
    unsigned int id      = 0;
    double       density = 0.; ///< in kg/m^3, zero for none
    std::string  rheology;     ///< as the file has it
    std::string  where;        ///< in the file that stands
    Scheme       scheme;

    /** Moduli of the springs, see spring_moduli(). */
    Moduli elasticity = {0., 0.};
    /** Of the elastic binder in parallel with the contact; zero if there is
     *  none. Where the hinge is in series with the contact it bridges both. */
    Moduli binder     = {0., 0.};
    bool   has_binder = false;
    /** Of a proportional binder, else 1. */
    double binder_ratio = 1.;
    /** The scheme with another ratio of a proportional binder. */
    std::function<Scheme(const double)> with_binder_ratio;

    bool is_elastic    = false; ///< a spring and nothing else
    bool is_reversible = false; ///< without hinges and dampers
    bool is_viscous    = false;
    bool has_cone      = false; ///< a rigid contact confines the stress
    /** Whether the stress of a step is the derivative of a potential. If not,
     *  the tangent is not symmetric. */
    bool has_potential = true;
    /** Whether the tangent can vanish: at the vertex of a cone without a binder
     *  in parallel. */
    bool may_lose_stiffness = false;

    /** $\sqrt{(k+4\mu/3)/\rho}$ of the closed medium in m/s. */
    double
    longitudinal_speed() const;

    /**
     * A distance in m by the speed that bounds the frequencies of cells, in s.
     * With the Lame constants of the closed medium that speed is
     * $\sqrt{(n\lambda+2\mu)/\rho}$ for equal extensions in n directions, at
     * least $\sqrt{2\mu/\rho}$ for shear; dampers are as stiff as they are in a
     * step of the time sought.
     */
    double
    crossing_time(const double distance, const unsigned int n_extensions) const;

    /** The law in words and formulas, for --explain. */
    std::string
    description() const;
  };

  /** What of a law is other than the file says, on the way to a solution. */
  struct Scaling
  {
    /** Proportional binders are at least as strong: continuation walks from
     *  strong ones to weak ones. */
    double least_binder_ratio = 0.;
  };

  Law
  make_law(const Material &material, const Scaling &scaling = {});
} // namespace Signoton::Rheology

#endif
