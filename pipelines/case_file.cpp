#include "pipelines/case_file.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>

#include "pipelines/case_shape.h"
#include "pipelines/closest_name.h"
#include "pipelines/quantity.h"

namespace nurbeam {

namespace {

using Json = nlohmann::ordered_json;
using Kind = Shape::Kind;

std::string child(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}
std::string child(const std::string& path, std::size_t index) {
  return path + "[" + std::to_string(index) + "]";
}

std::string text_of(double value) {
  std::ostringstream text;
  text.precision(15);
  text << value;
  return text.str();
}

/// The diagnostics of one file, each with the JSON path it is about.
class Findings {
 public:
  explicit Findings(std::string file) : file_(std::move(file)) {}

  void add(Severity severity, const std::string& path, std::string message) {
    diagnostics_.push_back({severity, path.empty() ? file_ : file_ + ": " + path, std::move(message)});
  }
  void error(const std::string& path, std::string message) { add(Severity::error, path, std::move(message)); }
  bool has_errors() const {
    return std::any_of(diagnostics_.begin(), diagnostics_.end(),
                       [](const Diagnostic& d) { return d.severity == Severity::error; });
  }
  std::vector<Diagnostic> take() { return std::move(diagnostics_); }

 private:
  std::string file_;
  std::vector<Diagnostic> diagnostics_;
};

// ---- text to JSON ----

/// "line 3, column 5" of a byte offset.
std::string line_and_column(const std::string& text, std::size_t offset) {
  const std::string before = text.substr(0, offset);
  const auto line_start = before.rfind('\n');
  const auto column = line_start == std::string::npos ? before.size() : before.size() - line_start - 1;
  return "line " + std::to_string(std::count(before.begin(), before.end(), '\n') + 1) + ", column " +
         std::to_string(column + 1);
}

/// The message of the parser without its own prefix ("[json.exception...] ... column 5: ").
std::string bare_message(const std::string& what) {
  const auto bracket = what.find("] ");
  std::string message = bracket == std::string::npos ? what : what.substr(bracket + 2);
  if (message.starts_with("parse error at")) {
    message.erase(0, message.find(": ") + 2);
  }
  return message;
}

/// The run of letters around an offset; "NaN" for the offset of any of its letters.
std::string word_at(const std::string& text, std::size_t offset) {
  const auto is_letter = [&](std::size_t i) {
    return std::isalpha(static_cast<unsigned char>(text[i])) != 0;
  };
  std::size_t begin = std::min(offset, text.size()), end = begin;
  while (begin > 0 && is_letter(begin - 1)) {
    --begin;
  }
  while (end < text.size() && is_letter(end)) {
    ++end;
  }
  return text.substr(begin, end - begin);
}

bool is_not_a_finite_number(const std::string& word) {
  static const std::set<std::string> words = {"nan", "NaN", "NAN",      "inf",
                                              "Inf", "INF", "Infinity", "infinity"};
  return words.contains(word);
}

/// Watches the parser's events for keys that stand twice in one object.
class DuplicateKeys {
 public:
  explicit DuplicateKeys(Findings& findings) : findings_(findings) {}

  bool operator()(int, Json::parse_event_t event, const Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::key) {
      Level& level = levels_.back();
      level.key = parsed.get<std::string>();
      if (!level.keys.insert(level.key).second) {
        findings_.error(path(), "the key " + in_quotes(level.key) + " stands twice in this object; keep one");
      }
    } else if (event == Event::object_end || event == Event::array_end) {
      levels_.pop_back();
    } else {
      if (!levels_.empty() && levels_.back().is_array) {
        ++levels_.back().count;
      }
      if (event != Event::value) {
        levels_.push_back({.is_array = event == Event::array_start});
      }
    }
    return true;
  }

 private:
  struct Level {
    bool is_array;
    std::size_t count = 0;  // items begun
    std::string key = {};
    std::set<std::string> keys = {};
  };

  std::string path() const {
    std::string path;
    for (const Level& level : levels_) {
      path = level.is_array ? child(path, level.count - 1) : child(path, level.key);
    }
    return path;
  }

  Findings& findings_;
  std::vector<Level> levels_;
};

std::optional<Json> parse(const std::string& text, Findings& findings) {
  try {
    return Json::parse(text, DuplicateKeys(findings), true, true);
  } catch (const Json::parse_error& error) {
    const std::size_t offset = error.byte == 0 ? 0 : error.byte - 1;
    const std::string word = word_at(text, offset);
    findings.error(line_and_column(text, offset),
                   is_not_a_finite_number(word)
                       ? word + " is not a number a case file can hold; write a finite number"
                       : bare_message(error.what()));
  } catch (const Json::out_of_range& error) {  // a number too large for a double
    const std::string message = bare_message(error.what());
    const auto begin = message.find('\''), end = message.rfind('\'');
    const std::string number = begin < end ? message.substr(begin + 1, end - begin - 1) : "";
    findings.error(line_and_column(text, text.find(number)),
                   "the number " + number + " is too large; write a finite number");
  }
  return {};
}

std::optional<std::string> read_text(const std::filesystem::path& file, Findings& findings) {
  if (std::filesystem::is_directory(file)) {
    findings.error("", "is a directory; expected a case file (JSON)");
    return {};
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream.is_open() || stream.bad()) {
    findings.error("", std::string("cannot be read: ") + std::strerror(errno));
    return {};
  }
  if (text.str().find_first_not_of(" \t\r\n") == std::string::npos) {
    findings.error("", "is empty; the smallest case has \"nurbeam\": 1, \"beams\" and \"analysis\"");
    return {};
  }
  return text.str();
}

// ---- overrides ----

const Key* find_key(const Shape& shape, const std::string& name) {
  const auto found =
      std::find_if(shape.keys.begin(), shape.keys.end(), [&](const Key& k) { return k.name == name; });
  return found == shape.keys.end() ? nullptr : &*found;
}

std::vector<std::string> key_names(const Shape& shape) {
  std::vector<std::string> names;
  for (const Key& key : shape.keys) {
    names.push_back(key.name);
  }
  return names;
}

/// The alternative of an `either` that can hold keys; the shape itself otherwise.
const Shape& object_alternative(const Shape& shape) {
  if (shape.kind == Kind::either) {
    for (const Shape& item : shape.items) {
      if (item.kind == Kind::object) {
        return item;
      }
    }
  }
  return shape;
}

/// "beams[0].section.radius" as "beams", "0", "section", "radius".
std::vector<std::string> path_parts(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.' || c == '[') {
      parts.emplace_back();
    } else if (c != ']') {
      parts.back() += c;
    }
  }
  return parts;
}

