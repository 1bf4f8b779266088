#include "pipelines/case/case_overrides.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

#include "nurbs/number_text.h"
#include "pipelines/case/case_file.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

using Kind = Shape::Kind;

/// The alternative of an `either` that can hold keys; the shape itself otherwise.
const Shape& object_alternative(const Shape& shape) {
  if (shape.kind == Kind::either) {
    for (const Shape& item : shape.items)
      if (item.kind == Kind::object) return item;
  }
  return shape;
}

/// "beams[0].section.radius" as "beams", "0", "section", "radius".
std::vector<std::string> path_parts(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path)
    if (c == '.' || c == '[')
      parts.emplace_back();
    else if (c != ']')
      parts.back() += c;
  return parts;
}

std::optional<std::size_t> as_index(const std::string& text) {
  const bool digits =
      !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? std::optional<std::size_t>(std::stoul(text)) : std::nullopt;
}

/// The item of an array that a path names by its number or by its "name"; nothing where there is none.
std::optional<std::size_t> item_of(const Json& array, const std::string& part) {
  if (const auto index = as_index(part)) return *index < array.size() ? index : std::nullopt;
  for (std::size_t i = 0; i < array.size(); ++i)
    if (array[i].is_object() && array[i].contains("name") && array[i]["name"] == part) return i;
  return std::nullopt;
}

/// What an item of an array may be called instead.
std::string known_items(const Json& array, const std::string& part) {
  std::vector<std::string> names;
  for (const Json& item : array)
    if (item.is_object() && item.contains("name") && item["name"].is_string())
      names.push_back(item["name"].get<std::string>());
  return names.empty() || as_index(part) ? std::string() : known_names(part, names);
}

/// The alternative of an `either` that has items; the shape itself otherwise.
const Shape& list_alternative(const Shape& shape) {
  if (shape.kind == Kind::either)
    for (const Shape& item : shape.items)
      if (item.kind == Kind::array || item.kind == Kind::table) return item;
  return shape;
}

bool is_list(const Shape& shape) {
  const Shape& list = list_alternative(shape);
  return list.kind == Kind::array || list.kind == Kind::table;
}

/// The number of an item that stands behind the last one.
constexpr const char* behind_last = "+";

/// Appends a value to a list, which is made where there is none.
AppliedOverride append_at(Json& list, const Shape& shape, const std::string& path, bool is_last,
                          const Json& value) {
  if (!is_last)
    return {path + "[+] is a new item, which has no parts yet; give it whole, as " + path + "[+]={...}", {}};
  if (!is_list(shape))
    return {path + " is no list, and nothing can be appended to it; set it as a whole", {}};
  if (value.is_null()) return {"null removes what is there, and [+] is a new item; give its number", {}};
  if (list.is_null()) list = Json::array();
  if (!list.is_array()) return {path + " is " + list.dump() + ", which is no list; set it as a whole", {}};
  list.push_back(value);
  return {{}, child(path, list.size() - 1)};
}

/// Whether the brackets of a path hold indices behind names, as in beams[0].section.radius.
bool has_sound_brackets(const std::string& path) {
  bool inside = false;
  char last = '.';
  for (const char c : path) {
    const bool opens = c == '[', closes = c == ']', continues = c == '.' || opens;
    if ((opens && (inside || last == '.')) || (closes && !inside) || (c == '.' && inside) ||
        (last == ']' && !continues))
      return false;
    inside = opens || (inside && !closes);
    last = c;
  }
  return !inside;
}

/// The number that a text outside JSON's grammar (".45", "5.", "+5", "007") means.
std::optional<double> loose_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc{} && end == text.data() + text.size() && std::isfinite(number);
  return whole ? std::optional(number) : std::nullopt;
}

