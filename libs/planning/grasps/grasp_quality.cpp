#include "handway/planning/grasps/grasp_quality.h"

#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

// The reentrant qhull is C, with macros of its own.
extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace handway::planning {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

void require(bool holds, const char* what) {
  if (!holds) {
    throw std::invalid_argument(what);
  }
}

void check(std::span<const GraspContact> contacts, const ContactModel& model,
           const TorqueScale& scale) {
  require(model.friction > 0.0 && std::isfinite(model.friction), "friction must be above 0");
  require(model.patch_radius >= 0.0 && std::isfinite(model.patch_radius),
          "the radius of a soft finger's patch must be 0 or more");
  require(model.edges >= 3, "a friction pyramid has at least three edges");
  require(scale.length > 0.0 && std::isfinite(scale.length), "the length must be above 0");
  for (const GraspContact& contact : contacts) {
    constexpr double kUnit = 1e-6;
    require(contact.p_O.allFinite() && std::abs(contact.normal_O.norm() - 1.0) < kUnit,
            "a contact needs a finite point and a normal of length 1");
  }
}

int columns_each(const ContactModel& model) {
  return model.edges + (model.patch_radius > 0.0 ? 2 : 0);
}

// Extreme forces of a contact for a normal force of 1 N: force and torque about the contact.
struct ContactEdges {
  Eigen::Matrix3Xd forces;
  Eigen::Matrix3Xd torques;
};

ContactEdges edges_of(const GraspContact& contact, const ContactModel& model) {
  const Vector3d& normal = contact.normal_O;
  const Vector3d u = tangent(normal);
  const Vector3d v = normal.cross(u);
  const int count = columns_each(model);
  ContactEdges edges{normal.replicate(1, count), Eigen::Matrix3Xd::Zero(3, count)};
  for (int edge = 0; edge < model.edges; ++edge) {
    const double angle = 2.0 * std::numbers::pi * edge / model.edges;
    edges.forces.col(edge) += model.friction * (std::cos(angle) * u + std::sin(angle) * v);
  }
  if (count > model.edges) {
    edges.torques.col(count - 2) = model.torsion() * normal;
    edges.torques.col(count - 1) = -model.torsion() * normal;
  }
  return edges;
}

// Minimises |A x - b| over x >= 0.
//
// Source: C. L. Lawson, R. J. Hanson, "Solving Least Squares Problems", 1974, chapter 23.
VectorXd nonnegative_least_squares(const MatrixXd& A, const VectorXd& b) {
  const Eigen::Index n = A.cols();
  const double tolerance = 1e-12 * (1.0 + A.cwiseAbs().maxCoeff() * b.cwiseAbs().maxCoeff());
  VectorXd x = VectorXd::Zero(n);
  std::vector<Eigen::Index> free;  // variables that are not held at 0
  const auto solve_free = [&] {
    return VectorXd(MatrixXd(A(Eigen::all, free)).colPivHouseholderQr().solve(b));
  };
  for (Eigen::Index round = 0; round < 3 * n; ++round) {
    VectorXd gradient = A.transpose() * (b - A * x);
    for (const Eigen::Index variable : free) {
      gradient[variable] = -1.0;
    }
    Eigen::Index best = 0;
    if (gradient.maxCoeff(&best) <= tolerance) {
      break;
    }
    free.push_back(best);
    for (VectorXd step = solve_free(); !free.empty(); step = solve_free()) {
      double share = 1.0;  // of the way to the unconstrained solution
      for (std::size_t k = 0; k < free.size(); ++k) {
        const double s = step[static_cast<Eigen::Index>(k)];
        const double now = x[free[k]];
        if (s <= 0.0) {
          share = std::min(share, now > 0.0 ? now / (now - s) : 0.0);
        }
      }
      for (std::size_t k = 0; k < free.size(); ++k) {
        x[free[k]] += share * (step[static_cast<Eigen::Index>(k)] - x[free[k]]);
      }
      if (share == 1.0) {
        break;
      }
      std::erase_if(free, [&](Eigen::Index variable) {
        constexpr double kZero = 1e-14;
        if (x[variable] > kZero) {
          return false;
        }
        x[variable] = 0.0;
        return true;
      });
    }
  }
  return x;
}

// The forces with the least sum of squares whose edge coefficients x ≥ 0 satisfy `C x = d`.
//
// By the method of multipliers: the equations are terms of a least-squares problem, shifted until
// they hold. Source: J. Nocedal, S. Wright, "Numerical Optimization", 2006, section 17.3.
std::optional<std::vector<Vector3d>> least_forces(std::span<const GraspContact> contacts,
                                                  const ContactModel& model, const MatrixXd& C,
                                                  const VectorXd& d) {
  constexpr double kWeight = 1e3;  // of the equations
  constexpr int kMostRounds = 20;
  constexpr double kExact = 1e-9;     // of the load
  constexpr double kResidual = 1e-5;  // more: nothing balances it
  const int each = columns_each(model);
  const auto count = std::ssize(contacts);
  MatrixXd A = MatrixXd::Zero(C.rows() + 3 * count, C.cols());
  A.topRows(C.rows()) = kWeight * C;
  for (Eigen::Index i = 0; i < count; ++i) {
    A.block(C.rows() + 3 * i, each * i, 3, each) =
        edges_of(contacts[static_cast<std::size_t>(i)], model).forces;
  }
  VectorXd b = VectorXd::Zero(A.rows());
  VectorXd shift = VectorXd::Zero(d.size());
  VectorXd x;
  double residual = HUGE_VAL;
  for (int round = 0; round < kMostRounds && residual > kExact * d.norm(); ++round) {
    b.head(d.size()) = kWeight * (d - shift);
    x = nonnegative_least_squares(A, b);
    shift += C * x - d;
    residual = (C * x - d).norm();
  }
  if (residual > kResidual * d.norm()) {
    return std::nullopt;
  }
  std::vector<Vector3d> forces;
  for (Eigen::Index i = 0; i < count; ++i) {
    forces.emplace_back(A.block(C.rows() + 3 * i, each * i, 3, each) * x.segment(each * i, each));
  }
  return forces;
}

// A convex hull of wrenches by qhull; empty where they span no volume.
class Hull {
 public:
  explicit Hull(const Wrenches& points)
      : coordinates_(points.data(), points.data() + points.size()),
        messages_(std::fopen("/dev/null", "w"), &std::fclose) {
    qh_zero(&qhull_, messages_.get());
    // FA computes the volume; Pp and the null file keep qhull quiet.
    std::string options = "qhull FA Pp";
    made_ = qh_new_qhull(&qhull_, kDimensions, static_cast<int>(points.cols()), coordinates_.data(),
                         False, options.data(), nullptr, messages_.get()) == 0;
  }
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;
  ~Hull() {
    int bytes = 0;
    int blocks = 0;
    qh_freeqhull(&qhull_, !qh_ALL);
    qh_memfreeshort(&qhull_, &bytes, &blocks);
  }

  [[nodiscard]] bool is_made() const { return made_; }
  [[nodiscard]] double volume() const { return qhull_.totvol; }
  // Calls `visit` with the unit normal and the signed distance of each facet's plane from the
  // origin, positive where the origin is inside.
  template <typename Visit>
  void for_each_facet(const Visit& visit) const {
    for (const facetT* facet = qhull_.facet_list; facet && facet->next; facet = facet->next) {
      visit(Eigen::Map<const Wrench>(facet->normal), -facet->offset);
    }
  }

 private:
  static constexpr int kDimensions = 6;

  std::vector<double> coordinates_;  // qhull keeps pointers to them
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages_;
  qhT qhull_{};
  bool made_ = false;
};

bool spans_all_dimensions(const Wrenches& wrenches) {
  constexpr double kMinSpreadShare = 1e-6;  // of the widest direction
  constexpr Eigen::Index kMinWrenches = 7;
  if (wrenches.cols() < kMinWrenches) {
    return false;
  }
  const Eigen::Matrix<double, 6, Eigen::Dynamic> centred =
      wrenches.colwise() - wrenches.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> spread(centred *
                                                                          centred.transpose());
  return spread.eigenvalues()[0] > kMinSpreadShare * kMinSpreadShare * spread.eigenvalues()[5];
}

}  // namespace

