#include "pipelines/inspect.h"

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "cad_import/import_curves.h"
#include "pipelines/print_diagnostics.h"
#include "pipelines/section_profile.h"

namespace nurbeam {

namespace {

using Json = nlohmann::ordered_json;

/// One curve as the user sees it.
struct CurveRow {
  std::string name, entity;
  int degree, control_points;
  bool rational, closed, exact;
  double length, deviation;    // [m]
  Eigen::Vector3d start, end;  // [m]
};

CurveRow row_of(const ImportedCurve& imported) {
  const NurbsCurve& curve = imported.curve;
  const double curve_length = length(curve);
  constexpr double closed_tolerance = 1e-9;  // of the length
  return {.name = imported.name,
          .entity = imported.entity,
          .degree = curve.degree(),
          .control_points = curve.knots().control_point_count(),
          .rational = curve.is_rational(),
          .closed = is_closed(curve, closed_tolerance * curve_length),
          .exact = imported.exact,
          .length = curve_length,
          .deviation = imported.deviation,
          .start = curve.point(curve.knots().start()),
          .end = curve.point(curve.knots().end())};
}

std::string text_of(const Eigen::Vector3d& point) {
  std::ostringstream text;
  text << '(' << point.x() << ", " << point.y() << ", " << point.z() << ')';
  return text.str();
}

std::string text_of(double value) {
  std::ostringstream text;
  text << std::setprecision(9) << value;
  return text.str();
}

std::string yes_or_no(bool value) { return value ? "yes" : "no"; }

/// Cells in columns as wide as their widest cell.
void print_table(std::ostream& out, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += "  " + row[i] + std::string(widths[i] - row[i].size(), ' ');
    }
    out << line.substr(0, line.find_last_not_of(' ') + 1) << '\n';
  }
}

void print_report(std::ostream& out, const ImportReport& report) {
  out << report.file << ": " << report.curves.size() << " curve(s), unit " << report.unit << '\n';
  std::vector<std::vector<std::string>> rows = {{"index", "name", "entity", "degree", "rational",
                                                 "control points", "length [m]", "closed", "start [m]",
                                                 "end [m]"}};
  for (std::size_t i = 0; i < report.curves.size(); ++i) {
    const CurveRow row = row_of(report.curves[i]);
    rows.push_back({std::to_string(i + 1), row.name.empty() ? "-" : row.name, row.entity,
                    std::to_string(row.degree), yes_or_no(row.rational), std::to_string(row.control_points),
                    text_of(row.length), yes_or_no(row.closed), text_of(row.start), text_of(row.end)});
  }
  print_table(out, rows);
}

Json to_json(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json to_json(const ImportReport& report) {
  Json curves = Json::array(), diagnostics = Json::array();
  for (std::size_t i = 0; i < report.curves.size(); ++i) {
    const CurveRow row = row_of(report.curves[i]);
    curves.push_back({{"index", i + 1},
                      {"name", row.name},
                      {"entity", row.entity},
                      {"degree", row.degree},
                      {"rational", row.rational},
                      {"control_points", row.control_points},
                      {"length [m]", row.length},
                      {"closed", row.closed},
                      {"start [m]", to_json(row.start)},
                      {"end [m]", to_json(row.end)},
                      {"exact", row.exact},
                      {"deviation [m]", row.deviation}});
  }
  for (const Diagnostic& d : report.diagnostics) {
    diagnostics.push_back(
        {{"severity", severity_name(d.severity)}, {"where", d.where}, {"message", d.message}});
  }
  return {{"file", report.file},
          {"unit", report.unit},
          {"unit_in_metres", report.unit_in_metres},
          {"curves", curves},
          {"diagnostics", diagnostics}};
}

}  // namespace

int inspect_files(const std::vector<std::filesystem::path>& files, bool json, std::ostream& out,
                  std::ostream& err) {
  bool readable = true;
  Json all = Json::array();
  for (const std::filesystem::path& file : files) {
    const ImportReport report = import_curves(file);
    readable = readable && report.ok();
    print_diagnostics(err, report.diagnostics);
    if (json) {
      all.push_back(to_json(report));
    } else if (!report.curves.empty()) {
      print_report(out, report);
    }
  }
  if (json) {
    // Names from files need not be valid UTF-8: what is not is replaced.
    out << all.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  }
  return readable ? 0 : 2;
}

int inspect_profiles(const std::vector<std::filesystem::path>& files, std::ostream& out, std::ostream& err) {
  bool usable = true;
  for (const std::filesystem::path& file : files) {
    const ImportReport report = import_curves(file);
    print_diagnostics(err, report.diagnostics);
    const ProfileReport drawn = report.ok() ? section_profile(report.curves, file.string()) : ProfileReport{};
    print_diagnostics(err, drawn.diagnostics);
    usable = usable && drawn.value;
    if (drawn.value) {
      out << report.file << ": section\n";
      print_profile(out, *drawn.value);
    }
  }
  return usable ? 0 : 2;
}

}  // namespace nurbeam