/// Whether a text that cannot be read was to be an object or a list.
bool is_meant_as_json(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\n");
  return first != std::string::npos && (text[first] == '{' || text[first] == '[');
}
constexpr const char* no_json_message =
    "the value cannot be read as JSON: names and texts stand in double quotes, and for the shell all of it in "
    "single ones, as in --set 'loads[+]={\"beam\": \"tube\", \"at\": \"end\", \"force\": [0, 0, -500]}'";

/// Of which a part is changed though all of it is omitted.
void write_out_gravity(Json& root) {
  if (!root.is_object() || root.contains("gravity")) return;
  for (const double g : CaseFile{}.gravity) root["gravity"].push_back(g);
}

/// The item of a list on the way along a path.
struct FoundItem {
  std::string problem;
  std::size_t index = 0;
};
FoundItem find_item(const Json& list, const Shape& shape, const std::string& path, const std::string& part) {
  if (const auto index = item_of(list, part)) return {{}, *index};
  return {path + " has " + std::to_string(list.size()) + " item(s), counted from 0; there is no [" + part +
          "]" + known_items(list, part) + (is_list(shape) ? "; " + path + "[+]=VALUE appends one" : "")};
}

/// What is there has no parts by which it could be changed.
std::string no_parts(const Shape& shape, const std::string& path) {
  if (is_list(shape)) return path + " has no items here; " + path + "[+]=VALUE appends the first";
  return path + " has no parts here; set it as a whole";
}

/// What stands under a key of an object, or under a name of a map; nullptr and the problem where there is
/// none.
const Shape* shape_under(const Shape& holder, const std::string& part, const std::string& path,
                         std::string& problem) {
  if (holder.kind == Kind::map) return &holder.items[0];
  if (const Key* key = find_key(holder, part)) return &key->shape;
  problem = "there is no " + in_quotes(part) + " in " + path + known_names(part, key_names(holder));
  return nullptr;
}

/// Makes the value an object, to which a key can be added; the problem where it is something else.
std::string open_object(Json& value, const Shape& holder, const std::string& path) {
  if (value.is_string() && find_key(holder, "name")) {
    value = {{"name", value}};  // a material of a standard, of which a part is another
  } else if (!value.is_object()) {
    if (!value.is_null()) return path + " is " + value.dump() + ", which has no parts; set it as a whole";
    value = Json::object();
  }
  return {};
}

AppliedOverride put_at(Json& root, const std::string& path, const Json& new_value) {
  const bool removes = new_value.is_null();
  Json* value = &root;
  Json absent;  // stands for what is not there, and of which nothing is to be removed
  const Shape* shape = &case_keys();
  std::string walked;
  const std::vector<std::string> parts = path_parts(path);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string& part = parts[i];
    const bool is_last = i + 1 == parts.size();
    const std::string here = walked.empty() ? "the case file" : walked;
    const Shape& holder = object_alternative(*shape);
    if (part == behind_last) return append_at(*value, *shape, walked, is_last, new_value);
    if (value->is_array()) {
      const FoundItem item = find_item(*value, *shape, here, part);
      if (!item.problem.empty()) return {item.problem, {}};
      walked = child(walked, item.index);
      if (removes && is_last) {
        value->erase(item.index);
        return {{}, walked};
      }
      const Shape& list = list_alternative(*shape);
      shape = list.kind == Kind::array ? &list.items[0] : shape;
      value = &(*value)[item.index];
      continue;
    }
    if (holder.kind != Kind::object && holder.kind != Kind::map) return {no_parts(*shape, here), {}};
    std::string problem;
    shape = shape_under(holder, part, here, problem);
    if (!shape) return {problem, {}};
    walked = child(walked, part);
    if (removes && is_last) {
      if (value->is_object()) value->erase(part);
      return {{}, walked};
    }
    problem = open_object(*value, holder, here);
    if (!problem.empty()) return {problem, {}};
    value = removes && !value->contains(part) ? &(absent = Json()) : &(*value)[part];
  }
  *value = new_value;
  return {{}, walked};
}

