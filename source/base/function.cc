#include <signoton/base/function.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

namespace Signoton
{
  namespace
  {
    /** Parse with the functions that FunctionParser adds to muparser's own.
     *  Only the error text is wanted here: FunctionParser itself would print
     *  it, on every rank, before it throws. */
    std::string
    error_in(const std::string &expression,
             const int          dim,
             const Constants   &constants)
    {
      mu::Parser                parser;
      std::array<double, 4>     values{{.5, .5, .5, .5}};
      const std::array<char, 3> names{{'x', 'y', 'z'}};
      const auto                one   = [](double) { return 1.; };
      const auto                two   = [](double, double) { return 1.; };
      const auto                three = [](double c, double a, double b) {
        return c != 0. ? a : b;
      };
      try
        {
          for (int d = 0; d < dim; ++d)
            parser.DefineVar(std::string(1, names[d]), &values[d]);
          parser.DefineVar("t", &values[3]);
          for (const auto &[name, value] : constants)
            parser.DefineConst(name, value);
          for (const char *name :
               {"int", "ceil", "cot", "csc", "floor", "sec", "erf", "erfc"})
            parser.DefineFun(name, one);
          parser.DefineFun("pow", two);
          parser.DefineFun("if", three);
          parser.DefineFun("rand", []() { return 1.; });
          parser.DefineFun("rand_seed", one);
          parser.DefineOprt("|", two, 1);
          parser.DefineOprt("&", two, 2);
          parser.SetExpr(expression);
          parser.Eval();
        }
      catch (const mu::ParserError &error)
        {
          return error.GetMsg();
        }
      return "";
    }

    bool
    is_name(const std::string &text)
    {
      return !text.empty() &&
             std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
             std::all_of(text.begin(), text.end(), [](const unsigned char c) {
               return std::isalnum(c) != 0 || c == '_';
             });
    }
  } // namespace

  Constants
  parse_constants(const std::string &text, const std::string &where)
  {
    Constants constants{{"pi", numbers::PI}};
    for (const auto &item : Utilities::split_string_list(text, ','))
      {
        const auto equal  = item.find('=');
        const auto refuse = [&](const std::string &expected) {
          throw UserError(where,
                          "'" + item + "'",
                          expected,
                          "for instance 'H = 10, q = 1e5'");
        };
        const std::string name = Utilities::trim(item.substr(0, equal));
        if (equal == std::string::npos || !is_name(name))
          refuse("assignments 'name = number', separated by commas");
        for (const char *variable : {"x", "y", "z", "t"})
          if (name == variable)
            refuse("a name other than those of the variables x, y, z, t");
        double value = 0.;
        try
          {
            value = Utilities::string_to_double(
              Utilities::trim(item.substr(equal + 1)));
          }
        catch (const ExceptionBase &)
          {
            refuse("a number after '='");
          }
        if (!std::isfinite(value))
          refuse("a finite number");
        if (!constants.emplace(name, value).second)
          refuse("each name once; pi is known already");
      }
    return constants;
  }

  bool
  depends_on(const std::string &expression, const char variable)
  {
    const auto in_name = [](const char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    };
    for (std::size_t i = 0; i < expression.size(); ++i)
      if (expression[i] == variable &&
          (i == 0 || !in_name(expression[i - 1])) &&
          (i + 1 == expression.size() || !in_name(expression[i + 1])))
        return true;
    return false;
  }

  bool
  depends_on_time(const std::string &expression)
  {
    return depends_on(expression, 't');
  }

  std::vector<std::string>
  split_components(const std::string &text,
                   const unsigned int n,
                   const std::string &where)
  {
    const auto parts = Utilities::split_string_list(text, ';');
    if (parts.size() != n)
      throw UserError(where,
                      "'" + text + "', " + std::to_string(parts.size()) +
                        " components",
                      std::to_string(n) + " expressions separated by ';'",
                      "give one expression for each direction");
    return parts;
  }

  template <int dim>
  SpaceTimeFunction<dim>::SpaceTimeFunction(
    const std::vector<std::string> &texts,
    const Constants                &constants,
    const std::string              &where)
    : Function<dim>(texts.size())
    , where(where)
    , constants(constants)
  {
    // in one dimension: of time alone, x is not to be used
    const std::string variables = dim == 1 ? "x,t" :
                                  dim == 2 ? "x,y,t" :
                                             "x,y,z,t";
    for (const std::string &text : texts)
      {
        components.emplace_back();
        components.back().text = text;
        if (TimeTable::is_table(text))
          {
            components.back().table =
              std::make_unique<TimeTable>(text, constants, where);
            continue;
          }
        const std::string error = error_in(text, dim == 1 ? 0 : dim, constants);
        if (!error.empty())
          throw UserError(where,
                          "'" + text + "' (" + error + ")",
                          "an expression in " + (dim == 1 ? "t" : variables) +
                            " and the " +
                            (dim == 1 ? "Constants" :
                                        "constants of 'Loads / Constants'"),
                          "see the function parser of deal.II and muparser");
        components.back().expression = std::make_unique<FunctionParser<dim>>(1);
        components.back().expression->initialize(variables,
                                                 text,
                                                 constants,
                                                 true);
      }
  }

