#include "cad_import/dxf/read_dxf.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdio>
#include <new>
#include <optional>
#include <set>
#include <stdexcept>

#include "cad_import/dxf/block_places.h"
#include "cad_import/dxf/drawing_unit.h"
#include "cad_import/dxf/dxf_curves.h"
#include "cad_import/dxf/dxf_entities.h"
#include "cad_import/report/length_unit.h"

namespace nurbeam {
namespace {

/// AutoCAD's colour numbers that have a name; a true colour (420) goes before, 0 is that of the block.
std::string colour_of(const DxfEntity& entity, const std::string& of_block) {
  constexpr std::array<const char*, 8> numbered{"",        "#ff0000", "#ffff00", "#00ff00",
                                                "#00ffff", "#0000ff", "#ff00ff", "#ffffff"};
  if (const double colour = entity.number_of(420, -1); colour >= 0 && colour < 0x1000000) {
    char text[8];
    std::snprintf(text, sizeof text, "#%06x", static_cast<unsigned>(colour));
    return text;
  }
  const int number = static_cast<int>(entity.number_of(62, 256));
  if (number == 0) return of_block;
  return number > 0 && number < 8 ? numbered[number] : "";
}

std::string without_unit(int insunits) {
  if (insunits == 0) return "the drawing declares no length unit ($INSUNITS); millimetres are assumed";
  return "$INSUNITS is " + std::to_string(insunits) +
         ", which is no unit; the units of DXF are 1 to 24: millimetres are assumed";
}

/// Layers and blocks are one where their names differ in the case of letters only.
std::string name_key(std::string name) {
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
      hidden.insert(name_key(layer.text_of(2)));
  return hidden;
}

bool is_curve(const DxfEntity& entity) {
  static const std::set<std::string> kinds{"LINE",   "ARC",        "CIRCLE",  "ELLIPSE",
                                           "SPLINE", "LWPOLYLINE", "POLYLINE"};
  return kinds.contains(entity.type);
}

bool is_in_paper_space(const DxfEntity& entity) { return entity.number_of(67, 0) == 1; }

/// What the entities of a block have of the INSERT that places it.
struct Placement {
  Eigen::Affine3d to_drawing = Eigen::Affine3d::Identity();
  std::vector<std::string> blocks = {};  // from the outermost
  std::string layer = "0", colour = {};
  bool hidden = false;
};

std::string label_of(const DxfEntity& entity, const Placement& in) {
  const std::string block = in.blocks.empty() ? "" : "block '" + in.blocks.back() + "', ";
  return block + "entity " + std::to_string(entity.number) + " " + entity.type;
}

std::string path_of(const std::vector<std::string>& blocks) {
  std::string path;
  for (const std::string& block : blocks) path += (path.empty() ? "" : "/") + block;
  return path;
}

NurbsCurve moved(const NurbsCurve& curve, const Eigen::Affine3d& place, double unit) {
  Eigen::Matrix4Xd points = curve.control_points();
  points.topRows<3>() = unit * (place.matrix().topRows<3>() * points).eval();
  return {curve.knots(), std::move(points)};
}

/// Blocks that place others over and over would have no end.
struct TooManyCopies : std::runtime_error {
  TooManyCopies() : std::runtime_error("its blocks (INSERT) place more than 200000 entities; explode some") {}
};

class DrawnCurves {
 public:
  DrawnCurves(const DxfDrawing& drawing, ImportReport& report)
      : drawing_(drawing), report_(report), hidden_layers_(hidden_layers(drawing)) {}

  void add(const std::vector<DxfEntity>& entities, const Placement& in) {
    for (const DxfEntity& entity : entities) {
      try {
        if (is_in_paper_space(entity)) {
          if (is_curve(entity)) on_paper_.push_back(&entity);
          continue;
        }
        if (entity.type == "INSERT") add_block(entity, in);
        for (const DrawnCurve& drawn : curves_of(entity, entities)) add(drawn, entity, in);
      } catch (const std::bad_alloc&) {
        throw;
      } catch (const TooManyCopies&) {
        throw;
      } catch (const std::exception& e) {
        warn(label_of(entity, in), std::string("not read: ") + e.what());
      }
    }
  }

