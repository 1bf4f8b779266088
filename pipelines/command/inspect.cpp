#include "pipelines/command/inspect.h"

#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <utility>

#include "nurbs/number_text.h"
#include "pipelines/command/text_table.h"
#include "pipelines/diagnostics/print_diagnostics.h"
#include "pipelines/diagnostics/reading_progress.h"
#include "pipelines/diagnostics/terminal_width.h"
#include "pipelines/diagnostics/utf8_text.h"
#include "pipelines/model/axis_selection.h"
#include "pipelines/section/section_profile.h"

namespace nurbeam {

namespace {

using Json = nlohmann::ordered_json;

/// One curve as the user sees it.
struct CurveRow {
  std::string name, entity, part, layer, colour;
  int degree, control_points;
  bool rational, closed, exact;
  double length, deviation;    // [m]
  Eigen::Vector3d start, end;  // [m]
};

std::string millimetres(double metres) { return text_of(1000 * metres, 9) + " mm"; }

// What the table adds to the kind of a centre line.
std::string pipe_of(const ImportedCurve& curve) {
  if (!curve.is_centre_line()) return "";
  if (curve.bar.area > 0)
    return " of a hollow bar, " + millimetres(curve.bar.width) + " by " + millimetres(curve.bar.height);
  const std::string bore = curve.bore_radius > 0 ? ", bore radius " + millimetres(curve.bore_radius) : "";
  return " of a pipe, radius " + millimetres(curve.pipe_radius) + bore;
}

CurveRow row_of(const ImportedCurve& imported) {
  const NurbsCurve& curve = imported.curve;
  const double curve_length = length(curve);
  constexpr double closed_tolerance = 1e-9;  // of the length
  return {.name = imported.name,
          .entity = imported.entity + pipe_of(imported) + (imported.hidden ? ", hidden" : ""),
          .part = imported.part,
          .layer = imported.layer,
          .colour = imported.colour,
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

// Without what is only round-off beside the largest coordinate, or below the digits of CAD systems.
std::string coordinates(const Eigen::Vector3d& point) {
  constexpr double part = 1e-13, least = 1e-12;
  const double round_off = std::max(part * point.cwiseAbs().maxCoeff(), least);
  std::ostringstream text;
  const char* before = "(";
  for (const double each : point)
    text << std::exchange(before, ", ") << (std::abs(each) < round_off ? 0 : each);
  text << ')';
  return text.str();
}

std::string yes_or_no(bool value) { return value ? "yes" : "no"; }

std::string dash_if_empty(const std::string& text) { return text.empty() ? "-" : text; }

std::vector<CurveRow> rows_of(const ImportReport& report) {
  std::vector<CurveRow> rows;
  for (const ImportedCurve& curve : report.curves) rows.push_back(row_of(curve));
  return rows;
}

void print_curves(std::ostream& out, const ImportReport& report, const std::vector<CurveRow>& curves) {
  const auto any_has = [&](std::string ImportedCurve::*property) {
    return std::any_of(report.curves.begin(), report.curves.end(),
                       [&](const ImportedCurve& curve) { return !(curve.*property).empty(); });
  };
  const bool layers = any_has(&ImportedCurve::layer), colours = any_has(&ImportedCurve::colour);
  const bool parts = any_has(&ImportedCurve::part);
  const auto shown = [&](std::vector<std::string> row, const std::string& part, const std::string& layer,
                         const std::string& colour) {
    if (colours) row.insert(row.begin() + 3, colour);
    if (layers) row.insert(row.begin() + 3, layer);
    if (parts) row.insert(row.begin() + 3, part);
    return row;
  };
  std::vector<std::vector<std::string>> cells = {
      shown({"index", "name", "entity", "degree", "rational", "control points", "length [m]", "closed",
             "start [m]", "end [m]"},
            "part", "layer", "colour")};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const CurveRow& row = curves[i];
    cells.push_back(
        shown({std::to_string(i + 1), dash_if_empty(row.name), row.entity, std::to_string(row.degree),
               yes_or_no(row.rational), std::to_string(row.control_points), text_of(row.length, 9),
               yes_or_no(row.closed), coordinates(row.start), coordinates(row.end)},
              dash_if_empty(row.part), dash_if_empty(row.layer), dash_if_empty(row.colour)));
  }
  const std::vector<std::string> dispensable = {"rational",  "closed", "control points", "degree", "end [m]",
                                                "start [m]", "colour", "layer",          "part"};
  const int width = out.rdbuf() == std::cout.rdbuf() ? terminal_width(STDOUT_FILENO).value_or(0) : 0;
  std::string left_out;
  for (const std::string& heading : print_table(out, std::move(cells), width, dispensable))
    left_out += (left_out.empty() ? "" : ", ") + heading;
  if (!left_out.empty()) out << "left out of this narrow terminal (--json has all): " << left_out << "\n";
}

/// A chain of the curves that a case would choose from.
struct ChainRow {
  std::vector<int> curves;  // indices, in running order
  double length;            // [m]
  bool closed;
};

// The longest first.
std::vector<ChainRow> chain_rows(const ImportReport& report, const std::vector<CurveRow>& curves) {
  std::vector<ChainRow> rows;
  for (const Chain& chain : chains_of(report, gap_tolerance(report, {}))) {
    double sum = 0;
    for (int curve : chain.curves) sum += curves[curve].length;
    rows.push_back({chain.curves, sum, chain.closed});
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const ChainRow& a, const ChainRow& b) { return a.length > b.length; });
  return rows;
}

constexpr std::size_t most_listed = 10;

void print_rest(std::ostream& out, std::size_t count) {
  if (count > most_listed) out << "  and " << count - most_listed << " more (--json lists all)\n";
}

void print_chains(std::ostream& out, const ImportReport& report, const std::vector<CurveRow>& curves) {
  const std::vector<ChainRow> chains = chain_rows(report, curves);
  out << "chains of curves: " << chains.size() << '\n';
  for (std::size_t i = 0; i < std::min(chains.size(), most_listed); ++i)
    out << "  " << text_of(chains[i].length, 9) << " m" << (chains[i].closed ? ", closed" : "")
        << (chains[i].curves.size() == 1 ? ": curve " : ": curves ")
        << list_of_curves(report, chains[i].curves) << '\n';
  print_rest(out, chains.size());
  const std::vector<Junction> found = junctions(report, gap_tolerance(report, {}));
  if (found.empty()) return;
  out << "points where three or more ends meet: " << found.size() << '\n';
  for (std::size_t i = 0; i < std::min(found.size(), most_listed); ++i)
    out << "  " << coordinates(found[i].point) << " m: curves " << list_of_curves(report, found[i].curves)
        << '\n';
  print_rest(out, found.size());
}

void print_report(std::ostream& out, const ImportReport& report) {
  out << report.file << ": " << report.curves.size() << (report.curves.size() == 1 ? " curve" : " curves")
      << ", unit " << report.unit;
  if (report.resolution > 0) out << ", resolution " << text_of(report.resolution, 9) << " m";
  out << '\n';
  const std::vector<CurveRow> curves = rows_of(report);
  print_curves(out, report, curves);
  print_chains(out, report, curves);
}

Json to_json(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

/// As the axis of a case may be given.
Json nurbs_of(const NurbsCurve& curve) {
  Json points = Json::array();
  for (const auto& point : curve.control_points().colwise()) points.push_back(to_json(point.hnormalized()));
  Json nurbs{{"degree", curve.degree()}, {"knots", curve.knots().knots()}, {"control_points", points}};
  const Eigen::VectorXd weights = curve.control_points().row(3);
  if (curve.is_rational()) nurbs["weights"] = std::vector<double>(weights.begin(), weights.end());
  return nurbs;
}

Json to_json(const ImportReport& report) {
  Json curves = Json::array(), chains = Json::array(), points = Json::array(), diagnostics = Json::array();
  const std::vector<CurveRow> rows = rows_of(report);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CurveRow& row = rows[i];
    curves.push_back({{"index", i + 1},
                      {"name", row.name},
                      {"entity", report.curves[i].entity},
                      {"part", row.part},
                      {"layer", row.layer},
                      {"colour", row.colour},
                      {"degree", row.degree},
                      {"rational", row.rational},
                      {"control_points", row.control_points},
                      {"length [m]", row.length},
                      {"closed", row.closed},
                      {"hidden", report.curves[i].hidden},
                      {"start [m]", to_json(row.start)},
                      {"end [m]", to_json(row.end)},
                      {"exact", row.exact},
                      {"deviation [m]", row.deviation},
                      {"nurbs", nurbs_of(report.curves[i].curve)}});
    if (!report.curves[i].is_centre_line()) continue;
    if (const BarSection& bar = report.curves[i].bar; bar.area > 0) {
      curves.back()["width [m]"] = bar.width;
      curves.back()["height [m]"] = bar.height;
      curves.back()["area [m^2]"] = bar.area;
      curves.back()["second_moments [m^4]"] = {bar.second_moments.x(), bar.second_moments.y()};
      continue;
    }
    curves.back()["pipe_radius [m]"] = report.curves[i].pipe_radius;
    curves.back()["bore_radius [m]"] = report.curves[i].bore_radius;
  }
  const auto from_one = [](std::vector<int> indices) {
    for (int& index : indices) ++index;
    return indices;
  };
  for (const ChainRow& chain : chain_rows(report, rows))
    chains.push_back(
        {{"curves", from_one(chain.curves)}, {"length [m]", chain.length}, {"closed", chain.closed}});
  for (const Junction& junction : junctions(report, gap_tolerance(report, {})))
    points.push_back({{"point [m]", to_json(junction.point)}, {"curves", from_one(junction.curves)}});
  for (const Diagnostic& d : report.diagnostics) {
    diagnostics.push_back(
        {{"severity", severity_name(d.severity)}, {"where", d.where}, {"message", d.message}});
  }
  return {{"file", report.file},
          {"unit", report.unit},
          {"unit_in_metres", report.unit_in_metres},
          {"resolution [m]", report.resolution},
          {"curves", curves},
          {"chains", chains},
          {"junctions", points},
          {"diagnostics", diagnostics}};
}

}  // namespace

int inspect_files(const std::vector<std::filesystem::path>& files, bool json, std::ostream& out,
                  std::ostream& err) {
  bool readable = true;
  Json all = Json::array();
  for (const std::filesystem::path& file : files) {
    const ImportReport report = read_with_progress(file, err);
    readable = readable && report.ok();
    print_diagnostics(err, report.diagnostics);
    if (json)
      all.push_back(to_json(report));
    else if (!report.curves.empty())
      print_report(out, report);
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
    const ImportReport report = read_with_progress(file, err);
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
