#pragma once
#include <filesystem>
#include <stdexcept>

#include "cad_import/export_curves.h"
#include "tests/support/profiles.h"

namespace nurbeam {

/// Writes outlines as a drawing of a section.
inline void write_profile(const std::filesystem::path& file, const std::vector<Outline>& outlines) {
  std::vector<NamedCurve> curves;
  for (const Outline& outline : outlines)
    for (const NurbsCurve& curve : outline)
      curves.push_back({"side " + std::to_string(curves.size() + 1), curve});
  for (const Diagnostic& problem : export_curves(file, curves, LengthUnit::millimetre))
    throw std::runtime_error(problem.message);
}

}  // namespace nurbeam
