#include "pipelines/diagnostics/joined_warnings.h"

#include <algorithm>
#include <string>

namespace nurbeam {

namespace {

// A path without the numbers in its brackets: "beams[].material".
std::string without_numbers(const std::string& path) {
  std::string text;
  bool inside = false;
  for (const char c : path) {
    if (c == ']') inside = false;
    if (!inside) text += c;
    if (c == '[') inside = true;
  }
  return text;
}

// "beams[2]" of "case.json: beams[2].material.density".
std::string item_of(const std::string& where) {
  const std::size_t end = where.rfind(']');
  const std::size_t space = where.rfind(' ', end);
  const std::size_t start = space == std::string::npos ? 0 : space + 1;
  return where.substr(start, where.find(']', start) + 1 - start);
}

bool says_the_same(const Diagnostic& a, const Diagnostic& b) {
  return a.severity == b.severity && a.message == b.message && a.where != b.where &&
         without_numbers(a.where) == without_numbers(b.where);
}

}  // namespace

std::vector<Diagnostic> joined_warnings(const std::vector<Diagnostic>& diagnostics) {
  constexpr std::size_t most_named = 3;
  struct Group {
    Diagnostic first;
    std::vector<std::string> others;
  };
  std::vector<Group> groups;
  for (const Diagnostic& each : diagnostics) {
    const auto group = std::ranges::find_if(groups, [&](const Group& known) {
      return each.severity != Severity::error && says_the_same(known.first, each);
    });
    if (group == groups.end())
      groups.push_back({each, {}});
    else
      group->others.push_back(item_of(each.where));
  }
  std::vector<Diagnostic> joined;
  for (auto& [first, others] : groups) {
    joined.push_back(first);
    if (others.empty()) continue;
    std::string& message = joined.back().message;
    message +=
        "; the same of " + std::to_string(others.size()) + (others.size() == 1 ? " other: " : " others: ");
    for (std::size_t i = 0; i < std::min(others.size(), most_named); ++i)
      message += (i == 0 ? "" : ", ") + others[i];
    if (others.size() > most_named) message += ", ...";
  }
  return joined;
}

}  // namespace nurbeam
