#include "pipelines/build_model.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

#include "cad_import/import_curves.h"
#include "nurbs/bezier_path.h"
#include "nurbs/closest_point.h"
#include "nurbs/smooth_corners.h"
#include "pipelines/axis_selection.h"
#include "pipelines/cgal_geometry.h"
#include "pipelines/closest_name.h"
#include "pipelines/section_profile.h"

namespace nurbeam {

namespace {

// What a beam's axis may measure [m], and its shortest segment as a part of it.
constexpr double shortest_beam = 1e-6, longest_beam = 1e7, shortest_segment = 1e-6;
// Places nearer to each other than this part of the beam's length are the same place.
constexpr double same_place = 1e-9;
// Radii nearer to each other than this part of them are the same radius.
constexpr double same_radius = 1e-6;
// In space an angle has no derivative where it is 0 or pi: no smaller sine can be held.
constexpr double least_sine = 0.02;
// Beams whose axes come within this part of their length of each other meet.
constexpr double same_joint = 1e-6;

std::string text(double value) {
  std::ostringstream stream;
  stream.precision(10);
  stream << value;
  return stream.str();
}

std::string text(const Eigen::Vector3d& p) {
  return "(" + text(p.x()) + ", " + text(p.y()) + ", " + text(p.z()) + ") m";
}

RationalCubic straight_cubic(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Matrix4d points;
  for (int i = 0; i < 4; ++i) points.col(i) << a + (b - a) * (i / 3.0), 1;
  return RationalCubic(points);
}

// Circular arc about `normal` from start to end in pieces of at most 90 degrees (Eq. 43 of Ding & Ouyang).
std::vector<RationalCubic> arc_cubics(const CaseAxis::Arc& arc) {
  const Eigen::Vector3d n = arc.normal.normalized(), a = arc.start - arc.center, b = arc.end - arc.center;
  double angle = std::atan2(n.dot(a.cross(b)), a.dot(b));
  if (angle <= 1e-12) angle += 2 * M_PI;
  const int pieces = static_cast<int>(std::ceil(angle / (M_PI / 2) - 1e-9));
  const double step = angle / pieces, w1 = (1 + 2 * std::cos(step / 2)) / 3;
  const auto at = [&](double theta) -> Eigen::Vector3d {
    return a * std::cos(theta) + n.cross(a) * std::sin(theta);
  };
  std::vector<RationalCubic> cubics;
  for (int i = 0; i < pieces; ++i) {
    const double theta = i * step;
    const Eigen::Vector3d p0 = at(theta), p3 = i + 1 == pieces ? Eigen::Vector3d(b) : at(theta + step);
    // Control points of the elevated quadratic: w1 P1 = (P0 + 2 w C)/3 with the tangents' intersection C.
    const Eigen::Vector3d tip = at(theta + step / 2) / std::cos(step / 2);
    const double wc = std::cos(step / 2);
    Eigen::Matrix4d points;
    points.col(0) << p0 + arc.center, 1;
    points.col(1) << (p0 + 2 * wc * tip) / 3 + w1 * arc.center, w1;
    points.col(2) << (p3 + 2 * wc * tip) / 3 + w1 * arc.center, w1;
    points.col(3) << p3 + arc.center, 1;
    cubics.emplace_back(points);
  }
  return cubics;
}

class Builder {
 public:
  explicit Builder(CaseFile case_file) : case_(std::move(case_file)) {}

  BuildReport build() {
    choose_chains();
    for (std::size_t b = 0; b < case_.beams.size() && !failed(); ++b)
      paths_.push_back(axis_of(case_.beams[b], chains_[b]));
    if (!failed()) {
      choose_frame();
      for (std::size_t b = 0; b < case_.beams.size() && !failed(); ++b) add_beam(static_cast<int>(b));
      if (!failed()) join_beams();
      for (std::size_t b = 0; b < case_.beams.size() && !failed(); ++b) divide_beam(static_cast<int>(b));
    }
    if (!failed()) check_joined_supports();
    if (!failed()) {
      add_loads();
      add_joints();
      add_gravity_energy();
      for (const CaseProbe& probe : case_.output.probes) {
        const int beam = beam_index(probe.beam);
        const double s = material_coordinate(beam, place(probe.at, beam, "output.probes"));
        built_.probes.push_back({probe.name, beam, s});
      }
    }
    BuildReport report;
    const bool ok = !failed();
    report.diagnostics = std::move(diagnostics_);
    if (ok) report.value = std::move(built_);
    return report;
  }

 private:
  void error(const std::string& where, const std::string& message) {
    diagnostics_.push_back({Severity::error, case_.path.string() + ": " + where, message});
  }
  void warn(const std::string& where, const std::string& message) {
    diagnostics_.push_back({Severity::warning, case_.path.string() + ": " + where, message});
  }
  bool failed() const {
    return std::any_of(diagnostics_.begin(), diagnostics_.end(),
                       [](const Diagnostic& d) { return d.severity == Severity::error; });
  }
  int beam_index(const std::string& name) const {
    for (std::size_t b = 0; b < case_.beams.size(); ++b)
      if (case_.beams[b].name == name) return static_cast<int>(b);
    return 0;  // names were checked with the case file
  }

  const ImportReport& imported(const std::filesystem::path& file) {
    if (const auto found = imports_.find(file); found != imports_.end()) return found->second;
    const auto start = std::chrono::steady_clock::now();
    ImportReport report = import_curves(file);
    built_.import_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    built_.inputs.push_back(file);
    diagnostics_.insert(diagnostics_.end(), report.diagnostics.begin(), report.diagnostics.end());
    return imports_.emplace(file, std::move(report)).first->second;
  }

