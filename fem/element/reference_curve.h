#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "fem/element/drawn_sections.h"
#include "nurbs/arc_length.h"
#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// Geometry of the drawn curve at one parameter u of one segment, as a chart needs it.
struct ChartGeometry {
  std::array<double, 4> stretch;    ///< J0 = |r_u| and its first three u-derivatives
  std::array<double, 4> weight;     ///< W and its first three u-derivatives
  std::array<double, 4> curvature;  ///< of the stress-free shape, kappa_0, and its first two u-derivatives
                                    ///< (the fourth entry is 0)
};

/// The measure of the material coordinate s of a reference curve.
enum class Metric {
  arc_length,  ///< of the drawn curve
  label  ///< s = s_j + L_j u inside segment j, no metric: the subdivision paper's elements, for comparison
         ///< only; strongly uneven parametrisations then converge to wrong results (theory.md section 3)
};

/// A place of a curve with its derivatives by arc length: the unit tangent and the curvature vector.
struct CurvePoint {
  Eigen::Vector3d position, tangent, curvature;  ///< [m], [-], [1/m]
};

/// The drawn, undeformed curve as a function of reference arc length s in [start, end]; immutable. The start
/// is 0, but for a curve that was lengthened there.
///
/// The curve is a chain of segments (rational cubics). Segment j covers [breaks()[j], breaks()[j+1]] and has
/// its own parameter u in [0,1]. In a planar model (dimension 2) coordinates are the plane's, and kappa_0 is
/// signed, positive where the curve turns from the first axis to the second; in space kappa_0 >= 0. With
/// Metric::label, "arc length" below means the label.
///
/// A closed curve (a ring) goes on over its seam: s and s + length() are one place, and any s may be asked
/// for.
class ReferenceCurve {
 public:
  /// Throws std::invalid_argument when there is no segment, the dimension is not 2 or 3, or the speed
  /// vanishes; for a `closed` curve also when it has less than two segments or no metric, or its end is not
  /// its start to 1e-9 of its length. Segments equal to those of `like`, which may be null, are not measured
  /// again.
  ReferenceCurve(std::vector<RationalCubic> segments, int dimension, Metric metric = Metric::arc_length,
                 bool closed = false, const ReferenceCurve* like = nullptr);

  /// The curve for a beam whose stress-free shape has this length but no curvature.
  ReferenceCurve straightened() const {
    ReferenceCurve curve = *this;
    curve.straight_ = true;
    return curve;
  }

  /// The curve with a straight piece of this length [m] before its start or behind its end, along its tangent
  /// there. Places keep their s. For open curves with their metric and without sections.
  ReferenceCurve lengthened(double length, bool at_start) const;

  /// The curve with sections. Throws std::invalid_argument where they have no meaning (DrawnSections), in the
  /// plane and with Metric::label.
  ReferenceCurve oriented(Orientation orientation) const;
  bool has_sections() const { return sections_ != nullptr; }
  /// The section at s, on a curve that has sections; at a break as tangent().
  DrawnSection section(double s, bool from_left = false) const;
  /// The section at s with derivatives by s, on the continuation of segment j.
  DrawnSectionSeries section_series(int j, double s) const;
  /// The angle by which sections turn about the tangent, against parallel transport, from s_a to s_b: the
  /// integral of their twist [rad].
  double section_turn(double s_a, double s_b) const;
  /// DrawnSections::holonomy of the curve [rad].
  double holonomy() const { return sections_->holonomy(); }

  Metric metric() const { return metric_; }
  /// Whether the stress-free shape has no curvature.
  bool straight() const { return straight_; }
  bool closed() const { return closed_; }
  int dimension() const { return dimension_; }
  int segment_count() const { return static_cast<int>(segments_.size()); }
  const RationalCubic& segment(int j) const { return segments_[j]; }
  /// Whether segment j is a straight line at constant speed (to round-off): u is then s but for a factor.
  bool is_uniform_line(int j) const { return uniform_line_[j]; }
  /// segment_count() + 1 reference arc lengths [m].
  const std::vector<double>& breaks() const { return breaks_; }
  double length() const { return breaks_.back() - breaks_.front(); }
  /// Reference arc lengths of both ends [m].
  double start() const { return breaks_.front(); }
  double end() const { return breaks_.back(); }
  /// The place in [0, length) on a closed curve; else s itself.
  double wrapped(double s) const;
  /// The place within half a length of `near` on a closed curve; else s itself.
  double unrolled(double s, double near) const {
    return closed_ ? s + length() * std::round((near - s) / length()) : s;
  }
  /// The first break between segments after s; infinity where none follows.
  double next_break(double s) const;

  /// Whether segment j is drawn alike on both curves, and s and `other_s` [m] are one place of it, to
  /// round-off: results there hold for both curves.
  bool draws_alike(const ReferenceCurve& other, int j, double s, double other_s) const;

  /// The segment that covers s; at a break the one before it when `from_left`, else the one after it.
  int segment_at(double s, bool from_left = false) const;
  /// u of segment j at s [m], at breaks exactly 0 and 1; slightly outside it extrapolates.
  double parameter(int j, double s) const {
    s = unrolled(s, (breaks_[j] + breaks_[j + 1]) / 2);
    if (s == breaks_[j + 1]) return 1;
    return metric_ == Metric::label ? (s - breaks_[j]) / segment_length(j)
                                    : maps_[j]->parameter(s - breaks_[j]);
  }
  /// Reference arc length [m] at parameter u of segment j, the inverse of parameter().
  double arc_length(int j, double u) const {
    return breaks_[j] + (metric_ == Metric::label ? u * segment_length(j) : maps_[j]->arc_length(u));
  }
  ChartGeometry geometry(int j, double u) const;
  /// Position at s, 3 [m] (third coordinate 0 in a planar model).
  Eigen::Vector3d position(double s) const;
  /// dr/ds at s, 3 [-], the unit tangent (its direction with Metric::label); at a break by the segment after
  /// it, or before it when `from_left`.
  Eigen::Vector3d tangent(double s, bool from_left = false) const;
  /// Place, tangent and curvature at s on the continuation of segment j; the curve must have a metric.
  CurvePoint point_in(int j, double s) const;
  /// Green's strain (|dr/ds|^2 - 1)/2 of the drawing: 0 except with Metric::label.
  double strain(double s, bool from_left = false) const;
  /// Largest curvature of the drawing, sampled [1/m].
  double largest_curvature() const;

 private:
  ChartGeometry drawn_geometry(int j, double u) const;
  double segment_length(int j) const { return breaks_[j + 1] - breaks_[j]; }

  std::vector<RationalCubic> segments_;
  std::vector<std::shared_ptr<const ArcLengthMap>> maps_;  // immutable, shared by copies
  std::vector<double> breaks_;
  std::vector<bool> uniform_line_;
  int dimension_;
  Metric metric_;
  bool closed_;
  bool straight_ = false;
  std::shared_ptr<const DrawnSections> sections_;  // immutable, shared by copies
};

}  // namespace nurbeam
