#pragma once
#include <algorithm>
#include <string>

#include "cad_import/import_curves.h"
#include "tests/cad_import/scratch_directory.h"

namespace nurbeam {

/// Pairs of a drawing from one line: "0 LINE 10 1.5 ...".
inline std::string dxf_pairs(std::string line) {
  std::replace(line.begin(), line.end(), ' ', '\n');
  return line + "\n";
}

/// A drawing of these entities, its header holding these variables besides.
inline std::string drawing_of(const std::string& entities, const std::string& header = "9 $INSUNITS 70 6") {
  return dxf_pairs("0 SECTION 2 HEADER " + header + " 0 ENDSEC 0 SECTION 2 ENTITIES " + entities +
                   " 0 ENDSEC 0 EOF");
}

inline ImportReport import_drawing(const std::string& text) {
  const ScratchDirectory scratch;
  return import_curves(scratch.file("drawing.dxf", text));
}

}  // namespace nurbeam
