#include "fem/system/pattern_shift.h"

#include <gtest/gtest.h>

#include <vector>

#include "fem/system/coupling.h"

namespace nurbeam {
namespace {

// Elements between nodes of two unknowns each, of which one also has a place; constraints hold the first node
// and tie two others, and a force acts at one.
struct Chain {
  std::vector<std::vector<int>> elements;
  CoupledGroups groups;

  // `tied`: node that is tied to the one after it; `loaded`: node of the force.
  Chain(int nodes, int moving, bool ring, int tied, int loaded) {
    const auto first = [&](int node) { return 2 * node + (node > moving ? 1 : 0); };
    for (int i = 0; i + 1 < nodes + ring; ++i) {
      std::vector<int>& dofs = elements.emplace_back();
      for (const int node : {i, (i + 1) % nodes}) {
        dofs.insert(dofs.end(), {first(node), first(node) + 1});
        dofs.push_back(node == moving ? first(node) + 2 : -1);
      }
    }
    for (const auto& dofs : elements) groups.elements.emplace_back(dofs);
    const int n = 2 * nodes + 1;
    groups.others = {{first(loaded), first(loaded) + 1},
                     {first(0), first(0) + 1, n},
                     {first(tied), first(tied + 1), n + 1}};
    groups.unknowns = n + 2;
  }

  SparsePattern pattern() const {
    Coupling coupling(groups.unknowns);
    for (const auto element : groups.elements) {
      coupling.add(element);
      coupling.close();
    }
    for (const auto& other : groups.others) {
      coupling.add(other);
      coupling.close();
    }
    return coupling.pattern();
  }
};

void expect_shifted(const Chain& old, const Chain& now, int left, int right) {
  const auto shift = PatternShift::between(old.groups, now.groups);
  ASSERT_TRUE(shift);
  const SparsePattern before = old.pattern(), expected = now.pattern(),
                      found = shift->pattern(before, now.groups);
  EXPECT_EQ(found.column_starts(), expected.column_starts());
  EXPECT_EQ(found.rows(), expected.rows());
  EXPECT_GE(shift->left(), left);
  EXPECT_GE(shift->right(), right);
  EXPECT_EQ(shift->entries_by(before, found),
            static_cast<int>(found.rows().size()) - static_cast<int>(before.rows().size()));
}

TEST(PatternShift, IsThePatternThatIsMadeAnew) {
  for (const bool ring : {false, true}) {
    const int ends = ring ? 0 : 4, right = ring ? 0 : 15;
    // The moving node goes on by one; a node comes behind it, or goes before it.
    expect_shifted({30, 10, ring, 20, 11}, {30, 11, ring, 20, 11}, ends, right);
    expect_shifted({30, 10, ring, 20, 10}, {31, 11, ring, 21, 11}, ends, right);
    expect_shifted({30, 12, ring, 20, 12}, {29, 11, ring, 19, 11}, ends, right);
    expect_shifted({30, 10, ring, 3, 10}, {31, 11, ring, 3, 11}, ends, right);
  }
}

TEST(PatternShift, IsNoneWhereMoreHasChanged) {
  const Chain old(30, 10, false, 20, 10);
  EXPECT_FALSE(PatternShift::between(old.groups, old.groups)) << "nothing has";
  EXPECT_FALSE(PatternShift::between(old.groups, Chain(31, 11, false, 20, 11).groups))
      << "another node is tied";
  EXPECT_FALSE(PatternShift::between(old.groups, Chain(31, 11, false, 21, 25).groups))
      << "the load has moved";
  EXPECT_FALSE(
      PatternShift::between(Chain(30, 10, false, 10, 10).groups, Chain(30, 11, false, 10, 10).groups))
      << "a constraint holds what is renewed, and its multiplier is elsewhere";
}

}  // namespace
}  // namespace nurbeam
