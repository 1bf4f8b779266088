#pragma once
#include <functional>
#include <string>
#include <vector>

#include "fem/motion/run/simulation.h"

/// The examples of Ding & Ouyang 2022 computed in the ways that are compared with the paper.
namespace nurbeam::papers {

/// One way to compute: element, merging, thresholds, form.
struct Method {
  std::string name;
  WeightRule weights = WeightRule::material;
  MergeRule merge = MergeRule::standard;
  LengthControl control = {};
  Form form = Form::variational;
  AxialStrain axial_strain = AxialStrain::pointwise;
};

/// nurbeam's defaults but for the axial strain, which is the papers'.
Method ours();
/// ALE-RANCF as in the paper: constant weights, Eqs. 29-38, kept nodal velocities, its thresholds.
Method paper_rule();
/// The same with all weights 1 after a merge.
Method all_ones();
/// ALE-ANCF with the paper's thresholds and kept nodal velocities.
Method ale_ancf();

/// An example of the paper.
struct Example {
  std::string name;
  std::function<BeamModel(int elements)> model;
  double end;               ///< [s]
  std::string stress_free;  ///< of the page's statements
};
Example falling_beam_example();
Example suspended_beam_example();
Example semicircle_example(bool straight);

struct Pace {
  double end, step;  ///< [s]
  double every;      ///< between frames [s]
  double rho_infinity = 0.9;
};

struct MeshChangeRecord {
  RunEvent event;
  BeamRecord before, after;
};

/// A run, complete or not.
struct Run {
  SimulationReport report;
  std::vector<Snapshot> frames;
  std::vector<MeshChangeRecord> changes;

  bool complete() const { return report.status == SimulationStatus::done; }
  double leave_time() const;  ///< of the body; not a number if it stays [s]
};

/// What a run keeps: beams and the probe in frames, and before and after changes of the mesh, take a third of
/// its time.
enum class Kept { shapes, bodies };

/// Runs a model by a method; frames hold a probe at the beam's end.
Run run(BeamModel model, const Method& method, const Pace& pace, Kept kept = Kept::shapes);

/// Calls work(0), ..., work(count - 1), two at a time; the first exception is rethrown.
void for_each_of(std::size_t count, const std::function<void(std::size_t)>& work);

/// Curvature measure, strain law, stress-free state, form, thresholds and step, as one sentence.
std::string statement(const Example& example, const std::vector<Method>& methods, const Pace& pace);

}  // namespace nurbeam::papers
