#include "cad_import/json/read_curves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cad_import/report/length_unit.h"
#include "nurbs/even_knots.h"
#include "nurbs/full_knots.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

using Json = nlohmann::json;

[[noreturn]] void fail(const std::string& message) { throw std::runtime_error(message); }

const Json& value_of(const Json& object, const char* key) {
  const auto at = object.find(key);
  if (at == object.end()) fail(std::string("it has no \"") + key + "\"");
  return *at;
}

double number_in(const Json& value, const char* key) {
  constexpr double largest = 1e15;  // lengths of what is drawn far beyond that take for ever
  if (!value.is_number() || !(std::abs(value.get<double>()) <= largest))
    fail(std::string("\"") + key + "\" has a value that is no number from -1e15 to 1e15");
  return value.get<double>();
}

const Json& list_in(const Json& object, const char* key) {
  const Json& list = value_of(object, key);
  if (!list.is_array()) fail(std::string("\"") + key + "\" is no list");
  return list;
}

std::vector<double> numbers_in(const Json& object, const char* key) {
  std::vector<double> numbers;
  for (const Json& value : list_in(object, key)) numbers.push_back(number_in(value, key));
  return numbers;
}

std::string text_in(const Json& object, const char* key) {
  const auto at = object.find(key);
  if (at == object.end()) return "";
  if (!at->is_string()) fail(std::string("\"") + key + "\" is no text");
  return at->get<std::string>();
}

int degree_in(const Json& object) {
  constexpr int largest = 1000;
  const Json& value = value_of(object, "degree");
  if (!value.is_number_integer() || !(value >= 1 && value <= largest))
    fail("\"degree\" is no whole number from 1 to 1000");
  return value.get<int>();
}

/// Points of two coordinates lie in the plane z = 0.
Eigen::Matrix4Xd points_in(const Json& curve) {
  const Json& places = list_in(curve, "control_points");
  Eigen::Matrix4Xd points(4, places.size());
  points.row(2).setZero();
  points.row(3).setOnes();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].is_array() || places[i].size() < 2 || places[i].size() > 3)
      fail("control point " + std::to_string(i + 1) + " is no list of two or three coordinates");
    for (std::size_t k = 0; k < places[i].size(); ++k)
      points(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) =
          number_in(places[i][k], "control_points");
  }
  if (!curve.contains("weights")) return points;
  const std::vector<double> weights = numbers_in(curve, "weights");
  if (weights.size() != places.size())
    fail("it has " + std::to_string(weights.size()) + " weights for " + std::to_string(places.size()) +
         " control points; each needs its own");
  if (std::any_of(weights.begin(), weights.end(), [](double w) { return !(w > 0); }))
    fail("a weight is not positive");
  for (std::size_t i = 0; i < weights.size(); ++i) points.col(static_cast<Eigen::Index>(i)) *= weights[i];
  return points;
}

// The knots of a curve; where it has none the error says those that it probably means.
std::vector<double> knots_in(const Json& curve, int degree, Eigen::Index count) {
  constexpr Eigen::Index most_shown = 12;
  if (curve.contains("knots") || count <= degree || count > most_shown) return numbers_in(curve, "knots");
  std::string shown;
  for (const double knot : even_clamped_knots(degree, static_cast<int>(count)))
    shown += (shown.empty() ? "" : ", ") + text_of(knot);
  fail("it has no \"knots\"; those of a clamped curve with equal spans are [" + shown + "]");
}

std::string unknown_keys(const Json& object, std::initializer_list<std::string_view> known) {
  std::string unknown;
  for (const auto& [key, value] : object.items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      unknown += (unknown.empty() ? "\"" : ", \"") + key + "\"";
  return unknown;
}

void add_curve(const Json& curve, ImportReport& report) {
  if (!curve.is_object()) fail("it is no object");
  ImportedCurve imported{.name = text_in(curve, "name"),
                         .entity = "bspline",
                         .layer = text_in(curve, "layer"),
                         .colour = text_in(curve, "colour"),
                         .part = text_in(curve, "part"),
                         .curve = NurbsCurve(KnotVector(1, {0, 0, 1, 1}), Eigen::Matrix4Xd::Ones(4, 2))};
  Eigen::Matrix4Xd points = points_in(curve);
  points.topRows<3>() *= report.unit_in_metres;
  const int degree = degree_in(curve);
  for (NurbsCurve& piece : split_at_full_knots(degree, knots_in(curve, degree, points.cols()), points)) {
    const Eigen::Matrix3Xd places = piece.control_points().colwise().hnormalized();
    if (!((places.colwise() - places.col(0)).cwiseAbs().maxCoeff() > 0)) fail("it has no length");
    imported.curve = std::move(piece);
    report.curves.push_back(imported);
  }
}

std::string label_of(const Json& curve, std::size_t index) {
  std::string name;
  if (curve.is_object() && curve.contains("name") && curve["name"].is_string())
    name = " '" + curve["name"].get<std::string>() + "'";
  return "curve " + std::to_string(index + 1) + name;
}

void read_unit(const Json& root, ImportReport& report) {
  const std::string name = text_in(root, "unit");
  const auto unit = name.empty() ? std::optional(named_unit(1)) : unit_of_name(name);
  if (!unit) fail("\"unit\" is '" + name + "'; known are " + known_unit_names());
  report.unit = unit->name;
  report.unit_in_metres = unit->in_metres;
  if (name.empty())
    report.diagnostics.push_back({Severity::warning, "", "the file has no \"unit\"; metres are assumed"});
}

void refuse_case(const std::string& content) {
  if (content.find("\"nurbeam\"") != std::string::npos)
    fail("it is a case file, not JSON of curves; \"nurbeam check\" takes it");
}

Json parsed(const std::string& content) {
  try {
    return Json::parse(content);
  } catch (const Json::exception& e) {
    refuse_case(content);
    fail(std::string("it is no JSON: ") + e.what());
  }
}

}  // namespace

ImportReport read_json(const std::string& content) {
  const Json root = parsed(content);
  if (!root.is_object() || !root.contains("curves") || !root["curves"].is_array()) {
    refuse_case(content);
    fail("it has no list \"curves\"; JSON of curves is {\"unit\": \"mm\", \"curves\": [...]}");
  }
  ImportReport report;
  read_unit(root, report);
  const Json& curves = root["curves"];
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const auto say = [&](Severity severity, const std::string& message) {
      report.diagnostics.push_back({severity, label_of(curves[i], i), message});
    };
    try {
      add_curve(curves[i], report);
      const std::string unknown = unknown_keys(
          curves[i], {"name", "degree", "knots", "control_points", "weights", "layer", "colour", "part"});
      if (!unknown.empty()) say(Severity::warning, "keys that are not known are passed over: " + unknown);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& e) {
      say(Severity::warning, std::string("not read: ") + e.what());
    }
  }
  return report;
}

}  // namespace nurbeam
