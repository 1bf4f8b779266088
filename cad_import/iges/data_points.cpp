#include "cad_import/iges/data_points.h"

#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESGeom_CopiousData.hxx>

namespace nurbeam {

std::vector<opencascade::handle<IGESData_IGESEntity>> data_points(const IGESData_IGESModel& model) {
  constexpr int last_form = 3;
  std::vector<opencascade::handle<IGESData_IGESEntity>> points;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const auto data = Handle(IGESGeom_CopiousData)::DownCast(model.Value(i));
    if (!data.IsNull() && data->FormNumber() <= last_form) points.emplace_back(data);
  }
  return points;
}

}  // namespace nurbeam
