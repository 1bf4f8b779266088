#pragma once
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cad_import/import_report.h"
#include "pipelines/case_shape.h"

/// Private to the reader of case files: its JSON, and what is wrong with it.
namespace nurbeam {

using Json = nlohmann::ordered_json;

inline std::string child(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}
inline std::string child(const std::string& path, std::size_t index) {
  return path + "[" + std::to_string(index) + "]";
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

/// The key of an object shape, nullptr if it has none of that name.
const Key* find_key(const Shape& shape, const std::string& name);
std::vector<std::string> key_names(const Shape& shape);

/// The JSON of a case file with comments; nothing, and findings, when it cannot be read as JSON.
std::optional<Json> read_json(const std::filesystem::path& file, Findings& findings);

/// Applies --set path=value texts; what is wrong with them goes to `wrong`.
void apply_overrides(Json& root, const std::vector<std::string>& overrides, std::vector<Diagnostic>& wrong);

/// Checks a value against its shape, turns every quantity into a number in SI units, and makes what is
/// unusable null (it has been reported), so that what is left can be checked further. Returns whether the
/// value is usable.
bool check_shape(const Shape& shape, Json& value, Findings& findings);

}  // namespace nurbeam