TorqueScale torque_scale(const geometric::TriangleMesh& mesh) {
  require(!mesh.empty(), "a mesh without triangles has no centre of mass");
  const bool is_solid = geometric::is_closed(mesh);
  const Vector3d middle = geometric::bounding_box(mesh).centre();
  double sum = 0.0;  // of volumes or areas
  Vector3d moment = Vector3d::Zero();
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3d a = mesh.vertices[i] - middle;
    const Vector3d b = mesh.vertices[j] - middle;
    const Vector3d c = mesh.vertices[k] - middle;
    const double part = is_solid ? a.dot(b.cross(c)) / 6.0 : 0.5 * (b - a).cross(c - a).norm();
    sum += part;
    moment += part * (a + b + c) / (is_solid ? 4.0 : 3.0);
  }
  constexpr double kZeroVolume = 1e-15;  // m³ or m²: flat, all its triangles cancelling
  TorqueScale scale{middle, 0.0};
  if (std::abs(sum) > kZeroVolume) {
    scale.centre_O += moment / sum;
  }
  for (const Vector3d& vertex : mesh.vertices) {
    scale.length = std::max(scale.length, (vertex - scale.centre_O).norm());
  }
  require(scale.length > 0.0, "a mesh needs an extent");
  return scale;
}

Vector3d tangent(const Vector3d& normal) { return normal.unitOrthogonal(); }

