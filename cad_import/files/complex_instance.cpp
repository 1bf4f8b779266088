#include "cad_import/files/complex_instance.h"

#include <algorithm>

namespace nurbeam {
namespace {

constexpr std::string_view space = " \t\r\n";

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

bool is_keyword(std::string_view text) {
  return text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string_view::npos;
}

bool stands_before(const InstancePart& a, const InstancePart& b) { return a.keyword < b.keyword; }

}  // namespace

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(space);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(space) + 1 - begin);
}

std::vector<InstancePart> parts_of(std::string_view value) {
  if (!value.starts_with('(') || closing(value, 0) != value.size() - 1) return {};
  std::vector<InstancePart> parts;
  for (std::string_view rest = without_blanks(value.substr(1, value.size() - 2)); !rest.empty();) {
    const std::size_t open = rest.find('(');
    const std::size_t end = open == std::string_view::npos ? open : closing(rest, open);
    if (end == std::string_view::npos) return {};
    parts.push_back(
        {without_blanks(rest.substr(0, open)), without_blanks(rest.substr(open + 1, end - open - 1))});
    rest = without_blanks(rest.substr(end + 1));
  }
  return parts;
}

std::optional<std::string> in_alphabetical_order(std::string_view value) {
  std::vector<InstancePart> parts = parts_of(without_blanks(value));
  if (std::is_sorted(parts.begin(), parts.end(), stands_before)) return std::nullopt;
  std::stable_sort(parts.begin(), parts.end(), stands_before);
  std::string ordered = "(";
  for (const auto& [keyword, parameters] : parts) {
    if (!is_keyword(keyword)) return std::nullopt;
    (((ordered += keyword) += '(') += parameters) += ')';
  }
  return ordered + ')';
}

}  // namespace nurbeam
