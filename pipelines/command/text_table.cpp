#include "pipelines/command/text_table.h"

#include <algorithm>
#include <numeric>
#include <ostream>

#include "pipelines/diagnostics/utf8_text.h"

namespace nurbeam {

namespace {

constexpr std::size_t gap = 2;

std::vector<std::size_t> widths_of(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], column_count(row[i]));
  return widths;
}

bool fits(const std::vector<std::vector<std::string>>& rows, int width) {
  const std::vector<std::size_t> widths = widths_of(rows);
  return width == 0 || std::accumulate(widths.begin(), widths.end(), gap * widths.size()) <=
                           static_cast<std::size_t>(width);
}

}  // namespace

std::vector<std::string> print_table(std::ostream& out, std::vector<std::vector<std::string>> rows, int width,
                                     const std::vector<std::string>& dispensable) {
  std::vector<std::string> left_out;
  for (const std::string& heading : dispensable) {
    if (fits(rows, width)) break;
    const auto found = std::ranges::find(rows.front(), heading);
    if (found == rows.front().end()) continue;
    const auto column = found - rows.front().begin();
    for (auto& row : rows) row.erase(row.begin() + column);
    left_out.push_back(heading);
  }
  const std::vector<std::size_t> widths = widths_of(rows);
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += std::string(gap, ' ') + row[i] + std::string(widths[i] - column_count(row[i]), ' ');
    out << line.substr(0, line.find_last_not_of(' ') + 1) << '\n';
  }
  return left_out;
}

}  // namespace nurbeam
