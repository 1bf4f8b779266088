#include "pipelines/study/best_variant.h"

#include <stdexcept>

#include "cad_import/export_curves.h"
#include "cad_import/files/atomic_file.h"
#include "pipelines/case/case_json.h"
#include "pipelines/study/variant.h"

namespace nurbeam {

namespace {

// Files are named relative to the folder of the case; best.json is in another one.
void name_files_absolutely(Json& json, const std::filesystem::path& folder) {
  if (json.is_object()) {
    for (auto& [key, value] : json.items())
      if (key == "file" && value.is_string())
        value = (folder / value.get<std::string>()).lexically_normal().string();
      else
        name_files_absolutely(value, folder);
  }
  if (json.is_array())
    for (Json& item : json) name_files_absolutely(item, folder);
}

void throw_if_wrong(const std::vector<Diagnostic>& diagnostics) {
  for (const Diagnostic& d : diagnostics)
    if (d.severity == Severity::error) throw std::runtime_error(d.where + ": " + d.message);
}

}  // namespace

void write_best_variant(const std::filesystem::path& directory, const StudyFile& study,
                        const StudyCase& study_case, const std::vector<double>& point) {
  const std::vector<double> values = all_values(study, point);
  Json json = Json::parse(study_case.variant(study.variables, values));
  name_files_absolutely(json, std::filesystem::absolute(study_case.file()).parent_path());
  throw_if_wrong(write_at_once(directory / "best.json", json.dump(1) + "\n"));
  std::vector<NamedCurve> curves;
  for (const auto& [beam, curve] : study_case.moved(study.variables, values)) curves.push_back({beam, curve});
  if (!curves.empty()) throw_if_wrong(export_curves(directory / "best.step", curves, LengthUnit::millimetre));
}

}  // namespace nurbeam
