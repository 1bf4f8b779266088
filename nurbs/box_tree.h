#pragma once
#include <Eigen/Geometry>
#include <vector>

namespace nurbeam {

/// Boxes, those near a point found without a look at the others.
class BoxTree {
 public:
  /// At least one box.
  explicit BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes);

  /// Calls look(i) for the boxes i that are nearer to the point than `reach`, about from the nearest on;
  /// look returns the reach from then on, which may only become less.
  template <typename Look>
  void visit_near(const Eigen::Vector3d& point, double reach, const Look& look) const {
    visit(0, point, reach, look);
  }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int left, right;  // nodes; of a leaf the box's number, and -1
  };

  int add(const std::vector<Eigen::AlignedBox3d>& boxes, std::vector<int>::iterator first,
          std::vector<int>::iterator last);

  template <typename Look>
  void visit(int number, const Eigen::Vector3d& point, double& reach, const Look& look) const {
    const Node& node = nodes_[number];
    if (node.box.exteriorDistance(point) >= reach) return;
    if (node.right < 0) {
      reach = look(node.left);
      return;
    }
    const bool left_first = nodes_[node.left].box.squaredExteriorDistance(point) <=
                            nodes_[node.right].box.squaredExteriorDistance(point);
    visit(left_first ? node.left : node.right, point, reach, look);
    visit(left_first ? node.right : node.left, point, reach, look);
  }

  std::vector<Node> nodes_;  // the root first
};

}  // namespace nurbeam
