#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cad_import/report/diagnostic.h"
#include "cad_import/report/format.h"
#include "fem/motion/remesh/mesh_rules.h"
#include "fem/motion/run/integrators.h"
#include "fem/structure/displacement_table.h"
#include "fem/structure/structure.h"
#include "nurbs/smooth/smooth_nurbs.h"
#include "pipelines/case/parts/beam_joint.h"
#include "pipelines/case/parts/body.h"
#include "pipelines/case/parts/connector.h"
#include "pipelines/case/parts/eyelet.h"
#include "pipelines/case/parts/load.h"
#include "pipelines/case/parts/probe.h"
#include "pipelines/case/parts/sliding_joint.h"
#include "pipelines/case/parts/stop.h"
#include "pipelines/case/parts/support.h"

namespace nurbeam {

/// Which curves of a CAD file.
struct AxisFile {
  std::filesystem::path path;  ///< absolute
  std::optional<std::string> curve_name = {};
  std::optional<int> curve_index = {};  ///< from 1
  bool chain = false;
  std::optional<std::string> part = {}, layer = {}, colour = {};
  std::optional<Eigen::Vector3d> near = {};  ///< [m]
  bool longest = false;
  bool all_chains = false;
  std::optional<double> gap = {};  ///< largest gap to close [m]
};

struct CaseAxis {
  using File = AxisFile;
  using Polyline = std::vector<Eigen::Vector3d>;
  struct Arc {
    Eigen::Vector3d center, start, end, normal;
  };
  std::variant<File, NurbsCurve, Polyline, Arc> source;
};

/// A section drawn in a CAD file.
struct CaseProfile {
  std::filesystem::path path;  ///< absolute; of an outline what it is called
  bool x_in_plane = false;     ///< a planar model bends along the profile's x axis; else along y
  /// Given by numbers instead of a file: corners, anticlockwise [m].
  std::vector<Eigen::Vector2d> outline = {};
};

struct CaseSection {
  double area = 0;                           ///< [m^2]
  double second_moment = 0;                  ///< [m^4]
  std::optional<double> radius = {};         ///< of a disk or a pipe [m]
  std::optional<double> bore = {};           ///< inner radius of a pipe [m]
  std::optional<double> extreme_fibre = {};  ///< greatest distance from the axis of bending [m]
  std::optional<std::array<double, 2>> second_moments = {};  ///< I_x, I_y, where they may differ [m^4]
  double product = 0;                                        ///< I_xy [m^4]
  std::optional<double> torsion_constant = {};               ///< [m^4]
  std::optional<CaseProfile> profile = {};                   ///< what gives area and second moment
  bool from_cad = false;  ///< all are those of the pipe whose centre line the axis is
};

struct CaseMaterial {
  double density = 0;                            ///< [kg/m^3]
  double youngs_modulus = 0;                     ///< [Pa]
  double damping = 0;                            ///< [s], theory c
  std::optional<double> shear_modulus = {};      ///< [Pa]
  std::optional<double> poissons_ratio = {};     ///< one of them at most
  std::optional<double> thermal_expansion = {};  ///< [1/K]
  double mass_damping = 0;                       ///< [1/s], alpha
  double stiffness_damping = 0;                  ///< [s], beta
  std::string name = {};                         ///< of a standard material whose numbers it has
};

struct CaseElements {
  std::optional<int> count;
  std::optional<double> max_length;  ///< [m]
  std::optional<int> per_segment;
  std::optional<double> tolerance;  ///< error of positions over the length (adapt_mesh)
  double grading = 0;               ///< increment of length between neighbouring elements of one segment [m]
};

/// What a run can be asked for.
constexpr int most_elements = 100'000;  ///< of one beam
constexpr int most_frames = 1'000'000;
constexpr double most_steps = 1e9;

enum class ElementKind { ale_rancf, ale_ancf };
/// What a corner of the axis above `smooth_angle` is; error and smooth: an error; rigid: it keeps its angle.
enum class Corners { error, smooth, rigid, hinge };
enum class StressFree { automatic, as_drawn, straight, as_drawn_without_torsion };

/// How a beam moves at time 0; in world coordinates.
struct CaseVelocity {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();     ///< [rad/s]
  Eigen::Vector3d about = Eigen::Vector3d::Zero();        ///< [m]
  double along = 0;                                       ///< of the material along the axis [m/s]
};

struct CaseBeam {
  std::string name;
  std::string path;  ///< JSON path of this object, for messages
  CaseAxis axis;
  std::optional<double> approximation_tolerance;  ///< for axes of degree above 3 [m]
  bool rigid = false;                     ///< a guide: no section, material or elements
  bool ring = false;                      ///< the axis is closed, and so is the beam
  Corners corners = Corners::error;
  double smooth_angle = 0;  ///< greatest corner that is smoothed [rad]; 0: none
  CaseSection section;
  CaseMaterial material;
  CaseElements elements;
  ElementKind element = ElementKind::ale_rancf;
  WeightRule weights = WeightRule::material;
  MergeRule merge = MergeRule::standard;
  bool torsion = false;
  bool torsion_by_drawing = false;  ///< nothing asks for torsion or against it: the model decides
  Orientation orientation = {};     ///< with torsion
  StressFree stress_free = StressFree::automatic;
  CurvatureMeasure curvature = CurvatureMeasure::material;
  AxialStrain axial_strain = AxialStrain::ends_and_mean;
  Metric metric = Metric::arc_length;
  Form form = Form::variational;
  std::optional<double> unstressed_length = {};  ///< [m]
  double tension = 0;                            ///< as drawn [N]
  TimeTable temperature = {};                    ///< above that of the unstressed length [K]; empty: none
  std::optional<CaseVelocity> velocity = {};
};

/// Of modes and buckling.
struct CaseModes {
  int count = 10;
  bool about_equilibrium = true;  ///< else as drawn, without loads
  bool bodies_held = true;
};

struct CaseAnalysis {
  enum class Type { dynamic, statics, modes, buckling } type = Type::dynamic;
  CaseModes modes;
  bool start_from_equilibrium = false;
  double end_time = 0;               ///< [s]; of a static analysis the last of its factors
  std::vector<double> load_factors;  ///< of a static analysis, increasing; empty: 1
  bool reads_tables = false;         ///< at the factor, of a static analysis (has_tables)
  std::optional<double> step;        ///< fixed steps [s]; else those of the integrator's tolerance
  IntegratorSettings integrator;
  LengthControl length_control;

