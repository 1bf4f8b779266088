#include "cad_import/dxf/read_dxf.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdio>
#include <new>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>

#include "cad_import/dxf/drawing_unit.h"
#include "cad_import/dxf/dxf_entities.h"
#include "cad_import/report/length_unit.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

/// A curve and its kind.
struct Drawn {
  std::string entity;
  NurbsCurve curve;
};

Eigen::Vector3d point_at(const DxfEntity& entity, int code) {
  return {entity.number_of(code, 0), entity.number_of(code + 10, 0), entity.number_of(code + 20, 0)};
}

/// The axes of the entity's own coordinates from its normal, by the "arbitrary axis algorithm" of the DXF
/// reference.
Eigen::Matrix3d own_axes(const DxfEntity& entity) {
  Eigen::Vector3d z(entity.number_of(210, 0), entity.number_of(220, 0), entity.number_of(230, 1));
  if (!(z.norm() > 0)) throw std::runtime_error("its normal has no direction");
  z.normalize();
  const bool near_z = std::abs(z.x()) < 1.0 / 64 && std::abs(z.y()) < 1.0 / 64;
  const Eigen::Vector3d x =
      (near_z ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ()).cross(z).normalized();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  return axes;
}

/// How many quarters of a turn an arc is made of.
int pieces_of(double sweep) { return std::max(1, static_cast<int>(std::ceil(sweep / (0.5 * pi) - 1e-9))); }

std::vector<double> knots_of_pieces(int pieces) {
  std::vector<double> knots(3, 0);
  for (int i = 1; i <= pieces; ++i) knots.insert(knots.end(), i == pieces ? 3 : 2, i);
  return knots;
}

/// centre + cos(t) a + sin(t) b from t = from to from + sweep, in quarters, as a rational quadratic.
NurbsCurve conic_arc(const Eigen::Vector3d& centre, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                     double from, double sweep) {
  const int pieces = pieces_of(sweep);
  const double half = 0.5 * sweep / pieces, weight = std::cos(half);
  Eigen::Matrix4Xd points(4, 2 * pieces + 1);
  for (int i = 0; i <= 2 * pieces; ++i) {
    const double w = i % 2 == 0 ? 1 : weight, t = from + i * half;
    points.col(i) << w * centre + std::cos(t) * a + std::sin(t) * b, w;
  }
  return {KnotVector(2, knots_of_pieces(pieces)), std::move(points)};
}

NurbsCurve polyline(const std::vector<Eigen::Vector3d>& places) {
  Eigen::Matrix3Xd points(3, places.size());
  std::vector<double> knots{0};
  for (std::size_t i = 0; i < places.size(); ++i) {
    points.col(static_cast<Eigen::Index>(i)) = places[i];
    knots.push_back(static_cast<double>(i));
  }
  knots.push_back(knots.back());
  return make_nurbs_curve(KnotVector(1, std::move(knots)), points, Eigen::VectorXd::Ones(points.cols()));
}

/// Counterclockwise; a whole turn where it is one but for the digits that files leave.
double sweep_of(double from, double to, double turn) {
  const double digits = 2e-7 * turn;  // six decimals of radians
  double sweep = std::fmod(to - from, turn);
  if (sweep < 0) sweep += turn;
  return sweep <= digits || sweep >= turn - digits ? turn : sweep;
}

Drawn circle(const DxfEntity& entity, bool whole) {
  const Eigen::Matrix3d axes = own_axes(entity);
  const double radius = entity.number_of(40, 0), degrees = pi / 180;
  if (!(radius > 0)) throw std::runtime_error("its radius is not positive");
  const double from = whole ? 0 : entity.number_of(50, 0);
  const double sweep = whole ? 360 : sweep_of(from, entity.number_of(51, 360), 360);
  return {"circle", conic_arc(axes * point_at(entity, 10), radius * axes.col(0), radius * axes.col(1),
                              degrees * from, degrees * sweep)};
}

