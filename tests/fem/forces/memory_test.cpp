#include "fem/forces/memory.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::memory_test {

const Friction rubs{.coefficient = 0.2};

// Three bodies, of which the first and the last rub, two stops, and connectors of which the second jumps.
BeamModel with_memory() {
  ModelBuilder builder(2);
  const int beam = add_bent_beam(builder, 2, 16);
  const int first = add_sliding(builder, beam, 0.3, {.friction = rubs}),
            smooth = add_sliding(builder, beam, 0.7),
            last = add_sliding(builder, beam, 1.2, {.friction = rubs});
  builder.connect(end_on_body(first), end_at({0, 1, 0}), ConnectorType::spring, 10).damping = 1;
  builder.connect(end_on_body(first), end_at({0, 1, 0}), ConnectorType::tension_only, 10).damping = 1;
  BeamModel model = builder.build();
  model.stops = {stop_at(model, smooth, 0.8), stop_between(model, smooth, last, 0.1)};
  return model;
}

TEST(Memory, HasThreeNumbersOfFrictionAndOneOfEachStopAndRope) {
  const BeamModel model = with_memory();
  const MemoryPlaces places(model);
  EXPECT_EQ(no_memory(places).size(), 2 * 3 + 2 + 1);
  EXPECT_EQ(no_memory(places).norm(), 0);
  EXPECT_EQ(what_remembers(model).size(), 2u + 2u + 1u);
}

// Each is read as it was written, and nothing else has changed.
TEST(Memory, KeepsApartWhatEachRemembers) {
  const BeamModel model = with_memory();
  const MemoryPlaces places(model);
  Eigen::VectorXd memory = no_memory(places);
  const int first = tie_of(model, 0), last = tie_of(model, 2);
  set_friction_memory(places, memory, first, {0.1, 0.3, 1});
  set_friction_memory(places, memory, last, {0.2, 1.2, -1});
  set_buffer_contact(places, memory, 1, BufferContact::let_go);
  set_taut(places, memory, 1, true);
  const FrictionMemory of_first = friction_memory(places, memory, first),
                       of_last = friction_memory(places, memory, last);
  EXPECT_EQ((std::array{of_first.z, of_first.s}), (std::array{0.1, 0.3}));
  EXPECT_EQ(of_first.slides, 1);
  EXPECT_EQ((std::array{of_last.z, of_last.s}), (std::array{0.2, 1.2}));
  EXPECT_EQ(of_last.slides, -1);
  EXPECT_EQ(buffer_contact(places, memory, 0), BufferContact::away);
  EXPECT_EQ(buffer_contact(places, memory, 1), BufferContact::let_go);
  EXPECT_TRUE(is_taut(places, memory, 1));
  EXPECT_TRUE((memory.array() != 0).count() == 3 + 3 + 1 + 1);
}

TEST(Memory, OfAStateWithoutOneSaysThatABodyIsAway) {
  EXPECT_EQ(buffer_contact(MemoryPlaces(with_memory()), {}, 0), BufferContact::away);
}

}  // namespace nurbeam::testing::memory_test
