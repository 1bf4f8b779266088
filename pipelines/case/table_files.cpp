#include "pipelines/case/table_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "nurbs/number_text.h"
#include "pipelines/case/quantity.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

using Kind = Shape::Kind;
constexpr std::size_t most_rows = 1'000'000;

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r\""), end = text.find_last_not_of(" \t\r\"");
  return begin == std::string::npos ? std::string() : text.substr(begin, end - begin + 1);
}

// Whether a space stands before or in the brackets of a unit: "moment [N m]".
bool is_before_or_in_brackets(const std::string& line, std::size_t space) {
  const auto opens = line.find_last_of("[(", line.find_first_not_of(' ', space));
  if (opens == std::string::npos) return false;
  const auto closes = line.find_first_of(")]", opens);
  return opens > space || (closes > space && closes != std::string::npos);
}

// What stands between commas or, where there are none, semicolons, tabs or spaces.
std::vector<std::string> cells_of(const std::string& line) {
  char separator = ' ';
  for (const char each : {',', ';', '\t'})
    if (separator == ' ' && line.find(each) != std::string::npos) separator = each;
  std::vector<std::string> cells;
  std::string cell;
  const std::string ended = line + separator;
  for (std::size_t i = 0; i < ended.size(); ++i) {
    if (ended[i] != separator || (separator == ' ' && is_before_or_in_brackets(line, i))) {
      cell += ended[i];
    } else if (separator != ' ' || !trimmed(cell).empty()) {
      cells.push_back(trimmed(cell));
      cell.clear();
    }
  }
  return cells;
}

std::optional<double> number_of(const std::string& cell) {
  const char* begin = cell.data() + (cell.starts_with('+') ? 1 : 0);
  const char* const end = cell.data() + cell.size();
  double number = 0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  const bool whole = error == std::errc{} && stop == end && std::isfinite(number);
  return whole ? std::optional(number) : std::nullopt;
}

// "z [mm]", "z (mm)" and "z/mm" are the column z in millimetres.
struct Column {
  std::string name;
  std::optional<std::string> unit = {};
  bool in_brackets = false;  // where nothing but a unit can stand
};

// Without the brackets around it.
std::optional<std::string> known_unit(const std::string& text) {
  const std::string unit =
      text.starts_with('(') && text.ends_with(')') ? text.substr(1, text.size() - 2) : text;
  const bool is_word = unit.find_first_not_of("0123456789 ./-") != std::string::npos;
  return is_word && in_si_units(unit) ? std::optional(trimmed(unit)) : std::nullopt;
}

// "z (left)" and "F/F0" are names.
Column column_of(const std::string& heading) {
  const std::size_t bracket = heading.find('[');
  if (bracket != std::string::npos && heading.ends_with(']'))
    return {trimmed(heading.substr(0, bracket)),
            trimmed(heading.substr(bracket + 1, heading.size() - bracket - 2)), true};
  for (const std::size_t end : {heading.rfind('('), heading.find('/')}) {
    if (end == std::string::npos || end == 0) continue;
    if (const auto unit = known_unit(trimmed(heading.substr(end + (heading[end] == '/' ? 1 : 0)))))
      return {trimmed(heading.substr(0, end)), unit};
  }
  return {heading};
}

// The t of f(t), the h of x/h, the g of a/g and the least force of "F (min)", where they are no units of what
// the column holds.
bool is_symbol(const Column& column, Dimension dimension) {
  const std::string& unit = *column.unit;
  const bool may_be = unit == "t" || unit == "h" || unit == "g" || unit == "min";
  return may_be && !column.in_brackets && !parse_quantity("1 " + unit, dimension).value;
}

// The lines of a file that count, with their numbers.
struct Line {
  int number;
  std::vector<std::string> cells;
};

class TableFile {
 public:
  TableFile(const Shape& shape, const Json& json, std::string path, const std::filesystem::path& directory,
            Findings& findings)
      : shape_(shape),
        json_(json),
        path_(std::move(path)),
        count_(1 + static_cast<std::size_t>(shape.values)),
        findings_(findings) {
    if (has_text("file")) file_ = (directory / json["file"].get<std::string>()).lexically_normal();
  }

