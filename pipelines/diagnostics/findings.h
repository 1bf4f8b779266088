#pragma once
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cad_import/report/diagnostic.h"

namespace nurbeam {

/// The diagnostics of one case file, each with the JSON path it is about, and each said once.
class Findings {
 public:
  explicit Findings(std::string file) : file_(std::move(file)) {}

  void add(Severity severity, const std::string& path, std::string message) {
    add({severity, where(path), std::move(message)});
  }
  void error(const std::string& path, std::string message) { add(Severity::error, path, std::move(message)); }
  void warn(const std::string& path, std::string message) {
    add(Severity::warning, path, std::move(message));
  }
  /// Those of a file that the case names.
  void append(const std::vector<Diagnostic>& others) {
    for (const Diagnostic& other : others) add(other);
  }
  /// The file, and the path in it; "" stands for the whole file.
  std::string where(const std::string& path) const { return path.empty() ? file_ : file_ + ": " + path; }
  bool has_errors() const { return nurbeam::has_errors(diagnostics_); }
  std::vector<Diagnostic> take() { return std::move(diagnostics_); }

 private:
  void add(Diagnostic diagnostic) {
    if (std::find(diagnostics_.begin(), diagnostics_.end(), diagnostic) == diagnostics_.end())
      diagnostics_.push_back(std::move(diagnostic));
  }

  std::string file_;
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace nurbeam