std::optional<std::size_t> as_index(const std::string& text) {
  const bool digits =
      !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? std::optional<std::size_t>(std::stoul(text)) : std::nullopt;
}

/// A value of --set: JSON if it reads as JSON, else the text itself.
Json override_value(const std::string& text) {
  Json value = Json::parse(text, nullptr, false);
  return value.is_discarded() ? Json(text) : value;
}

/// Sets one value of the case; null removes the key. Returns what is wrong, "" if nothing.
std::string apply_override(Json& root, const std::string& path, const Json& new_value) {
  Json* value = &root;
  const Shape* shape = &case_shape();
  std::string walked;
  const std::vector<std::string> parts = path_parts(path);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string& part = parts[i];
    const std::string here = walked.empty() ? "the case file" : walked;
    const Shape& holder = object_alternative(*shape);
    if (holder.kind != Kind::object && !value->is_array()) {
      return here + " has no parts here; set it as a whole";
    }
    if (value->is_array()) {
      const auto index = as_index(part);
      if (!index || *index >= value->size()) {
        return here + " has " + std::to_string(value->size()) + " item(s), counted from 0; there is no [" +
               part + "]";
      }
      walked = child(walked, *index);
      shape = holder.kind == Kind::array ? &holder.items[0] : shape;
      value = &(*value)[*index];
      continue;
    }
    const Key* key = find_key(holder, part);
    if (!key) {
      return "there is no " + in_quotes(part) + " in " + here + known_names(part, key_names(holder));
    }
    walked = child(walked, part);
    shape = &key->shape;
    if (new_value.is_null() && i + 1 == parts.size()) {
      if (value->is_object()) {
        value->erase(part);
      }
      return {};
    }
    if (!value->is_object()) {
      *value = Json::object();
    }
    value = &(*value)[part];
  }
  *value = new_value;
  return {};
}

void apply_overrides(Json& root, const std::vector<std::string>& overrides, std::vector<Diagnostic>& wrong) {
  for (const std::string& text : overrides) {
    const auto equals = text.find('=');
    Json changed = root;
    const std::string problem =
        equals == std::string::npos
            ? "expected path=value, for example analysis.end_time=0.1"
            : apply_override(changed, text.substr(0, equals), override_value(text.substr(equals + 1)));
    if (problem.empty()) {
      root = std::move(changed);
    } else {
      wrong.push_back({Severity::error, "--set " + text, problem});
    }
  }
}

// ---- checking against the shape ----

std::string json_kind(const Json& value) {
  switch (value.type()) {
    case Json::value_t::null:
      return "null";
    case Json::value_t::object:
      return "an object";
    case Json::value_t::array:
      return "an array";
    case Json::value_t::string:
      return "the text " + in_quotes(value.get<std::string>());
    case Json::value_t::boolean:
      return value.get<bool>() ? "true" : "false";
    default:
      return "the number " + value.dump();
  }
}

std::string quantity_hint(Dimension dimension) {
  return dimension == Dimension::number ? std::string("a number")
                                        : "a number in " + si_unit(dimension) + " or a text with a unit (" +
                                              unit_examples(dimension) + ")";
}

std::string expected(const Shape& shape) {
  switch (shape.kind) {
    case Kind::object:
      return "an object with " + quoted_list(key_names(shape));
    case Kind::array:
      return "an array [...]";
    case Kind::either:
      return expected(shape.items[0]) + ", or " + expected(shape.items[1]);
    case Kind::choice:
      return "one of " + quoted_list(shape.choices);
    case Kind::text:
    case Kind::name:
      return "a text in quotes";
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return "an integer";
    case Kind::quantity:
      return quantity_hint(shape.dimension);
    case Kind::vector:
      return "[x, y, z], each " + quantity_hint(shape.dimension);
    case Kind::table:
      return "rows [[time, value], ...], value being " + quantity_hint(shape.dimension);
    case Kind::unavailable:
      break;
  }
  return {};
}

bool fits_json_type(const Shape& shape, const Json& value) {
  switch (shape.kind) {
    case Kind::object:
      return value.is_object();
    case Kind::integer:
      return value.is_number();
    default:
      return value.is_string();
  }
}

/// Checks values against shapes, turns every quantity into a number in SI units, and makes what is unusable
/// null (it has been reported), so that what is left can be checked further.
class Checker {
 public:
  explicit Checker(Findings& findings) : findings_(findings) {}