  // Null where there is something wrong.
  Json rows() {
    for (const auto& [key, unused] : json_.items())
      if (key != "file" && key != "columns")
        return failed(child(path_, key),
                      "unknown key " + in_quotes(key) + known_names(key, {"file", "columns"}));
    if (!has_text("file")) return failed(path_, "\"file\" is missing (a CSV file with the rows)");
    if (!read()) return nullptr;
    if (!choose_columns() || !read_units()) return nullptr;
    Json rows = Json::array();
    for (const Line& line : lines_) {
      if (!has_headings(line))
        return failed(child(path_, "file"), where(line) + "has " + std::to_string(line.cells.size()) +
                                                " numbers, but the first line names " +
                                                std::to_string(header_.size()) + " columns");
      Json row = Json::array();
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        const std::size_t column = columns_[i];
        const auto number =
            column < line.cells.size() ? number_of(line.cells[column]) : std::optional<double>{};
        if (!number)
          return failed(
              child(path_, "file"),
              where(line) + "column " + std::to_string(column + 1) +
                  (column < line.cells.size() ? " is " + in_quotes(line.cells[column]) : " is missing") +
                  "; expected a number in SI units");
        row.push_back(*number * units_[i]);
      }
      rows.push_back(std::move(row));
    }
    return rows;
  }

 private:
  bool has_text(const char* key) const { return json_.contains(key) && json_[key].is_string(); }

  Json failed(const std::string& at, const std::string& message) {
    findings_.error(at, message);
    return nullptr;
  }
  std::string where(const Line& line) const {
    return in_quotes(file_.string()) + ", line " + std::to_string(line.number) + ": ";
  }

  bool read() {
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(file_, ignored);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {  // it may block
      findings_.error(child(path_, "file"),
                      in_quotes(file_.string()) + " is a " +
                          (std::filesystem::is_directory(status) ? "directory" : "device or pipe") +
                          "; expected a CSV file");
      return false;
    }
    std::ifstream stream(file_);
    if (!stream) {
      findings_.error(child(path_, "file"), "there is no file " + in_quotes(file_.string()) +
                                                "; expected a CSV file, relative to the one that names it");
      return false;
    }
    std::string text;
    for (int number = 1; std::getline(stream, text); ++number) {
      if (number == 1 && text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
      if (trimmed(text).empty() || trimmed(text).starts_with('#')) continue;
      Line line{number, cells_of(text)};
      const bool names = lines_.empty() && header_.empty() && !number_of(line.cells.front());
      if (names)
        header_ = line.cells;
      else
        lines_.push_back(std::move(line));
      if (lines_.size() > most_rows) {
        findings_.error(child(path_, "file"),
                        in_quotes(file_.string()) + " has more than " + std::to_string(most_rows) + " rows");
        return false;
      }
    }
    if (!lines_.empty()) return true;
    findings_.error(child(path_, "file"), in_quotes(file_.string()) + " has no rows of numbers");
    return false;
  }

  // Whether all that the line holds is in a column with a name, where columns have names.
  bool has_headings(const Line& line) const {
    if (header_.empty() || line.cells.size() <= header_.size()) return true;
    return std::all_of(line.cells.begin() + static_cast<std::ptrdiff_t>(header_.size()), line.cells.end(),
                       [](const std::string& cell) { return cell.empty(); });
  }

  // By their names; without them the first ones.
  bool choose_columns() {
    if (!json_.contains("columns")) {
      for (std::size_t i = 0; i < count_; ++i) columns_.push_back(i);
      return true;
    }
    const Json& names = json_["columns"];
    const bool texts = names.is_array() && std::all_of(names.begin(), names.end(),
                                                       [](const Json& name) { return name.is_string(); });
    if (!texts || names.size() != count_) {
      findings_.error(child(path_, "columns"),
                      "expected the names of " + std::to_string(count_) + " columns");
      return false;
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto name = names[i].get<std::string>();
      auto found = std::find(header_.begin(), header_.end(), name);
      if (found == header_.end())
        found = std::find_if(header_.begin(), header_.end(),
                             [&](const std::string& heading) { return column_of(heading).name == name; });
      if (found == header_.end()) {
        findings_.error(child(child(path_, "columns"), i),
                        in_quotes(file_.string()) + (header_.empty() ? " has no line with names of columns"
                                                                     : " has no column " + in_quotes(name) +
                                                                           known_names(name, header_)));
        return false;
      }
      columns_.push_back(static_cast<std::size_t>(found - header_.begin()));
    }
    return true;
  }

  // What 1 of each column is in SI units: of what it measures, where that is known.
  bool read_units() {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Column of = columns_[i] < header_.size() ? column_of(header_[columns_[i]]) : Column{};
      const Dimension dimension = i == 0 ? shape_.argument : shape_.dimension;
      if (!of.unit || is_symbol(of, dimension)) {
        units_.push_back(1);
        continue;
      }
      const std::string column =
          in_quotes(file_.string()) + ": the column " + in_quotes(header_[columns_[i]]);
      const auto unit = in_si_units(*of.unit);
      if (!unit) {
        findings_.error(child(path_, "file"),
                        column + " has an unknown unit " + in_quotes(*of.unit) +
                            "; write one as \"[mm]\" or \"[N m]\", or numbers in SI units without one");
        return false;
      }
      const bool any = dimension == Dimension::number || *of.unit == "-";
      const ParsedQuantity one = any ? ParsedQuantity{unit, {}} : parse_quantity("1 " + *of.unit, dimension);
      if (!one.value) {
        findings_.error(child(path_, "file"), column + " cannot be read: " + one.error);
        return false;
      }
      units_.push_back(*one.value);
    }
    return true;
  }

  const Shape& shape_;
  const Json& json_;
  std::string path_;
  std::size_t count_;
  Findings& findings_;
  std::filesystem::path file_;
  std::vector<std::string> header_;
  std::vector<Line> lines_;
  std::vector<std::size_t> columns_;
  std::vector<double> units_;  // of them
};

}  // namespace

void put_in_tables(const Shape& shape, Json& value, const std::string& path,
                   const std::filesystem::path& directory, Findings& findings) {
  if (shape.kind == Kind::object && value.is_object()) {
    for (const Key& key : shape.keys)
      if (value.contains(key.name))
        put_in_tables(key.shape, value[key.name], child(path, key.name), directory, findings);
  } else if (shape.kind == Kind::array && value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      put_in_tables(shape.items[0], value[i], child(path, i), directory, findings);
  } else if (shape.kind == Kind::either) {
    // An object that is not a table's file, where there may be either.
    const bool is_object =
        value.is_object() && !value.contains("file") &&
        std::ranges::any_of(shape.items, [](const Shape& item) { return item.kind == Kind::object; });
    for (const Shape& item : shape.items)
      if (!is_object || item.kind == Kind::object) put_in_tables(item, value, path, directory, findings);
  } else if (shape.kind == Kind::table && value.is_object()) {
    value = TableFile(shape, value, path, directory, findings).rows();
  }
}

}  // namespace nurbeam
