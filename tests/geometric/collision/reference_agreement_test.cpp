/// The fast checker against FCL on the published problems' own meshes.
#include "../robot/random_configurations.h"
#include "checker_agreement.h"
#include "handway_test/paths.h"
#include "kautham_importer.h"

#include <gtest/gtest.h>

#include <string>

namespace handway::geometric {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr int kConfigurations = 40;
#else
constexpr int kConfigurations = 500;
#endif

class ReferenceProblem : public testing::TestWithParam<const char*> {};

TEST_P(ReferenceProblem, IsTheSameForBothCheckers) {
  HANDWAY_NEED_REFERENCE(reference);
  const import_kautham::KauthamImporter importer;
  const auto loaded = importer.read(reference / "auro" / GetParam());
  test::CheckerAgreement checkers(*loaded.scene);
  test::RandomConfigurations random(checkers.world().model(), 31);
  const Configuration& start = *loaded.scene->start;
  const Configuration way = *loaded.scene->goal - start;
  for (int i = 0; i < kConfigurations; ++i) {
    // Around the segment: from next to it to the width of the planners' corridors.
    const double spread = (i % 5) * 0.02;
    const Configuration q = start + random.uniform(0.0, 1.0) * way +
                            spread * (random.next() - checkers.world().model().neutral());
    ASSERT_NO_FATAL_FAILURE(checkers.expect_same_collisions(q));
    if (i % 20 == 0) {
      ASSERT_NO_FATAL_FAILURE(checkers.expect_same_distances(q, 0.002));
    }
  }
  RecordProperty("in_collision", checkers.collisions());
  EXPECT_GT(checkers.collisions(), 0);
  EXPECT_GT(checkers.frees(), 0);
}

INSTANTIATE_TEST_SUITE_P(Auro, ReferenceProblem,
                         testing::Values("TX90_RHand_ICRA10_5PMD_TwoCanb_new.xml",
                                         "TX90_RHand_ICRA10_5PMD_CanBox_new.xml",
                                         "TX90_RHand_ICRA10_5PMD_ShelfCan2_new.xml",
                                         "TX90_RHand_ICRA10_5PMD-shelfT2_new.xml"),
                         [](const auto& test) {
                           return "Problem" + std::to_string(test.index + 1);
                         });

}  // namespace
}  // namespace handway::geometric
