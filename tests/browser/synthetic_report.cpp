// synthetic_report arc|still|large|twisted|sections FILE: writes a report of frames that no run has computed.
//   arc    a quarter of a circle of radius 1 m about the origin, one rational element
//   still  the same for a second, in which nothing changes
//   large  1000 frames of a wave on 1000 elements
//   twisted   a bar of a flat rectangle, 1 m long along x, that turns by a right angle about itself
//   sections  such bars above each other: a rectangle, a disk, a pipe and an I-section
#include <Eigen/Core>
#include <cmath>
#include <fstream>
#include <iostream>
#include <numbers>
#include <string>

#include "pipelines/report/report.h"

namespace {

using nurbeam::BeamRecord;
using nurbeam::ElementRecord;
using nurbeam::ReportFrames;
using nurbeam::Snapshot;

// Every frame and element here has all its numbers.
Snapshot frame_of(double time, std::vector<ElementRecord> elements) {
  Snapshot frame;
  frame.time = time;
  frame.step = 1e-3;
  frame.beams.push_back({});
  frame.beams[0].elements = std::move(elements);
  frame.beams[0].length = 1;
  return frame;
}

// The rational quadratic (1, 0), (1, 1), (0, 1) with weights 1, 1/sqrt 2, 1 is the quarter circle; here with
// its degree elevated by one.
ElementRecord quarter_circle() {
  const double half = std::numbers::sqrt2 / 2;
  const Eigen::Vector4d a(1, 0, 0, 1), b(half, half, 0, half), c(0, 1, 0, 1);
  ElementRecord element;
  element.control_points << a, (a + 2 * b) / 3, (2 * b + c) / 3, c;
  element.s_end = std::numbers::pi / 2;
  element.strain = element.axial_force = element.bending_moment = Eigen::Vector4d::Zero();
  element.curvature = Eigen::Vector4d::Ones();
  element.velocity.setZero();
  return element;
}

// A cubic through a travelling wave: its ends and end slopes are the wave's.
ElementRecord wave_element(double time, int i, int count) {
  const double x0 = 10.0 * i / count, x1 = 10.0 * (i + 1) / count, third = (x1 - x0) / 3;
  const auto height = [&](double x) { return std::sin(2 * x - 6 * time) + 0.3 * std::sin(7 * x + time); };
  const auto slope = [&](double x) { return 2 * std::cos(2 * x - 6 * time) + 2.1 * std::cos(7 * x + time); };
  ElementRecord element;
  element.control_points << x0, x0 + third, x1 - third, x1,                                    //
      height(x0), height(x0) + third * slope(x0), height(x1) - third * slope(x1), height(x1),  //
      0.2 * height(x0), 0.2 * height(x0), 0.2 * height(x1), 0.2 * height(x1), Eigen::RowVector4d::Ones();
  element.s_start = x0;
  element.s_end = x1;
  for (int k = 0; k < 4; ++k) {
    const double x = x0 + k * third;
    element.strain[k] = 1e-3 * height(x);
    element.curvature[k] = slope(x);
    element.axial_force[k] = 1e3 * height(x);
    element.bending_moment[k] = 5 * slope(x);
    element.velocity.col(k) << 0, slope(x), 0;
  }
  return element;
}

ReportFrames arc(const std::vector<double>& times) {
  return {"arc",
          {{}, {}, {"arc"}},
          times,
          [times](std::size_t first, std::size_t count) {
            std::vector<Snapshot> piece;
            for (std::size_t i = first; i < first + count; ++i)
              piece.push_back(frame_of(times[i], {quarter_circle()}));
            return piece;
          }};
}

ReportFrames large() {
  constexpr int frame_count = 1000, element_count = 1000;
  ReportFrames frames{"large", {{}, {}, {"beam"}}, {}, {}};
  for (int i = 0; i < frame_count; ++i) frames.times.push_back(0.01 * i);
  frames.read = [](std::size_t first, std::size_t count) {
    std::vector<Snapshot> piece;
    for (std::size_t i = first; i < first + count; ++i) {
      std::vector<ElementRecord> elements;
      for (int e = 0; e < element_count; ++e)
        elements.push_back(wave_element(0.01 * static_cast<double>(i), e, element_count));
      piece.push_back(frame_of(0.01 * static_cast<double>(i), std::move(elements)));
    }
    return piece;
  };
  return frames;
}

using Outline = std::vector<std::vector<Eigen::Vector2d>>;

std::vector<Eigen::Vector2d> circle(double radius, double turns) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 48; ++i)
    points.emplace_back(radius * std::cos(turns * i / 48 * 2 * std::numbers::pi),
                        radius * std::sin(turns * i / 48 * 2 * std::numbers::pi));
  return points;
}

