#ifndef signoton_rheology_library_h
#define signoton_rheology_library_h

#include <string>
#include <vector>

namespace Signoton::Rheology
{
  /** A scheme by name. Words in braces stand for elements that the constants of
   *  a material make, see Material. */
  struct ReadyScheme
  {
    std::string name;
    /** In chapter 2 of Sadovskaya and Sadovskii (2012), empty if none. */
    std::string figure;
    std::string text;
  };

  /** All of them, simple ones first. */
  const std::vector<ReadyScheme> &
  ready_schemes();

  /** The one of a name, or nullptr. */
  const ReadyScheme *
  ready_scheme(const std::string &name);
} // namespace Signoton::Rheology

#endif
