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

void Remarks::say(Severity severity, const Entity& entity, const std::string& message) {
  const std::string name = entity_name(entity);
  add_diagnostic(report_, severity, entity_label(model_, entity) + (name.empty() ? "" : " '" + name + "'"),
                 message);
}

void Remarks::refuse(const Entity& entity, const std::string& why) {
  refused_.insert(entity.get());
  warn(entity, "skipped with all that is made of it: " + why);
}

}  // namespace nurbeam