  // Replaces a beam of several chains by one beam for each, named "name 1", "name 2", ...; what was said of
  // the beam is said of each of them.
  void choose_chains() {
    std::vector<CaseBeam> beams;
    std::map<std::string, std::vector<std::string>> names;  // of the beams that a name stands for
    for (const CaseBeam& beam : case_.beams) {
      const auto* file = std::get_if<AxisFile>(&beam.axis.source);
      const std::vector<Chain> chains = file ? chosen_chains(beam, *file) : std::vector<Chain>{{}};
      for (std::size_t i = 0; i < chains.size(); ++i) {
        CaseBeam one = beam;
        if (file && file->all_chains) {
          one.name += " " + std::to_string(i + 1);
          names[beam.name].push_back(one.name);
        }
        names[one.name] = {one.name};
        if (one.section.from_cad) one.section = pipe_section(one, chains[i]);
        beams.push_back(std::move(one));
        chains_.push_back(chains[i]);
      }
    }
    case_.beams = std::move(beams);
    if (failed()) return;
    name_each_beam(case_.loads, names);
    name_each_beam(case_.supports, names);
    for (CaseSlidingJoint& joint : case_.sliding_joints)
      if (check_name(joint.beam, joint.path, names) && names[joint.beam].size() > 1)
        error(joint.path + ".beam", "is " + in_quotes(joint.beam) + ", which is several beams; choose one: " +
                                        quoted_list(names[joint.beam]));
    for (const CaseBeamJoint& joint : case_.joints)
      for (const std::string& name : joint.beams)
        if (check_name(name, joint.path, names) && names[name].size() > 1)
          error(joint.path + ".beams", "names " + in_quotes(name) + ", which is several beams; choose of: " +
                                           quoted_list(names[name]));
    for (CaseProbe& probe : case_.output.probes)
      if (check_name(probe.beam, "output.probes", names) && names[probe.beam].size() > 1)
        error("output.probes", "probe " + in_quotes(probe.name) + " is on " + in_quotes(probe.beam) +
                                   ", which is several beams; choose one: " + quoted_list(names[probe.beam]));
  }

  // What was said of a name is said of every beam that it stands for.
  template <class Item>
  void name_each_beam(std::vector<Item>& items,
                      const std::map<std::string, std::vector<std::string>>& names) {
    std::vector<Item> each;
    for (const Item& item : items) {
      if (!check_name(item.beam, item.path, names)) continue;
      for (const std::string& name : names.at(item.beam)) {
        each.push_back(item);
        each.back().beam = name;
      }
    }
    items = std::move(each);
  }

  bool check_name(const std::string& name, const std::string& path,
                  const std::map<std::string, std::vector<std::string>>& names) {
    if (names.contains(name)) return true;
    std::vector<std::string> known;
    for (const CaseBeam& beam : case_.beams) known.push_back(beam.name);
    error(path + ".beam", "there is no beam " + in_quotes(name) + known_names(name, known));
    return false;
  }

  // The chains of curves that the case chooses; one empty chain, with a diagnostic, where it cannot.
  std::vector<Chain> chosen_chains(const CaseBeam& beam, const AxisFile& axis) {
    const ImportReport& report = imported(axis.path);
    if (!report.ok()) return {{}};
    const AxisSelection selection = select_axis(axis, report);
    const std::string where = beam.path + ".axis";
    if (!selection.error.empty()) {
      error(selection.key.empty() ? where : where + "." + selection.key, selection.error);
      return {{}};
    }
    for (const Gap& gap : selection.gaps)
      warn(where, "the gap of " + text(gap.width) + " m between curves " + std::to_string(gap.curve_a + 1) +
                      " and " + std::to_string(gap.curve_b + 1) + " of " + report.file + " at " +
                      text(gap.point) + " was closed");
    note_junctions(where, selection.chains, report, gap_tolerance(report, axis.gap));
    return selection.chains;
  }

  // Where other curves meet the chosen ones.
  void note_junctions(const std::string& where, const std::vector<Chain>& chains, const ImportReport& report,
                      double tolerance) {
    std::set<int> chosen;
    for (const Chain& chain : chains) chosen.insert(chain.curves.begin(), chain.curves.end());
    for (const Junction& junction : junctions(report, tolerance)) {
      if (std::none_of(junction.curves.begin(), junction.curves.end(),
                       [&](int curve) { return chosen.contains(curve); }))
        continue;
      diagnostics_.push_back({Severity::note, case_.path.string() + ": " + where,
                              "curves " + list_of_curves(report, junction.curves) + " of " + report.file +
                                  " meet at " + text(junction.point)});
    }
  }

  // The section of the pipe whose centre line the chain is.
  CaseSection pipe_section(const CaseBeam& beam, const Chain& chain) {
    const auto* file = std::get_if<AxisFile>(&beam.axis.source);
    const std::string where = beam.path + ".section.from";
    if (!file) {
      error(where, "\"cad\" needs an axis from a file; give \"radius\"");
      return {};
    }
    if (chain.curves.empty()) return {};
    const std::vector<ImportedCurve>& curves = imported(file->path).curves;
    const ImportedCurve& first = curves[chain.curves.front()];
    for (int i : chain.curves) {
      const ImportedCurve& curve = curves[i];
      if (!curve.is_centre_line())
        error(where, "is \"cad\", but curve " + std::to_string(i + 1) + " of " + file->path.string() +
                         " is a " + curve.entity + " and no centre line of a pipe; give \"radius\"");
      else if (std::abs(curve.pipe_radius - first.pipe_radius) > same_radius * first.pipe_radius ||
               std::abs(curve.bore_radius - first.bore_radius) > same_radius * first.pipe_radius)
        error(where, "the pipe has the radius " + text(first.pipe_radius) + " m (bore " +
                         text(first.bore_radius) + " m) at curve " +
                         std::to_string(chain.curves.front() + 1) + " and " + text(curve.pipe_radius) +
                         " m (bore " + text(curve.bore_radius) + " m) at curve " + std::to_string(i + 1) +
                         "; a beam has one section: give \"radius\", or choose a part with \"curve\"");
    }
    const double outer = first.pipe_radius, inner = first.bore_radius;
    return {.area = M_PI * (outer * outer - inner * inner),
            .second_moment = M_PI / 4 * (std::pow(outer, 4) - std::pow(inner, 4)),
            .radius = outer};
  }

  std::vector<RationalCubic> axis_from_file(const CaseBeam& beam, const AxisFile& axis, const Chain& chain) {
    const ImportReport& report = imported(axis.path);
    std::vector<NurbsCurve> curves;
    for (const ImportedCurve& curve : report.curves) curves.push_back(curve.curve);
    const std::string& name = report.curves[chain.curves[0]].name;
    built_.curve_names.back() = name.empty() ? beam.name : name;
    const BezierPath path = join(curves, chain, beam.approximation_tolerance);
    const bool approximated =
        std::any_of(chain.curves.begin(), chain.curves.end(), [&](int i) { return curves[i].degree() > 3; });
    if (approximated)
      warn(beam.path + ".axis",
           "a curve of degree above 3 was approximated; largest deviation " + text(path.deviation) + " m");
    return path.segments;
  }

