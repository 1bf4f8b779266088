#include "pipelines/accuracy/error_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

#include "cad_import/files/atomic_file.h"
#include "nurbs/number_text.h"
#include "pipelines/results/file_error.h"
#include "pipelines/results/netcdf_file.h"

namespace nurbeam {

namespace {

constexpr int exact = 17;

std::vector<std::string> fields_of(const std::string& row) {
  std::vector<std::string> fields(1);
  for (const char c : row)
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}

// NaN where there is no number.
double number_of(const std::string& field) {
  double number = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(field.data(), field.data() + field.size(), number);
  return number;
}

// The row of errors of a row of histories: what is empty there stays so.
std::string errors_of(const std::string& row, const AccuracyTable& table) {
  const std::vector<std::string> fields = fields_of(row);
  const double time = number_of(fields.front());
  std::string errors = fields.front();
  for (std::size_t i = 1; i < fields.size(); ++i)
    errors += fields[i].empty() ? "," : "," + text_of(table.own_error(i - 1, time), exact);
  return errors;
}

// What results.nc calls the columns of a quantity; empty where it has none.
std::string variable_of(const HistoryColumn& column) {
  static const std::map<std::string, std::string> others = {
      {"probe.x", "position"},  {"body.x", "position"},       {"probe.vx", "velocity"},
      {"body.vx", "velocity"},  {"probe.ux", "displacement"}, {"probe.moment", "bending_moment"},
      {"reaction.fx", "force"}, {"reaction.mx", "couple"},    {"body.joint_force.x", "joint_force"}};
  if (column.of == "collector" || column.quantity == "speed") return {};
  if (column.of == "measure") return "measure";
  const auto found = others.find(column.of + "." + column.quantity);
  std::string name = found != others.end() ? found->second : column.quantity;
  std::ranges::replace(name, '.', '_');
  return column.of + "_" + name;
}

bool is_later_component(const HistoryColumn& column) {
  for (const char* before : {"", "v", "u", "f", "m", "joint_force."})
    for (const char axis : {'y', 'z'})
      if (column.quantity == before + std::string(1, axis)) return true;
  return false;
}

/// A variable of errors: the columns that it has, row after row of one time.
struct ErrorVariable {
  std::string name, of, unit;
  std::size_t components = 1;
  std::vector<std::size_t> columns;
};

std::vector<ErrorVariable> variables_of(const std::vector<HistoryColumn>& columns) {
  std::vector<ErrorVariable> variables;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string name = is_later_component(columns[i]) ? "" : variable_of(columns[i]);
    if (name.empty()) continue;
    const bool is_vector =
        i + 1 < columns.size() && is_later_component(columns[i + 1]) && columns[i + 1].of == columns[i].of;
    const std::size_t components = is_vector ? 3 : 1;
    auto same = std::ranges::find(variables, "error_" + name, &ErrorVariable::name);
    if (same == variables.end())
      same = variables.insert(same, {"error_" + name, columns[i].of, columns[i].unit, components, {}});
    for (std::size_t k = 0; k < components; ++k) same->columns.push_back(i + k);
  }
  return variables;
}

}  // namespace

void write_errors_table(const std::filesystem::path& directory, const AccuracyTable& table) {
  const std::filesystem::path histories = directory / "histories.csv";
  std::ifstream rows(histories);
  std::string row;
  std::ostringstream errors;
  if (!std::getline(rows, row)) fail(histories, "has no rows that errors could belong to");
  errors << row << '\n';
  while (std::getline(rows, row)) errors << errors_of(row, table) << '\n';
  for (const Diagnostic& problem : write_at_once(directory / "errors.csv", errors.str()))
    throw std::runtime_error(problem.where + ": " + problem.message);
}

void write_errors_netcdf(const std::filesystem::path& directory, const AccuracyTable& table,
                         const std::vector<HistoryColumn>& columns, const std::vector<double>& times) {
  if (times.empty()) return;
  const std::filesystem::path file = directory / "errors.nc";
  const std::vector<ErrorVariable> variables = variables_of(columns);
  NetcdfFile out = NetcdfFile::create(temporary_name(file), false);
  out.define_dimension("time", times.size());
  out.define_dimension("xyz", 3);
  out.define_plain("time", NetcdfFile::Type::real, {"time"}, "s", "output time");
  std::map<std::string, std::size_t> sizes;
  for (const ErrorVariable& each : variables)
    if (each.of != "energy" && !std::exchange(sizes[each.of], each.columns.size() / each.components))
      out.define_dimension(each.of, sizes[each.of]);
  for (const ErrorVariable& each : variables) {
    std::vector<std::string> dimensions = {"time"};
    if (each.of != "energy") dimensions.push_back(each.of);
    if (each.components == 3) dimensions.emplace_back("xyz");
    out.define_plain(each.name, NetcdfFile::Type::real, dimensions, each.unit,
                     "error of mesh and step of " + each.name.substr(std::string("error_").size()));
  }
  out.put("time", {0}, {times.size()}, times.data());
  for (const ErrorVariable& each : variables) {
    std::vector<double> values;
    for (const double time : times)
      for (const std::size_t column : each.columns) values.push_back(table.own_error(column, time));
    NetcdfFile::Sizes count = {times.size()};
    if (each.of != "energy") count.push_back(each.columns.size() / each.components);
    if (each.components == 3) count.push_back(3);
    out.put(each.name, NetcdfFile::Sizes(count.size(), 0), count, values.data());
  }
  out.close();
  publish(file);
}

std::map<std::string, std::vector<double>> errors_of_frames(const std::filesystem::path& directory,
                                                            const std::vector<double>& times) {
  std::map<std::string, std::vector<double>> errors;
  std::ifstream rows(directory / "errors.csv");
  std::string row;
  if (!std::getline(rows, row)) return errors;
  const std::vector<std::string> headings = fields_of(row);
  for (std::size_t frame = 0; frame < times.size() && std::getline(rows, row);) {
    const std::vector<std::string> fields = fields_of(row);
    if (number_of(fields.front()) != times[frame] || fields.size() != headings.size()) continue;
    for (std::size_t i = 1; i < headings.size(); ++i) errors[headings[i]].push_back(number_of(fields[i]));
    ++frame;
  }
  std::erase_if(errors, [&](const auto& each) { return each.second.size() != times.size(); });
  return errors;
}

}  // namespace nurbeam
