#include "cad_import/dxf/drawing_notes.h"

namespace nurbeam {

void DrawingNotes::add(Severity severity, const std::string& where, const std::string& message) {
  const auto [place, is_new] = place_of_.try_emplace(message, messages_.size());
  if (is_new) messages_.push_back({{severity, where, message}, 0});
  ++messages_[place->second].count;
}

std::vector<Diagnostic> DrawingNotes::diagnostics() const {
  std::vector<Diagnostic> all;
  for (const auto& [first, count] : messages_) {
    all.push_back(first);
    if (count > 1) all.back().message += "; so it is with " + std::to_string(count) + " entities in all";
  }
  if (kinds_not_read_.empty()) return all;
  std::string kinds;
  for (const auto& [kind, count] : kinds_not_read_)
    kinds += (kinds.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
  all.push_back({Severity::note, "",
                 "entities of " + std::to_string(kinds_not_read_.size()) + " kind(s) are not read: " + kinds +
                     "; what is wanted of them is to be exploded, or "
                     "drawn by lines, arcs, polylines or splines"});
  return all;
}

}  // namespace nurbeam
