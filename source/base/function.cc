#include <signoton/base/function.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <muParser.h>

namespace Signoton
{
  namespace
  {
    /** muparser knows most of deal.II's functions; `if` and `rand` are what
     *  FunctionParser adds. Only the error text is wanted here. */
    std::string
    error_in(const std::string &expression,
             const int          dim,
             const Constants   &constants)
    {
      mu::Parser                parser;
      std::array<double, 4>     values{{.5, .5, .5, .5}};
      const std::array<char, 3> names{{'x', 'y', 'z'}};
      for (int d = 0; d < dim; ++d)
        parser.DefineVar(std::string(1, names[d]), &values[d]);
      parser.DefineVar("t", &values[3]);
      for (const auto &[name, value] : constants)
        parser.DefineConst(name, value);
      parser.DefineFun("if", [](double c, double a, double b) {
        return c != 0. ? a : b;
      });
      parser.DefineFun("floor", [](double a) { return std::floor(a); });
      parser.DefineFun("ceil", [](double a) { return std::ceil(a); });
      parser.DefineFun("pow",
                       [](double a, double b) { return std::pow(a, b); });
      try
        {
          parser.SetExpr(expression);
          parser.Eval();
        }
      catch (const mu::ParserError &error)
        {
          return error.GetMsg();
        }
      return "";
    }
  } // namespace

  Constants
  parse_constants(const std::string &text, const std::string &where)
  {
    Constants constants{{"pi", numbers::PI}};
    for (const auto &item : Utilities::split_string_list(text, ','))
      {
        const auto equal  = item.find('=');
        const auto refuse = [&]() {
          throw UserError(where,
                          "'" + item + "'",
                          "assignments 'name = number', separated by commas",
                          "for instance 'H = 10, q = 1e5'");
        };
        if (equal == std::string::npos)
          refuse();
        try
          {
            constants[Utilities::trim(item.substr(0, equal))] =
              Utilities::string_to_double(
                Utilities::trim(item.substr(equal + 1)));
          }
        catch (const ExceptionBase &)
          {
            refuse();
          }
      }
    return constants;
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
  std::unique_ptr<FunctionParser<dim>>
  make_function(const std::vector<std::string> &expressions,
                const Constants                &constants,
                const std::string              &where)
  {
    const std::string variables = dim == 2 ? "x,y,t" : "x,y,z,t";
    for (const std::string &expression : expressions)
      {
        const std::string error = error_in(expression, dim, constants);
        if (!error.empty())
          throw UserError(where,
                          "'" + expression + "' (" + error + ")",
                          "an expression in " + variables +
                            " and the constants of 'Loads / Constants'",
                          "see the function parser of deal.II and muparser");
      }
    auto function = std::make_unique<FunctionParser<dim>>(expressions.size());
    function->initialize(variables, expressions, constants, true);
    return function;
  }

  template std::unique_ptr<FunctionParser<2>>
  make_function<2>(const std::vector<std::string> &,
                   const Constants &,
                   const std::string &);
  template std::unique_ptr<FunctionParser<3>>
  make_function<3>(const std::vector<std::string> &,
                   const Constants &,
                   const std::string &);
} // namespace Signoton
