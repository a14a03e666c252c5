#include <signoton/base/function.h>

#include <deal.II/base/utilities.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace Signoton
{
  namespace
  {
    bool
    is_part_of_name(const char c)
    {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    }

    /** As FunctionParser has it. */
    double
    nearest_integer(const double d)
    {
      return std::trunc(d < 0. ? d - 0.5 : d + 0.5);
    }

    /** Something in an expression that takes integer values only. */
    struct Switch
    {
      enum class Kind
      {
        positive,     ///< d > 0
        not_negative, ///< d >= 0
        zero,         ///< d == 0
        integer,      ///< the largest integer that is not above d
        nearest,      ///< the nearest integer
        near_zero,    ///< whether that is zero
      };

      std::string text; ///< of the number d that it depends on
      Kind        kind;

      double
      operator()(const double d) const
      {
        switch (kind)
          {
            case Kind::positive:
              return d > 0. ? 1. : 0.;
            case Kind::not_negative:
              return d >= 0. ? 1. : 0.;
            case Kind::zero:
              return d == 0. ? 1. : 0.;
            case Kind::integer:
              return std::floor(d);
            case Kind::nearest:
              return nearest_integer(d);
            case Kind::near_zero:
              return nearest_integer(d) == 0. ? 1. : 0.;
          }
        return 0.;
      }

      /** Whether it changes where d passes zero. */
      bool
      has_threshold() const
      {
        return kind == Kind::positive || kind == Kind::not_negative;
      }
    };

    /**
     * The switches of an expression. Only parentheses, names and those
     * operators matter that bind less than arithmetic; whoever calls has made
     * sure that the expression can be parsed.
     */
    class SwitchReader
    {
    public:
      void
      read(const std::string &text)
      {
        // the weakest operators first
        for (const auto &operators : std::vector<std::vector<std::string>>{
               {"?", ":"}, {"||", "|"}, {"&&", "&"}})
          if (const auto parts = split(text, operators); parts.size() > 1)
            {
              for (const std::string &part : parts)
                read(part);
              return;
            }
        if (!read_comparison(text))
          read_arithmetic(text);
      }

      std::vector<Switch> switches;

    private:
      /** Parts between operators that are in no parentheses; the text itself
       *  if there is none. */
      static std::vector<std::string>
      split(const std::string &text, const std::vector<std::string> &operators)
      {
        std::vector<std::string> parts(1);
        int                      depth = 0;
        for (std::size_t i = 0; i < text.size();)
          {
            depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
            const auto found =
              depth > 0 ?
                operators.end() :
                std::find_if(operators.begin(),
                             operators.end(),
                             [&](const std::string &op) {
                               return text.compare(i, op.size(), op) == 0;
                             });
            if (found != operators.end())
              {
                parts.emplace_back();
                i += found->size();
              }
            else
              parts.back() += text[i++];
          }
        return parts;
      }

      void
      add(const Switch::Kind kind, const std::string &text)
      {
        switches.push_back({text, kind});
      }

      void
      add_difference(const Switch::Kind kind,
                     const std::string &a,
                     const std::string &b)
      {
        add(kind, "(" + a + ")-(" + b + ")");
      }

      bool
      read_comparison(const std::string &text)
      {
        const auto parts = split(text, {"<=", ">=", "==", "!=", "<", ">"});
        if (parts.size() < 2)
          return false;
        for (const std::string &part : parts)
          read(part);
        std::string left = parts[0];
        std::size_t at   = 0;
        for (std::size_t i = 1; i < parts.size(); ++i)
          {
            at += parts[i - 1].size();
            const bool is_long = text[at + 1] == '=';
            const char first   = text[at];
            add_difference(first == '=' || first == '!' ? Switch::Kind::zero :
                           (first == '<') == is_long ? // <= or >
                             Switch::Kind::positive :
                             Switch::Kind::not_negative,
                           left,
                           parts[i]);
            at += is_long ? 2 : 1;
            left = text.substr(0, at) + parts[i];
          }
        return true;
      }

      /** Where the parenthesis that opens at @p open closes. */
      static std::size_t
      closing(const std::string &text, const std::size_t open)
      {
        int         depth = 0;
        std::size_t i     = open;
        for (; i < text.size(); ++i)
          {
            depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
            if (depth == 0)
              break;
          }
        return i;
      }

      /** What is in parentheses, and what functions make of it. */
      void
      read_arithmetic(const std::string &text)
      {
        std::size_t open = text.find('(');
        while (open != std::string::npos)
          {
            const std::size_t close  = closing(text, open);
            const std::string before = Utilities::trim(text.substr(0, open));
            std::size_t       name   = before.size();
            while (name > 0 && is_part_of_name(before[name - 1]))
              --name;
            const auto arguments =
              split(text.substr(open + 1, close - open - 1), {","});
            for (const std::string &argument : arguments)
              read(argument);
            read_function(before.substr(name), arguments);
            open = text.find('(', close);
          }
      }

      void
      read_function(const std::string              &name,
                    const std::vector<std::string> &arguments)
      {
        const std::string &first = arguments[0];
        if (name == "abs" || name == "sign")
          add(Switch::Kind::positive, first);
        else if (name == "floor")
          add(Switch::Kind::integer, first);
        else if (name == "ceil")
          add(Switch::Kind::integer, "-(" + first + ")");
        else if (name == "rint") // as muparser has it
          add(Switch::Kind::integer, "(" + first + ")+0.5");
        else if (name == "int")
          add(Switch::Kind::nearest, first);
        else if (name == "if") // which rounds its condition
          add(Switch::Kind::near_zero, first);
        else if (name == "min" || name == "max")
          {
            std::string so_far = first;
            for (std::size_t i = 1; i < arguments.size(); ++i)
              {
                add_difference(Switch::Kind::positive, so_far, arguments[i]);
                so_far = name + "(" + so_far + "," + arguments[i] + ")";
              }
          }
      }
    };

    /** Finds where a switch changes in an interval of time. */
    class ChangeFinder
    {
    public:
      ChangeFinder(const Switch         &sw,
                   SpaceTimeFunction<1> &number,
                   const double          start,
                   const double          end)
        : sw(sw)
        , number(number)
        , start(start)
        , end(end)
      {}

      std::vector<Kink>
      find()
      {
        constexpr unsigned int n_samples = 20000;
        sample(n_samples);
        // there may be more of them than samples can tell
        if (changes.size() > n_samples / 20)
          sample(16 * n_samples);
        return changes;
      }

    private:
      struct Sample
      {
        double time, number, value;
      };

      Sample
      at(const double time)
      {
        number.set_time(time);
        const double d = number.value(Point<1>());
        return {time, d, sw(d)};
      }

      void
      sample(const unsigned int n)
      {
        changes.clear();
        Sample before = at(start), last = before;
        for (unsigned int i = 0; i <= n && !is_full(); ++i)
          {
            // irregular, so that no period goes by unseen
            double part = 0.6180339887498949 * i;
            part -= std::floor(part);
            const Sample next =
              at(i < n ? start + (i + part) / n * (end - start) : end);
            bracket(last, next);
            const double sign = last.number > 0. ? 1. : -1.;
            if (sw.has_threshold() && before.value == last.value &&
                last.value == next.value && before.time < last.time &&
                sign * last.number <= sign * before.number &&
                sign * last.number <= sign * next.number)
              look_between(before, last, next, sign);
            before = last;
            last   = next;
          }
        std::sort(changes.begin(),
                  changes.end(),
                  [](const Kink &a, const Kink &b) {
                    return a.before < b.before;
                  });
      }

      bool
      is_full() const
      {
        return changes.size() > most_kinks;
      }

      /** Around a sample that is nearer to zero than its neighbors. */
      void
      look_between(const Sample &before,
                   const Sample &middle,
                   const Sample &next,
                   const double  sign)
      {
        if (sign * middle.number == sign * before.number &&
            sign * middle.number == sign * next.number)
          return; // constant
        boost::uintmax_t limit   = 60;
        const auto       nearest = boost::math::tools::brent_find_minima(
          [&](const double time) { return sign * at(time).number; },
          before.time,
          next.time,
          std::numeric_limits<double>::digits / 2,
          limit);
        const Sample found = at(nearest.first);
        bracket(before, found);
        bracket(found, next);
      }

      /** All changes between two samples, to round-off. */
      void
      bracket(const Sample &from, const Sample &to)
      {
        if (from.value == to.value || is_full() ||
            (std::isnan(from.value) && std::isnan(to.value)))
          return;
        const double middle = from.time + 0.5 * (to.time - from.time);
        if (!(middle > from.time && middle < to.time) ||
            to.time - from.time < 1e-18 * (end - start))
          {
            changes.push_back({from.time, to.time});
            return;
          }
        const Sample half = at(middle);
        bracket(from, half);
        bracket(half, to);
      }

      const Switch         &sw;
      SpaceTimeFunction<1> &number;
      const double          start, end;
      std::vector<Kink>     changes;
    };

    /** Sort, and join what is not further apart than a round-off. */
    void
    join_kinks(std::vector<Kink> &kinks, const double round_off)
    {
      std::sort(kinks.begin(), kinks.end(), [](const Kink &a, const Kink &b) {
        return a.before < b.before;
      });
      std::vector<Kink> joined;
      for (const Kink &kink : kinks)
        if (joined.empty() || kink.before > joined.back().after + round_off)
          joined.push_back(kink);
        else
          {
            joined.back().after = std::max(joined.back().after, kink.after);
            joined.back().jumps |= kink.jumps;
          }
      kinks.swap(joined);
    }

    /** Times closer than this are one. */
    double
    time_resolution(const double start, const double end)
    {
      return 1e-12 * (end - start) + 8. *
                                       std::numeric_limits<double>::epsilon() *
                                       std::max(std::abs(start), std::abs(end));
    }
  } // namespace

  std::vector<Kink>
  find_kinks(const std::string &expression,
             const Constants   &constants,
             const double       start,
             const double       end)
  {
    SwitchReader reader;
    reader.read(expression);
    std::vector<Kink> kinks;
    for (const Switch &sw : reader.switches)
      {
        if (!depends_on_time(sw.text))
          continue;
        std::unique_ptr<SpaceTimeFunction<1>> number;
        try
          {
            number = make_function<1>({sw.text}, constants, "");
          }
        catch (const UserError &)
          {
            continue; // depends on space
          }
        const auto found = ChangeFinder(sw, *number, start, end).find();
        kinks.insert(kinks.end(), found.begin(), found.end());
        if (kinks.size() > most_kinks)
          join_kinks(kinks, time_resolution(start, end));
        if (kinks.size() > most_kinks)
          break;
      }
    join_kinks(kinks, time_resolution(start, end));
    return kinks;
  }

  void
  TimesToMeet::add(const std::vector<Kink> &more)
  {
    const double round_off = time_resolution(start, end);
    for (const Kink &kink : more)
      if (kink.jumps ?
            !(kink.before < start) && kink.before < end :
            kink.before > start + round_off && kink.after < end - round_off)
        kinks.push_back(kink);
    join_kinks(kinks, round_off);
  }

  double
  TimesToMeet::next(const double time) const
  {
    const auto found = std::upper_bound(kinks.begin(),
                                        kinks.end(),
                                        time,
                                        [](const double t, const Kink &kink) {
                                          return t < kink.before;
                                        });
    return found == kinks.end() ? end : found->before;
  }

  double
  TimesToMeet::end_before_jump() const
  {
    return kinks.empty() || kinks.back().after < end ? end :
                                                       kinks.back().before;
  }

  double
  TimesToMeet::end_of_step(const double time, const double size) const
  {
    const double met = next(time), left = met - time;
    if (left <= 1.001 * size)
      return met;
    return time + (left < 1.1 * size ? 0.5 * left : size);
  }

  double
  TimesToMeet::behind_jump(const double time) const
  {
    const auto found = std::lower_bound(kinks.begin(),
                                        kinks.end(),
                                        time,
                                        [](const Kink &kink, const double t) {
                                          return kink.before < t;
                                        });
    return found != kinks.end() && found->jumps && !(found->before > time) ?
             found->after :
             time;
  }

  std::vector<double>
  read_times(const std::string &text, const std::string &where)
  {
    std::vector<double> times;
    for (const auto &item : Utilities::split_string_list(text, ','))
      {
        double time = std::numeric_limits<double>::quiet_NaN();
        try
          {
            time = Utilities::string_to_double(item);
          }
        catch (const ExceptionBase &)
          {}
        if (!std::isfinite(time))
          throw UserError(where,
                          "'" + item + "'",
                          "a number",
                          "times in s, separated by commas");
        times.push_back(time);
      }
    return times;
  }
} // namespace Signoton
