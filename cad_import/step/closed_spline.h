#pragma once
#include <Interface_InterfaceModel.hxx>

namespace nurbeam {

/// Takes the mark of closed curves from the B-splines of a STEP model whose ends have different weights:
/// OpenCASCADE makes marked ones periodic, which gives their end the weight of their start and bends the last
/// piece.
void unmark_closed_splines(const Interface_InterfaceModel& model);

}  // namespace nurbeam
