#include "features/glove/capture_hints.h"

#include "features/glove/finger_combinations.h"
#include "features/glove/joint_coverage.h"
#include "handway/device/glove/human_hand.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::test {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

class CaptureHints : public ::testing::Test {
 protected:
  CaptureHints() {
    for (const device::JointMapping& mapped : mapping_.joints) {
      joints_.push_back(mapped.joint);
      driven_.push_back(mapped.sensor >= 0);
    }
    coverage_.restart(joints_, driven_);
  }

  // All joints from `least` to `most`, but those named like `still` where they are.
  void sweep(double least, double most, const std::string& still = "none") {
    for (double p = least; p <= most; p += 0.01) {
      Eigen::VectorXd posture = Eigen::VectorXd::Constant(count(), p);
      for (Eigen::Index j = 0; j < count(); ++j) {
        if (joints_[static_cast<std::size_t>(j)].find(still) != std::string::npos) {
          posture[j] = 0.5;
        }
      }
      coverage_.add(posture);
    }
  }
  [[nodiscard]] std::vector<std::string> hints() const {
    std::vector<std::string> result;
    for (const QString& hint : gui::capture_hints(coverage_, mapping_, 20)) {
      result.push_back(hint.toStdString());
    }
    return result;
  }
  [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(joints_.size()); }

  device::HandMapping mapping_ = device::table1_mapping();
  std::vector<std::string> joints_;
  std::vector<bool> driven_;
  gui::JointCoverage coverage_;
};

TEST_F(CaptureHints, HaveNothingToAskForAfterAFullMotion) {
  sweep(0.0, 1.0);
  EXPECT_THAT(hints(), IsEmpty());
  EXPECT_NEAR(coverage_.share(), 1.0, 0.05);
}

TEST_F(CaptureHints, NameTheSensorThatHasHardlyMoved) {
  sweep(0.0, 1.0, "ring_abduction");
  EXPECT_THAT(hints(), ::testing::ElementsAre("Ring abduction has hardly moved"));
}

TEST_F(CaptureHints, AskToSpreadTheFingersIfNoneHas) {
  for (double p = 0.0; p <= 1.0; p += 0.01) {
    Eigen::VectorXd posture = Eigen::VectorXd::Constant(count(), p);
    posture[4] = posture[10] = 0.5;  // index and ring
    coverage_.add(posture);
  }
  EXPECT_THAT(hints(), ::testing::ElementsAre("Spread the fingers and close them again"));
}

TEST_F(CaptureHints, KnowWhichEndIsTheFist) {
  sweep(0.4, 1.0);  // fingers bend towards the lower limit
  EXPECT_THAT(hints(), Contains("Make a tight fist"));
  EXPECT_THAT(hints(), Not(Contains("Stretch all fingers out")));
}

TEST_F(CaptureHints, AskToStretchAHandThatWasNeverOpen) {
  sweep(0.0, 0.6);
  EXPECT_THAT(hints(), Contains("Stretch all fingers out"));
}

TEST_F(CaptureHints, BringTheThumbAcross) {
  sweep(0.0, 1.0, "thumb_base");
  EXPECT_THAT(hints(), Contains("Bring the thumb across the palm and back"));
}

device::GloveAngles bent(double index, double others) {
  device::GloveAngles angles;
  angles.angles.fill(others);
  for (const char* sensor : {"IndexMPJ", "IndexPIJ"}) {
    angles.angles.at(static_cast<std::size_t>(*device::find_sensor(sensor))) = index;
  }
  return angles;
}

TEST(FingerCombinations, KnowWhichFingersWereBentTogetherAndWhichNeverAlone) {
  gui::FingerCombinations combinations;
  EXPECT_EQ(combinations.share(), 0.0);
  for (const double all : {0.0, 0.7, 1.5}) {
    combinations.add(bent(all, all), {});
  }
  EXPECT_TRUE(combinations.visited(device::Finger::kIndex, 2, device::Finger::kRing, 2));
  EXPECT_FALSE(combinations.visited(device::Finger::kIndex, 2, device::Finger::kRing, 0));
  EXPECT_NEAR(combinations.share(), 3.0 / 9.0, 1e-9) << "no finger moved without the others";
  EXPECT_EQ(combinations.missing(), QStringLiteral("Thumb bent, index straight"));
  combinations.add(bent(1.5, 0.0), {});
  EXPECT_TRUE(combinations.visited(device::Finger::kIndex, 2, device::Finger::kRing, 0));
}

TEST(FingerCombinations, GoByThePersonsOwnRanges) {
  gui::FingerCombinations combinations;
  device::PersonRanges stiff;
  stiff.fill(std::pair(0.0, 0.5));
  combinations.add(bent(0.5, 0.5), stiff);
  EXPECT_TRUE(combinations.visited(device::Finger::kIndex, 2, device::Finger::kRing, 2));
}

}  // namespace
}  // namespace handway::test