  /// Whether the value is usable.
  bool check(const Shape& shape, Json& value, const std::string& path) {
    switch (shape.kind) {
      case Kind::object:
        return check_object(shape, value, path);
      case Kind::array:
        return check_array(shape, value, path);
      case Kind::either:
        return check_either(shape, value, path);
      case Kind::choice:
        return check_choice(shape, value, path);
      case Kind::text:
      case Kind::name:
        return check_text(shape, value, path);
      case Kind::boolean:
        return value.is_boolean() || wrong_type(shape, value, path);
      case Kind::integer:
        return check_integer(shape, value, path);
      case Kind::quantity:
        return check_quantity(shape, value, path);
      case Kind::vector:
        return check_vector(shape, value, path);
      case Kind::table:
        return check_table(shape, value, path);
      case Kind::unavailable:
        return failed(path, "is not available in this version; " + shape.hint);
    }
    return false;
  }

 private:
  bool failed(const std::string& path, std::string message) {
    findings_.error(path, std::move(message));
    return false;
  }
  bool wrong_type(const Shape& shape, const Json& value, const std::string& path) {
    return failed(path, "is " + json_kind(value) + "; expected " + expected(shape));
  }

  bool check_object(const Shape& shape, Json& value, const std::string& path) {
    if (!value.is_object()) {
      return wrong_type(shape, value, path);
    }
    for (const auto& [name, unused] : value.items()) {
      if (!find_key(shape, name)) {
        findings_.error(child(path, name),
                        "unknown key " + in_quotes(name) + known_names(name, key_names(shape)));
      }
    }
    check_presence(shape, value, path);
    for (const Key& key : shape.keys) {
      if (value.contains(key.name) && !check(key.shape, value[key.name], child(path, key.name))) {
        value[key.name] = nullptr;
      }
    }
    return true;
  }

  void check_presence(const Shape& shape, const Json& value, const std::string& path) {
    for (const Key& key : shape.keys) {
      if (key.required && !value.contains(key.name)) {
        findings_.error(path, in_quotes(key.name) + " is missing (" + key.description + ")");
      }
      if (value.contains(key.name) && !key.needs.empty() && !value.contains(key.needs)) {
        findings_.error(path, in_quotes(key.name) + " needs " + in_quotes(key.needs) + " beside it");
      }
    }
    for (const Alternatives& alternatives : shape.alternatives) {
      std::vector<std::string> given;
      std::copy_if(alternatives.keys.begin(), alternatives.keys.end(), std::back_inserter(given),
                   [&](const std::string& key) { return value.contains(key); });
      if (given.size() > 1) {
        findings_.error(path, quoted_list(given) + " exclude each other; give one of them");
      } else if (given.empty() && alternatives.required) {
        findings_.error(path, "give one of " + quoted_list(alternatives.keys));
      }
    }
  }

  bool check_array(const Shape& shape, Json& value, const std::string& path) {
    if (!value.is_array()) {
      return wrong_type(shape, value, path);
    }
    if (value.size() < static_cast<std::size_t>(shape.min_items)) {
      return failed(path, "has " + std::to_string(value.size()) + " item(s); expected at least " +
                              std::to_string(shape.min_items));
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (!check(shape.items[0], value[i], child(path, i))) {
        value[i] = nullptr;
      }
    }
    return true;
  }

  bool check_either(const Shape& shape, Json& value, const std::string& path) {
    for (const Shape& item : shape.items) {
      if (fits_json_type(item, value)) {
        return check(item, value, path);
      }
    }
    return wrong_type(shape, value, path);
  }

  bool check_choice(const Shape& shape, const Json& value, const std::string& path) {
    if (!value.is_string()) {
      return wrong_type(shape, value, path);
    }
    const auto text = value.get<std::string>();
    return std::find(shape.choices.begin(), shape.choices.end(), text) != shape.choices.end() ||
           failed(path, in_quotes(text) + " is not known here" + known_names(text, shape.choices));
  }

  bool check_text(const Shape& shape, const Json& value, const std::string& path) {
    if (!value.is_string()) {
      return wrong_type(shape, value, path);
    }
    const auto text = value.get<std::string>();
    if (text.empty()) {
      return failed(path, "is empty");
    }
    const auto is_barred = [](char c) { return c == ',' || c == '"' || (c >= 0 && c < ' '); };
    if (shape.kind == Kind::name && std::any_of(text.begin(), text.end(), is_barred)) {
      return failed(path, in_quotes(text) + ": a name must not hold commas, quotes or control characters");
    }
    return true;
  }

  bool in_range(const Shape& shape, double value, const std::string& path) {
    if (shape.range.contains(value)) {
      return true;
    }
    const std::string unit = shape.dimension == Dimension::number ? "" : " " + si_unit(shape.dimension);
    return failed(path, "is " + text_of(value) + unit + "; must be " + shape.range.rule() +
                            (shape.range.reason.empty() ? "" : " (" + shape.range.reason + ")"));
  }

  bool check_integer(const Shape& shape, Json& value, const std::string& path) {
    if (!value.is_number()) {
      return wrong_type(shape, value, path);
    }
    const double number = value.get<double>();
    if (number != std::floor(number) || std::abs(number) > std::numeric_limits<int>::max()) {
      return failed(path, "is " + text_of(number) + "; expected an integer");
    }
    value = static_cast<int>(number);
    return in_range(shape, number, path);
  }

