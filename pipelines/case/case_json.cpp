#include "pipelines/case/case_json.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <new>
#include <set>
#include <sstream>

#include "cad_import/files/cad_file_name.h"
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
  if (message.starts_with("parse error at")) message.erase(0, message.find(": ") + 2);
  return message;
}

/// The run of letters around an offset; "NaN" for the offset of any of its letters.
std::string word_at(const std::string& text, std::size_t offset) {
  const auto is_letter = [&](std::size_t i) {
    return std::isalpha(static_cast<unsigned char>(text[i])) != 0;
  };
  std::size_t begin = std::min(offset, text.size()), end = begin;
  while (begin > 0 && is_letter(begin - 1)) --begin;
  while (end < text.size() && is_letter(end)) ++end;
  return text.substr(begin, end - begin);
}

bool is_not_a_finite_number(const std::string& word) {
  static const std::set<std::string> words = {"nan", "NaN", "NAN",      "inf",
                                              "Inf", "INF", "Infinity", "infinity"};
  return words.contains(word);
}

/// What people write that JSON does not have, at the place where the parser stops; empty for other faults.
std::string common_fault(const std::string& text, std::size_t offset) {
  const auto is_digit = [&](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
  };
  std::size_t begin = std::min(offset, text.size());
  while (begin > 0 && is_digit(begin) && is_digit(begin - 1)) --begin;
  const std::size_t before = begin == 0 ? std::string::npos : text.find_last_not_of(" \t\r\n", begin - 1);
  if (before == std::string::npos || text[before] != ',') return "";
  const char here = offset < text.size() ? text[offset] : ' ';
  if (here == '}' || here == ']')
    return std::string("unexpected '") + here + "': a comma stands before the closing " + here +
           "; remove the comma";
  if (is_digit(begin) && before == begin - 1 && before > 0 && is_digit(before - 1)) {
    std::size_t start = before, end = begin;
    while (start > 0 && is_digit(start - 1)) --start;
    while (is_digit(end)) ++end;
    const std::string whole = text.substr(start, before - start), part = text.substr(begin, end - begin);
    return whole + "," + part + " has a decimal comma; did you mean " + whole + "." + part + "?";
  }
  return "";
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
      if (!level.keys.insert(level.key).second)
        findings_.error(path(), "the key " + in_quotes(level.key) + " stands twice in this object; keep one");
    } else if (event == Event::object_end || event == Event::array_end) {
      levels_.pop_back();
    } else {
      if (!levels_.empty() && levels_.back().is_array) ++levels_.back().count;
      if (event != Event::value) levels_.push_back({.is_array = event == Event::array_start});
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
    for (const Level& level : levels_)
      path = level.is_array ? child(path, level.count - 1) : child(path, level.key);
    return path;
  }

  Findings& findings_;
  std::vector<Level> levels_;
};

}  // namespace

std::optional<Json> parse_json(const std::string& text, Findings& findings) {
  if (const std::size_t offset = too_deep_at(text); offset != std::string::npos) {
    findings.error(line_and_column(text, offset), too_deep_message());
    return {};
  }
  try {
    return Json::parse(text, DuplicateKeys(findings), true, true);
  } catch (const Json::parse_error& error) {
    const std::size_t offset = error.byte == 0 ? 0 : error.byte - 1;
    const std::string word = word_at(text, offset), fault = common_fault(text, offset);
    findings.error(line_and_column(text, offset),
                   is_not_a_finite_number(word)
                       ? word + " is not a number a case file can hold; write a finite number"
                   : fault.empty() ? bare_message(error.what())
                                   : fault);
  } catch (const Json::out_of_range& error) {  // a number too large for a double
    const std::string message = bare_message(error.what());
    const auto begin = message.find('\''), end = message.rfind('\'');
    const std::string number = begin < end ? message.substr(begin + 1, end - begin - 1) : "";
    findings.error(line_and_column(text, text.find(number)),
                   "the number " + number + " is too large; write a finite number");
  }
  return {};
}

namespace {

/// What else was meant by a file that is not there.
std::string json_files_beside(const std::filesystem::path& file) {
  constexpr std::size_t most = 20;
  std::vector<std::string> names;
  const std::filesystem::path folder = file.parent_path();
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, failed))
    if (entry.path().extension() == ".json") names.push_back(entry.path().filename().string());
  if (failed) return "; there is no folder " + in_quotes(folder.string());
  if (names.empty()) return "; there is no .json file in its folder";
  std::sort(names.begin(), names.end());
  if (names.size() > most) names.resize(most);
  return known_names(file.filename().string(), names);
}

std::optional<std::string> read_text(const std::filesystem::path& file, const JsonFileKind& kind,
                                     Findings& findings) {
  const std::string expected = "; expected a " + std::string(kind.name) + " (JSON)";
  if (std::filesystem::is_directory(file)) {
    findings.error("", "is a directory" + expected);
    return {};
  }
  if (std::filesystem::exists(file) && !std::filesystem::is_regular_file(file)) {
    findings.error("", "is a device or a pipe" + expected);
    return {};
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (text.bad()) throw std::bad_alloc();  // streams keep it to themselves
  if (!stream.is_open() || stream.bad()) {
    findings.error("", std::string("cannot be read: ") + std::strerror(errno) + json_files_beside(file));
    return {};
  }
  if (is_named_as_cad_file(file)) {
    findings.error("", "is a CAD file" + expected + ", which names it: \"axis\": { \"file\": " +
                           in_quotes(file.filename().string()) + " }; \"nurbeam inspect\" lists its curves");
    return {};
  }
  if (text.str().find_first_not_of(" \t\r\n") == std::string::npos) {
    findings.error("", "is empty" + expected + "; the smallest has " + kind.smallest);
    return {};
  }
  return text.str();
}

}  // namespace

constexpr int deepest = 64;  // levels of brackets

std::size_t too_deep_at(const std::string& text) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    switch (text[i]) {
      case '"':
        for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\';
        break;
      case '/':
        if (text.compare(i, 2, "//") == 0)
          i = text.find('\n', i);
        else if (text.compare(i, 2, "/*") == 0)
          i = text.find("*/", i + 2);
        if (i == std::string::npos) return i;
        break;
      case '[':
      case '{':
        if (++depth > deepest) return i;
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
  return "brackets are nested more than " + std::to_string(deepest) + " deep; fewer than 10 are needed";
}

const Key* find_key(const Shape& shape, const std::string& name) {
  const auto found =
      std::find_if(shape.keys.begin(), shape.keys.end(), [&](const Key& k) { return k.name == name; });
  return found == shape.keys.end() ? nullptr : &*found;
}

std::vector<std::string> key_names(const Shape& shape) {
  std::vector<std::string> names;
  for (const Key& key : shape.keys) names.push_back(key.name);
  return names;
}

std::optional<Json> read_json(const std::filesystem::path& file, const JsonFileKind& kind,
                              Findings& findings) {
  const auto text = read_text(file, kind, findings);
  auto json = text ? parse_json(*text, findings) : std::nullopt;
  if (!json || json->contains(kind.version)) return json;
  for (const JsonFileKind& other : {case_file_kind, study_file_kind})
    if (json->contains(other.version)) {
      findings.error("", std::string("this is a ") + other.name + ", and a " + kind.name + " is wanted; \"" +
                             other.command + "\" takes it");
      return std::nullopt;
    }
  return json;
}

}  // namespace nurbeam
