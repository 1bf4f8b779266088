#include "cad_import/files/simple_spline.h"

#include <map>

namespace nurbeam {
namespace {

constexpr std::string_view space = " \t\r\n";

std::string_view without_space(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(space);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(space) + 1 - begin);
}

/// The place of the parenthesis that closes the one at `open`; npos where none does.
std::size_t closing(std::string_view text, std::size_t open) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = open; i < text.size(); ++i) {
    if (text[i] == '\'') quoted = !quoted;
    if (quoted) continue;
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && --depth == 0) return i;
  }
  return std::string_view::npos;
}

using Parts = std::map<std::string_view, std::string_view>;

/// The parts of a complex instance, by their keywords; empty where it is none.
Parts parts_of(std::string_view value) {
  if (!value.starts_with('(') || closing(value, 0) != value.size() - 1) return {};
  Parts parts;
  for (std::string_view rest = without_space(value.substr(1, value.size() - 2)); !rest.empty();) {
    const std::size_t open = rest.find('(');
    const std::size_t end = open == std::string_view::npos ? open : closing(rest, open);
    if (end == std::string_view::npos) return {};
    parts.emplace(without_space(rest.substr(0, open)), without_space(rest.substr(open + 1, end - open - 1)));
    rest = without_space(rest.substr(end + 1));
  }
  return parts;
}

}  // namespace

std::optional<std::string> simple_spline(std::string_view value) {
  value = without_space(value);
  if (!value.starts_with('(') || value.find("B_SPLINE_CURVE") == std::string_view::npos) return std::nullopt;
  Parts parts = parts_of(value);
  const std::string_view curve = parts["B_SPLINE_CURVE"], name = parts["REPRESENTATION_ITEM"];
  for (const char* known :
       {"B_SPLINE_CURVE", "REPRESENTATION_ITEM", "BOUNDED_CURVE", "CURVE", "GEOMETRIC_REPRESENTATION_ITEM"})
    parts.erase(known);
  if (parts.size() != 1 || curve.empty() || name.empty()) return std::nullopt;
  const auto& [keyword, more] = *parts.begin();
  if (keyword != "BEZIER_CURVE" && keyword != "UNIFORM_CURVE" && keyword != "QUASI_UNIFORM_CURVE" &&
      keyword != "B_SPLINE_CURVE_WITH_KNOTS")
    return std::nullopt;
  std::string simple(keyword);
  ((simple += '(') += name) += ',';
  simple += curve;
  if (!more.empty()) (simple += ',') += more;
  return simple + ')';
}

}  // namespace nurbeam
