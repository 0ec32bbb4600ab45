#include "panels/roadmap_legend.h"
#include "window_test.h"

#include <QAction>
#include <QLabel>
#include <QTextDocument>

#include <numeric>

namespace handway::test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

class RoadmapInTheView : public WindowTest {
 protected:
  [[nodiscard]] std::string text(const char* label) const {
    QTextDocument document;
    document.setHtml(part<QLabel>(label).text());
    return document.toPlainText().toStdString();
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
  window().plan_panel().choose_planner("pmd-rrt-connect");
  plan();
  ASSERT_TRUE(window().session().roadmap());
  EXPECT_FALSE(window().session().roadmap()->roadmap.winner) << "one search alone";
  EXPECT_THAT(text("roadmap_counts"), HasSubstr("1"));
}

}  // namespace
}  // namespace handway::test