Wrenches contact_wrenches(std::span<const GraspContact> contacts, const ContactModel& model,
                          const TorqueScale& scale) {
  check(contacts, model, scale);
  const int each = columns_each(model);
  Wrenches wrenches(6, each * std::ssize(contacts));
  for (Eigen::Index i = 0; i < std::ssize(contacts); ++i) {
    const GraspContact& contact = contacts[static_cast<std::size_t>(i)];
    const ContactEdges edges = edges_of(contact, model);
    const Vector3d arm = contact.p_O - scale.centre_O;
    for (int edge = 0; edge < each; ++edge) {
      wrenches.col(each * i + edge) << edges.forces.col(edge),
          (arm.cross(Vector3d(edges.forces.col(edge))) + edges.torques.col(edge)) / scale.length;
    }
  }
  return wrenches;
}

GraspQuality grasp_quality(const Wrenches& wrenches) {
  require(wrenches.allFinite(), "wrenches must be finite");
  GraspQuality quality;
  if (!spans_all_dimensions(wrenches)) {
    return quality;
  }
  const Hull hull(wrenches);
  if (!hull.is_made()) {
    return quality;
  }
  quality.epsilon = std::numeric_limits<double>::infinity();
  quality.volume = hull.volume();
  hull.for_each_facet([&](const auto& normal, double distance) {
    if (distance < quality.epsilon) {
      quality.epsilon = distance;
      quality.weakest = -normal;
    }
  });
  return quality;
}

namespace {

// Directions of length 1 all around, the same each time: those of the axes, and drawn ones.
const Wrenches& probed_directions() {
  static const Wrenches kAll = [] {
    constexpr int kDrawn = 256;
    Wrenches all(6, 12 + kDrawn);
    all.leftCols<6>().setIdentity();
    all.middleCols<6>(6) = -Wrenches::Identity(6, 6);
    sampling::RandomStream random(1);
    for (int i = 0; i < kDrawn; ++i) {
      Wrench direction = Wrench::Zero();
      while (direction.norm() < 0.1 || direction.norm() > 1.0) {
        for (double& component : direction) {
          component = 2.0 * random.uniform() - 1.0;
        }
      }
      all.col(12 + i) = direction.normalized();
    }
    return all;
  }();
  return kAll;
}

// Walks over the facets of the hull of some wrenches, each time to a neighbour whose plane is
// nearer to the origin, which is inside. In the polar of the hull, { y : w·y <= 1 for all wrenches
// w }, facets are corners and the nearest plane is the corner that is farthest from the origin.
class FacetWalk {
 public:
  explicit FacetWalk(const Wrenches& wrenches) : wrenches_(wrenches) {
    constexpr double kTieBreak = 1e-4;  // so that no corner is on more than six planes
    sampling::RandomStream random(1);
    limits_.resize(wrenches.cols());
    for (double& limit : limits_) {
      limit = 1.0 + kTieBreak * random.uniform();
    }
  }

  // Returns the direction of the plane at the end of the walk that begins where the hull is left
  // into `direction`.
  [[nodiscard]] Wrench nearest_from(const Wrench& direction) const {
    constexpr int kMostSteps = 40;
    Eigen::RowVectorXd reach = direction.transpose() * wrenches_;
    Eigen::Index first = 0;
    const double grown = (reach.array() / limits_.array()).maxCoeff(&first);
    Wrench y = direction / grown;
    Matrix6d planes;
    std::array<Eigen::Index, 6> tight{first};
    for (int count = 1; count < 6; ++count) {  // to a corner, away from the origin
      planes.row(count - 1) = wrenches_.col(tight[static_cast<std::size_t>(count - 1)]).transpose();
      const auto at = planes.topRows(count);
      const Wrench out = outwards(at, y);
      const auto [next, way] = next_plane(y, out);
      if (next < 0) {
        return out.normalized();
      }
      y += way * out;
      tight[static_cast<std::size_t>(count)] = next;
    }
    planes.row(5) = wrenches_.col(tight[5]).transpose();
    for (int step = 0; step < kMostSteps; ++step) {
      const Matrix6d edges = -planes.inverse();  // column j leaves plane j
      if (!edges.allFinite()) {
        break;
      }
      double farthest = y.squaredNorm();
      Wrench best = y;
      int left = -1;
      Eigen::Index entered = -1;
      for (int j = 0; j < 6; ++j) {
        const auto [next, way] = next_plane(y, edges.col(j));
        if (next < 0) {
          return edges.col(j).normalized();
        }
        const Wrench corner = y + way * edges.col(j);
        if (corner.squaredNorm() > farthest) {
          farthest = corner.squaredNorm();
          best = corner;
          left = j;
          entered = next;
        }
      }
      if (left < 0) {
        break;
      }
      y = best;
      planes.row(left) = wrenches_.col(entered).transpose();
    }
    return y.normalized();
  }

