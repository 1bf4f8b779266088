#include "cad_import/dxf/placed_entities.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <new>
#include <set>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "cad_import/dxf/block_places.h"
#include "cad_import/dxf/drawing_notes.h"
#include "cad_import/dxf/dxf_curves.h"
#include "cad_import/dxf/dxf_polyline.h"
#include "cad_import/dxf/entity_look.h"
#include "cad_import/files/told_share.h"

namespace nurbeam {
namespace {

/// What the entities of a block have of the INSERT that places it.
struct Placement {
  Eigen::Affine3d to_drawing = Eigen::Affine3d::Identity();
  std::vector<const DxfBlock*> blocks = {};  // from the outermost
  std::string path = {};                     // their names
  std::string layer = "0", colour = {};
  bool hidden = false;
};

std::string name_of(const DxfBlock& block) { return block.head.text_of(2); }

std::string label_of(const DxfEntity& entity, const Placement& in) {
  const std::string block = in.blocks.empty() ? "" : "block '" + name_of(*in.blocks.back()) + "', ";
  return block + "entity " + std::to_string(entity.number) + " " + std::string(entity.type);
}

NurbsCurve moved(const NurbsCurve& curve, const Eigen::Affine3d& place, double unit) {
  Eigen::Matrix4Xd points = curve.control_points();
  points.topRows<3>() = unit * (place.matrix().topRows<3>() * points).eval();
  return {curve.knots(), std::move(points)};
}

double largest_scale(const Eigen::Affine3d& place) { return place.linear().colwise().norm().maxCoeff(); }

bool has_length(const NurbsCurve& curve) {
  const Eigen::Matrix3Xd places = curve.control_points().colwise().hnormalized();
  return (places.colwise() - places.col(0)).cwiseAbs().maxCoeff() > 0;
}

/// Blocks that place others over and over would have no end.
struct TooManyCopies : std::runtime_error {
  TooManyCopies()
      : std::runtime_error("its blocks (INSERT) place more than 1000000 entities; explode some") {}
};

class PlacedEntities {
 public:
  PlacedEntities(const DxfDrawing& drawing, ImportReport& report) : report_(report) {
    for (const DxfEntity& layer : drawing.layers)
      if (is_hidden_layer(layer)) hidden_layers_.insert(name_key(layer.text_of(2)));
    for (const DxfBlock& block : drawing.blocks) blocks_.try_emplace(name_key(name_of(block)), &block);
  }

  void add(const std::vector<DxfEntity>& entities, const Placement& in) {
    constexpr PartOfWork after_text{0.2, 1};
    for (const DxfEntity& entity : entities) {
      if (in.blocks.empty())
        tell_share_of(after_text, static_cast<std::size_t>(&entity - entities.data()), entities.size());
      try {
        add(entity, entities, in);
      } catch (const std::bad_alloc&) {
        throw;
      } catch (const TooManyCopies&) {
        throw;
      } catch (const std::exception& e) {
        if (is_first_look_at(entity))
          notes_.add(Severity::warning, label_of(entity, in), std::string("not read: ") + e.what());
      }
    }
  }

  void add_notes() {
    if (!on_paper_.empty())
      notes_.add(Severity::warning, label_of(*on_paper_[0], {}),
                 "not read, for it lies in the paper space (group 67), which is no part of the "
                 "model; so do " +
                     std::to_string(on_paper_.size()) +
                     " curve(s) in all: move what is wanted to the model space");
    for (Diagnostic& note : notes_.diagnostics()) report_.diagnostics.push_back(std::move(note));
  }