  template <int dim>
  double
  SpaceTimeFunction<dim>::sample(const Point<dim>  &p,
                                 const unsigned int component) const
  {
    const Component &c = components[component];
    return c.table ? (*c.table)(this->get_time()) : c.expression->value(p);
  }

  template <int dim>
  double
  SpaceTimeFunction<dim>::value(const Point<dim>  &p,
                                const unsigned int component) const
  {
    const double value = sample(p, component);
    if (!std::isfinite(value) && found.empty())
      {
        std::ostringstream text;
        text << value << " at t = " << this->get_time() << " in the point "
             << p;
        found = text.str();
      }
    return value;
  }

  template <int dim>
  void
  SpaceTimeFunction<dim>::set_time(const double time)
  {
    Function<dim>::set_time(time);
    for (auto &component : components)
      if (component.expression)
        component.expression->set_time(time);
  }

  template <int dim>
  bool
  SpaceTimeFunction<dim>::varies() const
  {
    return std::any_of(components.begin(),
                       components.end(),
                       [](const Component &c) {
                         return c.table || depends_on_time(c.text);
                       });
  }

  template <int dim>
  bool
  SpaceTimeFunction<dim>::is_uniform() const
  {
    return std::none_of(components.begin(),
                        components.end(),
                        [](const Component &c) {
                          return !c.table && (depends_on(c.text, 'x') ||
                                              depends_on(c.text, 'y') ||
                                              depends_on(c.text, 'z'));
                        });
  }

  template <int dim>
  std::optional<double>
  SpaceTimeFunction<dim>::end_of_tables() const
  {
    std::optional<double> end;
    for (const Component &c : components)
      if (c.table && !(end && *end > c.table->times().back()))
        end = c.table->times().back();
    return end;
  }

  template <int dim>
  std::vector<Kink>
  SpaceTimeFunction<dim>::kinks(const double                   start,
                                const double                   end,
                                const std::vector<Point<dim>> &places)
  {
    std::vector<Kink> result;
    for (unsigned int c = 0; c < components.size(); ++c)
      {
        if (components[c].table)
          {
            for (const double time : components[c].table->times())
              result.push_back({time, time});
            continue;
          }
        auto found = find_kinks(components[c].text, constants, start, end);
        if (found.empty())
          continue;
        const auto at = [&](const double time) {
          set_time(time);
          std::vector<double> values;
          for (const Point<dim> &place : places)
            values.push_back(sample(place, c));
          return values;
        };
        // a jump is more than steepness over the round-off of the time
        constexpr unsigned int n_samples = 100;
        double                 scale     = 0.;
        const auto             measure   = [&](const double time) {
          for (const double v : at(time))
            if (std::isfinite(v))
              scale = std::max(scale, std::abs(v));
        };
        for (unsigned int i = 0; i <= n_samples; ++i)
          measure(start + (end - start) * i / n_samples);
        for (const Kink &kink : found)
          for (const double time : {kink.before, kink.after})
            measure(time);
        for (Kink &kink : found)
          {
            const auto before = at(kink.before), after = at(kink.after);
            for (std::size_t i = 0; i < places.size(); ++i)
              kink.jumps |= std::abs(after[i] - before[i]) > 1e-9 * scale;
          }
        result.insert(result.end(), found.begin(), found.end());
      }
    return result;
  }

  template <int dim>
  std::unique_ptr<SpaceTimeFunction<dim>>
  make_function(const std::vector<std::string> &components,
                const Constants                &constants,
                const std::string              &where)
  {
    return std::make_unique<SpaceTimeFunction<dim>>(components,
                                                    constants,
                                                    where);
  }

  template <int dim>
  void
  refuse_trouble(const MPI_Comm                           &communicator,
                 const std::vector<const Function<dim> *> &functions)
  {
    std::string trouble; // where and what, in two lines
    for (const auto *function : functions)
      if (const auto *scene =
            dynamic_cast<const SpaceTimeFunction<dim> *>(function);
          scene != nullptr && !scene->trouble().empty() && trouble.empty())
        trouble = scene->where + '\n' + scene->trouble();
    for (const auto &rank : Utilities::MPI::all_gather(communicator, trouble))
      if (const auto end = rank.find('\n'); end != std::string::npos)
        throw UserError(rank.substr(0, end),
                        rank.substr(end + 1),
                        "an expression that is finite at all points and times "
                        "that it is asked for",
                        "look for divisions by zero, roots and logarithms of "
                        "negative numbers; what was written before is "
                        "complete");
  }

#define INSTANTIATE(dim)                                                       \
  template class SpaceTimeFunction<dim>;                                       \
  template std::unique_ptr<SpaceTimeFunction<dim>> make_function<dim>(         \
    const std::vector<std::string> &, const Constants &, const std::string &); \
  template void refuse_trouble<dim>(                                           \
    const MPI_Comm &, const std::vector<const Function<dim> *> &);

  INSTANTIATE(1)
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