  std::vector<RationalCubic> axis_of(const CaseBeam& beam, const Chain& chain) {
    built_.curve_names.push_back(beam.name);
    std::vector<RationalCubic> segments;
    try {
      segments = std::visit(
          [&](const auto& source) -> std::vector<RationalCubic> {
            using Source = std::decay_t<decltype(source)>;
            if constexpr (std::is_same_v<Source, AxisFile>) return axis_from_file(beam, source, chain);
            if constexpr (std::is_same_v<Source, NurbsCurve>)
              return BezierPath::from_nurbs(source, beam.approximation_tolerance).segments;
            if constexpr (std::is_same_v<Source, CaseAxis::Arc>) return arc_cubics(source);
            if constexpr (std::is_same_v<Source, CaseAxis::Polyline>) {
              std::vector<RationalCubic> cubics;
              for (std::size_t i = 0; i + 1 < source.size(); ++i)
                cubics.push_back(straight_cubic(source[i], source[i + 1]));
              return cubics;
            }
          },
          beam.axis.source);
      check_extent(beam, segments);
    } catch (const std::invalid_argument& problem) {
      error(beam.path + ".axis", problem.what());
    }
    corners_.emplace_back();
    if (!failed() && beam.smooth_angle > 0) segments = smoothed(beam, segments);
    if (!failed() && beam.ring) {
      check_ring(beam);
      close_ring(beam, segments);
    }
    if (!failed() && !beam.ring) mention_closed_axis(beam, segments);
    if (!failed()) check_corners(beam, segments);
    return segments;
  }

  // The axis has an extent, and coordinates that arithmetic can bear.
  void check_extent(const CaseBeam& beam, const std::vector<RationalCubic>& segments) {
    double largest = 0, extent = 0;
    for (const RationalCubic& cubic : segments)
      for (int i = 0; i < 4; ++i) {
        const Eigen::Vector3d p = cubic.control_point(i);
        largest = std::max(largest,
                           p.allFinite() ? p.cwiseAbs().maxCoeff() : std::numeric_limits<double>::infinity());
        extent = std::max(extent, (p - segments.front().control_point(0)).norm());
      }
    if (!(largest <= longest_beam))
      error(beam.path + ".axis", "has a coordinate of " + text(largest) + " m; the limit is " +
                                     text(longest_beam) + " m (is the unit right?)");
    else if (!segments.empty() && extent < shortest_beam)
      error(beam.path + ".axis", "has an extent of " + text(extent) + " m; the smallest is " +
                                     text(shortest_beam) + " m (is the unit right?)");
  }

  static double gap_of(const std::vector<RationalCubic>& segments) {
    return (segments.front().control_point(0) - segments.back().control_point(3)).norm();
  }

  // A closed axis has its end on its start, to this part of its length.
  static constexpr double closed_gap = 1e-6;

  // The axis of a ring: its end on its start, without a corner there, and two segments at least.
  void close_ring(const CaseBeam& beam, std::vector<RationalCubic>& segments) {
    const std::string where = beam.path + ".closed";
    const Eigen::Vector3d start = segments.front().control_point(0), end = segments.back().control_point(3);
    const double L = BezierPath{segments, {}, 0}.length();
    if (gap_of(segments) > closed_gap * L)
      return error(where, "is true, but the axis starts at " + text(start) + " and ends at " + text(end) +
                              ", " + text(gap_of(segments)) + " m apart; a ring may have a gap of " +
                              text(closed_gap * L) + " m: close the curve, or leave \"closed\" out");
    const std::vector<Corner> seam =
        BezierPath{{segments.back(), segments.front()}, {}, 0}.corners(default_corner_angle);
    if (!seam.empty())
      return error(where, "is true, but the axis has a corner of " + text(seam[0].angle * 180 / M_PI) +
                              " degrees at its seam, " + text(start) +
                              "; a ring is smooth: round the corner, or leave \"closed\" out");
    if (segments.size() == 1) {
      const auto [first, second] = segments[0].split(0.5);
      segments = {first, second};
    }
    Eigen::Matrix4d points = segments.back().points();
    points.col(3).head<3>() = points(3, 3) * start;
    segments.back() = RationalCubic(points);
  }

  void mention_closed_axis(const CaseBeam& beam, const std::vector<RationalCubic>& segments) {
    if (gap_of(segments) <= closed_gap * BezierPath{segments, {}, 0}.length())
      warn(beam.path + ".axis", "is closed; the beam is open at its seam, " +
                                    text(segments.front().control_point(0)) +
                                    ": \"closed\": true makes it a ring");
  }

  std::vector<RationalCubic> smoothed(const CaseBeam& beam, const std::vector<RationalCubic>& segments) {
    const BezierPath smooth = smooth_corners({segments, {}, 0}, beam.smooth_angle);
    if (smooth.deviation > 0)
      warn(beam.path + ".corners", "corners of up to " + text(beam.smooth_angle * 180 / M_PI) +
                                       " degrees were smoothed; largest deviation " + text(smooth.deviation) +
                                       " m");
    return smooth.segments;
  }

  void check_corners(const CaseBeam& beam, const std::vector<RationalCubic>& segments) {
    for (const Corner& corner : BezierPath{segments, {}, 0}.corners(default_corner_angle)) {
      corners_.back().push_back(corner.after_segment + 1);
      const bool slides = std::any_of(case_.sliding_joints.begin(), case_.sliding_joints.end(),
                                      [&](const CaseSlidingJoint& joint) { return joint.beam == beam.name; });
      const std::string place = "the axis has a corner of " + text(corner.angle * 180 / M_PI) +
                                " degrees at " + text(corner.point) + "; ";
      const bool is_rigid = beam.corners == Corners::rigid;
      if (is_rigid || beam.corners == Corners::hinge) {
        if (slides)
          error(beam.path + ".corners", place + "a body cannot slide over a " +
                                            (is_rigid ? "rigid corner" : "hinge") + ": " + rounding(corner) +
                                            ", or divide the beam there and join the parts with \"joints\"");
        continue;
      }
      error(beam.path + (beam.corners == Corners::smooth ? ".corners" : ".axis"),
            place +
                (beam.smooth_angle > 0 ? "those of up to " + text(beam.smooth_angle * 180 / M_PI) +
                                             " degrees are smoothed (\"smooth_up_to\"): "
                                       : "a beam needs a smooth axis: ") +
                rounding(corner) +
                (beam.ring ? "" : ", or keep it with \"corners\": \"rigid\" (its angle stays) or \"hinge\""));
    }
  }

