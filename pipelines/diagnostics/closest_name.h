#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace nurbeam {

/// Number of single-character insertions, deletions, replacements and swaps of neighbours between two texts,
/// letter case ignored.
int edit_distance(std::string_view a, std::string_view b);

/// `; did you mean "x"?` of the nearest known name; empty where none is near (at most a third of the text's
/// characters, at least 2, differ).
std::string nearest_question(std::string_view unknown, const std::vector<std::string>& known);

/// The ending of a message about an unknown name: `; did you mean "x"? Known: "x", "y"`. The question is left
/// out when no known name is near.
std::string known_names(std::string_view unknown, const std::vector<std::string>& known);

/// The names of items that have one.
template <class Item>
std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  for (const Item& item : items) names.push_back(item.name);
  return names;
}

/// `"a"`.
std::string in_quotes(std::string_view text);

/// `"a", "b"`.
std::string quoted_list(const std::vector<std::string>& names);

}  // namespace nurbeam
