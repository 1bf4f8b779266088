#pragma once
#include <string>

#include "cad_import/import_curves.h"
#include "tests/cad_import/scratch_directory.h"

namespace nurbeam {

/// What import_curves() gives of a file that holds this text.
inline ImportReport import_text(const std::string& text) {
  const ScratchDirectory scratch;
  return import_curves(scratch.file("drawing.cad", text));
}

}  // namespace nurbeam