/// Of a number in one of its rows.
DimensionAtPath in_table(const Shape& table, const std::string& path, const std::vector<std::string>& parts) {
  const auto column = parts.size() == 2 && as_index(parts[0]) ? as_index(parts[1]) : std::nullopt;
  if (!column || *column > static_cast<std::size_t>(table.values))
    return {{},
            path + " is a table; name a row of it and one of the " + std::to_string(1 + table.values) +
                " numbers in it, as in " + path + "[0][1]"};
  return {*column == 0 ? table.argument : table.dimension, {}};
}

}  // namespace

AppliedOverride set_value(Json& root, const std::string& path, const Json& value) {
  if (!has_sound_brackets(path))
    return {"the brackets of the path do not match; write it as in beams[0].section.radius", {}};
  Json changed = root;
  if (path.starts_with("gravity[")) write_out_gravity(changed);
  AppliedOverride applied = put_at(changed, path, value);
  if (applied.problem.empty()) root = std::move(changed);
  return applied;
}

AppliedOverride apply_override(Json& root, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) return {"expected path=value, for example analysis.end_time=0.1", {}};
  const std::string path = text.substr(0, equals), value_text = text.substr(equals + 1);
  if (too_deep_at(value_text) != std::string::npos) return {too_deep_message(), {}};
  Json value = Json::parse(value_text, nullptr, false);
  if (value.is_discarded()) {
    if (is_meant_as_json(value_text)) return {no_json_message, {}};
    if (const auto number = loose_number(value_text))
      return {
          in_quotes(value_text) + " is not a number as JSON writes it; write " + text_of(*number, all_digits),
          {}};
    value = value_text;  // what does not read as JSON is a text
  }
  return set_value(root, path, value);
}

DimensionAtPath dimension_at(const std::string& path) {
  if (!has_sound_brackets(path))
    return {{}, "the brackets do not match; write it as in beams[0].section.radius"};
  const Shape* shape = &case_keys();
  std::string walked;
  const std::vector<std::string> parts = path_parts(path);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string &part = parts[i], here = walked.empty() ? "the case file" : walked;
    if (part == behind_last) return {{}, here + "[+] is a new item; name a number that is there"};
    const Shape* holder = shape;
    if (shape->kind == Kind::either)
      for (const Shape& item : shape->items) {
        const bool has_parts = item.kind == Kind::array || item.kind == Kind::table ||
                               (item.kind == Kind::vector && as_index(part));
        const bool has_keys = item.kind == Kind::object && holder->kind != Kind::vector;
        if (has_parts || has_keys) holder = &item;
      }
    if (holder->kind == Kind::array) {
      walked += "[" + part + "]";
      shape = &holder->items[0];
    } else if (holder->kind == Kind::vector && as_index(part)) {
      return {holder->dimension, {}};
    } else if (holder->kind == Kind::table) {
      return in_table(*holder, here, {parts.begin() + static_cast<std::ptrdiff_t>(i), parts.end()});
    } else if (holder->kind == Kind::object || holder->kind == Kind::map) {
      std::string problem;
      shape = shape_under(*holder, part, here, problem);
      if (!shape) return {{}, problem};
      walked = child(walked, part);
    } else {
      return {{}, here + " has no parts that one number could be"};
    }
  }
  if (shape->kind == Kind::either)
    for (const Shape& item : shape->items)
      if (item.kind == Kind::quantity || item.kind == Kind::integer) shape = &item;
  if (shape->kind == Kind::integer) return {Dimension::number, {}, true};
  if (shape->kind != Kind::quantity) return {{}, "is no single number; name one of its parts"};
  return {shape->dimension, {}};
}

void apply_overrides(Json& root, const std::vector<std::string>& overrides, std::vector<Diagnostic>& wrong) {
  for (const std::string& text : overrides)
    if (const std::string problem = apply_override(root, text).problem; !problem.empty())
      wrong.push_back({Severity::error, "--set " + text, problem});
}

}  // namespace nurbeam