  // How to be without a corner.
  static std::string rounding(const Corner& corner) {
    constexpr int most_degrees = 45;  // that "smooth_up_to" may be
    const int degrees = static_cast<int>(std::ceil(corner.angle * 180 / M_PI));
    if (degrees >= most_degrees) return "round the corner";
    return "round the corner, in the drawing or with \"corners\": \"smooth\", \"smooth_up_to\": " +
           std::to_string(degrees);
  }

  // The model is planar when axes, gravity and loads lie in one plane and moments are normal to it.
  void choose_frame() {
    std::vector<Eigen::Vector3d> in_plane, moments;
    const Eigen::Vector3d origin = paths_.front().front().control_point(0);
    double size = 0;
    for (const auto& path : paths_)
      for (const RationalCubic& cubic : path)
        for (int i = 0; i < 4; ++i) size = std::max(size, (cubic.control_point(i) - origin).norm());
    for (const auto& path : paths_)
      for (const RationalCubic& cubic : path)
        for (int i = 0; i < 4; ++i) in_plane.push_back((cubic.control_point(i) - origin) / size);
    const auto add_direction = [](std::vector<Eigen::Vector3d>& to, const Eigen::Vector3d& v) {
      if (v.norm() > 0) to.push_back(v.normalized());
    };
    add_direction(in_plane, case_.gravity);
    for (const CaseLoad& load : case_.loads)
      add_direction(load.kind == CaseLoad::Kind::moment ? moments : in_plane, load.value);

    const Eigen::Vector3d normal = plane_normal(in_plane, moments);
    constexpr double flat = 1e-9;
    const auto off_plane = [&](const Eigen::Vector3d& v) { return std::abs(v.dot(normal)) > flat; };
    const auto off_normal = [&](const Eigen::Vector3d& v) { return v.cross(normal).norm() > flat; };
    const bool planar = std::none_of(in_plane.begin(), in_plane.end(), off_plane) &&
                        std::none_of(moments.begin(), moments.end(), off_normal);
    built_.model.dimension = planar ? 2 : 3;
    if (planar) {
      const Eigen::Vector3d ahead =
          std::abs(normal.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
      const Eigen::Vector3d e1 = (ahead - ahead.dot(normal) * normal).normalized();
      built_.frame.rotation.row(0) = e1;
      built_.frame.rotation.row(1) = normal.cross(e1);
      built_.frame.rotation.row(2) = normal;
    }
    built_.frame.origin = origin;
    built_.model.gravity = built_.frame.rotation * case_.gravity;
    if (planar) built_.model.gravity.z() = 0;
  }

  static Eigen::Vector3d plane_normal(const std::vector<Eigen::Vector3d>& in_plane,
                                      const std::vector<Eigen::Vector3d>& moments) {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& v : in_plane) spread += v * v.transpose();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(spread, Eigen::ComputeFullU);
    const bool line = svd.singularValues()[1] < 1e-18 * svd.singularValues()[0];
    Eigen::Vector3d normal = svd.matrixU().col(2);
    if (line) {
      // Everything on one line: any plane through it; the one a moment asks for, else the one nearest to x-y.
      const Eigen::Vector3d along = svd.matrixU().col(0);
      Eigen::Vector3d wanted = moments.empty() ? Eigen::Vector3d::UnitZ() : moments.front();
      if (wanted.cross(along).norm() < 1e-6) wanted = Eigen::Vector3d::UnitY();
      normal = (wanted - wanted.dot(along) * along).normalized();
    }
    // Clean round-off so that a plane of two axes is exactly that plane.
    for (int i = 0; i < 3; ++i)
      if (std::abs(normal[i]) < 1e-12) normal[i] = 0;
    normal.normalize();
    int largest;
    normal.cwiseAbs().maxCoeff(&largest);
    return normal[largest] > 0 ? normal : Eigen::Vector3d(-normal);
  }

  RationalCubic to_local(const RationalCubic& cubic) const {
    Eigen::Matrix4d points;
    for (int i = 0; i < 4; ++i) {
      Eigen::Vector3d p = built_.frame.to_local(cubic.control_point(i));
      if (built_.model.dimension == 2) p.z() = 0;
      points.col(i) << cubic.weight(i) * p, cubic.weight(i);
    }
    return RationalCubic(points);
  }

  // The curve of one beam, which is also measured; nothing, with a diagnostic, where no beam can follow it.
  std::optional<ReferenceCurve> reference_curve(int b) {
    const CaseBeam& from = case_.beams[b];
    try {
      std::vector<RationalCubic> local;
      for (const RationalCubic& cubic : paths_[b]) local.push_back(to_local(cubic));
      measured_.emplace_back(local, built_.model.dimension, Metric::arc_length, from.ring);
      check_lengths(from, measured_.back());
      if (failed()) return {};
      return ReferenceCurve(local, built_.model.dimension, from.metric, from.ring);
    } catch (const std::invalid_argument& problem) {
      error(from.path + ".axis", problem.what());
      return {};
    }
  }

  void check_lengths(const CaseBeam& beam, const ReferenceCurve& curve) {
    const double L = curve.length();
    if (!(L >= shortest_beam && L <= longest_beam))
      return error(beam.path + ".axis", "is " + text(L) + " m long; must be between " + text(shortest_beam) +
                                            " and " + text(longest_beam) + " m (is the unit right?)");
    for (int j = 0; j < curve.segment_count(); ++j) {
      const double length = curve.breaks()[j + 1] - curve.breaks()[j];
      if (length < shortest_segment * L)
        error(beam.path + ".axis",
              "segment " + std::to_string(j + 1) + " of " + std::to_string(curve.segment_count()) +
                  ", at s = " + text(curve.breaks()[j]) + " m, is " + text(length) +
                  " m long; the shortest for a beam of " + text(L) + " m is " + text(shortest_segment * L) +
                  " m: remove it or merge it with its neighbour");
    }
  }

  // Adds the supports of one beam; returns their places.
  std::vector<double> add_supports(int b) {
    const double same = same_place * measured_[b].length();
    std::vector<double> places;
    std::vector<std::string> paths;
    for (const CaseSupport& support : case_.supports) {
      if (beam_index(support.beam) != b) continue;
      const double s = place(support.at, b, support.path);
      for (std::size_t i = 0; i < places.size(); ++i)
        if (std::abs(places[i] - s) < same)
          error(support.path,
                "holds beam \"" + support.beam + "\" at s = " + text(s) + " m, where " + paths[i] +
                    " already holds it; keep one of them (\"clamped\" holds what \"pinned\" holds)");
      places.push_back(s);
      paths.push_back(support.path);
      built_.model.supports.push_back(
          {b, material_coordinate(b, s), support.type == CaseSupport::Type::clamped});
    }
    return places;
  }

