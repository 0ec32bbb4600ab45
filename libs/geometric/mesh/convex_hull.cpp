#include "handway/geometric/mesh/convex_hull.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

// The reentrant qhull is C, with macros of its own.
extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace handway::geometric {
namespace {

using Eigen::Vector3d;

/// The convex hull of points in space by qhull; nothing where they span no volume.
class Hull {
 public:
  explicit Hull(std::span<const Vector3d> points)
      : points_(points), messages_(std::fopen("/dev/null", "w"), &std::fclose) {
    coordinates_.reserve(3 * points.size());
    for (const Vector3d& p : points) {
      coordinates_.insert(coordinates_.end(), p.begin(), p.end());
    }
    qh_zero(&qhull_, messages_.get());
    // Qt makes triangles of facets; Pp and the null file keep qhull quiet.
    std::string options = "qhull Qt Pp";
    made_ = qh_new_qhull(&qhull_, 3, static_cast<int>(points.size()), coordinates_.data(), False,
                         options.data(), nullptr, messages_.get()) == 0;
  }
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;
  ~Hull() {
    int bytes = 0;
    int blocks = 0;
    qh_freeqhull(&qhull_, !qh_ALL);
    qh_memfreeshort(&qhull_, &bytes, &blocks);
  }

  [[nodiscard]] TriangleMesh mesh() {
    TriangleMesh mesh;
    for (facetT* facet = made_ ? qhull_.facet_list : nullptr; facet && facet->next;
         facet = facet->next) {
      std::array<std::uint32_t, 3> corners{};
      std::size_t count = 0;
      for (void** element = &facet->vertices->e[0].p; *element && count < 3; ++element) {
        corners[count++] = number_of(static_cast<vertexT*>(*element), mesh);
      }
      const Vector3d& a = mesh.vertices[corners[0]];
      const Vector3d normal = (mesh.vertices[corners[1]] - a).cross(mesh.vertices[corners[2]] - a);
      if (normal.dot(Eigen::Map<const Vector3d>(facet->normal)) < 0.0) {
        std::swap(corners[1], corners[2]);
      }
      mesh.triangles.push_back(corners);
    }
    return mesh;
  }

 private:
  // The number of a corner in the mesh, where it is added the first time.
  std::uint32_t number_of(const vertexT* vertex, TriangleMesh& mesh) {
    const auto point = static_cast<std::size_t>(qh_pointid(&qhull_, vertex->point));
    const auto [entry, is_new] =
        numbers_.emplace(point, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) {
      mesh.vertices.push_back(points_[point]);
    }
    return entry->second;
  }

  std::span<const Vector3d> points_;
  std::vector<double> coordinates_;  // qhull keeps pointers to them
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages_;
  std::map<std::size_t, std::uint32_t> numbers_;
  qhT qhull_{};
  bool made_ = false;
};

}  // namespace

TriangleMesh convex_hull(std::span<const Vector3d> points) {
  constexpr std::size_t kFewest = 4;
  return points.size() < kFewest ? TriangleMesh() : Hull(points).mesh();
}

}  // namespace handway::geometric
