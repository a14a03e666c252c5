#ifndef signoton_base_scene_file_h
#define signoton_base_scene_file_h

#include <signoton/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Signoton
{
  using namespace dealii;

  /**
   * A parameter file in deal.II's format as a list of assignments with the
   * lines they stand in, so that every complaint can name its place.
   *
   * The class adds to ParameterHandler what a strict reading needs: sections
   * whose names the user chooses can be listed before anything is declared,
   * a misspelt name is answered with the nearest declared one, and later
   * checks across keys can still point to the line.
   */
  class SceneFile
  {
  public:
    /** The names of nested sections, outermost first. */
    using Path = std::vector<std::string>;

    SceneFile() = default;

    /** Read a file; a missing or unbalanced one is a UserError. */
    static SceneFile
    read(const std::string &file_name);

    /** Read text, @p name standing in for the file name in messages. */
    static SceneFile
    parse(const std::string &text, const std::string &name);

    /** Add an assignment from the command line, `Section/Key=value`. */
    void
    override_entry(const std::string &assignment);

    /** Set one entry, or change its value where it stands. */
    void
    set(const Path &path, const std::string &key, const std::string &value);

    /** Remove a section with all that is below, or a key. */
    void
    remove(const Path &path, const std::string &key = "");

    /** Names of the sections directly below @p path, in order of the file. */
    std::vector<std::string>
    subsections(const Path &path) const;

    /** The value given for a key, or @p fallback if the file has none. */
    std::string
    value(const Path        &path,
          const std::string &key,
          const std::string &fallback = "") const;

    bool
    has(const Path &path, const std::string &key) const;

    /** The keys given in a section, each once. */
    std::vector<std::string>
    keys(const Path &path) const;

    /** `file, line n: Section / Key`, or the best approximation to it. */
    std::string
    where(const Path &path, const std::string &key = "") const;

    /** Hand all entries to a handler that has everything declared. Unknown
     *  names and values that break their pattern throw a UserError. */
    void
    apply_to(ParameterHandler &handler) const;

    /** Remove the keys of top sections, and whole sections, that one handler has
     *  and the other has not.
     *  @return where they stood */
    std::vector<std::string>
    drop(const ParameterHandler &others, const ParameterHandler &own);

    /** All entries, the last one of each key, as a parameter file. */
    std::string
    text() const;

    /** The directory of the file, to resolve other names against. */
    std::string
    directory() const;

  private:
    struct Entry
    {
      Path         path;
      std::string  key;
      std::string  value;
      unsigned int line; ///< 0 for the command line
    };

    void
    open_sections(const Path &path);

    const Entry *
    find(const Path &path, const std::string &key) const;

    std::string
    place(const Entry &entry) const;

    std::string        name;
    std::vector<Entry> entries;
    /** Sections that were opened, with the line, even if they are empty. */
    std::vector<std::pair<Path, unsigned int>> sections;
  };

  /** The candidate with the smallest edit distance, or an empty string if
   *  none is close. */
  std::string
  nearest_name(const std::string              &word,
               const std::vector<std::string> &candidates);

  /** Items joined by a separator. */
  std::string
  join(const std::vector<std::string> &items, const std::string &separator);
} // namespace Signoton

#endif