  // No element may be as short as the places between which it lies make it.
  void check_intervals(const CaseBeam& beam, const std::vector<double>& places) {
    const double L = places.back();
    for (std::size_t i = 1; i < places.size(); ++i)
      if (places[i] - places[i - 1] < shortest_segment * L)
        error("supports", "a support of beam \"" + beam.name +
                              "\" and its neighbour (a support, an end or a "
                              "joint of two segments) are " +
                              text(places[i] - places[i - 1]) + " m apart, at s = " + text(places[i]) +
                              " m; move it there, or by at least " + text(shortest_segment * L) + " m");
  }

  // Area and second moment of a beam, from the drawing where there is one; nothing with a diagnostic.
  std::optional<CaseSection> section_of(int b) {
    const CaseBeam& from = case_.beams[b];
    if (!from.section.profile) return from.section;
    const std::filesystem::path& file = from.section.profile->path;
    const std::string where = from.path + ".section.profile";
    const ImportReport& report = imported(file);
    if (!report.ok()) return {};
    ProfileReport drawn =
        section_profile(report.curves, case_.path.string() + ": " + where + ": " + file.string());
    diagnostics_.insert(diagnostics_.end(), drawn.diagnostics.begin(), drawn.diagnostics.end());
    if (!drawn.value) return {};
    const SectionProfile& profile = *drawn.value;
    built_.profiles.push_back({b, file, profile});
    CaseSection section{.area = profile.area, .second_moment = profile.second_x};
    if (built_.model.dimension == 3) {
      check_isotropy(where, profile);
    } else {
      if (from.section.profile->x_in_plane) section.second_moment = profile.second_y;
      if (std::abs(profile.product) > 1e-6 * profile.principal_1())
        warn(where, "the principal axes of the profile are turned by " +
                        text(profile.principal_angle() * 180 / M_PI) +
                        " degrees: it would bend out of the plane; the planar model holds it in its plane");
    }
    return section;
  }

  // A spatial model has one bending stiffness for all directions.
  void check_isotropy(const std::string& where, const SectionProfile& profile) {
    constexpr double alike = 1e-3;
    const double most = profile.principal_1(), least = profile.principal_2();
    if (most - least > alike * most)
      error(where, "the profile's principal second moments are " + text(most) + " and " + text(least) +
                       " m^4; in a spatial model, whose beams bend alike in all directions, they may differ "
                       "by " +
                       text(alike * most) +
                       " m^4: draw a section that is alike in both, give \"area\" and \"second_moment\", or "
                       "keep axes, loads and gravity in one plane");
  }

  void add_beam(int b) {
    const CaseBeam& from = case_.beams[b];
    const std::optional<ReferenceCurve> curve = reference_curve(b);
    const std::optional<CaseSection> section = section_of(b);
    if (!curve || !section) return;
    Beam beam{from.name, *curve, {}, false, from.weights, from.merge, {}};
    if (from.element == ElementKind::ale_ancf) beam.weights = WeightRule::ones;
    beam.properties.axial_stiffness = from.material.youngs_modulus * section->area;
    beam.properties.bending_stiffness = from.material.youngs_modulus * section->second_moment;
    beam.properties.mass_per_length = from.material.density * section->area;
    beam.properties.damping = from.material.damping;
    beam.properties.curvature = from.curvature;
    beam.properties.form = from.form;
    if (from.metric == Metric::label) check_without_metric(from);
    beam.straight = is_straight(from, beam.curve);
    built_.model.beams.push_back(std::move(beam));
    built_.radii.push_back(section->radius);
  }

  // Its supports and elements.
  void divide_beam(int b) {
    const CaseBeam& from = case_.beams[b];
    Beam& added = built_.model.beams[b];
    std::vector<double> held = add_supports(b);
    held.insert(held.end(), joint_places_[b].begin(), joint_places_[b].end());
    const std::vector<double> places = fixed_places(measured_[b], held);
    check_intervals(from, places);
    if (failed()) return;
    std::vector<int> counts;
    try {
      counts = parts(from, places);
    } catch (const std::invalid_argument& problem) {
      return error(from.path + ".elements.count", problem.what());
    }
    if (counts.empty()) return;
    try {
      added.home = home_nodes(places, counts, from.elements.grading);
    } catch (const std::invalid_argument& problem) {
      return error(from.path + ".elements.grading", problem.what());
    }
    if (from.elements.grading != 0 && *from.elements.per_segment == 1)
      warn(from.path + ".elements.grading",
           text(from.elements.grading) + " m has no effect with one element per segment; take 2 or more");
    for (HomeNode& node : added.home) node.s = material_coordinate(b, node.s);
    if (from.ring) {
      added.home.front().late = added.home.back().late = true;  // the seam is a break of the drawing
      check_ring_elements(from, added);
    }
    const bool is_rigid = from.corners == Corners::rigid;
    for (int corner : corners_[b]) {
      const double s = added.curve.breaks()[corner];
      if (is_rigid) check_rigid_corner(from, added.curve, s);
      for (HomeNode& node : added.home)
        if (node.s == s) node.kind = is_rigid ? NodeKind::rigid : NodeKind::hinge;
    }
  }

  // In space the angle of a corner that hardly turns, or turns right back, has no derivative.
  void check_rigid_corner(const CaseBeam& from, const ReferenceCurve& curve, double s) {
    if (built_.model.dimension == 2) return;
    const Eigen::Vector3d before = curve.tangent(s, true).normalized(), after = curve.tangent(s).normalized();
    const double sine = before.cross(after).norm(), cosine = before.dot(after);
    if (sine >= least_sine) return;
    const double least = std::asin(least_sine) * 180 / M_PI;
    error(from.path + ".corners",
          "is \"rigid\", but the corner at " + text(built_.frame.to_world(curve.position(s))) + " turns by " +
              text(std::atan2(sine, cosine) * 180 / M_PI) +
              " degrees, and this is a spatial model, which keeps corners of " + text(least) + " to " +
              text(180 - least) + " degrees: " +
              (cosine > 0 ? "smooth it with \"smooth_up_to\": 2" : "round it") + ", or use \"hinge\"");
  }

