#include "pipelines/accuracy/number_names.h"

#include <algorithm>

#include "pipelines/diagnostics/simulation_text.h"

namespace nurbeam {

namespace {

// Names of extremes that are not those of columns.
std::vector<std::string> names_of_extremes(const std::vector<HistoryQuantity>& quantities) {
  std::vector<std::string> names;
  for (const HistoryQuantity& of : quantities)
    for (const auto& [quantity, ending] :
         {std::pair{"joint_force.", ".joint_force"}, {"f", ".force"}, {"m", ".couple"}})
      if (of.quantity == quantity) names.push_back(of.name + ending);
  return names;
}

bool is_event(const std::string& name, const std::vector<std::string>& bodies) {
  const std::string plain = name.ends_with(")") ? name.substr(0, name.rfind(" (")) : name;
  for (int kind = 0; kind <= static_cast<int>(EventKind::leaves_stop); ++kind)
    for (const std::string& body : bodies)
      if (is_booked(static_cast<EventKind>(kind)) &&
          plain == body + " " + name_of(static_cast<EventKind>(kind)))
        return true;
  return false;
}

}  // namespace

std::string name_of_column(const HistoryColumn& column) { return column.name + "." + column.quantity; }

std::vector<std::string> names_of_numbers(const AccuracyQuestion& question, bool modes) {
  std::vector<std::string> names;
  if (modes) return {"mode 1", "mode 2"};
  for (const HistoryColumn& column : question.columns) names.push_back(name_of_column(column));
  for (std::string& name : names_of_extremes(question.model.quantities)) names.push_back(std::move(name));
  return names;
}

std::vector<std::string> unknown_numbers(const AccuracyQuestion& question, bool modes) {
  const std::vector<std::string> names = names_of_numbers(question, modes);
  std::vector<std::string> unknown;
  for (const std::string& asked : question.of) {
    const bool is_peak =
        asked.size() > 5 && asked.ends_with(")") && (asked.starts_with("max(") || asked.starts_with("min("));
    const std::string name = is_peak ? asked.substr(4, asked.size() - 5) : asked;
    const bool is_known =
        modes ? asked.starts_with("mode ")
              : std::ranges::find(names, name) != names.end() || is_event(asked, question.bodies);
    if (!is_known) unknown.push_back(asked);
  }
  return unknown;
}

}  // namespace nurbeam
