#include <signoton/base/csv_table.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace Signoton
{
  CSVTable::CSVTable(const MPI_Comm &communicator, const std::string &file_name)
    : communicator(communicator)
    , file_name(file_name)
  {}

  std::string
  CSVTable::header(const Names &names)
  {
    std::string text;
    for (const std::string &name : names)
      {
        text += text.empty() ? "\"" : ",\"";
        for (const char c : name)
          text += c == '"' ? "\"\"" : std::string(1, c);
        text += '"';
      }
    return text + '\n';
  }

  std::string
  CSVTable::line(const Numbers &row)
  {
    std::ostringstream text;
    text.precision(12);
    for (std::size_t i = 0; i < row.size(); ++i)
      text << (i > 0 ? "," : "") << row[i];
    text << '\n';
    return text.str();
  }

  CSVTable::Fields
  CSVTable::split(const std::string &line)
  {
    Fields fields;
    bool   quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i)
      {
        if (fields.empty())
          fields.emplace_back();
        const char c = line[i];
        if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
          fields.back() += line[++i];
        else if (c == '"')
          quoted = !quoted;
        else if (c == ',' && !quoted)
          fields.emplace_back();
        else
          fields.back() += c;
      }
    return fields;
  }

  void
  CSVTable::resume(const std::size_t n_blocks, const bool by_lines)
  {
    old_names.clear();
    old_rows.clear();
    if (Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    std::ifstream file(file_name);
    std::string   text;
    if (std::getline(file, text))
      old_names = split(text);
    for (std::size_t n = 0; n < n_blocks && std::getline(file, text);)
      {
        old_rows.push_back(split(text));
        n += by_lines || text.empty() ? 1 : 0;
      }
  }

  std::string
  CSVTable::rearrange(const Names &names)
  {
    Names                    all(names), added, gone;
    std::vector<std::size_t> place;
    for (const std::string &name : old_names)
      {
        const auto found = std::find(all.begin(), all.end(), name);
        place.push_back(found - all.begin());
        if (found == all.end())
          all.push_back(name);
        if (place.back() >= names.size())
          gone.push_back(name);
      }
    for (const std::string &name : names)
      if (std::find(old_names.begin(), old_names.end(), name) ==
          old_names.end())
        added.push_back(name);
    padding = std::string(all.size() - names.size(), ',');
    for (Fields &row : old_rows)
      if (!row.empty()) // as the ends of blocks are
        {
          Fields moved(all.size());
          for (std::size_t i = 0; i < std::min(row.size(), place.size()); ++i)
            moved[place[i]] = row[i];
          row = moved;
        }
    const bool was_there = !old_names.empty();
    old_names            = all;
    if (!was_there || (added.empty() && gone.empty()))
      return "";
    const auto list = [](const Names &some) {
      std::string text;
      for (const std::string &name : some)
        text += (text.empty() ? "'" : ", '") + name + "'";
      return text;
    };
    return "Columns of " + file_name + " since the restart:" +
           (added.empty() ? "" : " new " + list(added) + ", empty before") +
           (added.empty() || gone.empty() ? "" : ";") +
           (gone.empty() ? "" : " no longer " + list(gone) + ", empty now") +
           "\n";
  }

  std::string
  CSVTable::append(const Names                &names,
                   const std::vector<Numbers> &rows,
                   const bool                  ends_block)
  {
    std::string text, change;
    const bool  begins = !has_begun;
    if (begins)
      {
        change = rearrange(names);
        text   = header(old_names);
        for (const Fields &row : old_rows)
          {
            for (std::size_t i = 0; i < row.size(); ++i)
              text += (i > 0 ? "," : "") + row[i];
            text += '\n';
          }
      }
    for (const Numbers &row : rows)
      {
        text += line(row);
        text.insert(text.size() - 1, padding);
      }
    if (ends_block)
      text += '\n';
    write_file(communicator,
               file_name,
               text,
               begins ? WriteMode::replace : WriteMode::append);
    has_begun = true;
    old_names.clear();
    old_rows.clear();
    old_rows.shrink_to_fit();
    return change;
  }

  std::string
  CSVTable::append(const Row &row)
  {
    Names   names;
    Numbers numbers;
    for (const auto &[name, number] : row)
      {
        names.push_back(name);
        numbers.push_back(number);
      }
    return append(names, {numbers});
  }

  std::vector<CSVTable::Row>
  CSVTable::read(const std::string &file_name)
  {
    std::ifstream    file(file_name);
    std::string      text;
    std::vector<Row> rows;
    std::getline(file, text);
    const Fields names = split(text);
    while (std::getline(file, text))
      {
        const Fields fields = split(text);
        Row          row;
        for (std::size_t i = 0; i < std::min(fields.size(), names.size()); ++i)
          if (!fields[i].empty())
            row.emplace_back(names[i], std::strtod(fields[i].c_str(), nullptr));
        if (!row.empty())
          rows.push_back(row);
      }
    return rows;
  }
} // namespace Signoton