  // What is there for comparison with the papers, whose beams have ends.
  void check_ring(const CaseBeam& from) {
    if (from.weights == WeightRule::constant)
      error(from.path + ".weights",
            "\"constant\" is a comparison for beams with ends; a ring needs \"material\"");
    if (from.metric == Metric::label)
      error(from.path + ".metric",
            "\"none\" is a comparison for beams with ends; a ring needs \"reference\"");
    for (const auto& [kind, name] : {std::pair(Corners::hinge, "hinge"), std::pair(Corners::rigid, "rigid")})
      if (from.corners == kind)
        error(from.path + ".corners", in_quotes(name) + " is not available on a ring; leave it out");
  }

  void check_ring_elements(const CaseBeam& from, const Beam& beam) {
    const int sliders = static_cast<int>(
        std::count_if(case_.sliding_joints.begin(), case_.sliding_joints.end(),
                      [&](const CaseSlidingJoint& joint) { return joint.beam == from.name; }));
    const int fewest = 4 + 2 * sliders;
    if (beam.home_intervals() < fewest)
      error(from.path + ".elements", "gives " + std::to_string(beam.home_intervals()) +
                                         " elements; a ring with " + std::to_string(sliders) +
                                         " sliding bodies needs at least " + std::to_string(fewest));
  }

  // A place of one beam, in reference arc length.
  struct BeamPlace {
    int beam;
    double s;
  };

  // The place of the beam nearest to the point; an end that is near is that end.
  BeamPlace nearest_place(int b, const Eigen::Vector3d& point) const {
    const ClosestPoint found = closest_point(BezierPath{paths_[b], {}, 0}, point);
    const double L = measured_[b].length(), s = measured_[b].arc_length(found.segment, found.u);
    const double end = measured_[b].closed() ? 0 : L;
    return {b, s < same_joint * L ? 0 : s > L * (1 - same_joint) ? end : s};
  }

  Eigen::Vector3d world_position(const BeamPlace& place) const {
    return built_.frame.to_world(measured_[place.beam].position(place.s));
  }
  double distance(const std::pair<BeamPlace, BeamPlace>& places) const {
    return (world_position(places.first) - world_position(places.second)).norm();
  }

  // A ring has none, but its seam is a place where a joint may be.
  std::vector<double> ends_of(int b) const {
    return measured_[b].closed() ? std::vector<double>{0} : std::vector<double>{0, measured_[b].length()};
  }

  // Where two beams meet: nearest to the point, or else where an end of one is nearest to the other.
  std::pair<BeamPlace, BeamPlace> meeting_place(int a, int b,
                                                const std::optional<Eigen::Vector3d>& near) const {
    if (near) return {nearest_place(a, *near), nearest_place(b, *near)};
    std::vector<std::pair<BeamPlace, BeamPlace>> candidates;
    for (const double s : ends_of(a))
      candidates.emplace_back(BeamPlace{a, s}, nearest_place(b, world_position({a, s})));
    for (const double s : ends_of(b))
      candidates.emplace_back(nearest_place(a, world_position({b, s})), BeamPlace{b, s});
    return *std::min_element(candidates.begin(), candidates.end(), [&](const auto& one, const auto& other) {
      return distance(one) < distance(other);
    });
  }

  void join_beams() {
    joint_places_.resize(case_.beams.size());
    for (const CaseBeamJoint& joint : case_.joints)
      for (std::size_t i = 1; i < joint.beams.size(); ++i)
        join_two(joint, beam_index(joint.beams[0]), beam_index(joint.beams[i]));
    if (!case_.joints.empty() && case_.analysis.method == CaseAnalysis::Method::rk4)
      error("analysis.integrator.type",
            "\"rk4\" is for models without joints; use \"generalized-alpha\" or \"ida\"");
  }

  void join_two(const CaseBeamJoint& joint, int a, int b) {
    const std::string beams = in_quotes(case_.beams[a].name) + " and " + in_quotes(case_.beams[b].name);
    if (a == b) return error(joint.path + ".beams", "joins " + beams + "; give different beams");
    const auto places = meeting_place(a, b, joint.near);
    const auto& [at_a, at_b] = places;
    const double allowed = same_joint * std::max(measured_[a].length(), measured_[b].length());
    if (distance(places) > allowed)
      return error(joint.path, beams + " do not meet: they are " + text(distance(places)) + " m apart at " +
                                   text(world_position(at_a)) + " and " + text(world_position(at_b)) +
                                   "; the limit is " + text(allowed) + " m");
    for (const BeamPlace& place : {at_a, at_b}) check_sliders(joint, place);
    if (joint.rigid) check_angle(joint, places, beams);
    if (!unite(places))
      return error(joint.path, beams + " are joined at " + text(world_position(at_a)) +
                                   " already; leave out one of the joints");
    for (const BeamPlace& place : {at_a, at_b}) {
      std::vector<double>& own = joint_places_[place.beam];
      if (std::find(own.begin(), own.end(), place.s) == own.end()) own.push_back(place.s);
    }
    built_.model.beam_joints.push_back(
        {a, material_coordinate(a, at_a.s), b, material_coordinate(b, at_b.s), joint.rigid});
  }

  void check_sliders(const CaseBeamJoint& joint, const BeamPlace& place) {
    const std::string& name = case_.beams[place.beam].name;
    const ReferenceCurve& curve = measured_[place.beam];
    const bool at_end = !curve.closed() && (place.s == 0 || place.s == curve.length());
    for (const CaseSlidingJoint& slider : case_.sliding_joints)
      if (slider.beam == name && !at_end)
        error(joint.path, "is at s = " + text(place.s) + " m of beam " + in_quotes(name) +
                              ", over which body " + in_quotes(slider.body) +
                              " slides; a joint there must be at an end of the beam: "
                              "divide the beam there");
  }

  // In space the angle of beams in one line has no derivative.
  void check_angle(const CaseBeamJoint& joint, const std::pair<BeamPlace, BeamPlace>& places,
                   const std::string& beams) {
    if (built_.model.dimension == 2) return;
    const auto tangent = [&](const BeamPlace& place) -> Eigen::Vector3d {
      return measured_[place.beam].tangent(place.s);
    };
    if (tangent(places.first).cross(tangent(places.second)).norm() < least_sine)
      error(joint.path + ".type",
            "is \"rigid\", but " + beams +
                " run in one line there, and this is a spatial model: make them one beam "
                "(\"curve\" with \"chain\"), or use \"hinged\"");
  }

