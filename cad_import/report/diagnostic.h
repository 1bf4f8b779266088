#pragma once
#include <string>
#include <vector>

namespace nurbeam {

enum class Severity { note, warning, error };

/// Something a user must know about a file: data, not an exception.
struct Diagnostic {
  Severity severity;
  std::string where;    ///< file, entity or JSON path
  std::string message;  ///< what was found, the rule, and the nearest valid alternative

  bool operator==(const Diagnostic&) const = default;
};

bool has_errors(const std::vector<Diagnostic>& diagnostics);

}  // namespace nurbeam
