#pragma once
#include <TopoDS_Shape.hxx>
#include <string>
#include <utility>

#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// swept_pipe() or swept_profile().
TopoDS_Shape swept_solid(const NamedSolid& solid);

/// Name of the solid and of its part.
std::pair<std::string, std::string> names_of(const NamedSolid& solid);

}  // namespace nurbeam
