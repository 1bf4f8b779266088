#pragma once
#include <string>
#include <vector>

#include "cad_import/report/import_report.h"
#include "pipelines/case/case_file.h"

namespace nurbeam {

/// The curves of a file that a case narrows its choice to, or why there are none.
struct ChosenCurves {
  std::vector<int> indices;  ///< into the report's curves, ascending
  std::string key, error;    ///< the key that no curve has; empty where there are some
};

/// Those of the part (its path, or the end of it), the layer and the colour that are asked for; of all where
/// nothing is.
ChosenCurves chosen_curves(const CurveChoice& choice, const ImportReport& report);

/// `; "layer" chooses among "axes", "outline"`: what curves of a file that has several of them could be
/// chosen by; empty where there is nothing.
std::string what_chooses(const CurveChoice& choice, const ImportReport& report);

}  // namespace nurbeam
