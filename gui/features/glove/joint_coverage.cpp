#include "features/glove/joint_coverage.h"

#include <algorithm>
#include <cstddef>

namespace handway::gui {
double JointVisits::share() const {
  return static_cast<double>(std::ranges::count(visited, true)) / kBins;
}

void JointCoverage::restart(const std::vector<std::string>& joints,
                            const std::vector<bool>& driven) {
  joints_.assign(joints.size(), {});
  for (std::size_t j = 0; j < joints.size(); ++j) {
    joints_[j].joint = joints[j];
    joints_[j].driven = driven[j];
  }
}

void JointCoverage::add(const Eigen::VectorXd& posture) {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointVisits& visits = joints_[j];
    visits.now = std::clamp(posture[static_cast<Eigen::Index>(j)], 0.0, 1.0);
    visits.least = std::min(visits.least, visits.now);
    visits.most = std::max(visits.most, visits.now);
    const int bin =
        std::min(static_cast<int>(visits.now * JointVisits::kBins), JointVisits::kBins - 1);
    visits.visited.at(static_cast<std::size_t>(bin)) = true;
  }
}

double JointCoverage::share() const {
  double sum = 0.0;
  int driven = 0;
  for (const JointVisits& visits : joints_) {
    if (visits.driven) {
      sum += visits.share();
      ++driven;
    }
  }
  return driven > 0 ? sum / driven : 0.0;
}

}  // namespace handway::gui
