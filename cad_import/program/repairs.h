#pragma once
#include <map>
#include <string>

#include "cad_import/report/import_report.h"

namespace nurbeam {

/// What is done to knots, in every format.
inline constexpr const char* repaired_knots =
    "knots that decrease, or differ at an end, in their last digits are one";

/// What was repaired in a file, by the rule of report/leniency.h: one note for each kind.
class Repairs {
 public:
  /// An entity, what was done to those of its kind, and by how much [m].
  void add(const std::string& entity, const std::string& what, double size);
  /// The same, by how much as a part of the whole.
  void add_relative(const std::string& entity, const std::string& what, double part);
  /// Their numbers and largest sizes; nothing of them is told twice.
  void tell(ImportReport& report);

 private:
  struct Kind {
    std::string first;  // entity
    int count = 0;
    double largest = 0;
    bool is_relative = false;
  };
  void add(const std::string& entity, const std::string& what, double size, bool is_relative);

  std::map<std::string, Kind> kinds_;  // by what was done
};

}  // namespace nurbeam