std::vector<Outline> outlines(int count) {
  const std::vector<Eigen::Vector2d> rectangle = {{-0.01, -0.06}, {0.01, -0.06}, {0.01, 0.06}, {-0.01, 0.06}};
  const std::vector<Eigen::Vector2d> i_section = {
      {-0.04, -0.06}, {0.04, -0.06}, {0.04, -0.045}, {0.006, -0.045}, {0.006, 0.045},   {0.04, 0.045},
      {0.04, 0.06},   {-0.04, 0.06}, {-0.04, 0.045}, {-0.006, 0.045}, {-0.006, -0.045}, {-0.04, -0.045}};
  std::vector<Outline> all = {
      {rectangle}, {circle(0.05, 1)}, {circle(0.05, 1), circle(0.04, -1)}, {i_section}};
  all.resize(count);
  return all;
}

// Four elements that turn by a right angle in all: at the start the section's y axis is the world's z.
std::vector<ElementRecord> twisted_bar(double z) {
  std::vector<ElementRecord> elements;
  for (int i = 0; i < 4; ++i) {
    ElementRecord e;
    for (int k = 0; k < 4; ++k) {
      const double x = (i + k / 3.0) / 4, angle = std::numbers::pi / 2 * x;
      e.control_points.col(k) << x, 0, z, 1;
      e.d1.col(k) << 0, std::cos(angle), std::sin(angle);
      e.d2.col(k) << 0, -std::sin(angle), std::cos(angle);
      e.strain[k] = 1e-3 * x;
      e.twist[k] = angle;
    }
    e.s_start = i / 4.0;
    e.s_end = (i + 1) / 4.0;
    e.curvature = e.axial_force = e.bending_moment = Eigen::Vector4d::Zero();
    e.velocity.setZero();
    elements.push_back(e);
  }
  return elements;
}

ReportFrames sections(int count) {
  ReportFrames frames{"sections", {}, {0}, {}};
  frames.names.sections = true;
  for (int i = 0; i < count; ++i) frames.names.beams.push_back("bar " + std::to_string(i + 1));
  frames.read = [count](std::size_t, std::size_t) {
    Snapshot frame = frame_of(0, twisted_bar(0));
    for (int i = 1; i < count; ++i) frame.beams.push_back(frame_of(0, twisted_bar(0.2 * i)).beams[0]);
    return std::vector<Snapshot>{frame};
  };
  return frames;
}

std::string model_of(const std::vector<Outline>& all) {
  std::string beams;
  for (const Outline& outline : all) {
    std::string loops;
    for (const auto& loop : outline) {
      std::string points;
      for (const Eigen::Vector2d& p : loop)
        points += (points.empty() ? "[" : ", [") + std::to_string(p.x()) + ", " + std::to_string(p.y()) + "]";
      loops += (loops.empty() ? "[" : ", [") + points + "]";
    }
    beams +=
        std::string(beams.empty() ? "" : ", ") + R"({"name": "bar", "section outline [m]": [)" + loops + "]}";
  }
  return R"("model": {"dimension": 3, "plane_normal": null, "gravity [m/s^2]": [0, 0, -9.81], "bodies": [],
    "supports": [], "joints": [], "loads": [], "beams": [)" +
         beams + "]}, ";
}

ReportFrames frames_of(const std::string& kind) {
  if (kind == "arc") return arc({0});
  if (kind == "still") return arc({0, 1});
  if (kind == "large") return large();
  return sections(kind == "twisted" ? 1 : 4);
}

}  // namespace

int main(int, char** arguments) {
  const std::string kind = arguments[1];
  std::ofstream file(arguments[2], std::ios::binary);
  const bool has_sections = kind == "twisted" || kind == "sections";
  const std::string model = has_sections ? model_of(outlines(kind == "twisted" ? 1 : 4)) : "";
  nurbeam::write_report_page(file, frames_of(kind), "{" + model + R"("nurbeam": "test", "status": "done",
    "steps": 1, "rejected_steps": 0, "newton_iterations": 1, "energy_drift [J]": 0, "inputs": [], "events": [],
    "diagnostics": [], "wall_times [s]": {"import": 0, "model": 0, "motion": 0, "length_control": 0, "output": 0}})");
  return file ? 0 : 1;
}