Drawn ellipse(const DxfEntity& entity) {
  const Eigen::Vector3d major = point_at(entity, 11), normal = own_axes(entity).col(2);
  const double from = entity.number_of(41, 0), to = entity.number_of(42, 2 * pi);
  return {"ellipse", conic_arc(point_at(entity, 10), major, entity.number_of(40, 1) * normal.cross(major),
                               from, sweep_of(from, to, 2 * pi))};
}

void check_count(std::size_t count, std::size_t points, const std::string& what) {
  if (count != points)
    throw std::runtime_error("it has " + std::to_string(points) + " x of control points (group 10) and " +
                             std::to_string(count) + " " + what + "; each point needs its own");
}

/// A spline without group 30 lies in the plane z = 0, one without group 41 is not rational.
Drawn spline(const DxfEntity& entity) {
  const std::vector<double> x = entity.numbers_of(10), y = entity.numbers_of(20);
  std::vector<double> z = entity.numbers_of(30), weights = entity.numbers_of(41);
  if (x.empty()) throw std::runtime_error("it has fit points only; draw it with control points");
  if (z.empty()) z.assign(x.size(), 0);
  if (weights.empty()) weights.assign(x.size(), 1);
  check_count(y.size(), x.size(), "y (group 20)");
  check_count(z.size(), x.size(), "z (group 30)");
  check_count(weights.size(), x.size(), "weights (group 41)");
  Eigen::Matrix3Xd points(3, x.size());
  for (std::size_t i = 0; i < x.size(); ++i) points.col(static_cast<Eigen::Index>(i)) << x[i], y[i], z[i];
  return {"bspline",
          make_nurbs_curve(KnotVector(static_cast<int>(entity.number_of(71, 3)), entity.numbers_of(40)),
                           points, Eigen::Map<Eigen::VectorXd>(weights.data(), points.cols()))};
}

/// A corner of a polyline, and the tangent of a quarter of the angle of the arc from it to the next; 0: a
/// line.
struct Corner {
  Eigen::Vector3d point;
  double bulge = 0;
};

/// The arc through these places, an odd number of them at equal angles, from each second one to the next a
/// conic section whose own weight in the middle is `weight`.
NurbsCurve arc_through(const std::vector<Eigen::Vector3d>& places, double weight) {
  Eigen::Matrix4Xd points(4, places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    auto point = points.col(static_cast<Eigen::Index>(i));
    if (i % 2 == 0)
      point << places[i], 1;
    else
      point << (1 + weight) * places[i] - 0.5 * (places[i - 1] + places[i + 1]), weight;
  }
  return {KnotVector(2, knots_of_pieces(static_cast<int>(places.size() / 2))), std::move(points)};
}

/// Its arc by chords from its start, so that it meets both corners however flat it is.
Drawn side(const Corner& from, const Corner& to, const Eigen::Vector3d& normal) {
  if (from.bulge == 0) return {"line", polyline({from.point, to.point})};
  const Eigen::Vector3d chord = to.point - from.point, left = normal.cross(chord);
  const double sweep = 4 * std::atan(from.bulge);
  const int pieces = pieces_of(std::abs(sweep));
  std::vector<Eigen::Vector3d> places{from.point};
  for (int i = 1; i < 2 * pieces; ++i) {
    const double angle = i * sweep / (2 * pieces), turn = 0.5 * (angle - sweep);
    places.push_back(from.point + std::sin(0.5 * angle) / std::sin(0.5 * sweep) *
                                      (std::cos(turn) * chord + std::sin(turn) * left));
  }
  places.push_back(to.point);
  return {"circle", arc_through(places, std::cos(0.5 * sweep / pieces))};
}

std::vector<Drawn> polyline_of(std::vector<Corner> corners, bool closed, const Eigen::Vector3d& normal) {
  if (closed && !corners.empty()) corners.push_back(corners.front());
  if (corners.size() < 2) throw std::runtime_error("it has fewer than two corners");
  std::vector<Drawn> drawn;
  std::vector<Eigen::Vector3d> places{corners[0].point};
  bool straight = true;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    if (corners[i].point == corners[i + 1].point) continue;
    drawn.push_back(side(corners[i], corners[i + 1], normal));
    places.push_back(corners[i + 1].point);
    straight = straight && corners[i].bulge == 0;
  }
  if (straight && places.size() > 1) return {{"bspline", polyline(places)}};
  return drawn;
}

