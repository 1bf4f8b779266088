#pragma once
#include <Interface_InterfaceModel.hxx>
#include <Standard_Transient.hxx>
#include <functional>

namespace nurbeam {

/// Puts a point in the place of those entities that are elements of geometric sets, or items of
/// representations, of a STEP model.
void replace_items(const Interface_InterfaceModel& model,
                   const std::function<bool(const opencascade::handle<Standard_Transient>&)>& is_replaced);

}  // namespace nurbeam