  bool check_quantity(const Shape& shape, Json& value, const std::string& path) {
    if (value.is_string()) {
      const ParsedQuantity quantity = parse_quantity(value.get<std::string>(), shape.dimension);
      if (!quantity.value) {
        return failed(path, quantity.error);
      }
      value = *quantity.value;
    }
    if (!value.is_number()) {
      return wrong_type(shape, value, path);
    }
    value = value.get<double>();
    return in_range(shape, value.get<double>(), path);
  }

  bool check_vector(const Shape& shape, Json& value, const std::string& path) {
    if (!value.is_array()) {
      return wrong_type(shape, value, path);
    }
    if (value.size() != 3) {
      return failed(path, "has " + std::to_string(value.size()) + " item(s); expected " + expected(shape));
    }
    const Shape component = {.kind = Kind::quantity, .dimension = shape.dimension};
    bool usable = true;
    for (std::size_t i = 0; i < 3; ++i) {
      usable = check(component, value[i], child(path, i)) && usable;
    }
    return usable;
  }

  bool check_table(const Shape& shape, Json& value, const std::string& path) {
    if (!value.is_array() || value.empty()) {
      return wrong_type(shape, value, path);
    }
    const Shape time = {.kind = Kind::quantity, .dimension = Dimension::time};
    const Shape entry = {.kind = Kind::quantity, .dimension = shape.dimension};
    double last = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < value.size(); ++i) {
      Json& row = value[i];
      const std::string row_path = child(path, i);
      if (!row.is_array() || row.size() != 2) {
        return failed(row_path, "expected a row [time, value]");
      }
      if (!check(time, row[0], child(row_path, std::size_t{0})) ||
          !check(entry, row[1], child(row_path, 1))) {
        return false;
      }
      if (row[0].get<double>() <= last) {
        return failed(row_path, "time " + text_of(row[0].get<double>()) + " s does not come after " +
                                    text_of(last) + " s; times must increase");
      }
      last = row[0].get<double>();
    }
    return true;
  }

  Findings& findings_;
};

// ---- checked JSON to the structs ----

/// Whether a usable value stands under the key.
bool has(const Json& object, const char* key) { return object.contains(key) && !object[key].is_null(); }

double number(const Json& object, const char* key,
              double otherwise = std::numeric_limits<double>::quiet_NaN()) {
  return has(object, key) ? object[key].get<double>() : otherwise;
}
std::optional<double> optional_number(const Json& object, const char* key) {
  return has(object, key) ? std::optional(object[key].get<double>()) : std::nullopt;
}
std::optional<int> optional_integer(const Json& object, const char* key) {
  return has(object, key) ? std::optional(object[key].get<int>()) : std::nullopt;
}
std::string text(const Json& object, const char* key, const std::string& otherwise = {}) {
  return has(object, key) ? object[key].get<std::string>() : otherwise;
}
bool flag(const Json& object, const char* key) { return has(object, key) && object[key].get<bool>(); }

const Json& part(const Json& object, const char* key) {
  static const Json none = Json::object();
  return has(object, key) ? object[key] : none;
}

Eigen::Vector3d to_vector(const Json& value) {
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}
Eigen::Vector3d vector(
    const Json& object, const char* key,
    const Eigen::Vector3d& otherwise = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())) {
  return has(object, key) ? to_vector(object[key]) : otherwise;
}

std::vector<Eigen::Vector3d> points(const Json& object, const char* key) {
  std::vector<Eigen::Vector3d> points;
  for (const Json& item : part(object, key)) {
    if (!item.is_null()) {
      points.push_back(to_vector(item));
    }
  }
  return points;
}

std::vector<double> numbers(const Json& object, const char* key) {
  std::vector<double> numbers;
  for (const Json& item : part(object, key)) {
    if (!item.is_null()) {
      numbers.push_back(item.get<double>());
    }
  }
  return numbers;
}

TimeTable time_table(const Json& object, const char* key) {
  TimeTable table;
  for (const Json& row : part(object, key)) {
    table.emplace_back(row[0].get<double>(), row[1].get<double>());
  }
  return table;
}

/// The enumerator whose text stands under the key; the first one if there is none.
template <class Enum>
Enum chosen(const Json& object, const char* key, const std::vector<std::pair<const char*, Enum>>& values) {
  for (const auto& [name, value] : values) {
    if (text(object, key) == name) {
      return value;
    }
  }
  return values.front().second;
}

Place read_place(const Json& object) {
  Place place;
  const Json& at = part(object, "at");
  if (at.is_string()) {
    place.kind = at == "end" ? Place::Kind::end : Place::Kind::start;
  } else if (has(at, "length")) {
    place = {.kind = Place::Kind::length, .value = number(at, "length")};
  } else if (has(at, "fraction")) {
    place = {.kind = Place::Kind::fraction, .value = number(at, "fraction")};
  } else if (has(at, "near")) {
    place = {.kind = Place::Kind::near, .point = vector(at, "near")};
  }
  return place;
}

/// Calls read(item, path) for every usable item of an array.
template <class Read>
void for_each_item(const Json& object, const char* key, const std::string& path, Read read) {
  std::size_t index = 0;
  for (const Json& item : part(object, key)) {
    const std::string item_path = child(child(path, key), index++);
    if (!item.is_null()) {
      read(item, item_path);
    }
  }
}

std::vector<std::string> cad_files_in(const std::filesystem::path& directory) {
  static const std::set<std::string> extensions = {".step", ".stp", ".iges", ".igs",
                                                   ".STEP", ".STP", ".IGES", ".IGS"};
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored)) {
    if (extensions.contains(entry.path().extension().string())) {
      names.push_back(entry.path().filename().string());
    }
  }
  return names;
}