  // Puts both places into one group of places that are held together; false when they are in one.
  bool unite(const std::pair<BeamPlace, BeamPlace>& places) {
    const auto group_of = [&](const BeamPlace& place) {
      const auto key = std::pair(place.beam, place.s);
      return joined_.emplace(key, static_cast<int>(joined_.size())).first->second;
    };
    const int a = group_of(places.first), b = group_of(places.second);
    for (auto& [place, group] : joined_)
      if (group == b) group = a;
    return a != b;
  }

  // Of places that are joined, one may be supported: the others are held by it.
  void check_joined_supports() {
    std::map<int, std::string> first;
    for (const CaseSupport& support : case_.supports) {
      const int b = beam_index(support.beam);
      const auto found = joined_.find({b, place(support.at, b, support.path)});
      if (found == joined_.end()) continue;
      const auto [other, is_new] = first.emplace(found->second, support.path);
      if (!is_new)
        error(support.path, "holds beam " + in_quotes(support.beam) + " where " + other->second +
                                " already holds a beam that is joined to it; keep one of them");
    }
  }

  bool is_straight(const CaseBeam& from, const ReferenceCurve& curve) {
    if (built_.model.dimension == 2 || from.stress_free == StressFree::straight)
      return from.stress_free == StressFree::straight;
    const bool curved = curve.largest_curvature() * curve.length() > 1e-9;
    if (from.stress_free == StressFree::as_drawn_without_torsion) return false;
    if (from.stress_free == StressFree::as_drawn && curved)
      error(from.path + ".stress_free",
            "\"as-drawn\" needs torsional stiffness for a curved axis in a spatial model, which this element "
            "has not; "
            "use \"straight\" (exact for cables) or \"as-drawn-without-torsion\" (the limit of no torsional "
            "stiffness)");
    return true;
  }

  // Elements of each interval; none, with a diagnostic, when they are too many.
  std::vector<int> parts(const CaseBeam& from, const std::vector<double>& places) {
    const int intervals = static_cast<int>(places.size()) - 1;
    const CaseElements& asked = from.elements;
    if (asked.per_segment) {
      const int most = most_elements / intervals;
      if (*asked.per_segment <= most) return std::vector<int>(intervals, *asked.per_segment);
      too_many(from, "per_segment", std::to_string(*asked.per_segment),
               static_cast<double>(intervals) * *asked.per_segment,
               most > 0 ? "at most " + std::to_string(most) : "an axis of fewer segments");
      return {};
    }
    if (asked.max_length) {
      std::vector<double> counts;
      for (int i = 0; i < intervals; ++i)
        counts.push_back(
            std::max(1.0, std::ceil((places[i + 1] - places[i]) / *asked.max_length * (1 - 1e-12))));
      const double count = std::accumulate(counts.begin(), counts.end(), 0.0);
      if (count <= most_elements) return {counts.begin(), counts.end()};
      too_many(from, "max_length", text(*asked.max_length) + " m", count,
               intervals < most_elements
                   ? "at least " + text(places.back() / (most_elements - intervals)) + " m"
                   : "an axis of fewer segments");
      return {};
    }
    constexpr int default_count = 20;
    return spread_elements(places, asked.count.value_or(std::max(default_count, intervals)));
  }

  void too_many(const CaseBeam& from, const std::string& key, const std::string& value, double count,
                const std::string& valid) {
    error(from.path + ".elements." + key, "is " + value + ": " + text(count) +
                                              " elements, and the limit for one "
                                              "beam is " +
                                              std::to_string(most_elements) + "; give " + valid);
  }

  // The comparison of the subdivision paper: its strain law and measure, no sliding.
  void check_without_metric(const CaseBeam& beam) {
    if (beam.curvature != CurvatureMeasure::spatial)
      error(beam.path + ".metric", "\"none\" needs \"curvature\": \"spatial\", which it is defined for");
    for (const CaseSlidingJoint& joint : case_.sliding_joints)
      if (joint.beam == beam.name)
        error(beam.path + ".metric", "\"none\" is a comparison without sliding joints, but body \"" +
                                         joint.body + "\" slides on this beam; use \"reference\"");
  }

  // The model's material coordinate of a place in reference arc length: the same but without a metric.
  double material_coordinate(int b, double s) const {
    const ReferenceCurve& curve = built_.model.beams[b].curve;
    if (curve.metric() == Metric::arc_length) return s;
    const int j = measured_[b].segment_at(s);
    return curve.arc_length(j, measured_[b].parameter(j, s));
  }

  // In reference arc length, also without a metric.
  double place(const Place& at, int b, const std::string& where) {
    const ReferenceCurve& curve = measured_[b];
    const double L = curve.length();
    double s = 0;
    switch (at.kind) {
      case Place::Kind::start:
        s = 0;
        break;
      case Place::Kind::end:
        s = L;
        break;
      case Place::Kind::length:
        s = at.value;
        break;
      case Place::Kind::fraction:
        s = at.value * L;
        break;
      case Place::Kind::near: {
        const ClosestPoint found = closest_place(BezierPath{paths_[b], {}, 0}, at.point);
        const double within = at.within.value_or(0.01 * L);
        if (found.distance > within)
          error(where + ".at.near", text(at.point) + " is " + text(found.distance) + " m from beam \"" +
                                        case_.beams[b].name + "\"; the limit is " + text(within) + " m (" +
                                        (at.within ? "\"within\"" : "1 % of its length without \"within\"") +
                                        ") and the closest point of the axis " + text(found.point));
        s = curve.arc_length(found.segment, found.u);
        break;
      }
    }
    if (!(s >= -1e-9 * L && s <= L * (1 + 1e-9)))
      error(where + ".at",
            text(s) + " m is not on beam \"" + case_.beams[b].name + "\", which is " + text(L) + " m long");
    if (s < 1e-9 * L || (curve.closed() && s > L * (1 - 1e-9))) return 0;
    return s > L * (1 - 1e-9) ? L : s;
  }

  Eigen::Vector3d local_direction(const Eigen::Vector3d& world, bool is_moment) const {
    Eigen::Vector3d local = built_.frame.rotation * world;
    if (built_.model.dimension == 2) {
      if (is_moment)
        local.head<2>().setZero();
      else
        local.z() = 0;
    }
    return local;
  }

