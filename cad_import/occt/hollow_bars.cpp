#include "cad_import/occt/hollow_bars.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Standard_ErrorHandler.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

#include "cad_import/occt/loose_faces.h"
#include "cad_import/report/length_unit.h"

namespace nurbeam {
namespace {

/// An outline and what is hollow in it.
struct HollowSection {
  PrismLoop outline;
  AreaMoments moments;             // of the material
  std::vector<std::size_t> edges;  // of all
};

/// Nothing where no hole, or only small ones, are in the outline.
std::optional<HollowSection> hollow_section(const PrismLoop& outline, const std::vector<PrismLoop>& loops) {
  constexpr double least_hollow = 0.25;  // of the area
  HollowSection section{outline, outline.moments, outline.edges};
  for (const PrismLoop& hole : loops) {
    if (hole.moments.area >= outline.moments.area || !outline.surrounds(hole.corners[0])) continue;
    section.moments += {-hole.moments.area, -hole.moments.first, -hole.moments.second};
    section.edges.insert(section.edges.end(), hole.edges.begin(), hole.edges.end());
  }
  if (section.moments.area > (1 - least_hollow) * outline.moments.area || !(section.moments.area > 0))
    return std::nullopt;
  return section;
}

/// Along and across the longest side.
Eigen::Matrix2d axes_of(const PrismLoop& outline) {
  Eigen::Vector2d longest = Eigen::Vector2d::Zero();
  for (std::size_t i = 0, k = outline.corners.size() - 1; i < outline.corners.size(); k = i++)
    if (const Eigen::Vector2d side = outline.corners[i] - outline.corners[k]; side.norm() > longest.norm())
      longest = side;
  longest.normalize();
  Eigen::Matrix2d axes;
  axes << longest.x(), -longest.y(), longest.y(), longest.x();
  return axes;
}

BarSection section_of(const HollowSection& hollow) {
  const Eigen::Matrix2d axes = axes_of(hollow.outline);
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Eigen::Vector2d& corner : hollow.outline.corners) {
    low = low.cwiseMin(axes.transpose() * corner);
    high = high.cwiseMax(axes.transpose() * corner);
  }
  const AreaMoments& m = hollow.moments;
  const Eigen::Matrix2d second =
      axes.transpose() * (m.second - m.first * m.first.transpose() / m.area) * axes;
  constexpr double mm = metres_per_millimetre;
  return {mm * (high - low).x(), mm * (high - low).y(), mm * mm * m.area,
          std::pow(mm, 4) * Eigen::Vector2d(second(1, 1), second(0, 0))};
}

/// Where the plane through corners (x, y, z) has x = y = 0; nothing where they lie in none.
std::optional<double> plane_at_centre(const Eigen::Matrix3Xd& corners, double size) {
  constexpr double in_plane = 1e-4;  // of the size
  Eigen::MatrixX3d rows(corners.cols(), 3);
  rows << Eigen::VectorXd::Ones(corners.cols()), corners.topRows<2>().transpose();
  const double level = corners.row(2).mean();
  const Eigen::VectorXd heights = corners.row(2).transpose().array() - level;
  const Eigen::Vector3d plane = rows.colPivHouseholderQr().solve(heights);
  if ((rows * plane - heights).cwiseAbs().maxCoeff() > in_plane * size) return std::nullopt;
  return level + plane[0];
}

HollowBar::End end_of(const HollowBar& bar, const PrismEdges& prism, bool upper) {
  const std::vector<std::size_t>& edges = bar.outline.edges;
  Eigen::Matrix3Xd corners(3, edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const PrismEdge& edge = prism.edges[edges[i]];
    corners.col(static_cast<Eigen::Index>(i)) << edge.place - bar.centre, upper ? edge.high : edge.low;
  }
  return {corners.row(2).minCoeff(), corners.row(2).maxCoeff(), plane_at_centre(corners, bar.size())};
}

HollowBar bar_of(const HollowSection& hollow, const PrismEdges& prism, const Eigen::Vector2d& origin) {
  HollowBar bar{prism.axes,         origin + hollow.moments.first / hollow.moments.area, hollow.outline,
                section_of(hollow), prism.edges[hollow.outline.edges[0]].faces[0],       {}};
  bar.ends = {end_of(bar, prism, false), end_of(bar, prism, true)};
  return bar;
}

bool is_long(const HollowBar& bar) {
  const auto& [lower, upper] = bar.ends;
  return upper.low + upper.high - lower.low - lower.high >= 2 * bar.size();
}

/// Finds bars by the sections midway of edges, the longest first, but for edges of sections that are known.
class BarsAlong {
 public:
  explicit BarsAlong(const PrismEdges& prism) : prism_(prism) {}

  void find(std::vector<HollowBar>& bars) {
    constexpr std::size_t most_work = 4'000'000;  // edges looked at
    std::size_t sections_left = most_work / (prism_.edges.size() + 1);
    for (const std::size_t i : longest_first())
      if (!known_.contains(i) && sections_left-- > 0) add_bars_beside(i, bars);
  }

 private:
  std::vector<std::size_t> longest_first() const {
    std::vector<std::size_t> order(prism_.edges.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto length = [&](std::size_t i) { return prism_.edges[i].high - prism_.edges[i].low; };
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return length(a) > length(b); });
    return order;
  }

  void add_bars_beside(std::size_t edge, std::vector<HollowBar>& bars) {
    const auto& [origin, low, high, faces] = prism_.edges[edge];
    const std::vector<PrismLoop> loops = prism_section(prism_, (low + high) / 2, origin);
    for (const PrismLoop& loop : loops) {
      const auto is_known = [&](std::size_t of) { return known_.contains(of); };
      if (std::all_of(loop.edges.begin(), loop.edges.end(), is_known)) continue;
      if (const std::optional<HollowSection> hollow = hollow_section(loop, loops)) {
        known_.insert(hollow->edges.begin(), hollow->edges.end());
        if (HollowBar bar = bar_of(*hollow, prism_, origin); is_long(bar)) bars.push_back(std::move(bar));
      } else if (std::find(loop.edges.begin(), loop.edges.end(), edge) != loop.edges.end()) {
        known_.insert(loop.edges.begin(), loop.edges.end());
      }
    }
  }

  const PrismEdges& prism_;
  std::set<std::size_t> known_;
};

void add_bars(const TopoDS_Shape& solid, const TopTools_IndexedMapOfShape& faces,
              std::vector<HollowBar>& bars) {
  constexpr std::size_t fewest_edges = 6;  // of two triangles
  for (const PrismEdges& prism : prism_edges(solid, faces))
    if (prism.edges.size() >= fewest_edges) BarsAlong(prism).find(bars);
}

}  // namespace

double HollowBar::size() const { return std::max(section.width, section.height) / metres_per_millimetre; }

std::vector<HollowBar> hollow_bars(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces) {
  std::vector<HollowBar> bars;
  const auto attempt = [&](const auto& add) {
    try {
      OCC_CATCH_SIGNALS
      add();
    } catch (const Standard_Failure&) {  // what OpenCASCADE cannot evaluate is no bar; its edges are reported
    } catch (const std::invalid_argument&) {  // so is what has coordinates that are no numbers
    }
  };
  for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next())
    attempt([&] { add_bars(solids.Current(), faces, bars); });
  attempt([&] {
    const SewnFaces sewn = sewn_loose_faces(shape, faces);
    if (!sewn.shape.IsNull()) add_bars(sewn.shape, sewn.faces, bars);
  });
  return bars;
}

}  // namespace nurbeam
