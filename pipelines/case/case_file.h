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
#include "pipelines/case/parts/analysis.h"
#include "pipelines/case/parts/beam.h"
#include "pipelines/case/parts/beam_joint.h"
#include "pipelines/case/parts/body.h"
#include "pipelines/case/parts/body_joint.h"
#include "pipelines/case/parts/collector.h"
#include "pipelines/case/parts/connector.h"
#include "pipelines/case/parts/eyelet.h"
#include "pipelines/case/parts/load.h"
#include "pipelines/case/parts/output.h"
#include "pipelines/case/parts/probe.h"
#include "pipelines/case/parts/reel.h"
#include "pipelines/case/parts/sliding_joint.h"
#include "pipelines/case/parts/stop.h"
#include "pipelines/case/parts/support.h"

namespace nurbeam {

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
  std::optional<MassField> field = {};  ///< of a frame that turns, or of a point that attracts
  std::vector<CaseBeam> beams;
  std::vector<CaseBody> bodies;
  std::vector<CaseLoad> loads;
  std::vector<CaseSupport> supports;
  std::vector<CaseSlidingJoint> sliding_joints;
  std::vector<CaseEyelet> eyelets;
  std::vector<CaseReel> reels;
  std::vector<CaseStop> stops;
  std::vector<CaseBeamJoint> joints;
  std::vector<CaseBodyJoint> body_joints;  ///< and supports of bodies
  std::vector<CaseBodyLoad> body_loads;
  std::vector<CaseConnector> connectors;
  std::vector<CaseCollector> collectors;
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
