#pragma once
#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// The text of an OpenCASCADE BREP file [mm]: a compound of one edge for each curve. It holds no names, and
/// 15 digits of every double. Throws std::runtime_error when OpenCASCADE makes no edge of a curve.
std::string brep_text(const std::vector<NamedCurve>& curves);

/// The same with the solids, as step_solid_text(); to be called in a child process.
std::string brep_solid_text(const std::vector<NamedSolid>& solids);

/// The shape [mm] in the text of a BREP file. Throws std::runtime_error when there is none.
TopoDS_Shape brep_shape(const std::string& content);

}  // namespace nurbeam
