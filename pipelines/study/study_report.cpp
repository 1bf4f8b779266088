#include "pipelines/study/study_report.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cad_import/files/atomic_file.h"
#include "pipelines/study/study_output.h"
#include "pipelines/study/study_page.h"

namespace nurbeam {

namespace {

using Json = nlohmann::ordered_json;

/// The most variants whose curves the page holds.
constexpr std::size_t most_curves = 2000;

Json homogeneous(const NurbsCurve& curve) {
  Json points = Json::array();
  for (const auto& p : curve.control_points().colwise()) points.push_back({p[0], p[1], p[2], p[3]});
  return points;
}

/// The curves of a variant; none where its values make no curves, of one that is refused.
std::map<std::string, NurbsCurve> moved_curves(const StudyFile& study, const StudyCase& study_case,
                                               const Variant& variant) {
  try {
    return study_case.moved(study.variables, variant.values);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

Json curves_of(const StudyFile& study, const StudyCase& study_case, const std::vector<Variant>& variants,
               const std::vector<std::size_t>& best) {
  Json curves = Json::array();
  for (const auto& [beam, curve] : study_case.curves())
    curves.push_back({{"beam", beam},
                      {"degree", curve.drawn.degree()},
                      {"knots", curve.drawn.knots().knots()},
                      {"drawn", homogeneous(curve.drawn)},
                      {"variants", Json::object()}});
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const Variant& variant = variants[i];
    const bool wanted = i < most_curves || std::find(best.begin(), best.end(), variant.number) != best.end();
    if (!wanted) continue;
    for (const auto& [beam, curve] : moved_curves(study, study_case, variant))
      for (Json& of : curves)
        if (of["beam"] == beam) of["variants"][std::to_string(variant.number)] = homogeneous(curve);
  }
  return curves;
}

std::vector<double> first_of(const std::vector<double>& values, std::size_t count) {
  return {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(std::min(count, values.size()))};
}

/// The numbers of the variants that a search ended with.
std::vector<std::size_t> best_variants(const StudyFile& study, const StudyResult& result) {
  StudyPoints points;
  if (const auto* optimum = std::get_if<OptimumResult>(&result.answer)) points = optimum->points;
  if (const auto* calibrated = std::get_if<CalibrationResult>(&result.answer)) points = {calibrated->point};
  std::vector<std::size_t> best;
  for (const std::vector<double>& point : points) {
    const std::vector<double> values = all_values(study, point);
    const auto found = std::find_if(result.variants.begin(), result.variants.end(),
                                    [&](const Variant& variant) { return variant.values == values; });
    if (found != result.variants.end()) best.push_back(found->number);
  }
  return best;
}

Json page_data(const StudyFile& study, const StudyCase* study_case, const StudyResult& result) {
  const Json summary = Json::parse(study_summary(study, result));
  const std::vector<std::size_t> best = best_variants(study, result);
  Json data = {{"title", study.name},
               {"status", summary["status"]},
               {"counts", summary["variants"]},
               {"seconds", summary["wall time of all variants [s]"]},
               {"answer", summary["answer"]},
               {"surrogates", summary["surrogates"]},
               {"variables", Json::array()},
               {"quantities", Json::array()},
               {"objectives", Json::array()},
               {"rows", Json::array()},
               {"best", best},
               {"is_plan", std::holds_alternative<StudyPlan>(study.task)},
               {"curves", study_case ? curves_of(study, *study_case, result.variants, best) : Json::array()}};
  for (const StudyVariable& variable : study.variables)
    data["variables"].push_back(
        {{"name", variable.name}, {"unit", variable.unit}, {"derived", variable.derived.has_value()}});
  std::size_t shown = 0;  // what is observed stands in the answer
  for (const StudyQuantity& quantity : study.quantities) {
    if (quantity.observed) break;
    data["quantities"].push_back({{"name", quantity.name}, {"unit", quantity.unit}});
    ++shown;
  }
  if (const auto* optimum = std::get_if<StudyOptimum>(&study.task))
    for (const StudyOptimum::Objective& objective : optimum->objectives)
      for (std::size_t k = 0; k < study.quantities.size(); ++k)
        if (study.quantities[k].name == objective.quantity) data["objectives"].push_back(k);
  for (const Variant& variant : result.variants)
    data["rows"].push_back({{"number", variant.number},
                            {"values", variant.values},
                            {"quantities", first_of(variant.quantities, shown)},
                            {"status", name_of(variant.status)},
                            {"reason", variant.reason}});
  return data;
}

// A text between tags.
std::string html_text(const std::string& text) {
  std::string safe;
  for (const char c : text)
    if (c == '<')
      safe += "&lt;";
    else if (c == '&')
      safe += "&amp;";
    else
      safe += c;
  return safe;
}

// JSON inside a script element: nothing in it may end the element.
std::string script_text(const Json& data) {
  std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3)
    text.replace(at, 2, "<\\/");
  return text;
}

std::string with(const std::string& page, const std::string& marker, const std::string& text) {
  const std::size_t at = page.find(marker);
  return page.substr(0, at) + text + page.substr(at + marker.size());
}

}  // namespace

void write_study_report(const std::filesystem::path& file, const StudyFile& study,
                        const StudyCase* study_case, const StudyResult& result) {
  std::string page(study_page);
  page = with(page, "{{title}}", html_text(study.name));
  page = with(page, "{{data}}",
              R"(<script type="application/json" id="data">)" +
                  script_text(page_data(study, study_case, result)) + "</script>");
  for (const Diagnostic& d : write_at_once(file, page)) throw std::runtime_error(d.where + ": " + d.message);
}

}  // namespace nurbeam
