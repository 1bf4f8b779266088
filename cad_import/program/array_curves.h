#pragma once
#include <IGESData_IGESEntity.hxx>
#include <XSControl_Reader.hxx>
#include <vector>

#include "cad_import/program/restated_curves.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// The curves that an IGES array (412, 414) puts at its places, in world coordinates [m], the places one
/// after another; its base may be a curve, a group (402), a subfigure definition (308) or another array. They
/// have the names, layers and colours of what they are copies of, else those of the array. Throws
/// std::exception or Standard_Failure where there are none, more than 100,000, or arrays nested too deeply.
/// `unit`: of the file [m].
std::vector<ImportedCurve> array_curves(const opencascade::handle<IGESData_IGESEntity>& array,
                                        const XSControl_Reader& reader, const RestatedCurves& restated,
                                        double unit, double tolerance);

}  // namespace nurbeam
