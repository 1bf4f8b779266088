#include "cad_import/program/damaged_entities.h"

#include <IGESData_IGESEntity.hxx>
#include <Interface_Check.hxx>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "cad_import/program/entity_origins.h"
#include "cad_import/step/step_instances.h"

namespace nurbeam {
namespace {

constexpr int most_damaged = 20;

bool is_set_of_curves(const Standard_Transient& entity) {
  const std::string_view type = entity.DynamicType()->Name();
  return type == "StepShape_GeometricSet" || type == "StepShape_GeometricCurveSet";
}

// Whether numbers of a curve may be lost with what OpenCASCADE could not read in the entity: not with a name.
bool matters(const Standard_Transient& entity, std::string_view failure) {
  const bool step = !entity.IsKind(STANDARD_TYPE(IGESData_IGESEntity));
  const std::string_view type = entity.DynamicType()->Name();
  const bool geometry = is_set_of_curves(entity) || type.starts_with("StepGeom_");
  return !step || (geometry && failure.find("(name)") == std::string_view::npos);
}

/// The text with the first occurrence of `phrase`, if there is one, replaced.
std::string replaced(std::string text, std::string_view phrase, std::string_view by) {
  const std::size_t at = text.find(phrase);
  return at == std::string::npos ? text : text.replace(at, phrase.size(), by);
}

// OpenCASCADE's words, or those in place of what it says in its own code.
std::string in_words(const std::string& failure) {
  if (failure.find("Unknown message invoked") != std::string::npos)
    return "a parameter of it is none that its kind may have";
  const std::string kind = replaced(failure, " : Entity has illegal type",
                                    " refers to an entity of a kind that does not belong there");
  return replaced(replaced(kind, "Parameter n0.", "parameter "), "parameter %d ", "parameter ");
}

/// The instances of a STEP file, looked at when the first damage is.
class Instances {
 public:
  explicit Instances(const std::string& content) : content_(&content) {}

  /// "#7, #9": what the instance refers to and the file does not have.
  std::string missing_in(int number) {
    try {
      if (!instances_) instances_.emplace(*content_);
    } catch (const std::runtime_error&) {  // an instance stands twice, or there is none
      return "";
    }
    std::string missing;
    for (const int reference : instances_->references(number))
      if (!has(reference)) missing += (missing.empty() ? "#" : ", #") + std::to_string(reference);
    return missing;
  }

 private:
  bool has(int number) const {
    try {
      instances_->value(number);
      return true;
    } catch (const std::runtime_error&) {
      return false;
    }
  }

  const std::string* content_;
  std::optional<StepInstances> instances_;
};

// What is wrong with the entity; nothing where what it refers to is read, or named, by itself.
std::optional<std::string> damage(const Interface_InterfaceModel& model, int i, Instances& instances) {
  const Handle(Interface_Check) check = model.Check(i, /*syntactic=*/Standard_True);
  const Handle(Standard_Transient) entity = model.Value(i);
  if (!check->HasFailed() || !matters(*entity, check->CFail(1))) return std::nullopt;
  const std::string failure = check->CFail(1);
  if (entity->IsKind(STANDARD_TYPE(IGESData_IGESEntity))) return in_words(failure);
  const std::string label = trimmed_text(model.StringLabel(entity));
  const std::string missing =
      label.starts_with('#') ? instances.missing_in(std::atoi(label.c_str() + 1)) : "";
  if (!missing.empty()) return "it refers to " + missing + ", which the file does not have";
  if (is_set_of_curves(*entity) && failure.find("(elements)") != std::string::npos) return std::nullopt;
  return in_words(failure);
}

}  // namespace

void add_damaged_entities(const Interface_InterfaceModel& model, const std::string& content,
                          ImportReport& report) {
  Instances instances(content);
  int count = 0;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const std::optional<std::string> what = damage(model, i, instances);
    if (!what || ++count > most_damaged) continue;
    add_diagnostic(report, Severity::warning, entity_label(model, model.Value(i)),
                   "damaged, and curves made of it may be wrong: " + *what);
  }
  if (count > most_damaged)
    add_diagnostic(report, Severity::warning, "",
                   std::to_string(count - most_damaged) + " more damaged entities");
}

}  // namespace nurbeam
