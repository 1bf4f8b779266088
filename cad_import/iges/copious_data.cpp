#include "cad_import/iges/copious_data.h"

#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>

namespace nurbeam {

namespace {

constexpr int copious_data = 106;

template <class Condition>
std::vector<Handle(IGESData_IGESEntity)> copious_data_where(const IGESData_IGESModel& model,
                                                            Condition&& condition) {
  std::vector<Handle(IGESData_IGESEntity)> found;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const auto entity = Handle(IGESData_IGESEntity)::DownCast(model.Value(i));
    if (!entity.IsNull() && entity->TypeNumber() == copious_data && condition(*entity))
      found.push_back(entity);
  }
  return found;
}

}  // namespace

std::vector<Handle(IGESData_IGESEntity)> data_points(const IGESData_IGESModel& model) {
  constexpr int last_form = 3;
  return copious_data_where(
      model, [](const IGESData_IGESEntity& entity) { return entity.FormNumber() <= last_form; });
}

std::vector<Handle(IGESData_IGESEntity)> drawing_lines(const IGESData_IGESModel& model) {
  constexpr int centre_line = 20, witness_line = 40;
  return copious_data_where(model, [](const IGESData_IGESEntity& entity) {
    return entity.FormNumber() >= centre_line && entity.FormNumber() <= witness_line &&
           entity.SubordinateStatus() == 0;
  });
}

}  // namespace nurbeam