bool is_closed_flag(const DxfEntity& entity) { return static_cast<int>(entity.number_of(70, 0)) & 1; }

std::vector<Drawn> light_polyline(const DxfEntity& entity) {
  const Eigen::Matrix3d axes = own_axes(entity);
  const double height = entity.number_of(38, 0);
  std::vector<Eigen::Vector3d> places;
  std::vector<double> bulges;
  DxfEntity one{entity.type, entity.number, {}};
  for (const DxfPair& pair : entity.pairs) {  // 10, 20 and perhaps 42 of each corner
    one.pairs = {pair};
    if (pair.code == 10) {
      places.emplace_back(one.number_of(10, 0), 0, height);
      bulges.push_back(0);
    } else if (!places.empty() && pair.code == 20) {
      places.back().y() = one.number_of(20, 0);
    } else if (!places.empty() && pair.code == 42) {
      bulges.back() = one.number_of(42, 0);
    }
  }
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < places.size(); ++i) corners.push_back({axes * places[i], bulges[i]});
  return polyline_of(std::move(corners), is_closed_flag(entity), axes.col(2));
}

/// A POLYLINE, whose corners are the VERTEX entities after it.
std::vector<Drawn> heavy_polyline(const DxfEntity& entity, const std::vector<DxfEntity>& all) {
  constexpr int in_space = 8, surface = 16 | 64, spline_frame = 16;
  const int flags = static_cast<int>(entity.number_of(70, 0));
  if (flags & surface) throw std::runtime_error("it is a mesh");
  const Eigen::Matrix3d axes = flags & in_space ? Eigen::Matrix3d::Identity() : own_axes(entity);
  const double height = flags & in_space ? 0 : entity.number_of(30, 0);  // of all its corners
  std::vector<Corner> corners;
  for (std::size_t i = entity.number; i < all.size() && all[i].type == "VERTEX"; ++i) {
    if (static_cast<int>(all[i].number_of(70, 0)) & spline_frame) continue;
    Eigen::Vector3d place = point_at(all[i], 10);
    if (height != 0) place.z() = height;
    corners.push_back({axes * place, flags & in_space ? 0 : all[i].number_of(42, 0)});
  }
  return polyline_of(std::move(corners), is_closed_flag(entity), axes.col(2));
}

/// The curves of the entity; none of one that is no curve.
std::vector<Drawn> curves_of(const DxfEntity& entity, const std::vector<DxfEntity>& all) {
  if (entity.type == "LINE") return {{"line", polyline({point_at(entity, 10), point_at(entity, 11)})}};
  if (entity.type == "ARC") return {circle(entity, false)};
  if (entity.type == "CIRCLE") return {circle(entity, true)};
  if (entity.type == "ELLIPSE") return {ellipse(entity)};
  if (entity.type == "SPLINE") return {spline(entity)};
  if (entity.type == "LWPOLYLINE") return light_polyline(entity);
  if (entity.type == "POLYLINE") return heavy_polyline(entity, all);
  if (entity.type == "INSERT") throw std::runtime_error("blocks are not placed; explode it");
  if (std::set<std::string>{"MLINE", "RAY", "XLINE", "HELIX", "REGION", "3DFACE", "3DSOLID"}.contains(
          entity.type))
    throw std::runtime_error("entities of this kind are not read");
  return {};
}

