#include "nurbs/box_tree.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace nurbeam {

BoxTree::BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes) {
  assert(!boxes.empty());
  std::vector<int> numbers(boxes.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  nodes_.reserve(2 * boxes.size());
  add(boxes, numbers.begin(), numbers.end());
}

// The node that holds these boxes, halved across the longest side of their common box.
int BoxTree::add(const std::vector<Eigen::AlignedBox3d>& boxes, std::vector<int>::iterator first,
                 std::vector<int>::iterator last) {
  const int number = static_cast<int>(nodes_.size());
  nodes_.push_back({.box = boxes[*first], .left = *first, .right = -1});
  if (last - first == 1) return number;
  for (auto i = first; i != last; ++i) nodes_[number].box.extend(boxes[*i]);
  Eigen::Index axis = 0;
  nodes_[number].box.sizes().maxCoeff(&axis);
  const auto middle = first + (last - first) / 2;
  std::nth_element(first, middle, last, [&](int a, int b) {
    return boxes[a].min()[axis] + boxes[a].max()[axis] < boxes[b].min()[axis] + boxes[b].max()[axis];
  });
  const int left = add(boxes, first, middle);
  const int right = add(boxes, middle, last);
  nodes_[number].left = left;
  nodes_[number].right = right;
  return number;
}

}  // namespace nurbeam