 private:
  using Matrix6d = Eigen::Matrix<double, 6, 6>;

  // The way along `planes` that leads away from the origin fastest.
  template <typename Planes>
  [[nodiscard]] static Wrench outwards(const Planes& planes, const Wrench& y) {
    constexpr double kNone = 1e-9;
    const Eigen::HouseholderQR<Eigen::Matrix<double, 6, Eigen::Dynamic>> basis(planes.transpose());
    const Matrix6d Q = basis.householderQ();
    const auto along = Q.rightCols(6 - planes.rows());
    const Wrench way = along * (along.transpose() * y);
    return way.norm() > kNone * y.norm() ? Wrench(way) : Wrench(along.col(0));
  }

  // The plane that is met first from y into a direction, and after how much of it; -1 if none is.
  [[nodiscard]] std::pair<Eigen::Index, double> next_plane(const Wrench& y,
                                                           const Wrench& direction) const {
    constexpr double kParallel = 1e-9;
    const Eigen::RowVectorXd approach = direction.transpose() * wrenches_;
    const Eigen::RowVectorXd room = limits_ - y.transpose() * wrenches_;
    const double least = kParallel * direction.norm();
    std::pair<Eigen::Index, double> first{-1, HUGE_VAL};
    for (Eigen::Index i = 0; i < approach.size(); ++i) {
      if (approach[i] > least && room[i] < first.second * approach[i]) {
        first = {i, std::max(room[i] / approach[i], 0.0)};
      }
    }
    return first;
  }

  const Wrenches& wrenches_;
  Eigen::RowVectorXd limits_;
};

}  // namespace

double epsilon_bound(const Wrenches& wrenches) {
  require(wrenches.allFinite(), "wrenches must be finite");
  constexpr std::size_t kWalks = 4;
  if (wrenches.cols() == 0) {
    return 0.0;
  }
  const Eigen::RowVectorXd reach =
      (wrenches.transpose() * probed_directions()).colwise().maxCoeff();
  std::vector<Eigen::Index> starts(static_cast<std::size_t>(reach.size()));
  std::iota(starts.begin(), starts.end(), 0);
  std::ranges::partial_sort(starts, starts.begin() + kWalks, {},
                            [&](Eigen::Index i) { return reach[i]; });
  double bound = reach[starts.front()];
  const FacetWalk walk(wrenches);
  for (std::size_t i = 0; i < kWalks && bound > 0.0; ++i) {
    const Wrench direction = walk.nearest_from(probed_directions().col(starts[i]));
    bound = std::min(bound, (wrenches.transpose() * direction).maxCoeff());
  }
  return bound;
}

std::optional<std::vector<Vector3d>> least_contact_forces(std::span<const GraspContact> contacts,
                                                          const ContactModel& model,
                                                          const TorqueScale& scale,
                                                          const Wrench& load) {
  require(load.allFinite(), "the load must be finite");
  const Wrenches wrenches = contact_wrenches(contacts, model, scale);
  if (load.isZero()) {
    return std::vector<Vector3d>(contacts.size(), Vector3d::Zero());
  }
  if (contacts.empty()) {
    return std::nullopt;
  }
  const double size = load.norm();  // any load is as well conditioned as one of 1 N
  auto forces = least_forces(contacts, model, wrenches, -load / size);
  if (forces) {
    for (Vector3d& force : *forces) {
      force *= size;
    }
  }
  return forces;
}

std::optional<std::vector<Vector3d>> internal_contact_forces(std::span<const GraspContact> contacts,
                                                             const ContactModel& model,
                                                             const TorqueScale& scale) {
  const Wrenches wrenches = contact_wrenches(contacts, model, scale);
  if (contacts.empty()) {
    return std::nullopt;
  }
  MatrixXd C(7, wrenches.cols());
  C << wrenches, Eigen::RowVectorXd::Ones(wrenches.cols());  // each edge has a normal force of 1 N
  VectorXd d = VectorXd::Zero(7);
  d[6] = 1.0;
  return least_forces(contacts, model, C, d);
}

}  // namespace handway::planning
