#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cad_import/report/import_report.h"

namespace nurbeam {

/// The curves of a directrix from one of its parameters to another, and what is to be said of it.
struct CutDirectrix {
  std::vector<ImportedCurve> curves;
  std::string remark = {};  ///< "" where there is nothing to say
};

/// Cuts a directrix whose curves stand one after another, each with the parameters of IFC as its knots: those
/// of the whole count on from curve to curve. None: from its start, to its end. Both are taken for lengths
/// where they are no parameters, as some programs write them, which the remark tells. An end that is the
/// number of curves, the length or 1 cuts nothing but a polyline. Throws std::runtime_error for parameters
/// that are none of these, or leave nothing.
CutDirectrix cut_directrix(std::vector<ImportedCurve> directrix, std::optional<double> first,
                           std::optional<double> last);

}  // namespace nurbeam
