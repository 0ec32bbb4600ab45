#include "collision/surface_distance.h"

#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr double kTouch = 1e-9;  // m: a hair, so that roundings can't hide a touch

using Corners = std::array<Eigen::Vector3d, 3>;

struct Waiting {
  std::uint32_t a;
  std::uint32_t b;
  double bound;
};

Corners corners(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [i, j, k] = mesh.triangles[triangle];
  return {mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]};
}

/// One descent through both trees.
class Descent {
 public:
  Descent(const Surface& a, const Surface& b, const Pose& X_BA, double enough)
      : a_(a),
        b_(b),
        X_BA_(X_BA),
        R_BA_(X_BA.linear()),
        p_BA_(X_BA.translation()),
        R_BA_abs_(R_BA_.cwiseAbs()),
        least_(enough) {
    wait_for(0, 0);
  }

  double distance() {
    while (find_closer()) {
    }
    return least_;
  }

  Closeness closeness(TrianglePair& witness) {
    const double seen = triangle_distance(witness.a, witness.b);
    if (seen < least_) {
      least_ = seen;
    } else if (!find_closer()) {
      return Closeness::kFarther;
    }
    if (least_ >= kTouch) {  // closer than the tolerance: only touching is of interest now
      least_ = kTouch;
      waiting_.clear();
      wait_for(0, 0);
      find_closer();
    }
    if (closest_) {
      witness = *closest_;
    }
    return least_ < kTouch ? Closeness::kTouching : Closeness::kCloser;
  }

 private:
  // Goes on to the next triangles that are closer than any before; false: none.
  bool find_closer() {
    while (!waiting_.empty()) {
      const Waiting top = waiting_.back();
      waiting_.pop_back();
      if (top.bound < least_ && open(top)) {
        return true;
      }
    }
    return false;
  }

  // True if the pair is of triangles, and closer than any before.
  bool open(const Waiting& pair) {
    const BoxTree::Node& a = a_.boxes.nodes()[pair.a];
    const BoxTree::Node& b = b_.boxes.nodes()[pair.b];
    if (a.right == 0 && b.right == 0) {
      const double distance = triangle_distance(a.triangle, b.triangle);
      if (distance >= least_) {
        return false;
      }
      least_ = distance;
      closest_ = {a.triangle, b.triangle};
      return true;
    }
    const std::size_t before = waiting_.size();
    if (a.right == 0 || (b.right != 0 && b.size > a.size)) {
      wait_for(pair.a, pair.b + 1);
      wait_for(pair.a, b.right);
    } else {
      wait_for(pair.a + 1, pair.b);
      wait_for(a.right, pair.b);
    }
    if (waiting_.size() == before + 2 && waiting_[before].bound < waiting_[before + 1].bound) {
      std::swap(waiting_[before], waiting_[before + 1]);  // the nearer one first
    }
    return false;
  }

  // A lower bound of the boxes' distance puts them off: each box against the
  // other's, enlarged to stand square to it.
  void wait_for(std::uint32_t a, std::uint32_t b) {
    const BoxTree::Node& box_a = a_.boxes.nodes()[a];
    const BoxTree::Node& box_b = b_.boxes.nodes()[b];
    const double enough = least_ * least_;
    const Eigen::Vector3d offset = R_BA_ * box_a.centre + p_BA_ - box_b.centre;
    const double in_b =
        (offset.cwiseAbs() - box_b.half - R_BA_abs_ * box_a.half).cwiseMax(0.0).squaredNorm();
    if (in_b >= enough) {
      return;
    }
    const double in_a =
        ((R_BA_.transpose() * offset).cwiseAbs() - box_a.half - R_BA_abs_.transpose() * box_b.half)
            .cwiseMax(0.0)
            .squaredNorm();
    if (in_a < enough) {
      waiting_.push_back({a, b, std::sqrt(std::max(in_a, in_b))});
    }
  }

  [[nodiscard]] double triangle_distance(std::uint32_t a, std::uint32_t b) const {
    Corners s = corners(a_.mesh, a);
    for (Eigen::Vector3d& p : s) {
      p = X_BA_ * p;
    }
    const Corners t = corners(b_.mesh, b);
    Eigen::Vector3d p;
    Eigen::Vector3d q;
    return fcl::detail::TriangleDistance<double>::triDistance(s.data(), t.data(), p, q);
  }

  const Surface& a_;
  const Surface& b_;
  const Pose& X_BA_;
  Eigen::Matrix3d R_BA_;
  Eigen::Vector3d p_BA_;
  Eigen::Matrix3d R_BA_abs_;
  double least_;
  std::optional<TrianglePair> closest_;
  std::vector<Waiting> waiting_;
};

}  // namespace

double surface_distance(const Surface& a, const Surface& b, const Pose& X_BA, double enough) {
  return Descent(a, b, X_BA, enough).distance();
}

Closeness surface_closeness(const Surface& a, const Surface& b, const Pose& X_BA, double tolerance,
                            TrianglePair& witness) {
  return Descent(a, b, X_BA, tolerance).closeness(witness);
}

}  // namespace handway::geometric