CaseAxis::File read_axis_file(const Json& axis, const std::filesystem::path& directory,
                              const std::string& path, Findings& findings) {
  CaseAxis::File file;
  file.path = (directory / text(axis, "file")).lexically_normal();
  file.chain = flag(axis, "chain");
  if (has(axis, "curve")) {
    const Json& curve = axis["curve"];
    if (curve.is_string()) {
      file.curve_name = curve.get<std::string>();
    } else {
      file.curve_index = curve.get<int>();
    }
  }
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file.path, ignored)) {
    findings.error(child(path, "file"),
                   "there is no file " + in_quotes(file.path.string()) +
                       known_names(file.path.filename().string(), cad_files_in(file.path.parent_path())));
  }
  return file;
}

std::optional<NurbsCurve> read_nurbs(const Json& nurbs, const std::string& path, Findings& findings) {
  const std::vector<Eigen::Vector3d> points_in = points(nurbs, "control_points");
  const std::vector<double> knots = numbers(nurbs, "knots");
  std::vector<double> weights = numbers(nurbs, "weights");
  const bool complete = has(nurbs, "degree") && points_in.size() == part(nurbs, "control_points").size() &&
                        knots.size() == part(nurbs, "knots").size() &&
                        weights.size() == part(nurbs, "weights").size();
  if (!complete || knots.empty() || points_in.empty()) {
    return {};  // what is missing has been reported
  }
  if (!has(nurbs, "weights")) {
    weights.assign(points_in.size(), 1.0);
  }
  if (weights.size() != points_in.size()) {
    findings.error(path, "has " + std::to_string(weights.size()) + " weights for " +
                             std::to_string(points_in.size()) +
                             " control points; give one per control point");
    return {};
  }
  Eigen::Matrix3Xd control_points(3, points_in.size());
  for (std::size_t i = 0; i < points_in.size(); ++i) {
    control_points.col(i) = points_in[i];
  }
  try {
    return make_nurbs_curve(KnotVector(nurbs["degree"].get<int>(), knots), control_points,
                            Eigen::Map<const Eigen::VectorXd>(weights.data(), weights.size()));
  } catch (const std::invalid_argument& error) {
    findings.error(path, error.what());
    return {};
  }
}

CaseAxis::Polyline read_polyline(const Json& axis, const std::string& path, Findings& findings) {
  const CaseAxis::Polyline polyline = points(axis, "polyline");
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    if (polyline[i] == polyline[i - 1]) {
      findings.error(child(child(path, "polyline"), i), "is the same point as the one before; remove one");
    }
  }
  return polyline;
}

CaseAxis::Arc read_arc(const Json& axis, const std::string& axis_path, Findings& findings) {
  const Json& json = part(axis, "arc");
  const std::string path = child(axis_path, "arc");
  const CaseAxis::Arc arc = {vector(json, "center"), vector(json, "start"), vector(json, "end"),
                             vector(json, "normal")};
  const Eigen::Vector3d a = arc.start - arc.center, b = arc.end - arc.center;
  constexpr double relative = 1e-6;
  // Comparisons with a missing (NaN) point are false: it has been reported.
  if (arc.normal.norm() == 0) {
    findings.error(child(path, "normal"), "is [0, 0, 0]; must have a direction");
  } else if (a.norm() == 0) {
    findings.error(child(path, "start"), "is the center; must be apart from it");
  } else if (std::abs(a.norm() - b.norm()) > relative * a.norm()) {
    findings.error(path, "start is " + text_of(a.norm()) + " m and end " + text_of(b.norm()) +
                             " m from the center; must be the same distance");
  } else if (std::max(std::abs(a.dot(arc.normal)), std::abs(b.dot(arc.normal))) >
             relative * a.norm() * arc.normal.norm()) {
    findings.error(child(path, "normal"), "is not perpendicular to the plane of center, start and end");
  } else if ((a - b).norm() <= relative * a.norm()) {
    findings.error(path, "start and end are the same point; a full circle can be given as \"nurbs\"");
  }
  return arc;
}

CaseAxis read_axis(const Json& axis, const std::string& path, const std::filesystem::path& directory,
                   Findings& findings) {
  if (has(axis, "file")) {
    return {read_axis_file(axis, directory, path, findings)};
  }
  if (has(axis, "nurbs")) {
    const auto curve = read_nurbs(axis["nurbs"], child(path, "nurbs"), findings);
    return curve ? CaseAxis{*curve} : CaseAxis{};
  }
  if (has(axis, "polyline")) {
    return {read_polyline(axis, path, findings)};
  }
  if (has(axis, "arc")) {
    return {read_arc(axis, path, findings)};
  }
  return {};
}

CaseSection read_section(const Json& section) {
  if (has(section, "radius")) {
    const double r = number(section, "radius");
    return {.area = std::numbers::pi * r * r, .second_moment = std::numbers::pi * std::pow(r, 4) / 4};
  }
  return {.area = number(section, "area"), .second_moment = number(section, "second_moment")};
}

