#include "cad_import/program/repairs.h"

#include <algorithm>

#include "cad_import/program/entity_origins.h"
#include "cad_import/report/length_unit.h"
#include "nurbs/number_text.h"

namespace nurbeam {

void Repairs::add(const std::string& entity, const std::string& what, double size, bool is_relative) {
  Kind& kind = kinds_[what];
  if (++kind.count == 1) kind.first = entity;
  kind.largest = std::max(kind.largest, size);
  kind.is_relative = is_relative;
}

void Repairs::add(const std::string& entity, const std::string& what, double size) {
  add(entity, what, size, false);
}

void Repairs::add_relative(const std::string& entity, const std::string& what, double part) {
  add(entity, what, part, true);
}

void Repairs::tell(ImportReport& report) {
  for (const auto& [what, kind] : kinds_) {
    const std::string size = kind.is_relative ? text_of(kind.largest, 3) + " of the whole"
                                              : text_of(kind.largest * millimetres_per_metre, 3) + " mm";
    add_diagnostic(report, Severity::note, kind.first,
                   "repaired: " + what + ", by at most " + size + "; so in " + std::to_string(kind.count) +
                       (kind.count == 1 ? " entity" : " entities") + " in all");
  }
  kinds_.clear();
}

}  // namespace nurbeam
