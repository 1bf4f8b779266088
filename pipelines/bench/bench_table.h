#pragma once
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace nurbeam {

/// A number with some significant digits, never as a power of ten; "-" for none.
inline std::string few_digits(double value, int digits = 3) {
  if (std::isnan(value)) return "-";
  std::ostringstream text;
  int decimals = digits;
  for (double bound = 1; std::abs(value) >= bound && decimals > 0; bound *= 10) --decimals;
  text << std::fixed << std::setprecision(std::max(0, decimals)) << value;
  return text.str();
}

/// Columns as wide as what they hold; the first to the left, the others to the right.
inline void print_table(std::ostream& out, const std::string& title,
                        const std::vector<std::vector<std::string>>& rows) {
  out << title << "\n";
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  for (const auto& row : rows) {
    out << "  " << row[0] << std::string(widths[0] - row[0].size(), ' ');
    for (std::size_t k = 1; k < row.size(); ++k)
      out << "  " << std::string(widths[k] - row[k].size(), ' ') << row[k];
    out << "\n";
  }
  out << std::endl;
}

}  // namespace nurbeam
