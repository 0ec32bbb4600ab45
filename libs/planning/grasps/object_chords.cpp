#include "grasps/object_chords.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace handway::planning {
namespace {

using Eigen::Vector3d;

constexpr int kPoints = 2000;
constexpr int kTries = 16;
constexpr double kOpposed = -0.7;       // cosine between the normals at the ends of a chord
constexpr double kLeastLength = 0.001;  // m

// Areas of all triangles up to each one, m².
std::vector<double> summed_areas(const geometric::TriangleMesh& mesh) {
  std::vector<double> sums;
  double sum = 0.0;
  for (const auto& triangle : mesh.triangles) {
    const Vector3d& a = mesh.vertices[static_cast<std::size_t>(triangle[0])];
    const Vector3d& b = mesh.vertices[static_cast<std::size_t>(triangle[1])];
    const Vector3d& c = mesh.vertices[static_cast<std::size_t>(triangle[2])];
    sum += 0.5 * (b - a).cross(c - a).norm();
    sums.push_back(sum);
  }
  return sums;
}

}  // namespace

ObjectChords::ObjectChords(const geometric::TriangleMesh& mesh)
    : points_(3, kPoints), normals_(3, kPoints) {
  const std::vector<double> sums = summed_areas(mesh);
  spacing_ = std::sqrt(sums.back() / kPoints);
  sampling::RandomStream random(1);  // the same points each time
  for (int i = 0; i < kPoints; ++i) {
    const auto found = std::ranges::lower_bound(sums, sums.back() * (i + 0.5) / kPoints);
    const auto& triangle = mesh.triangles[static_cast<std::size_t>(found - sums.begin())];
    const Vector3d& a = mesh.vertices[static_cast<std::size_t>(triangle[0])];
    const Vector3d& b = mesh.vertices[static_cast<std::size_t>(triangle[1])];
    const Vector3d& c = mesh.vertices[static_cast<std::size_t>(triangle[2])];
    const double root = std::sqrt(random.uniform());
    const double share = random.uniform();
    points_.col(i) = (1.0 - root) * a + root * (1.0 - share) * b + root * share * c;
    normals_.col(i) = (b - a).cross(c - a).stableNormalized();
  }
}

Chord ObjectChords::draw(sampling::RandomStream& random) const {
  for (int tries = 0; tries < kTries; ++tries) {
    const Chord chord = chord_from(static_cast<Eigen::Index>(random.below(kPoints)), random);
    if (chord.length > 0.0) {
      return chord;
    }
  }
  return {};
}

Chord ObjectChords::chord_from(Eigen::Index from, sampling::RandomStream& random) const {
  const Vector3d p = points_.col(from);
  const Vector3d inwards = -normals_.col(from);
  const Eigen::RowVectorXd along = inwards.transpose() * (points_.colwise() - p);
  const Eigen::RowVectorXd opposed = -inwards.transpose() * normals_;
  const auto aside = [&](Eigen::Index i) {
    return (points_.col(i) - p - along[i] * inwards).squaredNorm();
  };
  std::vector<Eigen::Index> ends;  // points whose normals are opposed
  for (Eigen::Index i = 0; i < kPoints; ++i) {
    if (along[i] > kLeastLength && opposed[i] < kOpposed && aside(i) < spacing_ * spacing_) {
      ends.push_back(i);
    }
  }
  if (ends.empty()) {
    return {};
  }
  const double chosen = along[ends[random.below(ends.size())]];
  std::erase_if(ends, [&](Eigen::Index i) { return std::abs(along[i] - chosen) > spacing_; });
  const Eigen::Index end = *std::ranges::min_element(ends, {}, aside);
  // To where the line leaves the face that the nearest point is on.
  const double length =
      normals_.col(end).dot(points_.col(end) - p) / normals_.col(end).dot(inwards);
  return {p + 0.5 * length * inwards, inwards, length};
}

geometric::Aabb ObjectChords::core(const Vector3d& point, double radius) const {
  geometric::Aabb box{point, point};
  for (Eigen::Index i = 0; i < kPoints; ++i) {
    if ((points_.col(i) - point).squaredNorm() < radius * radius) {
      box.lower = box.lower.cwiseMin(points_.col(i));
      box.upper = box.upper.cwiseMax(points_.col(i));
    }
  }
  const Vector3d inner = 0.5 * (box.size().array() - box.size().minCoeff());
  return {box.centre() - inner, box.centre() + inner};
}

}  // namespace handway::planning
