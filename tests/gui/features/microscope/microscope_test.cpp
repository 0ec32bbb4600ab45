#include "model/planning/microscope.h"

#include "features/microscope/algorithm_listing.h"
#include "features/microscope/listing_view.h"
#include "features/microscope/microscope_panel.h"
#include "patience.h"
#include "window_test.h"

#include <QLabel>
#include <QSlider>

namespace handway::test {
namespace {

using ::testing::HasSubstr;
namespace lines = planning::algorithm_lines;

TEST(AlgorithmListings, HaveALineForEveryStep) {
  for (const planning::AlgorithmLine line :
       {lines::kArmFree, lines::kNoArm, lines::kHandFreeOfSelf, lines::kHandFree, lines::kAddNode,
        lines::kNeighbours, lines::kSameComponent, lines::kLocalPlan, lines::kAddEdge,
        lines::kWiden, lines::kHypercube, lines::kJoined, lines::kSearchRange, lines::kFailure}) {
    const gui::AlgorithmListing& listing = gui::algorithm_listing(line.algorithm);
    EXPECT_EQ(listing.algorithm, line.algorithm);
    EXPECT_LE(static_cast<std::size_t>(line.line), listing.lines.size());
  }
  EXPECT_EQ(gui::algorithm_listing(4).lines[19], "              if start and goal are joined");
}

class MicroscopeTest : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) {
      return;
    }
    open(source_dir() / "scenes" / "can_on_table.yaml");
    show_dock("microscope");
  }
  [[nodiscard]] gui::Microscope& microscope() const {
    return tool<gui::MicroscopePanel>().microscope();
  }
  void record() {
    click("microscope_record");
    ASSERT_TRUE(QTest::qWaitFor([&] { return microscope().run() != nullptr; }, kPatienceMs));
  }
  [[nodiscard]] std::string words() const {
    return part<QLabel>("microscope_words").text().toStdString();
  }
  /// The first step of that line with that answer.
  [[nodiscard]] std::size_t find(planning::AlgorithmLine line, bool yes = true) const {
    const auto& steps = microscope().run()->steps;
    const auto found = std::ranges::find_if(steps, [&](const gui::RecordedStep& recorded) {
      return recorded.step.line == line && recorded.step.yes == yes;
    });
    EXPECT_NE(found, steps.end()) << line.algorithm << "." << line.line;
    return static_cast<std::size_t>(found - steps.begin());
  }
};

TEST_F(MicroscopeTest, BeginsWithStartAndGoalInTheRoadmap) {
  record();
  const gui::RecordedRun& run = *microscope().run();
  EXPECT_TRUE(run.result.solved()) << run.result.reason;
  EXPECT_EQ(run.left_out, 0U);
  EXPECT_EQ(run.steps[0].step.line, lines::kAddNode);
  EXPECT_EQ(run.samples[0], *window().document().scene()->start);
  EXPECT_THAT(words(), HasSubstr("the start"));
  EXPECT_EQ(run.steps.back().step.line, lines::kJoined);
  EXPECT_TRUE(run.steps.back().step.yes);
}

TEST_F(MicroscopeTest, HasTheRoadmapThatThePlannerHad) {
  record();
  const gui::RecordedRun& run = *microscope().run();
  EXPECT_EQ(static_cast<std::uint64_t>(run.nodes_after(run.steps.size())),
            run.result.statistics.nodes);
  EXPECT_EQ(run.edges_after(run.steps.size()).size(), run.result.statistics.edges);
  EXPECT_EQ(microscope().palms().size(), run.nodes.size());
}

TEST_F(MicroscopeTest, ShowsARefusedSampleAndSaysWhatItTouches) {
  record();
  microscope().go_to(find(lines::kHandFree, false));
  EXPECT_THAT(words(), HasSubstr("refused"));
  EXPECT_THAT(words(), HasSubstr("touches"));
  const auto sample = static_cast<std::size_t>(microscope().step().sample);
  EXPECT_EQ(window().document().configuration(), microscope().run()->samples[sample]);
  const auto listings = tool<gui::MicroscopePanel>().findChildren<gui::ListingView*>();
  EXPECT_EQ(listings.at(0)->algorithm(), 4);
  EXPECT_EQ(listings.at(0)->line(), 18);
  EXPECT_EQ(listings.at(1)->algorithm(), 2);
  EXPECT_EQ(listings.at(1)->line(), 7);
  keep_picture("microscope_refused");
}

TEST_F(MicroscopeTest, ShowsAnEdge) {
  record();
  microscope().go_to(find(lines::kAddEdge));
  EXPECT_THAT(words(), HasSubstr("get an edge"));
  keep_picture("microscope_edge");
  microscope().go_to(microscope().run()->steps.size());
  EXPECT_THAT(words(), HasSubstr("there is a path"));
  keep_picture("microscope_end");
}

TEST_F(MicroscopeTest, StepsOnBackAndToTheBeginning) {
  record();
  click("microscope_forward");
  click("microscope_forward");
  EXPECT_EQ(microscope().position(), 2U);
  click("microscope_back");
  EXPECT_EQ(microscope().position(), 1U);
  part<QSlider>("microscope_position").setValue(5);
  EXPECT_EQ(microscope().position(), 5U);
  click("microscope_rewind");
  EXPECT_EQ(microscope().position(), 0U);
}

TEST_F(MicroscopeTest, RunsByItselfUntilItIsPaused) {
  record();
  click("microscope_run");
  ASSERT_TRUE(QTest::qWaitFor([&] { return microscope().position() > 0; }, kPatienceMs));
  click("microscope_run");
  const std::size_t position = microscope().position();
  QTest::qWait(500);
  EXPECT_EQ(microscope().position(), position);
}

TEST_F(MicroscopeTest, ForgetsTheRunWithTheScene) {
  record();
  open(cell().wall());
  EXPECT_FALSE(microscope().run());
  EXPECT_EQ(words(), "");
  keep_picture("microscope_empty");
}

}  // namespace
}  // namespace handway::test
