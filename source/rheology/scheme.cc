#include <signoton/base/exceptions.h>
#include <signoton/base/quoting.h>
#include <signoton/base/scene_file.h>
#include <signoton/rheology/scheme.h>

#include <deal.II/base/utilities.h>

#include <cctype>
#include <cmath>
#include <optional>

namespace Signoton::Rheology
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    // wider than what is allowed for the keys of a material, from which the
    // moduli of a ready scheme are derived
    constexpr double smallest = 1e-40, largest = 1e40;

    /** A named number of an element. */
    struct Argument
    {
      std::string name;
      double      value;
      std::size_t position; ///< in the text
      bool        is_used = false;
    };

    /** What a number may be. */
    struct Range
    {
      double      lowest, highest; ///< excluded if the lowest is not allowed
      bool        with_lowest;
      std::string words;
    };

    const Range positive{0., infinity, false, "a positive number"};
    const Range not_negative{0., infinity, true, "a number not below zero"};
    const Range angle{1.6, 89.9, true, "an angle in degrees, 1.6 to 89.9"};
    const Range poisson_range{-1., 0.5, false, "a number above -1, below 0.5"};

    /** Whether a set admits tension; for sets of contacts. */
    bool
    is_cohesive(const AdmissibleSet &set)
    {
      return std::visit(
        [](const auto &s) {
          if constexpr (std::is_same_v<std::decay_t<decltype(s)>,
                                       VonMisesCylinder<false>> ||
                        std::is_same_v<std::decay_t<decltype(s)>,
                                       VonMisesCylinder<true>>)
            return false;
          else
            return s.apex_tension() > 0.;
        },
        set);
    }

    const std::vector<std::string> reserved =
      {"series", "parallel", "spring", "damper", "hinge", "contact"};

    constexpr unsigned int most_nodes = 1000;

    /** Recursive descent through one text. Words may contain blanks. */
    class Parser
    {
    public:
      Parser(const std::string                        &text,
             const std::string                        &where,
             const std::map<std::string, std::string> &definitions,
             const std::vector<std::string>           &open,
             unsigned int                             &n_nodes)
        : text(text)
        , where(where)
        , definitions(definitions)
        , open(open)
        , n_nodes(n_nodes)
      {}

      Scheme
      whole()
      {
        Scheme scheme = node();
        skip_blanks();
        if (position < text.size())
          refuse(position, "the end of the scheme");
        return scheme;
      }

    private:
      [[noreturn]] void
      refuse(const std::size_t  at,
             const std::string &expected,
             const std::string &hint = "") const
      {
        // the part of the text around the mark, on one line
        const std::size_t begin = at > 50 ? at - 40 : 0;
        std::string       part  = text.substr(begin, 70);
        for (char &c : part)
          if (std::isspace(static_cast<unsigned char>(c)) != 0)
            c = ' ';
        const std::string dots = begin > 0 ? "... " : "";
        throw UserError(
          where,
          dots + part + (begin + 70 < text.size() ? " ..." : "") + "\n" +
            std::string(12 + dots.size() + at - begin, ' ') + "^",
          expected,
          hint.empty() ? "for instance series(spring(bulk = 1e8, shear = 6e7), "
                         "contact(mises schleicher, friction = 0.5))" :
                         hint);
      }

      void
      skip_blanks()
      {
        while (position < text.size() &&
               std::isspace(static_cast<unsigned char>(text[position])) != 0)
          ++position;
      }

      bool
      take(const char c)
      {
        skip_blanks();
        if (position >= text.size() || text[position] != c)
          return false;
        ++position;
        return true;
      }

      void
      require(const char c, const std::string &expected)
      {
        if (!take(c))
          refuse(position, expected);
      }

      /** Letters and digits with single blanks between words. */
      std::string
      words()
      {
        skip_blanks();
        std::string result = quoted_words();
        while (position < text.size() &&
               std::string("(),=").find(text[position]) == std::string::npos)
          {
            const char c = text[position++];
            if (std::isspace(static_cast<unsigned char>(c)) == 0)
              result += c;
            else if (!result.empty() && result.back() != ' ')
              result += ' ';
          }
        return Utilities::trim(result);
      }

      /** What stands in quotes here, if anything does. */
      std::string
      quoted_words()
      {
        const std::string rest = text.substr(position);
        if (rest.empty() || rest[0] != '"')
          return "";
        // the first mark behind the quotes
        std::size_t end = rest.size();
        for (const char mark : {'(', ')', ',', '='})
          end = std::min(end, find_unquoted(rest, mark));
        const std::string words = Utilities::trim(rest.substr(0, end));
        if (unquoted(words) == words)
          return "";
        position += end;
        return unquoted(words);
      }

      Scheme
      node()
      {
        skip_blanks();
        const std::size_t begin = position;
        const std::string name  = words();
        Scheme            scheme;
        if (++n_nodes > most_nodes)
          refuse(begin,
                 "at most " + std::to_string(most_nodes) +
                   " elements and "
                   "groups",
                 "do definitions contain others more than once?");
        if (name == "series" || name == "parallel")
          {
            scheme.kind =
              name == "series" ? Scheme::Kind::series : Scheme::Kind::parallel;
            require('(', "'(' and the parts of the group");
            do
              scheme.parts.push_back(node());
            while (take(','));
            if (scheme.parts.size() < 2)
              refuse(position, "',' and a second part of the group");
            require(')', "',' and another part, or ')'");
          }
        else if (name == "spring" || name == "damper" || name == "hinge" ||
                 name == "contact")
          scheme = element(name, begin);
        else
          scheme = definition(name, begin);
        if (scheme.text.empty())
          scheme.text = text.substr(begin, position - begin);
        return scheme;
      }

      Scheme
      definition(const std::string &name, const std::size_t at)
      {
        std::vector<std::string> known = reserved;
        for (const auto &entry : definitions)
          known.push_back(entry.first);
        const auto found = definitions.find(name);
        if (found == definitions.end())
          {
            const std::string nearest = nearest_name(name, known);
            refuse(at,
                   "one of: " + join(known, ", "),
                   nearest.empty() ? "" : "did you mean '" + nearest + "'?");
          }
        if (std::find(open.begin(), open.end(), name) != open.end())
          refuse(at,
                 "a scheme that does not contain itself",
                 "'" + name + "' is defined by " + join(open, ", then "));
        std::vector<std::string> now_open(open);
        now_open.push_back(name);
        Scheme scheme = Parser(found->second,
                               where + ", scheme '" + name + "'",
                               definitions,
                               now_open,
                               n_nodes)
                          .whole();
        scheme.text = name;
        return scheme;
      }

      Scheme
      element(const std::string &name, const std::size_t begin)
      {
        Scheme scheme;
        arguments.clear();
        asked.clear();
        require('(', "'(' and the constants of the " + name);
        std::string set;
        skip_blanks();
        const std::size_t set_at = position;
        bool              more   = !(name == "hinge" || name == "contact");
        if (!more)
          {
            set  = words();
            more = take(',');
          }
        skip_blanks();
        if (!more)
          require(')', "',' and a constant, or ')'");
        else if (set.empty() && take(')'))
          ; // what is missing is told below
        else
          {
            do
              arguments.push_back(argument());
            while (take(','));
            require(')', "',' and another constant, or ')'");
          }
        end_of_element = position;
        if (name == "spring")
          {
            scheme.kind = Scheme::Kind::spring;
            if (is_given("young"))
              {
                const double E  = number("young", positive);
                const double nu = number("poisson", poisson_range);
                scheme.moduli   = {E / (3. * (1. - 2. * nu)),
                                   E / (2. * (1. + nu))};
              }
            else
              {
                scheme.moduli.bulk = number("bulk", not_negative);
                scheme.moduli.shear =
                  number("shear",
                         scheme.moduli.bulk > 0. ? not_negative : positive);
              }
          }
        else if (name == "damper")
          {
            scheme.kind        = Scheme::Kind::damper;
            scheme.moduli.bulk = number("bulk viscosity", not_negative, 0.);
            scheme.moduli.shear =
              number("shear viscosity",
                     scheme.moduli.bulk > 0. ? not_negative : positive,
                     scheme.moduli.bulk > 0. ? std::optional<double>(0.) :
                                               std::nullopt);
          }
        else
          {
            scheme.kind =
              name == "hinge" ? Scheme::Kind::hinge : Scheme::Kind::contact;
            scheme.set.push_back(admissible_set(set, set_at, scheme.kind));
            if (scheme.kind == Scheme::Kind::contact)
              {
                scheme.gap = number("gap", not_negative, 0.);
                if (scheme.gap > 0. &&
                    std::holds_alternative<NoCompression>(scheme.set[0]))
                  refuse(end_of_element - 1,
                         "no gap of a contact that carries tension alone",
                         "a gap closes under compression");
                if (scheme.gap > 0. && is_cohesive(scheme.set[0]))
                  refuse(end_of_element - 1,
                         "no cohesion where there is a gap",
                         "sides that are apart do not pull: leave out the gap "
                         "or the strength in tension");
              }
          }
        for (const auto &argument : arguments)
          if (!argument.is_used)
            refuse(argument.position,
                   "no '" + argument.name + "' in a " + name +
                     (set.empty() ? "" : " on " + set),
                   "allowed here: " + join(asked, ", "));
        scheme.text = text.substr(begin, position - begin);
        return scheme;
      }

      AdmissibleSet
      admissible_set(const std::string  &set,
                     const std::size_t   at,
                     const Scheme::Kind &kind)
      {
        const bool is_hinge = kind == Scheme::Kind::hinge;
        if (set == "mises schleicher")
          {
            const double kappa = number("friction", positive);
            return MisesSchleicherCone(kappa,
                                       number("cohesion", not_negative, 0.) /
                                         kappa);
          }
        if (set == "coulomb mohr")
          {
            const double phi =
              number("friction angle", angle) * numbers::PI / 180.;
            return PrincipalSet::coulomb_mohr(
              phi, number("cohesion", not_negative, 0.) / std::tan(phi));
          }
        if (set == "hydrostatic" && is_hinge)
          {
            const double strength = number("strength", positive);
            return HydrostaticSet(strength, strength);
          }
        if (set == "hydrostatic")
          return HydrostaticSet(number("tensile strength", not_negative, 0.));
        if (set == "no tension" && !is_hinge)
          return PrincipalSet::no_tension(
            number("tensile strength", not_negative, 0.));
        if (set == "no compression" && !is_hinge)
          return NoCompression();
        if (set == "tresca" && is_hinge)
          return PrincipalSet::tresca(number("strength", positive));
        if (set == "von mises" && is_hinge)
          {
            const double strength = number("strength", positive);
            const double hardening =
              number("isotropic hardening", not_negative, 0.);
            if (hardening > 0.)
              return VonMisesCylinder<true>(strength, hardening);
            return VonMisesCylinder<false>(strength);
          }
        refuse(at,
               is_hinge ? "a yield set: von mises, tresca, mises schleicher, "
                          "coulomb mohr or hydrostatic" :
                          "a cone: mises schleicher, coulomb mohr, no tension, "
                          "no compression or hydrostatic",
               is_hinge ? "hinge(von mises, strength = 1e5)" :
                          "contact(coulomb mohr, friction angle = 30)");
      }

      Argument
      argument()
      {
        skip_blanks();
        Argument result;
        result.position = position;
        result.name     = words();
        if (result.name.empty())
          refuse(position, "the name of a constant");
        require('=', "'=' and a number");
        skip_blanks();
        const std::size_t at    = position;
        const std::string value = words();
        try
          {
            result.value = Utilities::string_to_double(value);
          }
        catch (const ExceptionBase &)
          {
            refuse(at, "a number");
          }
        if (!std::isfinite(result.value))
          refuse(at, "a finite number");
        if (const double size = std::abs(result.value);
            size > 0. && !(size >= smallest && size <= largest))
          refuse(at, "zero, or a number of a size between 1e-40 and 1e40");
        for (const auto &other : arguments)
          if (other.name == result.name)
            refuse(result.position, "each constant once");
        return result;
      }

      bool
      is_given(const std::string &name) const
      {
        return std::any_of(arguments.begin(),
                           arguments.end(),
                           [&](const auto &a) { return a.name == name; });
      }

      /** Use an argument up. */
      double
      number(const std::string           &name,
             const Range                 &range,
             const std::optional<double> &fallback = {})
      {
        asked.push_back(name);
        for (auto &argument : arguments)
          if (argument.name == name && !argument.is_used)
            {
              if (!(argument.value > range.lowest ||
                    (range.with_lowest && argument.value >= range.lowest)) ||
                  !(argument.value < range.highest))
                refuse(argument.position, name + ": " + range.words);
              argument.is_used = true;
              return argument.value;
            }
        if (fallback)
          return *fallback;
        for (const auto &argument : arguments)
          if (nearest_name(argument.name, {name}) == name)
            refuse(argument.position,
                   "'" + name + " = ' and " + range.words,
                   "did you mean '" + name + "'?");
        refuse(end_of_element - 1, "'" + name + " = ' and " + range.words);
      }

      const std::string                        &text;
      const std::string                        &where;
      const std::map<std::string, std::string> &definitions;
      const std::vector<std::string>            open;
      unsigned int            &n_nodes; ///< so far, of all texts
      std::size_t              position       = 0;
      std::size_t              end_of_element = 0;
      std::vector<Argument>    arguments;
      std::vector<std::string> asked;
    };
  } // namespace

  Scheme
  parse_scheme(const std::string                        &text,
               const std::string                        &where,
               const std::map<std::string, std::string> &definitions)
  {
    unsigned int n_nodes = 0;
    return Parser(text, where, definitions, {}, n_nodes).whole();
  }

  bool
  is_scheme_name(const std::string &name)
  {
    return std::find(reserved.begin(), reserved.end(), name) == reserved.end();
  }
} // namespace Signoton::Rheology
