#include "handway/device/retargeting/fingertip_errors.h"

#include "handway/device/glove/human_hand.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace handway::device {

namespace {

/// Converts postures of some joints to postures of all the hand's.
class HandPostures {
 public:
  HandPostures(const std::vector<std::string>& joints, const FingertipRetargeter& hand)
      : middle_(hand.middle()) {
    for (const std::string& joint : joints) {
      const auto found = std::ranges::find(hand.joints(), joint);
      places_.push_back(found == hand.joints().end() ? -1 : found - hand.joints().begin());
    }
  }

  /// @param values shape [joints].
  [[nodiscard]] Eigen::VectorXd of(const Eigen::VectorXd& values) const {
    Eigen::VectorXd posture = middle_;
    for (Eigen::Index j = 0; j < values.size(); ++j) {
      if (const Eigen::Index place = places_[static_cast<std::size_t>(j)]; place >= 0) {
        posture[place] = values[j];
      }
    }
    return posture;
  }

 private:
  Eigen::VectorXd middle_;
  std::vector<Eigen::Index> places_;  ///< Index of each joint in the hand; -1: the hand lacks it.
};

}  // namespace

FingertipErrors fingertip_errors(std::span<const GloveAngles> rows,
                                 const std::vector<std::string>& joints,
                                 const Eigen::MatrixXd& postures, const FingertipRetargeter& hand) {
  const HandPostures all(joints, hand);
  std::vector<double> misses;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const Eigen::VectorXd q = all.of(postures.row(static_cast<Eigen::Index>(row)).transpose());
    const Eigen::RowVectorXd miss =
        (hand.fingertips(q) - hand.wanted(hand.landmarks(rows[row]))).colwise().norm();
    misses.insert(misses.end(), miss.begin(), miss.end());
  }
  std::ranges::sort(misses);
  return {std::accumulate(misses.begin(), misses.end(), 0.0) / static_cast<double>(misses.size()),
          misses[misses.size() / 2], misses[misses.size() * 95 / 100]};
}

std::function<Eigen::Matrix3Xd(const Eigen::VectorXd&)> normalised_fingertips(
    const std::shared_ptr<const FingertipRetargeter>& hand, const PostureSource& source) {
  return
      [hand, all = HandPostures(source.joints(), *hand), lower = source.lower(),
       range = Eigen::VectorXd(source.upper() - source.lower())](const Eigen::VectorXd& posture) {
        return hand->fingertips(all.of(lower + posture.cwiseProduct(range)));
      };
}

}  // namespace handway::device