  /// Of the states of a static analysis; empty: one under full loads, in which nothing is read at a factor.
  std::vector<double> factors() const {
    return load_factors.empty() && reads_tables ? std::vector<double>{1} : load_factors;
  }
  /// Whether a time that is asked for is that of a state.
  bool is_same_time(double a, double b) const { return std::abs(a - b) < 1e-9 * std::max(end_time, 1e-9); }
  bool has_modes() const { return type == Type::modes || type == Type::buckling; }
  /// An explicit method, which is for models without constraints between moving parts.
  bool is_explicit() const { return std::holds_alternative<ExplicitRungeKutta>(integrator); }
};

struct CaseOutput {
  std::optional<double> every;           ///< [s]; always there in a dynamic analysis
  std::vector<std::string> cad_formats;  ///< "step", "iges", "dxf", "step-solid", ...
  std::vector<double> cad_times;         ///< [s]; the end time unless the file says otherwise
  bool cad_at_all_times = false;         ///< every stored frame, numbered
  std::string cad_unit = "mm";
  StepSchema cad_schema = StepSchema::ap214;
  CurveParameter cad_parameter = CurveParameter::free;
  std::vector<CaseProbe> probes;
  bool paraview = false;  ///< a series of files for ParaView
  bool report = true;     ///< report.html
};

/// A place on a beam or a body that the law of a host program acts on.
struct CaseLawPoint {
  std::string path;
  std::string body, beam;  ///< one of them
  Place at;                ///< on the beam
};

/// A force whose law is a function of the program that has made the case in memory.
struct CaseLaw {
  std::string path;
  std::vector<CaseLawPoint> points;
  bool spatial = false;  ///< it may act in every direction: the model is no planar one
};

/// A case file, resolved to SI units and absolute paths, valid as far as the file alone can tell.
struct CaseFile {
  std::filesystem::path path;
  std::string json = {};                          ///< as read, overrides applied, without comments and spaces
  std::vector<std::filesystem::path> files = {};  ///< absolute: drawings and tables that it names
  std::string name;
  Eigen::Vector3d gravity = Eigen::Vector3d(0, 0, -9.81);
  Air air = {};
  std::vector<CaseBeam> beams;
  std::vector<CaseBody> bodies;
  std::vector<CaseLoad> loads;
  std::vector<CaseSupport> supports;
  std::vector<CaseSlidingJoint> sliding_joints;
  std::vector<CaseEyelet> eyelets;
  std::vector<CaseStop> stops;
  std::vector<CaseBeamJoint> joints;
  std::vector<CaseConnector> connectors;
  CaseAnalysis analysis;
  CaseOutput output;
  std::vector<CaseLaw> laws = {};  ///< of a case made in memory
};

/// A case file and everything that is wrong with it; `value` is empty when any diagnostic is an error.
struct CaseFileReport {
  std::optional<CaseFile> value;
  std::vector<Diagnostic> diagnostics;
};

/// Reads, checks and resolves a case file: comments allowed, unit strings ("5 mm"), unknown keys are errors
/// that name the closest known key, all errors at once, each with its JSON path. `overrides`: "path=value"
/// (--set), applied before the checks; the value is JSON or else a text, and null removes the key.
CaseFileReport read_case_file(const std::filesystem::path& file,
                              const std::vector<std::string>& overrides = {});

/// The same of a text made by a program, which may have the keys of host_keys() besides; `file` heads the
/// messages, and files that the text names are relative to its folder.
CaseFileReport read_case_text(const std::string& text, const std::filesystem::path& file);
/// The same of the JSON itself, whose numbers are finite; the case has no text.
CaseFileReport read_case_json(nlohmann::ordered_json json, const std::filesystem::path& file);

/// The text of a case file as JSON without comments, overrides applied; empty, with errors, where it cannot
/// be read as JSON. Nothing else is checked.
struct CaseTextReport {
  std::string json;
  std::vector<Diagnostic> diagnostics;
};
CaseTextReport case_text(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

}  // namespace nurbeam