CaseBeam read_beam(const Json& json, const std::string& path, const std::filesystem::path& directory,
                   Findings& findings) {
  CaseBeam beam;
  beam.path = path;
  beam.name = text(json, "name");
  beam.axis = read_axis(part(json, "axis"), child(path, "axis"), directory, findings);
  beam.section = read_section(part(json, "section"));
  const Json& material = part(json, "material");
  beam.material = {.density = number(material, "density"),
                   .youngs_modulus = number(material, "youngs_modulus"),
                   .damping = number(material, "damping", 0)};
  const Json& elements = part(json, "elements");
  beam.elements = {.count = optional_integer(elements, "count"),
                   .max_length = optional_number(elements, "max_length"),
                   .per_segment = optional_integer(elements, "per_segment"),
                   .grading = number(elements, "grading", 0)};
  beam.approximation_tolerance = number(json, "approximation_tolerance", beam.approximation_tolerance);
  beam.hinged_corners = text(json, "corners") == "hinge";
  beam.element = chosen<ElementKind>(
      json, "element", {{"ale-rancf", ElementKind::ale_rancf}, {"ale-ancf", ElementKind::ale_ancf}});
  beam.weights = chosen<WeightRule>(json, "weights",
                                    {{"material", WeightRule::material}, {"constant", WeightRule::constant}});
  beam.merge = chosen<MergeRule>(
      json, "merge",
      {{"default", MergeRule::standard}, {"paper", MergeRule::paper}, {"ones", MergeRule::ones}});
  beam.stress_free = chosen<StressFree>(json, "stress_free",
                                        {{"", StressFree::automatic},
                                         {"as-drawn", StressFree::as_drawn},
                                         {"straight", StressFree::straight},
                                         {"as-drawn-without-torsion", StressFree::as_drawn_without_torsion}});
  beam.curvature = chosen<CurvatureMeasure>(
      json, "curvature", {{"material", CurvatureMeasure::material}, {"spatial", CurvatureMeasure::spatial}});
  beam.metric = chosen<Metric>(json, "metric", {{"reference", Metric::arc_length}, {"none", Metric::label}});
  beam.form =
      chosen<Form>(json, "form", {{"variational", Form::variational}, {"virtual-work", Form::virtual_work}});
  return beam;
}

CaseLoad read_load(const Json& json, const std::string& path) {
  CaseLoad load;
  load.path = path;
  load.beam = text(json, "beam");
  load.at = read_place(json);
  load.follower = flag(json, "follower");
  load.moving_speed = optional_number(part(json, "moves"), "speed");
  load.time = time_table(json, "time");
  for (const auto& [key, kind] : {std::pair{"force", CaseLoad::Kind::force},
                                  {"moment", CaseLoad::Kind::moment},
                                  {"force_per_length", CaseLoad::Kind::force_per_length}}) {
    if (has(json, key)) {
      load.kind = kind;
      load.value = vector(json, key);
    }
  }
  return load;
}

CaseSupport read_support(const Json& json, const std::string& path) {
  return {.type = chosen<CaseSupport::Type>(
              json, "type", {{"clamped", CaseSupport::Type::clamped}, {"pinned", CaseSupport::Type::pinned}}),
          .path = path,
          .beam = text(json, "beam"),
          .at = read_place(json)};
}

CaseSlidingJoint read_sliding_joint(const Json& json, const std::string& path) {
  const Json& motion = part(json, "motion");
  return {.path = path,
          .body = text(json, "body"),
          .beam = text(json, "beam"),
          .at = read_place(json),
          .speed = number(json, "speed", 0),
          .motion_speed = optional_number(motion, "speed"),
          .motion_table = time_table(motion, "table"),
          .continuous_slope = text(json, "slope") != "discontinuous",
          .leave_at_end = text(json, "at_beam_end") != "stop"};
}

CaseAnalysis read_analysis(const Json& json, Findings& findings) {
  CaseAnalysis analysis;
  analysis.type = chosen<CaseAnalysis::Type>(
      json, "type", {{"dynamic", CaseAnalysis::Type::dynamic}, {"static", CaseAnalysis::Type::statics}});
  analysis.start_from_equilibrium = text(json, "initial") == "equilibrium";
  using Method = CaseAnalysis::Method;
  const Json& integrator = part(json, "integrator");
  analysis.method = chosen<Method>(
      integrator, "type",
      {{"generalized-alpha", Method::generalized_alpha}, {"ida", Method::ida}, {"rk4", Method::rk4}});
  analysis.rho_infinity = number(integrator, "rho_infinity", analysis.rho_infinity);
  if (analysis.method != Method::generalized_alpha && has(integrator, "rho_infinity"))
    findings.add(Severity::warning, "analysis.integrator.rho_infinity",
                 "has an effect with \"generalized-alpha\" only");
  const Json& control = part(json, "length_control");
  analysis.length_control_min = number(control, "min", analysis.length_control_min);
  analysis.length_control_max = number(control, "max", analysis.length_control_max);
  if (analysis.type == CaseAnalysis::Type::statics) {
    for (const char* key : {"end_time", "step", "tolerance", "initial"}) {
      if (has(json, key)) {
        findings.add(Severity::warning, child("analysis", key), "has no effect in a static analysis");
      }
    }
    return analysis;
  }
  const double default_tolerance = analysis.method == Method::ida ? 1e-8 : 1e-4;
  analysis.end_time = number(json, "end_time", 0);
  analysis.step = optional_number(json, "step");
  analysis.tolerance = optional_number(json, "tolerance");
  if (!analysis.step && !analysis.tolerance) {
    analysis.tolerance = default_tolerance;
  }
  if (analysis.method == Method::rk4 && !analysis.step)
    findings.error("analysis.step", "is missing; the explicit method \"rk4\" needs a fixed step");
  return analysis;
}