  void add_loads() {
    for (const CaseLoad& load : case_.loads) {
      const int b = beam_index(load.beam);
      const bool is_moment = load.kind == CaseLoad::Kind::moment;
      const Eigen::Vector3d value = local_direction(load.value, is_moment);
      if (load.kind == CaseLoad::Kind::force_per_length) {
        built_.model.line_loads.push_back({b, value, load.time});
        continue;
      }
      const double s = material_coordinate(b, place(load.at, b, load.path));
      const ReferenceCurve& curve = built_.model.beams[b].curve;
      const double speed = load.moving_speed.value_or(0);
      if (!curve.closed() && ((s == 0 && speed < 0) || (s == curve.length() && speed > 0)))
        warn(load.path + ".moves.speed", "is " + text(speed) +
                                             " m/s: the force leaves the beam at once and does "
                                             "nothing; it moves from the " +
                                             (s == 0 ? "start" : "end") + " into the beam with a " +
                                             (s == 0 ? "positive" : "negative") + " speed");
      const Eigen::Vector3d along = curve.tangent(s);
      if (is_moment && std::abs(value.dot(along)) > 1e-9 * value.norm())
        error(load.path + ".moment",
              "the moment has a component of " + text(value.dot(along)) +
                  " N m along the beam, which has no torsion; leave only the part across it");
      built_.model.point_loads.push_back({is_moment ? PointLoad::Kind::moment : PointLoad::Kind::force, b, s,
                                          speed, value, load.follower, load.time});
    }
  }

  void add_gravity_energy() {
    double mass = 0;
    for (const Beam& beam : built_.model.beams) mass += beam.properties.mass_per_length * beam.curve.length();
    for (const Body& body : built_.model.bodies) mass += body.mass;
    built_.frame.gravity_energy = -mass * case_.gravity.dot(built_.frame.origin);
  }

  void add_joints() {
    if (case_.analysis.method == CaseAnalysis::Method::rk4 && !case_.sliding_joints.empty())
      error("analysis.integrator.type",
            "\"rk4\" is for models without sliding joints; use \"generalized-alpha\" or \"ida\"");
    for (const CaseBody& body : case_.bodies) {
      built_.model.bodies.push_back({body.name, body.mass});
      const auto carries = [&](const CaseSlidingJoint& j) { return j.body == body.name; };
      const auto count = std::count_if(case_.sliding_joints.begin(), case_.sliding_joints.end(), carries);
      if (count != 1)
        error("bodies", "body \"" + body.name + "\" is in " + std::to_string(count) +
                            " sliding joints; a body needs exactly one");
    }
    for (const CaseSlidingJoint& joint : case_.sliding_joints) {
      const int b = beam_index(joint.beam);
      SlidingJoint added{0,
                         b,
                         place(joint.at, b, joint.path),
                         joint.speed,
                         std::nullopt,
                         joint.continuous_slope,
                         joint.leave_at_end};
      for (std::size_t i = 0; i < case_.bodies.size(); ++i)
        if (case_.bodies[i].name == joint.body) added.body = static_cast<int>(i);
      if (!joint.motion_table.empty()) {
        check_motion(joint, added.s, built_.model.beams[b].curve.length());
        added.motion = joint.motion_table;
        added.s = value_and_slope(joint.motion_table, 0).first;
      }
      if (joint.motion_speed) {
        const double speed = *joint.motion_speed, L = built_.model.beams[b].curve.length();
        const double end = built_.model.beams[b].is_ring() ? added.s + speed * case_.analysis.end_time
                           : speed > 0                     ? L
                                                           : 0;
        added.motion = speed == 0 || end == added.s ? TimeTable{{0, added.s}, {1, added.s}}
                                                    : TimeTable{{0, added.s}, {(end - added.s) / speed, end}};
      }
      if (joint.leave_at_end) warn_of_held_ends(joint, b);
      built_.model.joints.push_back(std::move(added));
    }
  }

  // A prescribed motion begins where the body is and stays on the beam.
  void check_motion(const CaseSlidingJoint& joint, double s, double L) {
    const double start = value_and_slope(joint.motion_table, 0).first;
    if (std::abs(start - s) > same_place * L)
      error(joint.path + ".motion.table", "is at s = " + text(start) + " m at time 0, but \"at\" is s = " +
                                              text(s) + " m; it must start where \"at\" is");
    for (std::size_t i = 0; i < joint.motion_table.size(); ++i) {
      const double row = joint.motion_table[i].second;
      if (built_.model.beams[beam_index(joint.beam)].is_ring()) continue;  // as often around as it says
      if (!(row >= -same_place * L && row <= L * (1 + same_place)))
        error(joint.path + ".motion.table[" + std::to_string(i) + "]",
              text(row) + " m is not on beam \"" + joint.beam + "\", which is " + text(L) +
                  " m long; must be between 0 and " + text(L) + " m");
    }
  }

  void warn_of_held_ends(const CaseSlidingJoint& joint, int b) {
    if (case_.analysis.type == CaseAnalysis::Type::statics || built_.model.beams[b].is_ring()) return;
    bool start = false, end = false;
    for (const Support& support : built_.model.supports) {
      start = start || (support.beam == b && support.s == 0);
      end = end || (support.beam == b && support.s == built_.model.beams[b].curve.length());
    }
    for (const double s : joint_places_[b]) {
      start = start || s == 0;
      end = end || s == measured_[b].length();
    }
    if (start || end)
      warn(joint.path + ".at_beam_end", std::string("the ") +
                                            (start && end ? "start and the end"
                                             : start      ? "start"
                                                          : "end") +
                                            " of beam \"" + joint.beam + "\" " +
                                            (start && end ? "are" : "is") +
                                            " supported: there \"leave\" acts like \"stop\"");
  }

  CaseFile case_;
  std::vector<Chain> chains_;  // per beam: the curves of its file
  BuiltModel built_;
  std::vector<Diagnostic> diagnostics_;
  std::vector<std::vector<RationalCubic>> paths_;
  std::vector<std::vector<int>> corners_;          // per beam: breaks that are corners
  std::vector<std::vector<double>> joint_places_;  // per beam: where others are joined to it [m]
  std::map<std::pair<int, double>, int> joined_;   // places by beam and s: which are held together
  std::vector<ReferenceCurve> measured_;           // per beam: the drawing in reference arc length
  std::map<std::filesystem::path, ImportReport> imports_;
};

}  // namespace

BuildReport build_model(const CaseFile& case_file) { return Builder(case_file).build(); }

}  // namespace nurbeam
