#pragma once
#include <gtest/gtest.h>

#include <cmath>

#include "fem/motion/record/snapshot.h"

namespace nurbeam::test {

/// Expects two frames to hold the same numbers, bit by bit.
inline void expect_equal(const Snapshot& a, const Snapshot& b) {
  const auto equal = [](const PointRecord& x, const PointRecord& y) {
    return x.position == y.position && x.velocity == y.velocity;
  };
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  const auto alike = [&](const Extreme& x, const Extreme& y) {
    return same(x.value, y.value) && same(x.s, y.s);
  };
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.newton_iterations, b.newton_iterations);
  EXPECT_EQ(a.energy.kinetic, b.energy.kinetic);
  EXPECT_EQ(a.energy.dissipated, b.energy.dissipated);
  EXPECT_EQ(a.energy.input, b.energy.input);
  EXPECT_EQ(a.energy.total, b.energy.total);
  EXPECT_EQ(a.energy.spring, b.energy.spring);
  ASSERT_EQ(a.probes.size(), b.probes.size());
  for (std::size_t i = 0; i < a.probes.size(); ++i) {
    EXPECT_TRUE(equal(a.probes[i], b.probes[i]));
    EXPECT_EQ(a.probes[i].displacement, b.probes[i].displacement);
    const SectionRecord &x = a.probes[i].section, &y = b.probes[i].section;
    EXPECT_EQ(x.axial_force, y.axial_force);
    EXPECT_EQ(x.bending_moment, y.bending_moment);
    EXPECT_EQ(x.torque, y.torque);
    EXPECT_EQ(x.shear_force, y.shear_force);
    EXPECT_TRUE(same(x.stress, y.stress));
    for (const auto part : {&SectionRecord::moment_1, &SectionRecord::moment_2, &SectionRecord::twist,
                            &SectionRecord::von_mises})
      EXPECT_TRUE(same(x.*part, y.*part));
  }
  EXPECT_EQ(a.energy.spring, b.energy.spring);
  ASSERT_EQ(a.connectors.size(), b.connectors.size());
  for (std::size_t i = 0; i < a.connectors.size(); ++i) {
    EXPECT_EQ(a.connectors[i].force, b.connectors[i].force);
    EXPECT_EQ(a.connectors[i].length, b.connectors[i].length);
    EXPECT_EQ(a.connectors[i].from, b.connectors[i].from);
    EXPECT_EQ(a.connectors[i].to, b.connectors[i].to);
  }
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    EXPECT_TRUE(equal(a.bodies[i].point, b.bodies[i].point));
    EXPECT_EQ(a.bodies[i].s, b.bodies[i].s);
    EXPECT_EQ(a.bodies[i].joint_force, b.bodies[i].joint_force);
    EXPECT_EQ(a.bodies[i].holding_force, b.bodies[i].holding_force);
    for (const auto part : {&BodyRecord::friction_force, &BodyRecord::stuck, &BodyRecord::drive_force})
      EXPECT_TRUE(same(a.bodies[i].*part, b.bodies[i].*part));
  }
  ASSERT_EQ(a.beams.size(), b.beams.size());
  for (std::size_t i = 0; i < a.beams.size(); ++i) {
    const BeamRecord &one = a.beams[i], &other = b.beams[i];
    EXPECT_EQ(one.length, other.length);
    EXPECT_TRUE(same(one.sag, other.sag));
    EXPECT_TRUE(alike(one.axial_force_min, other.axial_force_min));
    EXPECT_TRUE(alike(one.axial_force_max, other.axial_force_max));
    EXPECT_TRUE(alike(one.moment_max, other.moment_max));
    EXPECT_TRUE(alike(one.shear_force_max, other.shear_force_max));
    EXPECT_TRUE(alike(one.stress_max, other.stress_max));
    EXPECT_TRUE(alike(one.displacement_max, other.displacement_max));
    EXPECT_TRUE(alike(one.torque_max, other.torque_max));
    EXPECT_TRUE(alike(one.twist_max, other.twist_max));
    EXPECT_TRUE(alike(one.von_mises_max, other.von_mises_max));
    EXPECT_EQ(a.beams[i].node_positions, b.beams[i].node_positions);
    EXPECT_EQ(a.beams[i].node_slopes, b.beams[i].node_slopes);
    EXPECT_EQ(a.beams[i].node_s, b.beams[i].node_s);
    ASSERT_EQ(a.beams[i].elements.size(), b.beams[i].elements.size());
    for (std::size_t e = 0; e < a.beams[i].elements.size(); ++e) {
      const ElementRecord &x = a.beams[i].elements[e], &y = b.beams[i].elements[e];
      EXPECT_EQ(x.control_points, y.control_points);
      const auto all_same = [&](const auto& u, const auto& v) {
        for (int k = 0; k < u.size(); ++k)
          if (!same(u.data()[k], v.data()[k])) return false;
        return true;
      };
      EXPECT_TRUE(all_same(x.moment_1, y.moment_1) && all_same(x.moment_2, y.moment_2) &&
                  all_same(x.twist, y.twist) && all_same(x.von_mises, y.von_mises));
      EXPECT_TRUE(all_same(x.d1, y.d1) && all_same(x.d2, y.d2));
      EXPECT_EQ(x.s_start, y.s_start);
      EXPECT_EQ(x.s_end, y.s_end);
      EXPECT_EQ(x.strain, y.strain);
      EXPECT_EQ(x.curvature, y.curvature);
      EXPECT_EQ(x.axial_force, y.axial_force);
      EXPECT_EQ(x.axial_mismatch, y.axial_mismatch);
      EXPECT_EQ(x.bending_moment, y.bending_moment);
      EXPECT_EQ(x.torque, y.torque);
      EXPECT_EQ(x.shear_force, y.shear_force);
      for (int k = 0; k < 4; ++k) EXPECT_TRUE(same(x.stress[k], y.stress[k]));
      EXPECT_EQ(x.velocity, y.velocity);
    }
  }
  ASSERT_EQ(a.reactions.size(), b.reactions.size());
  for (std::size_t i = 0; i < a.reactions.size(); ++i) {
    EXPECT_EQ(a.reactions[i].position, b.reactions[i].position);
    EXPECT_EQ(a.reactions[i].force, b.reactions[i].force);
    EXPECT_EQ(a.reactions[i].couple, b.reactions[i].couple);
  }
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t i = 0; i < a.steps.size(); ++i) {
    EXPECT_EQ(a.steps[i].time, b.steps[i].time);
    EXPECT_EQ(a.steps[i].size, b.steps[i].size);
    EXPECT_EQ(a.steps[i].newton_iterations, b.steps[i].newton_iterations);
    EXPECT_EQ(a.steps[i].rejected, b.steps[i].rejected);
  }
}

}  // namespace nurbeam::test
