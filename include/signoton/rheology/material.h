#ifndef signoton_rheology_material_h
#define signoton_rheology_material_h

#include <signoton/base/scene_file.h>
#include <signoton/rheology/law.h>

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
    check(const SceneFile &file) const;

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

    /** Moduli of the elastic spring. */
    Moduli
    elasticity() const;

    /** The law in words and formulas, for --explain. */
    std::string
    description() const;

    bool
    is_elastic() const;

    bool
    is_reversible() const;

    /** Whether a rigid contact confines the stress to a cone. */
    bool
    has_cone() const;

    /** Whether the tangent can vanish: at the vertex of a cone without a binder
     *  in parallel. */
    bool
    may_lose_stiffness() const;

    /** Whether an elastic binder is in parallel with the contact. */
    bool
    has_binder() const;

    std::string  name;
    unsigned int id      = 0;
    double       density = 0.;

  private:
    std::vector<std::string>
    required_keys() const;

    std::vector<std::string>
    optional_keys() const;

    Moduli
    binder(const std::optional<double> &ratio) const;

    /** Apex of the cone, the hydrostatic tensile strength $p_0$ in Pa. */
    double
    apex() const;

    std::string rheology                    = "elastic";
    std::string admissible_set              = "mises schleicher";
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
  };
} // namespace Signoton::Rheology

#endif
