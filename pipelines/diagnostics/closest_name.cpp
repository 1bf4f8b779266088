#include "pipelines/diagnostics/closest_name.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

namespace nurbeam {

namespace {

int lower(char c) { return std::tolower(static_cast<unsigned char>(c)); }

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const auto same = [&](std::size_t i, std::size_t j) { return lower(a[i - 1]) == lower(b[j - 1]); };
  std::vector<int> row(b.size() + 1);  // row[j]: distance between the first i of a and the first j of b
  std::iota(row.begin(), row.end(), 0);
  std::vector<int> last, last_but_one;  // of smaller i
  for (std::size_t i = 1; i <= a.size(); ++i) {
    last_but_one = std::exchange(last, row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same(i, j) ? 0 : 1)});
      if (i > 1 && j > 1 && same(i, j - 1) && same(i - 1, j))
        row[j] = std::min(row[j], last_but_one[j - 2] + 1);
    }
  }
  return row.back();
}

std::string in_quotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

std::string quoted_list(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + in_quotes(name);
  return list;
}

std::string nearest_question(std::string_view unknown, const std::vector<std::string>& known) {
  if (known.empty()) return {};
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edit_distance(unknown, a) < edit_distance(unknown, b);
  });
  const int near = std::max(2, static_cast<int>(unknown.size()) / 3);
  return edit_distance(unknown, *nearest) <= near ? "; did you mean " + in_quotes(*nearest) + "?" : "";
}

std::string known_names(std::string_view unknown, const std::vector<std::string>& all) {
  std::vector<std::string> known = all;
  std::erase(known, "");  // of what should have a name
  if (known.empty()) return "; there is none to name here";
  const std::string question = nearest_question(unknown, known);
  return (question.empty() ? "; known: " : question + " Known: ") + quoted_list(known);
}

}  // namespace nurbeam
