#pragma once
#include <Interface_InterfaceModel.hxx>
#include <Standard_Transient.hxx>
#include <functional>
#include <string>

#include "cad_import/program/entity_origins.h"
#include "cad_import/program/repairs.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// What is said of the entities of one model.
class Remarks {
 public:
  using Entity = opencascade::handle<Standard_Transient>;

  Remarks(const Interface_InterfaceModel& model, ImportReport& report) : model_(model), report_(report) {}

  /// Does it; whether that went well: else the entity is refused, with a warning, unless it was before.
  bool attempt(const Entity& entity, const std::function<void()>& restate);
  void refuse(const Entity& entity, const std::string& why);
  void refuse_silently(const Entity& entity) { refused_.insert(entity.get()); }
  void warn(const Entity& entity, const std::string& message) { say(Severity::warning, entity, message); }
  void note(const Entity& entity, const std::string& message) { say(Severity::note, entity, message); }
  /// Counts a repair: what was done to entities of one kind, and by how much [m].
  void repaired(const Entity& entity, const std::string& what, double size);
  void repaired_relative(const Entity& entity, const std::string& what, double part);
  void tell_repairs() { repairs_.tell(report_); }
  const EntitySet& refused() const { return refused_; }

 private:
  void say(Severity severity, const Entity& entity, const std::string& message);
  std::string label_of(const Entity& entity) const;

  const Interface_InterfaceModel& model_;
  ImportReport& report_;
  EntitySet refused_;
  Repairs repairs_;
};

}  // namespace nurbeam
