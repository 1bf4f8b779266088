#include "cad_import/program/remarks.h"

#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <stdexcept>

namespace nurbeam {

bool Remarks::attempt(const Entity& entity, const std::function<void()>& restate) {
  try {
    OCC_CATCH_SIGNALS
    restate();
    return true;
  } catch (const Standard_Failure& e) {
    refuse(entity, std::string("OpenCASCADE makes no curve of its numbers: ") + e.GetMessageString());
  } catch (const std::runtime_error& e) {
    refuse(entity, e.what());
  }
  return false;
}

void Remarks::repaired(const Entity& entity, const std::string& what, double size) {
  repairs_.add(label_of(entity), what, size);
}

void Remarks::repaired_relative(const Entity& entity, const std::string& what, double part) {
  repairs_.add_relative(label_of(entity), what, part);
}

std::string Remarks::label_of(const Entity& entity) const {
  const std::string name = entity_name(entity);
  return entity_label(model_, entity) + (name.empty() ? "" : " '" + name + "'");
}

void Remarks::say(Severity severity, const Entity& entity, const std::string& message) {
  add_diagnostic(report_, severity, label_of(entity), message);
}

void Remarks::refuse(const Entity& entity, const std::string& why) {
  if (refused_.insert(entity.get()).second) warn(entity, "skipped with all that is made of it: " + why);
}

}  // namespace nurbeam
