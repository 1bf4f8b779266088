#pragma once
#include <Standard_Handle.hxx>
#include <vector>

class IGESData_IGESEntity;
class IGESData_IGESModel;

namespace nurbeam {

/// Copious data (106) of forms 1 to 3, which are points that nothing connects; forms 11 to 13 are paths.
std::vector<opencascade::handle<IGESData_IGESEntity>> data_points(const IGESData_IGESModel& model);

}  // namespace nurbeam
