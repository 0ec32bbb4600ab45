#pragma once

#include "handway/geometric/scene/triangle_mesh.h"

#include <queue>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace handway::gui {

/// Makes a mesh coarser by drawing edges together into points, those first that change the surface
/// least: M. Garland and P. Heckbert, "Surface simplification using quadric error metrics",
/// SIGGRAPH 1997. Sharp edges and borders stay where they are, as far as the error allows.
class MeshCoarsener {
 public:
  /// @param mesh welded.
  explicit MeshCoarsener(const geometric::TriangleMesh& mesh);

  /// Draws edges together as long as their points stay within `error` (m, root mean square) of
  /// the triangles that they stand for.
  void coarsen(double error);
  /// What it has become, and for every vertex the one of the first mesh that is near.
  struct Coarse {
    geometric::TriangleMesh mesh;
    std::vector<std::uint32_t> origins;
  };
  [[nodiscard]] Coarse mesh() const;

 private:
  using Index = std::uint32_t;

  /// Sum over planes of their weights times the square of a point's distance.
  struct Quadric {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    double c = 0.0;
    double weight = 0.0;

    void add_plane(const Eigen::Vector3d& normal, const Eigen::Vector3d& point, double share);
    void add_point(const Eigen::Vector3d& point, double share);
    Quadric& operator+=(const Quadric& other);
    [[nodiscard]] Eigen::Vector3d best_point() const;
    /// Mean of the squares, m².
    [[nodiscard]] double mean_at(const Eigen::Vector3d& point) const;
  };
  struct Vertex {
    Eigen::Vector3d place;
    Quadric quadric;
    std::vector<Index> triangles;
    Index origin = 0;
    Index version = 0;  ///< Counts its changes.
    bool is_there = true;
  };
  struct Edge {
    double cost;  ///< m²
    Index from;
    Index to;
    Index from_version;
    Index to_version;
    bool operator<(const Edge& other) const { return cost > other.cost; }  // the least on top
  };

  void add_planes();
  void add_borders();
  void offer(Index from, Index to);
  void offer_around(Index vertex);
  [[nodiscard]] std::vector<Index> neighbours(Index vertex) const;
  /// Would the surface stay one, and no triangle turn over?
  [[nodiscard]] bool can_join(Index from, Index to, const Eigen::Vector3d& place) const;
  [[nodiscard]] bool turns_over(Index vertex, Index other, const Eigen::Vector3d& place) const;
  void join(Index from, Index to, const Eigen::Vector3d& place);

  std::vector<Eigen::Vector3d> origins_;
  std::vector<Vertex> vertices_;
  std::vector<std::array<Index, 3>> triangles_;
  std::vector<bool> triangle_is_there_;
  std::priority_queue<Edge> edges_;
};

}  // namespace handway::gui
