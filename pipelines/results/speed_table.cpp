#include "pipelines/results/speed_table.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "cad_import/files/atomic_file.h"
#include "nurbs/number_text.h"

namespace nurbeam {

std::string SpeedLine::name() const {
  const char* kind = whirl > 0 ? "forward " : whirl < 0 ? "backward " : "mode ";
  return kind + std::to_string(number);
}

void write_speed_table(const std::filesystem::path& file, const SpeedTable& table) {
  constexpr int exact = 17;
  std::ostringstream out;
  out << "speed [rad/s]";
  for (const SpeedLine& line : table.lines) out << ',' << line.name() << " [Hz]";
  out << '\n';
  for (std::size_t i = 0; i < table.speeds.size(); ++i) {
    out << text_of(table.speeds[i], exact);
    for (const SpeedLine& line : table.lines) {
      out << ',';
      if (!std::isnan(line.omega[i])) out << text_of(line.omega[i] / (2 * std::numbers::pi), exact);
    }
    out << '\n';
  }
  for (const Diagnostic& problem : write_at_once(file, out.str()))
    throw std::runtime_error(problem.where + ": " + problem.message);
}

std::string critical_text(const CriticalSpeed& critical) {
  constexpr int digits = 7, of_minute = 4;
  constexpr double to_rev_per_min = 30 / std::numbers::pi;
  return "critical speed: " + text_of(critical.speed, digits) + " rad/s (" +
         text_of(critical.speed * to_rev_per_min, of_minute) + " rev/min), where " + critical.line +
         " meets it";
}

}  // namespace nurbeam
