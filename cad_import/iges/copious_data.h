#pragma once
#include <Standard_Handle.hxx>
#include <vector>

class IGESData_IGESEntity;
class IGESData_IGESModel;

namespace nurbeam {

/// Copious data (106) of forms 1 to 3, which are points that nothing connects; forms 11 to 13 are paths.
std::vector<opencascade::handle<IGESData_IGESEntity>> data_points(const IGESData_IGESModel& model);

/// Copious data (106) of forms 20 to 40, the centre, section and witness lines of a drawing, of which
/// OpenCASCADE makes no shape; without those that are parts of another entity, as of a dimension.
std::vector<opencascade::handle<IGESData_IGESEntity>> drawing_lines(const IGESData_IGESModel& model);

}  // namespace nurbeam
