#include "handway/planning/queries/human_likeness.h"

#include "handway/geometric/robot/normalised_joints.h"
#include "handway/sampling/sequences/random_stream.h"

#include <gtest/gtest.h>
#include <handway_test/planar_problems.h>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace handway::planning {
namespace {

class HumanLikenessOfTheFlatArm : public testing::Test {
 protected:
  // Postures that the hand can reach by its basis, first of all its mean.
  HumanLikenessOfTheFlatArm() {
    basis_.directions.pop_back();  // the two of the problem reach every posture
    sampling::RandomStream draw(3);
    sampling::PostureTable table{basis_.hand, "drawn", basis_.joints, {}};
    table.postures.resize(9, static_cast<Eigen::Index>(basis_.joints.size()));
    table.postures.row(0) = middle().transpose();
    for (Eigen::Index row = 1; row < table.postures.rows(); ++row) {
      table.postures.row(row) =
          sampling::map_to_posture(basis_, draw.uniform(basis_.dimension())).transpose();
    }
    postures_ = std::make_shared<const sampling::RecordedPostures>(basis_, table, "drawn");
  }

  [[nodiscard]] Eigen::VectorXd middle() const {
    return sampling::map_to_posture(basis_, Eigen::VectorXd::Constant(basis_.dimension(), 0.5));
  }
  [[nodiscard]] Configuration with_hand(const Eigen::VectorXd& posture) const {
    Configuration p = geometric::normalised(problem_.model(), problem_.start);
    p(problem_.joints.hand) = posture;
    return geometric::denormalised(problem_.model(), p);
  }
  [[nodiscard]] HumanLikeness likeness() const {
    return {problem_.model(), problem_.joints.hand, basis_, postures_};
  }

  PlanningProblem problem_ = test::open_problem();
  sampling::PmdBasis basis_ = *problem_.basis;
  std::shared_ptr<const sampling::RecordedPostures> postures_;
};

TEST_F(HumanLikenessOfTheFlatArm, IsZeroInARecordedPostureOfTheBasis) {
  const HandLikeness here = likeness().at(with_hand(middle()));
  EXPECT_NEAR(here.to_subspace, 0.0, 1e-12);
  ASSERT_TRUE(here.to_recorded);
  EXPECT_NEAR(*here.to_recorded, 0.0, 1e-12);
}

TEST_F(HumanLikenessOfTheFlatArm, IsWhatTheSamplingLibrarySays) {
  sampling::RandomStream draw(5);
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd posture = draw.uniform(static_cast<int>(problem_.joints.hand.size()));
    const HandLikeness here = likeness().at(with_hand(posture));
    EXPECT_NEAR(here.to_subspace, sampling::distance_to_subspace(basis_, posture), 1e-9);
    EXPECT_NEAR(*here.to_recorded, postures_->nearest(posture).distance, 1e-9);
  }
}

TEST_F(HumanLikenessOfTheFlatArm, TakesTheHandToTheNearestRecordedPosture) {
  const Configuration q =
      with_hand(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem_.joints.hand.size())));
  const std::optional<Configuration> nearest = likeness().nearest_recorded(q);
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(*likeness().at(*nearest).to_recorded, 0.0, 1e-9);
  EXPECT_EQ((*nearest)(problem_.joints.arm), q(problem_.joints.arm)) << "the arm stays";
}

TEST_F(HumanLikenessOfTheFlatArm, DoesWithoutRecordedPostures) {
  const HumanLikeness alone(problem_.model(), problem_.joints.hand, basis_, nullptr);
  EXPECT_FALSE(alone.at(problem_.start).to_recorded);
  EXPECT_FALSE(alone.nearest_recorded(problem_.start));
  EXPECT_FALSE(
      path_likeness(problem_.model(), alone, {{problem_.start, problem_.goal}}).to_recorded);
}

TEST_F(HumanLikenessOfTheFlatArm, AveragesOverTheLengthOfAPath) {
  // The hand moves away from the mean along one joint and back: the distance rises and falls
  // evenly, whatever waypoints are put in between.
  Eigen::VectorXd away = middle();
  away[away.size() - 1] += 0.3;
  const Configuration near = with_hand(middle());
  const Configuration far = with_hand(away);
  const double most = likeness().at(far).to_subspace;
  ASSERT_NEAR(most, 0.3 / std::sqrt(2.0), 1e-9);
  const Path path{{near, 0.9 * near + 0.1 * far, far, near, near}};
  const PathLikeness along = path_likeness(problem_.model(), likeness(), path);
  EXPECT_NEAR(along.to_subspace.largest, most, 1e-9);
  EXPECT_NEAR(along.to_subspace.mean, 0.5 * most, 1e-6);
  ASSERT_TRUE(along.to_recorded);
  EXPECT_LE(along.to_recorded->mean, along.to_recorded->largest);
}

TEST_F(HumanLikenessOfTheFlatArm, LooksOnceAtAPathThatStands) {
  const Path path{{problem_.start}};
  const PathLikeness along = path_likeness(problem_.model(), likeness(), path);
  EXPECT_EQ(along.to_subspace.mean, likeness().at(problem_.start).to_subspace);
  EXPECT_EQ(along.to_subspace.largest, along.to_subspace.mean);
  EXPECT_THROW(static_cast<void>(path_likeness(problem_.model(), likeness(), {})),
               std::invalid_argument);
}

TEST_F(HumanLikenessOfTheFlatArm, WantsTheHandOfTheBasis) {
  EXPECT_THROW(HumanLikeness(problem_.model(), problem_.joints.arm, basis_, nullptr),
               std::invalid_argument);
}

}  // namespace
}  // namespace handway::planning