  void name_curves_on_paper() {
    if (on_paper_.empty()) return;
    warn(label_of(*on_paper_[0], {}),
         "not read, for it lies in the paper space (group 67), which is no part of the "
         "model; so do " +
             std::to_string(on_paper_.size()) + " curve(s) in all: move what is wanted to the model space");
  }

 private:
  void add(const DrawnCurve& drawn, const DxfEntity& entity, const Placement& in) {
    NurbsCurve curve = moved(drawn.curve, in.to_drawing, report_.unit_in_metres);
    if (!(length(curve) > 0)) throw std::runtime_error("it has no length");
    report_.curves.push_back({.name = in.blocks.empty() ? "" : in.blocks.back(),
                              .entity = drawn.entity,
                              .layer = layer_of(entity, in),
                              .colour = colour_of(entity, in.colour),
                              .part = path_of(in.blocks),
                              .hidden = is_hidden(entity, in),
                              .curve = std::move(curve)});
  }

  void add_block(const DxfEntity& insert, const Placement& in) {
    constexpr std::size_t most_copies = 200000;
    const DxfBlock& block = block_of(insert);
    Placement below = in;
    below.blocks.push_back(block.head.text_of(2));
    if (std::count(in.blocks.begin(), in.blocks.end(), below.blocks.back()) > 0)
      throw std::runtime_error("the block '" + below.blocks.back() + "' places itself");
    below.layer = layer_of(insert, in);
    below.colour = colour_of(insert, in.colour);
    below.hidden = is_hidden(insert, in);
    for (const Eigen::Affine3d& place : places_of(insert, block)) {
      copies_ += block.entities.size() + 1;
      if (copies_ > most_copies) throw TooManyCopies();
      below.to_drawing = in.to_drawing * place;
      add(block.entities, below);
    }
  }

  const DxfBlock& block_of(const DxfEntity& insert) const {
    constexpr int external = 4 | 8;
    const std::string name = insert.text_of(2);
    const auto at = std::find_if(drawing_.blocks.begin(), drawing_.blocks.end(), [&](const DxfBlock& block) {
      return name_key(block.head.text_of(2)) == name_key(name);
    });
    if (at == drawing_.blocks.end())
      throw std::runtime_error("the block '" + name + "' that it places is not in the drawing");
    if (static_cast<int>(at->head.number_of(70, 0)) & external)
      throw std::runtime_error("the block '" + name + "' that it places lies in another drawing; bind it");
    return *at;
  }

  /// What lies on the layer 0 of a block lies on that of its INSERT.
  static std::string layer_of(const DxfEntity& entity, const Placement& in) {
    const std::string own = entity.text_of(8);
    return !in.blocks.empty() && (own == "0" || own.empty()) ? in.layer : own;
  }

  bool is_hidden(const DxfEntity& entity, const Placement& in) const {
    return in.hidden || entity.number_of(60, 0) == 1 ||
           hidden_layers_.contains(name_key(layer_of(entity, in)));
  }

  /// Once, however often its block is placed.
  void warn(const std::string& where, const std::string& message) {
    if (warned_.insert(where + message).second)
      report_.diagnostics.push_back({Severity::warning, where, message});
  }

  const DxfDrawing& drawing_;
  ImportReport& report_;
  std::set<std::string> hidden_layers_, warned_;
  std::vector<const DxfEntity*> on_paper_;
  std::size_t copies_ = 0;
};

}  // namespace

ImportReport read_dxf(const std::string& content) {
  const DxfDrawing drawing = dxf_drawing(content);
  const std::optional<NamedUnit> unit = drawing_unit(drawing.unit);
  const NamedUnit named = unit.value_or(named_unit(metres_per_millimetre));
  ImportReport report{
      .file = "", .unit = named.name, .unit_in_metres = named.in_metres, .curves = {}, .diagnostics = {}};
  if (!unit) report.diagnostics.push_back({Severity::warning, "", without_unit(drawing.unit)});
  DrawnCurves curves(drawing, report);
  curves.add(drawing.entities, {});
  curves.name_curves_on_paper();
  return report;
}

}  // namespace nurbeam
