#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem/forces/custom_force.h"
#include "fem/model/beam_model.h"
#include "fem/motion/record/snapshot.h"
#include "fem/motion/rest/adapted_mesh.h"
#include "pipelines/case/case_file.h"
#include "pipelines/model/beam_axis.h"
#include "pipelines/model/collectors.h"
#include "pipelines/model/law_of_motion.h"
#include "pipelines/model/model_frame.h"
#include "pipelines/model/section_outline.h"
#include "pipelines/model/slopes.h"
#include "pipelines/section/section_profile.h"

namespace nurbeam {

/// A place where results are recorded.
struct Probe {
  std::string name;
  int beam;
  double s;  ///< [m]
  ProbePlace::Side side = ProbePlace::Side::after;
};

/// A section that was drawn.
struct BeamProfile {
  std::filesystem::path file;
  SectionProfile profile;
};

/// Where a beam of the model comes from.
struct BeamSource {
  std::string curve_name;               ///< for export
  std::optional<AxisSource> axis = {};  ///< empty where the axis is in no file
  std::optional<BeamProfile> profile = {};
  double drawn_bending = 0;  ///< energy that the drawing holds against the stress-free shape [J]
  std::string torsion;       ///< whether a beam in space has torsion, and why
  SectionOutline outline = {};
};

/// A case as a model: everything resolved and in place.
struct BuiltModel {
  BeamModel model;
  ModelFrame frame;
  std::vector<BeamSource> sources;  ///< per beam
  std::vector<Probe> probes;
  std::vector<std::vector<Grip>> laws = {};  ///< where each law of the case acts
  std::vector<LawOfMotion> motions = {};     ///< that functions prescribe
  std::vector<std::vector<int>> loads = {};  ///< per load of the case: its forces, one for each of its beams
  std::vector<Collector> collectors = {};
  std::vector<SlopeDecision> slopes = {};   ///< where something holds or loads a beam
  std::optional<AdaptedMesh> adapted = {};  ///< where beams name a tolerance instead of a number of elements
  std::vector<std::filesystem::path> inputs;  ///< CAD files read
  double import_seconds = 0;
};

struct BuildReport {
  std::optional<BuiltModel> value;  ///< empty when any diagnostic is an error
  std::vector<Diagnostic> diagnostics;
};

/// Reads the curves of a case and makes its model: axes to segments, plane detection, elements, places.
/// `interrupted` is asked while files are read and a mesh is adapted: a model that it ends is an error.
/// `like`: the model of a neighbouring case, from which is taken what both have in common, and of which is
/// known what its drawing holds.
BuildReport build_model(const CaseFile& case_file, const std::function<bool()>& interrupted = {},
                        const BuiltModel* like = nullptr);

}  // namespace nurbeam
