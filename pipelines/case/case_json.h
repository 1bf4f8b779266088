#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/case/case_keys.h"
#include "pipelines/diagnostics/findings.h"

/// Private to the reader of case files: its JSON.
namespace nurbeam {

using Json = nlohmann::ordered_json;

inline std::string child(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}
inline std::string child(const std::string& path, std::size_t index) {
  return path + "[" + std::to_string(index) + "]";
}

/// The offset of the bracket that opens a level deeper than any case needs, or npos. JSON is nested freely
/// and read recursively: a text of brackets alone would exhaust the stack.
std::size_t too_deep_at(const std::string& text);
std::string too_deep_message();

/// The key of an object shape, nullptr if it has none of that name.
const Key* find_key(const Shape& shape, const std::string& name);
std::vector<std::string> key_names(const Shape& shape);

/// The JSON of a text with comments; nothing, and findings, when it cannot be read as JSON.
std::optional<Json> parse_json(const std::string& text, Findings& findings);
/// What a file should be, for messages.
struct JsonFileKind {
  const char* name;
  const char* version;   ///< the key that says so
  const char* command;   ///< that takes it
  const char* smallest;  ///< what the smallest one has
};
inline constexpr JsonFileKind case_file_kind{"case file", "nurbeam", "nurbeam run",
                                             R"("nurbeam": 1, "beams" and "analysis")"};
inline constexpr JsonFileKind study_file_kind{"study file", "nurbeam_study", "nurbeam study",
                                              R"("nurbeam_study": 1, "variables", "quantities" and "plan")"};
/// The same of a file of that kind; nothing, and a finding, where it is of the other.
std::optional<Json> read_json(const std::filesystem::path& file, const JsonFileKind& kind,
                              Findings& findings);

}  // namespace nurbeam
