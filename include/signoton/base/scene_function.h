#ifndef signoton_base_scene_function_h
#define signoton_base_scene_function_h

#include <signoton/base/function.h>

namespace Signoton
{
  /**
   * An expression of the scene, as make_function() makes it, that remembers
   * where it has no finite value: the rank that meets it must not throw while
   * the others go on.
   */
  template <int dim>
  class SceneFunction : public FunctionParser<dim>
  {
  public:
    /** @param where place of the expressions, for messages */
    SceneFunction(const unsigned int n_components, const std::string &where)
      : FunctionParser<dim>(n_components)
      , where(where)
    {}

    double
    value(const Point<dim> &p, const unsigned int component = 0) const override;

    const std::string where;

    /** The first time and point, on this rank; empty if there is none. */
    const std::string &
    trouble() const
    {
      return found;
    }

  private:
    mutable std::string found;
  };

  /** Throw a UserError if one of some expressions had a value that is not
   *  finite on some rank; null pointers are skipped. Collective. */
  template <int dim>
  void
  refuse_trouble(const MPI_Comm                           &communicator,
                 const std::vector<const Function<dim> *> &functions);
} // namespace Signoton

#endif
