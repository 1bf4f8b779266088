#include "pipelines/case/case_json.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

using Kind = Shape::Kind;

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

constexpr int deepest = 64;

/// The offset of the bracket that opens a level deeper than any case needs, or npos. JSON is nested freely
/// and read recursively: a text of brackets alone would exhaust the stack.
std::size_t too_deep_at(const std::string& text) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    switch (text[i]) {
      case '"':
        for (++i; i < text.size() && text[i] != '"'; ++i) {
          i += text[i] == '\\';
        }
        break;
      case '/':
        if (text.compare(i, 2, "//") == 0) {
          i = text.find('\n', i);
        } else if (text.compare(i, 2, "/*") == 0) {
          i = text.find("*/", i + 2);
        }
        if (i == std::string::npos) {
          return i;
        }
        break;
      case '[':
      case '{':
        if (++depth > deepest) {
          return i;
        }
        break;
      case ']':
      case '}':
        --depth;
        break;
      default:
        break;
    }
  }
  return std::string::npos;
}

std::string too_deep_message() {
  return "brackets are nested more than " + std::to_string(deepest) + " deep; a case needs fewer than 10";
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
  if (const std::size_t offset = too_deep_at(text); offset != std::string::npos) {
    findings.error(line_and_column(text, offset), too_deep_message());
    return {};
  }
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
  if (std::filesystem::is_block_file(file) || std::filesystem::is_character_file(file)) {
    findings.error("", "is a device; expected a case file (JSON)");
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

/// Whether the brackets of a path hold indices behind names, as in beams[0].section.radius.
bool has_sound_brackets(const std::string& path) {
  bool inside = false;
  char last = '.';
  for (const char c : path) {
    const bool opens = c == '[', closes = c == ']', continues = c == '.' || opens;
    if ((opens && (inside || last == '.')) || (closes && !inside) || (c == '.' && inside) ||
        (last == ']' && !continues)) {
      return false;
    }
    inside = opens || (inside && !closes);
    last = c;
  }
  return !inside;
}

/// The number that a text outside JSON's grammar (".45", "5.", "+5", "007") means.
std::optional<double> loose_number(std::string_view text) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
  }
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc{} && end == text.data() + text.size() && std::isfinite(number);
  return whole ? std::optional(number) : std::nullopt;
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

}  // namespace

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

std::optional<Json> read_json(const std::filesystem::path& file, Findings& findings) {
  const auto text = read_text(file, findings);
  return text ? parse(*text, findings) : std::nullopt;
}

namespace {

/// What is wrong with a --set text, "" if nothing; then the case has been changed.
std::string apply_override(Json& root, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) {
    return "expected path=value, for example analysis.end_time=0.1";
  }
  const std::string path = text.substr(0, equals), value_text = text.substr(equals + 1);
  if (!has_sound_brackets(path)) {
    return "the brackets of the path do not match; write it as in beams[0].section.radius=0.01";
  }
  if (too_deep_at(value_text) != std::string::npos) {
    return too_deep_message();
  }
  Json value = Json::parse(value_text, nullptr, false);
  if (value.is_discarded()) {
    if (const auto number = loose_number(value_text)) {
      return in_quotes(value_text) + " is not a number as JSON writes it; write " +
             text_of(*number, all_digits);
    }
    value = value_text;  // what does not read as JSON is a text
  }
  Json changed = root;
  const std::string problem = apply_override(changed, path, value);
  if (problem.empty()) {
    root = std::move(changed);
  }
  return problem;
}

}  // namespace

void apply_overrides(Json& root, const std::vector<std::string>& overrides, std::vector<Diagnostic>& wrong) {
  for (const std::string& text : overrides) {
    if (const std::string problem = apply_override(root, text); !problem.empty()) {
      wrong.push_back({Severity::error, "--set " + text, problem});
    }
  }
}

}  // namespace nurbeam
