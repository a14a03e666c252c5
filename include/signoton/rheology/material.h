#ifndef signoton_rheology_material_h
#define signoton_rheology_material_h

#include <signoton/base/scene_file.h>
#include <signoton/rheology/laws.h>

#include <optional>

namespace Signoton::Rheology
{
  /**
   * A material as the scene file describes it: its constants, and the law
   * they make. The documentation strings of add_parameters() are the manual
   * page of every constant.
   */
  class Material
  {
  public:
    /** @param name the subsection of `Materials` it stands in */
    explicit Material(const std::string &name)
      : name(name)
    {}

    /** Declare the constants in the current section of @p handler. */
    void
    add_parameters(ParameterHandler &handler);

    /** Check the constants against each other, and that the file gives all
     *  that the rheology needs and nothing that it ignores. */
    void
    check(const SceneFile &file);

    /**
     * The law of the material.
     * @param binder_ratio if given, replaces the ratio of a proportional
     *   binder: continuation solvers walk from a strong binder to a weak one
     */
    Law
    law(const std::optional<double> &binder_ratio = {}) const;

    /** The binder ratio if the material has a proportional binder, else 1. */
    double
    binder_ratio() const;

    /** Refuse an ill-posed scheme, see there. */
    void
    require_stress_from_strain() const;

    /** Refuse a scheme with a part that flows freely, see there. */
    void
    require_resistance() const;

    /** The scheme that the rheology names, with the constants filled in.
     *  @param binder_ratio as in law() */
    Scheme
    scheme(const std::optional<double> &binder_ratio = {}) const;

    /** Moduli of the springs, see spring_moduli(). */
    Moduli
    elasticity() const;

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

    bool
    is_elastic() const;

    bool
    is_reversible() const;

    bool
    is_viscous() const;

    /** Whether a rigid contact confines the stress to a cone. */
    bool
    has_cone() const;

    /** Whether the tangent can vanish: at the vertex of a cone without a binder
     *  in parallel. */
    bool
    may_lose_stiffness() const;

    /** Whether the stress of a step is the derivative of a potential. If not,
     *  the tangent is not symmetric. */
    bool
    has_potential() const;

    /** Whether an elastic binder is in parallel with the contact. */
    bool
    has_binder() const;

    /** Of the binder in parallel with the contact; zero if there is none. Where
     *  the hinge is in series with the contact it bridges both. */
    Moduli
    binder() const;

    std::string  name;
    unsigned int id      = 0;
    double       density = 0.;

  private:
    std::vector<std::string>
    required_keys() const;

    std::vector<std::string>
    optional_keys() const;

    /** Whether the ready scheme has an element in braces. */
    bool
    uses(const std::string &element) const;

    bool
    uses_set() const;

    bool
    may_be_bound() const;

    Moduli
    spring() const;

    Moduli
    binder(const std::optional<double> &ratio) const;

    /** The text of what stands in braces in a ready scheme. */
    std::string
    element(const std::string &name, const std::optional<double> &ratio) const;

    std::string
    set_text(const bool with_cohesion = true) const;

    std::string rheology                    = "elastic";
    std::string admissible_set              = "mises schleicher";
    std::string plastic_flow                = "series";
    std::string binder_kind                 = "none";
    double      bulk_modulus                = 0.;
    double      shear_modulus               = 0.;
    double      young_modulus               = 0.;
    double      poisson_ratio               = 0.;
    double      friction_parameter          = 0.;
    double      friction_angle              = 0.;
    double      cohesion                    = 0.;
    double      tensile_strength            = 0.;
    double      shear_strength              = 0.;
    double      proportional_binder         = 1e-3;
    double      binder_bulk_modulus         = 0.;
    double      binder_shear_modulus        = 0.;
    double      isotropic_hardening_modulus = 0.;
    double      kinematic_hardening_modulus = 0.;
    double      bulk_viscosity              = 0.;
    double      shear_viscosity             = 0.;
    double      second_bulk_modulus         = 0.;
    double      second_shear_modulus        = 0.;
    double      gap                         = 0.;
    // of check(): where the rheology stands, and schemes by name
    std::string                        where;
    std::map<std::string, std::string> definitions;
  };
} // namespace Signoton::Rheology

#endif
