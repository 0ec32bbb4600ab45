#include "features/planning/plan_panel.h"
#include "features/planning/planning_commands.h"
#include "features/planning/roadmap_display.h"
#include "window_test.h"

#include <QAction>
#include <QCheckBox>
#include <QLabel>
#include <QTextDocument>

#include <algorithm>
#include <filesystem>
#include <numeric>

namespace handway::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

class RoadmapInTheView : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!IsSkipped()) {
      part<QAction>("samples").setChecked(true);
    }
  }
  [[nodiscard]] std::string text(const char* label) const {
    QTextDocument document;
    document.setHtml(part<QLabel>(label).text());
    return document.toPlainText().toStdString();
  }
  /// The way around the post is far from the straight motion.
  void widen() const {
    tool<gui::PlanPanel>().enter("rho_max", 0.5);
    tool<gui::PlanPanel>().enter("rho_a", 0.3);
  }
  [[nodiscard]] bool legend_is_shown() const {
    return !part<gui::RoadmapLegend>("roadmap_legend").isHidden();
  }
};

TEST_F(RoadmapInTheView, IsThatOfTheRun) {
  open(cell().post());
  EXPECT_FALSE(legend_is_shown()) << "nothing has been planned";
  EXPECT_EQ(window().session().roadmap(), nullptr);
  plan();
  const gui::SharedRoadmap roadmap = window().session().roadmap();
  ASSERT_NE(roadmap, nullptr);
  EXPECT_THAT(roadmap->palms, SizeIs(roadmap->roadmap.nodes.size()));
  EXPECT_GE(roadmap->roadmap.edges.size(), 2U);
  const std::vector<int> counts = gui::nodes_per_pmds(*roadmap);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::size_t{0}),
            roadmap->roadmap.nodes.size());
  EXPECT_TRUE(legend_is_shown());
  EXPECT_THAT(text("roadmap_title"),
              HasSubstr("Roadmap: " + std::to_string(roadmap->roadmap.nodes.size()) + " nodes"));
  keep_picture("roadmap");
}

/// Card that lies over the lower edge.
class LowCard : public gui::FloatingCard {
 public:
  using gui::FloatingCard::appear;
  explicit LowCard(QWidget* host) : FloatingCard(host, "low_card", "legend") {}

 protected:
  void place() override {
    setGeometry(0, parentWidget()->height() - 60, parentWidget()->width(), 60);
  }
};

TEST_F(RoadmapInTheView, HasItsLegendBesideOtherCards) {
  open(cell().post());
  plan();
  const auto& legend = part<gui::RoadmapLegend>("roadmap_legend");
  const QRect place = legend.geometry();
  LowCard card(legend.parentWidget());
  card.appear();
  EXPECT_FALSE(legend.geometry().intersects(card.geometry()));
  card.hide();
  EXPECT_EQ(legend.geometry(), place);
}

TEST_F(RoadmapInTheView, GoesWithItsSwitchAndWithTheScene) {
  open(cell().post());
  plan();
  auto& shown = part<QAction>("samples");
  shown.setChecked(false);
  EXPECT_FALSE(legend_is_shown());
  shown.setChecked(true);
  EXPECT_TRUE(legend_is_shown());
  open(cell().wall());
  EXPECT_FALSE(legend_is_shown());
  EXPECT_EQ(window().session().roadmap(), nullptr);
}

TEST_F(RoadmapInTheView, CountsNodesByTheirPrincipalDirections) {
  open(cell().post());
  window().workbench().plan_settings.choose_planner("pmd-rrt-connect");
  plan();
  ASSERT_TRUE(window().session().roadmap());
  EXPECT_FALSE(window().session().roadmap()->roadmap.winner) << "one search alone";
  EXPECT_THAT(text("roadmap_counts"), HasSubstr("1"));
}

TEST_F(RoadmapInTheView, DoesNotSearchAnyMoreOnceThereIsAPath) {
  open(cell().post());
  window().workbench().plan_settings.choose_planner("pmd-prm");
  widen();
  plan();
  EXPECT_THAT(text("roadmap_note"), Not(HasSubstr("Searching")));
}

class HypercubesInTheView : public RoadmapInTheView {
 protected:
  [[nodiscard]] const gui::HypercubeDisplay& display() const {
    return tool<gui::HypercubeDisplay>();
  }
  [[nodiscard]] bool are_drawn() const {
    return QTest::qWaitFor([&] { return !display().boxes().empty(); }, 8000);
  }
  void plan_with(const char* planner) { plan_with(planner, cell().post()); }
  void plan_with(const char* planner, const std::filesystem::path& scene) {
    open(scene);
    window().workbench().plan_settings.choose_planner(planner);
    widen();
    plan();
  }
};

TEST_F(HypercubesInTheView, AreDrawnWhenTheyAreAskedFor) {
  plan_with("pmd-prm");
  EXPECT_TRUE(display().boxes().empty());
  auto& box = part<QCheckBox>("roadmap_boxes");
  EXPECT_TRUE(box.isVisible());
  box.click();
  EXPECT_TRUE(part<QAction>("hypercubes").isChecked());
  ASSERT_TRUE(are_drawn());
  EXPECT_LE(display().boxes().size(), 66U);
  keep_picture("hypercubes");
  part<QAction>("hypercubes").trigger();
  EXPECT_FALSE(box.isChecked());
  EXPECT_TRUE(display().boxes().empty());
}

TEST_F(HypercubesInTheView, HaveTheSizeOfTheLastIteration) {
  part<QAction>("hypercubes").setChecked(true);
  plan_with("pmd-prm");
  ASSERT_TRUE(are_drawn());
  double largest = 0.0;
  for (const auto& node : window().session().roadmap()->roadmap.nodes) {
    largest = std::max(largest, node.rho_a);
  }
  EXPECT_EQ(display().half_side(), largest);
}

TEST_F(HypercubesInTheView, AreThoseOfTheSearchThatWon) {
  part<QAction>("hypercubes").setChecked(true);
  plan_with("auto", cell().post_aside());
  ASSERT_EQ(window().session().roadmap()->roadmap.winner, 0) << "the trees in the corridor";
  ASSERT_TRUE(are_drawn());
  EXPECT_GT(display().half_side().value(), 0.0);
}

TEST_F(HypercubesInTheView, AreNotOfferedForPlannersWithout) {
  part<QAction>("hypercubes").setChecked(true);
  plan_with("rrt-connect");
  EXPECT_FALSE(part<QCheckBox>("roadmap_boxes").isVisible());
  EXPECT_TRUE(display().boxes().empty());
}

TEST_F(HypercubesInTheView, GoWithTheScene) {
  part<QAction>("hypercubes").setChecked(true);
  plan_with("pmd-prm");
  ASSERT_TRUE(are_drawn());
  open(cell().wall());
  EXPECT_TRUE(display().boxes().empty());
}

}  // namespace
}  // namespace handway::test