CaseOutput read_output(const Json& json, const CaseAnalysis& analysis, Findings& findings) {
  CaseOutput output;
  output.every = optional_number(json, "every");
  constexpr int default_frames = 100;
  if (!output.every && analysis.type == CaseAnalysis::Type::dynamic) {
    output.every = analysis.end_time / default_frames;
  }
  if (has(json, "cad")) {
    const Json& cad = json["cad"];
    output.cad_formats = {"step"};
    output.cad_times = {analysis.end_time};
    output.cad_unit = text(cad, "unit", output.cad_unit);
    if (has(cad, "formats")) {
      output.cad_formats.clear();
      for_each_item(cad, "formats", "", [&](const Json& format, const std::string&) {
        output.cad_formats.push_back(format.get<std::string>());
      });
    }
    if (has(cad, "times")) {
      output.cad_times = numbers(cad, "times");
    }
  }
  for_each_item(json, "probes", "output", [&](const Json& probe, const std::string&) {
    output.probes.push_back(
        {.name = text(probe, "name"), .beam = text(probe, "beam"), .at = read_place(probe)});
  });
  for (const char* key : {"paraview", "report"}) {
    if (flag(json, key)) {
      findings.add(Severity::note, child("output", key), "this version does not write it");
    }
  }
  return output;
}

CaseFile read_case(const Json& json, const std::filesystem::path& file, Findings& findings) {
  CaseFile result;
  result.path = file;
  result.name = text(json, "name", file.stem().string());
  result.gravity = vector(json, "gravity", result.gravity);
  const std::filesystem::path directory = std::filesystem::absolute(file).parent_path();
  for_each_item(json, "beams", "", [&](const Json& beam, const std::string& path) {
    result.beams.push_back(read_beam(beam, path, directory, findings));
  });
  for_each_item(json, "bodies", "", [&](const Json& body, const std::string&) {
    result.bodies.push_back({.name = text(body, "name"), .mass = number(body, "mass")});
  });
  for_each_item(json, "loads", "", [&](const Json& load, const std::string& path) {
    result.loads.push_back(read_load(load, path));
  });
  for_each_item(json, "supports", "", [&](const Json& support, const std::string& path) {
    result.supports.push_back(read_support(support, path));
  });
  for_each_item(json, "sliding_joints", "", [&](const Json& joint, const std::string& path) {
    result.sliding_joints.push_back(read_sliding_joint(joint, path));
  });
  result.analysis = read_analysis(part(json, "analysis"), findings);
  result.output = read_output(part(json, "output"), result.analysis, findings);
  return result;
}

// ---- checks across the file ----

/// Reports names that occur twice. An empty name has been reported.
void check_unique(const std::vector<std::pair<std::string, std::string>>& names_and_paths,
                  Findings& findings) {
  std::map<std::string, std::string> first;
  for (const auto& [name, path] : names_and_paths) {
    const auto [other, is_new] = first.emplace(name, path);
    if (!is_new && !name.empty()) {
      findings.error(path,
                     in_quotes(name) + " is already the name of " + other->second + "; names must differ");
    }
  }
}

void check_names(const Json& json, Findings& findings) {
  const auto collect = [](const Json& holder, const char* key, const std::string& path) {
    std::vector<std::pair<std::string, std::string>> names;
    for_each_item(holder, key, path, [&](const Json& item, const std::string& item_path) {
      names.emplace_back(text(item, "name"), child(item_path, "name"));
    });
    return names;
  };
  check_unique(collect(json, "beams", ""), findings);
  auto columns = collect(json, "bodies", "");  // bodies and probes head columns of the same table
  const auto probes = collect(part(json, "output"), "probes", "output");
  columns.insert(columns.end(), probes.begin(), probes.end());
  check_unique(columns, findings);
}

/// The names of the items under the key; nothing when one of them is unusable.
std::optional<std::vector<std::string>> names_under(const Json& json, const char* key) {
  std::vector<std::string> names;
  if (json.contains(key) && json[key].is_null()) {
    return {};
  }
  for (const Json& item : part(json, key)) {
    names.push_back(item.is_null() ? "" : text(item, "name"));
    if (names.back().empty()) {
      return {};
    }
  }
  return names;
}

bool is_one_of(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Reports, for every item under the key, a name under `reference` that is not among the known ones.
void check_references(const Json& holder, const char* key, const std::string& path, const char* reference,
                      const std::vector<std::string>& known, Findings& findings) {
  for_each_item(holder, key, path, [&](const Json& item, const std::string& item_path) {
    const std::string name = text(item, reference);
    if (!name.empty() && !is_one_of(name, known)) {
      findings.error(child(item_path, reference), "there is no " + std::string(reference) + " " +
                                                      in_quotes(name) + known_names(name, known));
    }
  });
}

void check_references(const Json& json, Findings& findings) {
  if (const auto beams = names_under(json, "beams")) {
    check_references(json, "loads", "", "beam", *beams, findings);
    check_references(json, "supports", "", "beam", *beams, findings);
    check_references(json, "sliding_joints", "", "beam", *beams, findings);
    check_references(part(json, "output"), "probes", "output", "beam", *beams, findings);
  }
  if (const auto bodies = names_under(json, "bodies")) {
    check_references(json, "sliding_joints", "", "body", *bodies, findings);
  }
}

/// Every body is held by exactly one sliding joint.
void check_bodies(const Json& json, const CaseFile& c, Findings& findings) {
  std::map<std::string, std::vector<std::string>> holders;  // paths of the joints of each body
  for (const CaseSlidingJoint& joint : c.sliding_joints) {
    holders[joint.body].push_back(joint.path);
  }
  const std::vector<std::string> bodies = names_under(json, "bodies").value_or(std::vector<std::string>{});
  const bool all_known = std::all_of(holders.begin(), holders.end(),
                                     [&](const auto& holder) { return is_one_of(holder.first, bodies); });
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::vector<std::string>& joints = holders[bodies[i]];
    if (joints.empty() && all_known) {
      findings.error(child("bodies", i),
                     "no sliding joint holds the body " + in_quotes(bodies[i]) +
                         ", so it has no place; add one to \"sliding_joints\" or remove it");
    } else if (joints.size() > 1) {
      findings.error(joints[1], "the body " + in_quotes(bodies[i]) + " is already held by " + joints[0] +
                                    "; a body slides on one beam");
    }
  }
}

