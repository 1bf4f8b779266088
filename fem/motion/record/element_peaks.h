#pragma once
#include <vector>

#include "fem/motion/record/snapshot.h"
#include "fem/system/stress_resultants.h"

/// The search for extremes of values along a beam, inside its elements too.
namespace nurbeam {

/// An extreme along a beam: the value of the largest size among the values of its sections.
struct ElementExtreme {
  Extreme BeamRecord::*extreme;
  Eigen::Vector4d ElementRecord::*samples;
  double SectionRecord::*value;
  double (*size)(double);
  bool of_torsion = false;  ///< whether beams with torsion alone have it

  static double itself(double x) { return x; }
  static double negative(double x) { return -x; }
  static double magnitude(double x);
};
inline constexpr ElementExtreme element_extremes[] = {
    {&BeamRecord::axial_force_min, &ElementRecord::axial_force, &SectionRecord::axial_force,
     ElementExtreme::negative},
    {&BeamRecord::axial_force_max, &ElementRecord::axial_force, &SectionRecord::axial_force,
     ElementExtreme::itself},
    {&BeamRecord::moment_max, &ElementRecord::bending_moment, &SectionRecord::bending_moment,
     ElementExtreme::magnitude},
    {&BeamRecord::shear_force_max, &ElementRecord::shear_force, &SectionRecord::shear_force,
     ElementExtreme::magnitude},
    {&BeamRecord::stress_max, &ElementRecord::stress, &SectionRecord::stress, ElementExtreme::magnitude},
    {&BeamRecord::displacement_max, &ElementRecord::displacement, &SectionRecord::displacement,
     ElementExtreme::itself},
    {&BeamRecord::von_mises_max, &ElementRecord::von_mises, &SectionRecord::von_mises,
     ElementExtreme::magnitude},
    {&BeamRecord::torque_max, &ElementRecord::torque, &SectionRecord::torque, ElementExtreme::magnitude,
     true},
    {&BeamRecord::twist_max, &ElementRecord::twist, &SectionRecord::twist, ElementExtreme::magnitude, true}};

/// Takes a value over if it is larger by `size`, or the first.
void keep(Extreme& extreme, double value, double s, double (*size)(double), std::optional<double> layer = {});

/// A value at a place of an element, `x` in parts of its reference length.
struct Peak {
  double x, value;
};

/// The element in a span of a state, whose sections are asked for one by one.
class ElementSections {
 public:
  /// `twisted`: twist of the beam at the start of the span, against the beam's start [rad].
  ElementSections(const BeamSystem& system, const State& state, int span, SpanResultants carried,
                  double twisted);

  double place(double x) const { return start_ + x * (end_ - start_); }
  double value(const ElementExtreme& of, double x) const;
  bool has_actions() const { return !carried_.inside().empty(); }
  /// Where the value may be largest: at the ends, at both sides of each action inside, and where it is
  /// stationary between them. Stationary places are those of a cubic through four values, then refined.
  std::vector<Peak> peaks(const ElementExtreme& of) const;

 private:
  void add_peaks_between(const ElementExtreme& of, double a, double b, std::vector<Peak>& peaks) const;
  Peak refined(const ElementExtreme& of, double x, double a, double b) const;

  const BeamSystem* system_;
  const State* state_;
  int span_;
  SpanResultants carried_;
  double twisted_, start_, end_;
};

/// The largest size of a value inside an element, estimated by the cubic through its samples.
double estimated_size(const Eigen::Vector4d& samples, double (*size)(double));

/// The extremes along a beam. Elements are looked at in their order; the few that may have an extreme inside
/// are searched at the end.
class BeamExtremes {
 public:
  BeamExtremes(const BeamSystem& system, const State& state, const CarriedBySpans& carried, int beam);

  /// Looks at the elements in the spans from `first` on.
  void look_at(const std::vector<ElementRecord>& elements, int first);
  /// Searches the elements that were put aside. Puts all extremes into the record.
  void finish(BeamRecord& record);

 private:
  static constexpr int most = 2;
  static constexpr std::size_t kinds = std::size(element_extremes);
  /// An element that may have an extreme inside.
  struct Candidate {
    int span = -1;
    double twisted = 0, size = 0;
  };
  void look_inside(const ElementSections& sections, std::size_t kind);
  void put_aside(std::array<Candidate, most>& list, const Candidate& candidate);

  const BeamSystem& system_;
  const State& state_;
  const CarriedBySpans& carried_;
  int beam_;
  double twisted_ = 0;
  std::array<Extreme, kinds> found_;
  std::array<std::array<Candidate, most>, kinds> candidates_;
};

}  // namespace nurbeam
