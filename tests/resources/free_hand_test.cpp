/// The recording that ships, and the basis made from it.
#include "handway/device/emulators/glove_signals.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/principal_components.h"
#include "handway_test/paths.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace handway::test {
namespace {

std::filesystem::path resource(const std::string& name) {
  return source_dir() / "resources" / name;
}

class FreeHand : public testing::Test {
 protected:
  // Returns postures of the hand that the mapping is for, normalised by the joint limits.
  [[nodiscard]] Eigen::MatrixXd postures(const std::string& mapping = "table1_sah") const {
    const device::HandMapping read =
        device::read_mapping(resource("mappings/" + mapping + ".yaml"));
    const device::HandMapper mapper(
        read, *geometric::load_robot(resource("robots/" + read.hand + "/" + read.hand + ".urdf")));
    const Eigen::RowVectorXd lower = mapper.lower().transpose();
    const Eigen::RowVectorXd range = (mapper.upper() - mapper.lower()).transpose();
    const Eigen::MatrixXd radians =
        mapper.map_recording(device::to_angles(recording_, device::typical_calibration())).postures;
    return (radians.rowwise() - lower).array().rowwise() / range.array();
  }

  device::Recording recording_ = device::read_recording(resource("recordings/free_hand.csv"));
};

TEST_F(FreeHand, HasAsManyPosturesAsThePaperAndSaysHowItWasMade) {
  EXPECT_EQ(recording_.times.size(), 13500);
  EXPECT_EQ(recording_.times[13499], 134.99);
  EXPECT_EQ(recording_.header.kind, device::RecordingKind::kCounts);
  EXPECT_NE(recording_.header.origin.find("handway glove generate --seed 1 "), std::string::npos);
  EXPECT_TRUE(recording_.warnings.empty());
}

TEST_F(FreeHand, IsMadeAgainBySeed) {
  constexpr int kRows = 1000;
  const device::Recording again = device::generate_recording(1, kRows, 100.0);
  EXPECT_EQ(again.times, recording_.times.head(kRows));
  EXPECT_EQ(again.values, recording_.values.topRows(kRows));
}

TEST_F(FreeHand, VariesAsThePapersHandDid) {
  for (const std::vector<int>& left_out : {std::vector<int>{}, std::vector<int>{0}}) {
    const Eigen::VectorXd shares = sampling::principal_components(postures(), left_out).shares;
    EXPECT_NEAR(shares.head(1).sum(), 0.4219, 0.03);
    EXPECT_NEAR(shares.head(2).sum(), 0.7712, 0.03);
    EXPECT_NEAR(shares.head(3).sum(), 0.8471, 0.03);
  }
}

struct MadeBasis {
  std::string name, mapping;
};

std::ostream& operator<<(std::ostream& stream, const MadeBasis& basis) {
  return stream << basis.name;
}

class BasisOfFreeHand : public FreeHand, public testing::WithParamInterface<MadeBasis> {};

TEST_P(BasisOfFreeHand, IsTheOneThatShips) {
  const sampling::PmdBasis shipped =
      sampling::read_pmd_basis(resource("bases/" + GetParam().name + ".yaml"));
  ASSERT_EQ(shipped.free_joints.size(), 1U);
  const int free = shipped.free_joints[0].joint;
  EXPECT_EQ(shipped.joints[static_cast<std::size_t>(free)], "thumb_base");
  const sampling::PrincipalComponents found =
      sampling::principal_components(postures(GetParam().mapping), {free});
  ASSERT_EQ(shipped.directions.size(), 4U);
  EXPECT_LT((shipped.mean - found.mean).norm(), 1e-9);
  for (Eigen::Index k = 0; k < 4; ++k) {
    const sampling::PrincipalDirection& direction = shipped.directions[static_cast<std::size_t>(k)];
    EXPECT_LT((direction.vector - found.directions.col(k)).norm(), 1e-9);
    EXPECT_NEAR(direction.variance, found.variances[k], 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Hands, BasisOfFreeHand,
                         testing::Values(MadeBasis{"sah_free_hand", "table1_sah"},
                                         MadeBasis{"allegro_free_hand", "allegro_class_right"},
                                         MadeBasis{"leap_free_hand", "leap_class_right"},
                                         MadeBasis{"shadow_free_hand", "shadow_class_right"}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace handway::test
