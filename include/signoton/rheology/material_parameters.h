#ifndef signoton_rheology_material_parameters_h
#define signoton_rheology_material_parameters_h

#include <signoton/base/scene_file.h>
#include <signoton/rheology/material.h>

namespace Signoton::Rheology
{
  /**
   * The constants of a material in the scene file, and the material that they
   * make. The documentation strings of add_parameters() are the manual page of
   * every constant.
   */
  class MaterialParameters
  {
  public:
    /** @param name the subsection of `Materials` it stands in */
    explicit MaterialParameters(const std::string &name)
      : name(name)
    {}

    /** Declare the constants in the current section of @p handler. */
    void
    add_parameters(ParameterHandler &handler);

    /** Check the constants against each other, and that the file gives all
     *  that the rheology needs and nothing that it ignores; make the
     *  material. */
    Material
    make(const SceneFile &file);

    const std::string name;

  private:
    // what the file may say
    std::vector<std::string>
    required_keys() const;
    std::vector<std::string>
    optional_keys() const;
    void
    find_rheology(const SceneFile &file);
    void
    check_keys(const SceneFile &file) const;
    void
    check_numbers(const SceneFile &file) const;
    void
    check_set(const SceneFile &file) const;
    [[noreturn]] void
    refuse(const SceneFile   &file,
           const std::string &key,
           const std::string &expected,
           const std::string &hint) const;

    // the scheme that it means
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
    binder(const double ratio) const;
    std::string
    set_text(const bool with_cohesion = true) const;
    /** The text of what stands in braces in a ready scheme. */
    std::string
    element(const std::string &name, const double binder_ratio) const;
    Scheme
    scheme(const double binder_ratio) const;

    unsigned int id                          = 0;
    double       density                     = 0.;
    std::string  rheology                    = "elastic";
    std::string  admissible_set              = "mises schleicher";
    std::string  plastic_flow                = "series";
    std::string  binder_kind                 = "none";
    double       bulk_modulus                = 0.;
    double       shear_modulus               = 0.;
    double       young_modulus               = 0.;
    double       poisson_ratio               = 0.;
    double       friction_parameter          = 0.;
    double       friction_angle              = 0.;
    double       cohesion                    = 0.;
    double       tensile_strength            = 0.;
    double       shear_strength              = 0.;
    double       proportional_binder         = 1e-3;
    double       binder_bulk_modulus         = 0.;
    double       binder_shear_modulus        = 0.;
    double       isotropic_hardening_modulus = 0.;
    double       kinematic_hardening_modulus = 0.;
    double       bulk_viscosity              = 0.;
    double       shear_viscosity             = 0.;
    double       second_bulk_modulus         = 0.;
    double       second_shear_modulus        = 0.;
    double       gap                         = 0.;
    // where the rheology stands, and schemes by name
    std::string                        where;
    std::map<std::string, std::string> definitions;
  };
} // namespace Signoton::Rheology

#endif