void check_times(const Json& json, const CaseFile& c, Findings& findings) {
  const bool dynamic = c.analysis.type == CaseAnalysis::Type::dynamic;
  if (dynamic && has(json, "analysis") && !json["analysis"].contains("end_time")) {
    findings.error("analysis",
                   "\"end_time\" is missing; a dynamic analysis needs it (or \"type\": \"static\")");
    return;
  }
  for (std::size_t i = 0; dynamic && i < c.output.cad_times.size(); ++i) {
    if (c.output.cad_times[i] > c.analysis.end_time) {
      findings.error(child("output.cad.times", i), "is " + text_of(c.output.cad_times[i]) +
                                                       " s; must not be after analysis.end_time, " +
                                                       text_of(c.analysis.end_time) + " s");
    }
  }
}

// ---- the schema ----

Json schema_of(const Shape& shape);

Json object_schema(const Shape& shape) {
  Json schema = {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
  for (const Key& key : shape.keys) {
    Json property = schema_of(key.shape);
    const std::string detail = property.value("description", "");
    property["description"] = key.description + (detail.empty() ? "" : " (" + detail + ")");
    schema["properties"][key.name] = property;
    if (key.required) {
      schema["required"].push_back(key.name);
    }
    if (!key.needs.empty()) {
      schema["dependentRequired"][key.name] = Json::array({key.needs});
    }
  }
  for (const Alternatives& alternatives : shape.alternatives) {
    Json one_of = Json::array();
    for (const std::string& key : alternatives.keys) {
      one_of.push_back({{"required", Json::array({key})}});
    }
    if (!alternatives.required) {
      one_of.push_back({{"not", {{"anyOf", one_of}}}});
    }
    schema["allOf"].push_back({{"oneOf", one_of}});
  }
  return schema;
}

Json with_range(Json schema, const Range& range) {
  if (std::isfinite(range.lower)) {
    schema[range.open ? "exclusiveMinimum" : "minimum"] = range.lower;
  }
  if (std::isfinite(range.upper)) {
    schema[range.open ? "exclusiveMaximum" : "maximum"] = range.upper;
  }
  return schema;
}

Json quantity_schema(Dimension dimension) {
  if (dimension == Dimension::number) {
    return {{"type", "number"}};
  }
  return {{"type", {"number", "string"}},
          {"description", "in " + si_unit(dimension) + ", or a text with a unit"}};
}

Json schema_of(const Shape& shape) {
  switch (shape.kind) {
    case Kind::object:
      return object_schema(shape);
    case Kind::array:
      return {{"type", "array"}, {"items", schema_of(shape.items[0])}, {"minItems", shape.min_items}};
    case Kind::either:
      return {{"anyOf", {schema_of(shape.items[0]), schema_of(shape.items[1])}}};
    case Kind::choice:
      return {{"enum", shape.choices}};
    case Kind::text:
      return {{"type", "string"}, {"minLength", 1}};
    case Kind::name:
      return {{"type", "string"}, {"pattern", "^[^,\"\\u0000-\\u001f]+$"}};
    case Kind::boolean:
      return {{"type", "boolean"}};
    case Kind::integer:
      return with_range({{"type", "integer"}}, shape.range);
    case Kind::quantity:
      return with_range(quantity_schema(shape.dimension), shape.range);
    case Kind::vector:
      return {
          {"type", "array"}, {"items", quantity_schema(shape.dimension)}, {"minItems", 3}, {"maxItems", 3}};
    case Kind::table:
      return {{"type", "array"},
              {"items",
               {{"type", "array"},
                {"prefixItems", {quantity_schema(Dimension::time), quantity_schema(shape.dimension)}},
                {"minItems", 2},
                {"maxItems", 2}}},
              {"minItems", 1}};
    case Kind::unavailable:
      return {{"not", Json::object()}, {"description", "not available in this version; " + shape.hint}};
  }
  return {};
}

}  // namespace

CaseFileReport read_case_file(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Findings findings(file.string());
  const auto text_in = read_text(file, findings);
  auto json = text_in ? parse(*text_in, findings) : std::nullopt;
  if (!json) {
    return {{}, findings.take()};
  }
  std::vector<Diagnostic> diagnostics;
  apply_overrides(*json, overrides, diagnostics);
  std::optional<CaseFile> value;
  if (Checker(findings).check(case_shape(), *json, "")) {
    value = read_case(*json, file, findings);
    check_names(*json, findings);
    check_references(*json, findings);
    check_bodies(*json, *value, findings);
    check_times(*json, *value, findings);
  }
  if (findings.has_errors() || !diagnostics.empty()) {
    value.reset();
  }
  const std::vector<Diagnostic> found = findings.take();
  diagnostics.insert(diagnostics.end(), found.begin(), found.end());
  return {std::move(value), std::move(diagnostics)};
}

std::string case_file_schema() {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "nurbeam case file"}};
  schema.update(schema_of(case_shape()));
  return schema.dump(2) + "\n";
}

}  // namespace nurbeam
