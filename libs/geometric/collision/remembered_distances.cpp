#include "collision/remembered_distances.h"

#include "collision/solid.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace handway::geometric {
namespace {

constexpr std::string_view kLayout = "distances 4";  // to change with what is in the tables

// What a table's distances depend on: the two surfaces, and where they are against
// each other at both ends and in the middle of the joints' ranges, and at rest.
std::string description(const CollisionWorld& world, const BodyPair& pair, const Surface& a,
                        const Surface& b) {
  std::string text(a.key.begin(), a.key.end());
  text.append(b.key.begin(), b.key.end());
  for (const int body : {pair.a, pair.b}) {
    const BodySolids& solids = *world.body(body).solids;
    text += std::to_string(solids.parts.size()) + ' ' + std::to_string(solids.points.size()) + ' ';
  }
  const RobotModel& model = world.model();
  const Configuration middle = 0.5 * (model.lower() + model.upper());
  for (const Configuration& q : {model.lower(), middle, model.upper(), model.neutral()}) {
    const std::vector<Pose> X_BBody = poses_at_base(world, q);
    const Pose X_ba = X_BBody[static_cast<std::size_t>(pair.b)].inverse(Eigen::Isometry) *
                      X_BBody[static_cast<std::size_t>(pair.a)];
    text.append(reinterpret_cast<const char*>(X_ba.matrix().data()), 16 * sizeof(double));
  }
  return text;
}

}  // namespace

std::vector<Pose> poses_at_base(const CollisionWorld& world, const Configuration& q) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(world.model().link_count()));
  world.model().forward_kinematics(q, X_BL);
  std::vector<Pose> X_BBody(world.bodies().size(), Pose::Identity());
  for (std::size_t i = 0; i < X_BBody.size(); ++i) {
    if (const CollisionBody& body = world.bodies()[i]; body.moves()) {
      const Pose& X_BLink = X_BL[static_cast<std::size_t>(body.link)];
      X_BBody[i] = body.is_carried ? X_BLink * body.X_FB : X_BLink;
    }
  }
  return X_BBody;
}

RememberedDistances::RememberedDistances(
    const CollisionWorld& world, const std::vector<std::shared_ptr<const Surface>>& surfaces,
    bool keeps)
    : keeps_(keeps) {
  const MotionBound motion(world);
  std::string all;
  for (const BodyPair& pair : world.pairs()) {
    tables_.push_back(world.is_self_pair(pair)
                          ? DistanceTable::make(world.model(), world.body(pair.a).link,
                                                world.body(pair.b).link,
                                                static_cast<int>(tables_.size()), motion)
                          : nullptr);
    if (tables_.back()) {
      all += description(world, pair, *surfaces[static_cast<std::size_t>(pair.a)],
                         *surfaces[static_cast<std::size_t>(pair.b)]);
    }
  }
  key_ = cache_key(kLayout, all);
  recall();
}

void RememberedDistances::recall() {
  const std::optional<std::string> cached = DiskCache::of_user().read(key_);
  std::size_t count = 0;
  for (const auto& table : tables_) {
    count += table ? table->cell_count() : 0;
  }
  if (!cached || cached->size() != count * sizeof(float)) {
    return;
  }
  keeps_ = true;
  std::vector<float> cells(count);
  std::memcpy(cells.data(), cached->data(), cached->size());
  std::span<const float> rest(cells);
  for (const auto& table : tables_) {
    if (table) {
      table->set_cells(rest.first(table->cell_count()));
      rest = rest.subspan(table->cell_count());
    }
  }
}

RememberedDistances::~RememberedDistances() {
  const bool learned =
      std::ranges::any_of(tables_, [](const auto& table) { return table && table->has_learned(); });
  if (!learned || !keeps_) {
    return;
  }
  std::string bytes;
  for (const auto& table : tables_) {
    if (table) {
      const std::vector<float> cells = table->cells();
      bytes.append(reinterpret_cast<const char*>(cells.data()), cells.size() * sizeof(float));
    }
  }
  DiskCache::of_user().write(key_, bytes);
}

}  // namespace handway::geometric
