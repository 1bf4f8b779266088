#include "pipelines/results/mode_table.h"

#include <algorithm>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "cad_import/files/atomic_file.h"
#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

constexpr int exact = 17, read_by_people = 7, rough = 3;

std::string columns(const Eigen::Vector3d& v) {
  return "," + text_of(v.x(), exact) + "," + text_of(v.y(), exact) + "," + text_of(v.z(), exact);
}

std::string heads(const std::string& name, const std::string& unit) {
  std::string text;
  for (const char* axis : {"x", "y", "z"}) text += "," + name + "." + axis + " [" + unit + "]";
  return text;
}

}  // namespace

bool ModeTable::whirls() const {
  return std::ranges::any_of(
      rows, [](const ModeRow& row) { return row.whirl != 0; });
}

double ModeRow::frequency() const { return omega / (2 * std::numbers::pi); }

void write_mode_table(const std::filesystem::path& file, const ModeTable& table) {
  std::ostringstream out;
  const bool has_errors = !table.rows.empty() && table.rows.front().error;
  if (table.buckling)
    out << "number,factor" << (has_errors ? ",factor.error" : "") << '\n';
  else
    out << "number,frequency [Hz],period [s]" << heads("effective_mass", "kg")
        << heads("participation", "sqrt(kg)") << (has_errors ? ",frequency.error [Hz]" : "")
        << (table.whirls() ? ",whirl" : "") << '\n';
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const ModeRow& row = table.rows[i];
    out << i + 1 << ',';
    if (table.buckling)
      out << text_of(row.factor, exact);
    else
      out << text_of(row.frequency(), exact) << ','
          << (row.omega > 0 ? text_of(1 / row.frequency(), exact) : "") << columns(row.effective_mass())
          << columns(row.participation);
    if (has_errors) out << ',' << (row.error ? text_of(*row.error, exact) : "");
    if (table.whirls()) out << ',' << row.whirl;
    out << '\n';
  }
  for (const Diagnostic& problem : write_at_once(file, out.str()))
    throw std::runtime_error(problem.where + ": " + problem.message);
}

std::string mode_text(const ModeTable& table, std::size_t i) {
  const ModeRow& row = table.rows[i];
  const std::string number = "mode " + std::to_string(i + 1) + ": ";
  if (table.buckling)
    return number + "buckles at " + text_of(row.factor, read_by_people) + " times the loads" +
           (row.factor < 0 ? ", which are reversed" : "");
  Eigen::Vector3d part = row.effective_mass() / table.mass * 100;
  part = (part.array() < 0.001).select(0, part);
  return number +
         (row.omega > 0 ? text_of(row.frequency(), read_by_people) + " Hz" : "0 Hz, a rigid motion") +
         (row.whirl > 0   ? ", forward whirl"
          : row.whirl < 0 ? ", backward whirl"
                          : "") +
         ", effective mass " + text_of(part.x(), rough) + ", " + text_of(part.y(), rough) + ", " +
         text_of(part.z(), rough) + " % in x, y, z";
}

}  // namespace nurbeam