// AutoCAD's colour numbers that have a name; a true colour (420) goes before.
std::string colour_of(const DxfEntity& entity) {
  constexpr std::array<const char*, 8> numbered{"",        "#ff0000", "#ffff00", "#00ff00",
                                                "#00ffff", "#0000ff", "#ff00ff", "#ffffff"};
  if (const double colour = entity.number_of(420, -1); colour >= 0 && colour < 0x1000000) {
    char text[8];
    std::snprintf(text, sizeof text, "#%06x", static_cast<unsigned>(colour));
    return text;
  }
  const int number = static_cast<int>(entity.number_of(62, 256));
  return number > 0 && number < 8 ? numbered[number] : "";
}

std::string without_unit(int insunits) {
  if (insunits == 0) return "the drawing declares no length unit ($INSUNITS); millimetres are assumed";
  return "$INSUNITS is " + std::to_string(insunits) +
         ", which is no unit; the units of DXF are 1 to 24: millimetres are assumed";
}

/// Layers are one where their names differ in the case of letters only.
std::string layer_key(std::string name) {
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return name;
}

/// Those that are frozen, or switched off by a negative colour.
std::set<std::string> hidden_layers(const DxfDrawing& drawing) {
  constexpr int frozen = 1;
  std::set<std::string> hidden;
  for (const DxfEntity& layer : drawing.layers)
    if ((static_cast<int>(layer.number_of(70, 0)) & frozen) || layer.number_of(62, 7) < 0)
      hidden.insert(layer_key(layer.text_of(2)));
  return hidden;
}

bool is_curve(const DxfEntity& entity) {
  static const std::set<std::string> kinds{"LINE",   "ARC",        "CIRCLE",  "ELLIPSE",
                                           "SPLINE", "LWPOLYLINE", "POLYLINE"};
  return kinds.contains(entity.type);
}

bool is_in_paper_space(const DxfEntity& entity) { return entity.number_of(67, 0) == 1; }

std::string label_of(const DxfEntity& entity) {
  return "entity " + std::to_string(entity.number) + " " + entity.type;
}

ImportedCurve imported(Drawn drawn, const DxfEntity& entity, double unit) {
  Eigen::Matrix4Xd points = drawn.curve.control_points();
  points.topRows<3>() *= unit;
  NurbsCurve curve(drawn.curve.knots(), std::move(points));
  if (!(length(curve) > 0)) throw std::runtime_error("it has no length");
  return {.name = "",
          .entity = std::move(drawn.entity),
          .layer = entity.text_of(8),
          .colour = colour_of(entity),
          .hidden = entity.number_of(60, 0) == 1,
          .curve = std::move(curve)};
}

}  // namespace

ImportReport read_dxf(const std::string& content) {
  const DxfDrawing drawing = dxf_drawing(content);
  const std::optional<NamedUnit> unit = drawing_unit(drawing.unit);
  const NamedUnit named = unit.value_or(named_unit(metres_per_millimetre));
  ImportReport report{
      .file = "", .unit = named.name, .unit_in_metres = named.in_metres, .curves = {}, .diagnostics = {}};
  if (!unit) report.diagnostics.push_back({Severity::warning, "", without_unit(drawing.unit)});
  const std::set<std::string> hidden = hidden_layers(drawing);
  std::vector<const DxfEntity*> on_paper;
  for (const DxfEntity& entity : drawing.entities) {
    try {
      if (is_in_paper_space(entity)) {
        if (is_curve(entity)) on_paper.push_back(&entity);
        continue;
      }
      for (Drawn& drawn : curves_of(entity, drawing.entities))
        report.curves.push_back(imported(std::move(drawn), entity, report.unit_in_metres));
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& e) {
      report.diagnostics.push_back(
          {Severity::warning, label_of(entity), std::string("not read: ") + e.what()});
    }
  }
  for (ImportedCurve& curve : report.curves) curve.hidden |= hidden.contains(layer_key(curve.layer));
  if (!on_paper.empty())
    report.diagnostics.push_back(
        {Severity::warning, label_of(*on_paper[0]),
         "not read, for it lies in the paper space (group 67), which is no part of the "
         "model; so do " +
             std::to_string(on_paper.size()) + " curve(s) in all: move what is wanted to the model space"});
  return report;
}

}  // namespace nurbeam
