#include "pipelines/run/motion_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "fem/motion/run/simulation.h"
#include "nurbs/number_text.h"
#include "pipelines/case/limits.h"
#include "pipelines/model/slopes.h"
#include "pipelines/run/level_model.h"
#include "pipelines/run/simulation_plan.h"

namespace nurbeam {

namespace {

constexpr int places_of_beam = 33;
constexpr double error_over_difference = 1.5;

/// Where the looked at beams are at the output times of a run: place after place, beam after beam [m].
using Course = std::vector<std::vector<Eigen::Vector3d>>;

/// The elements of beams, and what a run with them is off by.
struct Difference {
  double value = 0;  ///< over the length, the greatest of all beams in units of their tolerances
  int beam = 0;      ///< whose it is
  double time = 0;   ///< [s]
};

class MotionMesh {
 public:
  MotionMesh(const CaseFile& c, BuiltModel& built, const std::function<bool()>& interrupted)
      : case_(c), built_(built), interrupted_(interrupted) {
    for (int b = 0; b < static_cast<int>(c.beams.size()); ++b)
      if (c.beams[b].elements.over == ToleranceOver::motion) beams_.push_back(b);
  }

  std::vector<Diagnostic> divide() {
    if (beams_.empty()) return {};
    constexpr int most_doublings = 10;
    std::optional<Course> coarse = course();
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; coarse && i < most_doublings; ++i) {
      const BeamModel model = built_.model;
      const std::vector<SlopeDecision> slopes = built_.slopes;
      if (!double_elements()) return {unmet("at most " + std::to_string(most_elements) + " elements")};
      std::optional<Course> fine = course();
      if (fine) last_ = difference(*coarse, *fine);
      if (!fine || last_.value <= 1) {
        built_.model = model;
        built_.slopes = slopes;
        return ended(fine ? met() : unmet("a run that does not come to its end"));
      }
      // Steps, or a motion that is not determined, keep runs apart: more elements do not bring them together.
      constexpr double falls = 0.71;
      if (i > 1 && last_.value > falls * before) return {apart()};
      before = last_.value;
      coarse = std::move(fine);
    }
    return ended(unmet(coarse ? "ten doublings" : "a run that does not come to its end"));
  }

 private:
  // Of a search that was interrupted there is nothing to say.
  std::vector<Diagnostic> ended(Diagnostic found) const {
    return interrupted_ && interrupted_() ? std::vector<Diagnostic>{} : std::vector{std::move(found)};
  }

  std::optional<Course> course() const {
    std::vector<ProbePlace> places;
    for (const int b : beams_) {
      const ReferenceCurve& curve = built_.model.beams[b].curve;
      for (int k = 0; k < places_of_beam; ++k)
        places.push_back({.beam = b, .s = curve.start() + curve.length() * k / (places_of_beam - 1)});
    }
    Course course;
    SimulationObserver observer;
    observer.contents = {.beams = false, .sections = false, .reactions = false, .measures = false};
    observer.interrupted = interrupted_;
    observer.snapshot = [&](const Snapshot& snapshot) {
      course.emplace_back();
      for (const ProbeRecord& probe : snapshot.probes) course.back().push_back(probe.position);
      times_.resize(std::max(times_.size(), course.size()));
      times_[course.size() - 1] = snapshot.time;
    };
    const SimulationReport run = simulate(built_.model, places, simulation_options(case_), observer);
    return run.status == SimulationStatus::done ? std::optional(std::move(course)) : std::nullopt;
  }

  Difference difference(const Course& coarse, const Course& fine) const {
    Difference greatest;
    for (std::size_t i = 0; i < std::min(coarse.size(), fine.size()); ++i)
      for (std::size_t k = 0; k < fine[i].size(); ++k) {
        const int b = beams_[k / places_of_beam];
        const double allowed = *case_.beams[b].elements.tolerance * built_.model.beams[b].curve.length();
        const double off = error_over_difference * (fine[i][k] - coarse[i][k]).norm() / allowed;
        if (off > greatest.value) greatest = {off, b, times_[i]};
      }
    return greatest;
  }

  // Of each beam that is looked at; whether none has too many then.
  bool double_elements() {
    for (const int b : beams_)
      if (2 * built_.model.beams[b].home_intervals() > most_elements) return false;
    for (const int b : beams_) halve_elements(built_.model.beams[b]);
    smooth_fine_kinks(built_.model, built_.slopes);
    return true;
  }

  std::string path() const {
    const int b = last_.value > 0 ? last_.beam : beams_.front();
    return case_.path.string() + ": " + case_.beams[b].path + ".elements.tolerance";
  }
  int elements() const { return built_.model.beams[last_.beam].home_intervals(); }
  // "3e-5 of its length, at t = 0.4 s"
  std::string found() const {
    const double relative = last_.value * *case_.beams[last_.beam].elements.tolerance / error_over_difference;
    return text_of(relative, 2) + " of its length, at t = " + text_of(last_.time, 4) + " s";
  }

  Diagnostic met() const {
    return {Severity::note, path(),
            "over the motion " + std::to_string(elements()) + " elements differ from twice as many by " +
                found()};
  }
  Diagnostic apart() const {
    return {Severity::warning, path(),
            "is not met: with " + std::to_string(elements()) +
                " elements and half as many the motion differs by " + found() +
                ", hardly less than before; the steps leave that (a smaller \"analysis.step\" or "
                "\"analysis.tolerance\"), or the motion does not depend on its start smoothly"};
  }
  Diagnostic unmet(const std::string& end) const {
    return {Severity::warning, path(),
            "is not met: the search over the motion ended at " + end +
                (last_.value > 0 ? ", where runs still differ by " + found() : "")};
  }

  const CaseFile& case_;
  BuiltModel& built_;
  const std::function<bool()>& interrupted_;
  std::vector<int> beams_;
  mutable std::vector<double> times_;
  Difference last_;
};

}  // namespace

std::vector<Diagnostic> divide_for_motion(const CaseFile& case_file, BuiltModel& built,
                                          const std::function<bool()>& interrupted) {
  if (case_file.analysis.type != CaseAnalysis::Type::dynamic) return {};
  return MotionMesh(case_file, built, interrupted).divide();
}

}  // namespace nurbeam
