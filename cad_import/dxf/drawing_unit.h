#pragma once
#include <optional>

#include "cad_import/report/length_unit.h"

namespace nurbeam {

/// The unit that a value of $INSUNITS declares, of all that the DXF reference has; nothing for 0, which
/// declares none, and for any other value.
std::optional<NamedUnit> drawing_unit(int insunits);

}  // namespace nurbeam