 private:
  void add(const DxfEntity& entity, const std::vector<DxfEntity>& all, const Placement& in) {
    const bool mesh = is_mesh(entity);
    if (entity.type == "VERTEX" && !has_polyline(entity, all))
      throw std::runtime_error("no POLYLINE stands before it");
    if (draws_no_curves(entity.type)) return;
    if (is_in_paper_space(entity)) {
      if (is_curve_kind(entity.type)) on_paper_.push_back(&entity);
    } else if (entity.type == "INSERT") {
      add_block(entity, in);
    } else if (is_curve_kind(entity.type) && !mesh) {
      for (const DrawnCurve& drawn : curves_of(entity, all)) add(drawn, entity, in);
    } else if (is_first_look_at(entity)) {
      notes_.count_not_read(std::string(entity.type) + (mesh ? " (mesh)" : ""));
    }
  }

  /// Of the first of several vertices, whether the entity before it is theirs.
  static bool has_polyline(const DxfEntity& vertex, const std::vector<DxfEntity>& all) {
    if (vertex.number < 2) return false;
    const std::string_view before = all[static_cast<std::size_t>(vertex.number) - 2].type;
    return before == "POLYLINE" || before == "VERTEX";
  }

  void add(const DrawnCurve& drawn, const DxfEntity& entity, const Placement& in) {
    NurbsCurve curve = moved(drawn.curve, in.to_drawing, report_.unit_in_metres);
    if (!has_length(curve)) throw std::runtime_error("it has no length");
    report_.curves.push_back(
        {.name = in.blocks.empty() ? "" : name_of(*in.blocks.back()),
         .entity = drawn.entity,
         .layer = layer_of(entity, in),
         .colour = colour_of(entity, in.colour),
         .part = in.path,
         .hidden = is_hidden(entity, in),
         .exact = drawn.deviation == 0,
         .deviation = drawn.deviation * largest_scale(in.to_drawing) * report_.unit_in_metres,
         .curve = std::move(curve)});
    if (!drawn.note.empty() && is_first_look_at(entity))
      notes_.add(Severity::note, label_of(entity, in), drawn.note);
  }

  void add_block(const DxfEntity& insert, const Placement& in) {
    constexpr std::size_t most_copies = 1'000'000;
    const DxfBlock& block = block_of(insert);
    if (std::count(in.blocks.begin(), in.blocks.end(), &block) > 0)
      throw std::runtime_error("the block '" + name_of(block) + "' places itself");
    Placement below{.blocks = in.blocks,
                    .path = (in.path.empty() ? "" : in.path + "/") + name_of(block),
                    .layer = layer_of(insert, in),
                    .colour = colour_of(insert, in.colour),
                    .hidden = is_hidden(insert, in)};
    below.blocks.push_back(&block);
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
    const auto at = blocks_.find(name_key(name));
    if (at == blocks_.end())
      throw std::runtime_error("the block '" + name + "' that it places is not in the drawing");
    if (at->second->head.whole_number_of(70, 0) & external)
      throw std::runtime_error("the block '" + name + "' that it places lies in another drawing; bind it");
    return *at->second;
  }

  /// What lies on the layer 0 of a block lies on that of its INSERT.
  static std::string layer_of(const DxfEntity& entity, const Placement& in) {
    const std::string own = entity.text_of(8);
    return !in.blocks.empty() && (own == "0" || own.empty()) ? in.layer : own;
  }

  bool is_hidden(const DxfEntity& entity, const Placement& in) const {
    return in.hidden || is_invisible(entity) || hidden_layers_.contains(name_key(layer_of(entity, in)));
  }

  /// An entity is spoken of once, however often its block is placed.
  bool is_first_look_at(const DxfEntity& entity) { return spoken_of_.insert(&entity).second; }

  ImportReport& report_;
  DrawingNotes notes_;
  std::unordered_map<std::string, const DxfBlock*> blocks_;
  std::set<std::string> hidden_layers_;
  std::unordered_set<const DxfEntity*> spoken_of_;
  std::vector<const DxfEntity*> on_paper_;
  std::size_t copies_ = 0;
};

}  // namespace

void add_placed_entities(const DxfDrawing& drawing, ImportReport& report) {
  PlacedEntities placed(drawing, report);
  placed.add(drawing.entities, {});
  placed.add_notes();
}

}  // namespace nurbeam
