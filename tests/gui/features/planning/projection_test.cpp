#include "features/editing/scene_editing.h"
#include "features/planning/planning_commands.h"
#include "features/planning/projection_panel.h"
#include "features/planning/projection_tool.h"
#include "model/document/scene_editor.h"
#include "widgets/plots/projection_plot.h"
#include "window_test.h"

#include <QComboBox>
#include <QLabel>
#include <QUndoStack>

namespace handway::test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

class ProjectionOfTheRoadmap : public WindowTest {
 protected:
  void show_projection() {
    window().resize(1200, 860);
    show_dock("projection");
  }
  void settle() {
    ASSERT_TRUE(QTest::qWaitFor([&] { return !tool().is_busy(); }));
  }
  [[nodiscard]] gui::ProjectionTool& tool() const {
    return WindowTest::tool<gui::ProjectionTool>();
  }
  [[nodiscard]] gui::ProjectionPlot& plot() const { return tool().panel()->plot(); }
  [[nodiscard]] QPoint place_of(int node) const {
    return plot().place_of(plot().roadmap().nodes.at(static_cast<std::size_t>(node)).place);
  }
};

TEST_F(ProjectionOfTheRoadmap, SaysWhatItIsForAtFirst) {
  open(cell().post());
  show_projection();
  EXPECT_TRUE(part<QLabel>("projection_empty").isVisible());
  keep_picture("projection_empty");
}

TEST_F(ProjectionOfTheRoadmap, HasADotForEveryNode) {
  open(cell().post());
  show_projection();
  plan();
  settle();
  const auto& roadmap = window().session().roadmap()->roadmap;
  EXPECT_THAT(plot().roadmap().nodes, SizeIs(roadmap.nodes.size()));
  EXPECT_EQ(plot().roadmap().edges, roadmap.edges);
  EXPECT_GT(plot().roadmap().path.size(), 10);
  EXPECT_NEAR(plot().roadmap().start.x(), 0.0, 1e-9);
  EXPECT_NEAR(plot().roadmap().goal.x(), 1.0, 1e-9);
  EXPECT_THAT(part<QLabel>("projection_note").text().toStdString(), HasSubstr("nodes"));
  keep_picture("projection");
}

TEST_F(ProjectionOfTheRoadmap, MovesTheRobotToANodeThatIsClicked) {
  open(cell().post());
  show_projection();
  plan();
  settle();
  const int undo = window().editor().undo_stack().count();
  window().player().play();
  const auto& nodes = window().session().roadmap()->roadmap.nodes;
  const int last = static_cast<int>(nodes.size()) - 1;
  QTest::mouseClick(plot().canvas(), Qt::LeftButton, Qt::NoModifier, place_of(last));
  const std::optional<int> clicked = plot().node_at(place_of(last));
  ASSERT_TRUE(clicked) << "nodes may lie on each other";
  EXPECT_EQ(window().document().configuration(), nodes[static_cast<std::size_t>(*clicked)].q);
  EXPECT_FALSE(window().player().is_playing());
  EXPECT_EQ(window().editor().undo_stack().count(), undo) << "nothing to undo";
  QTest::mouseClick(plot().canvas(), Qt::LeftButton, Qt::NoModifier, QPoint(2, 2));
  EXPECT_EQ(window().document().configuration(), nodes[static_cast<std::size_t>(*clicked)].q);
}

TEST_F(ProjectionOfTheRoadmap, TellsWhatIsUnderThePointer) {
  open(cell().post());
  show_projection();
  plan();
  settle();
  QMouseEvent move(QEvent::MouseMove, place_of(1), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QCoreApplication::sendEvent(plot().canvas(), &move);
  EXPECT_THAT(part<QLabel>("projection_note").text().toStdString(), HasSubstr("Node"));
}

TEST_F(ProjectionOfTheRoadmap, ShowsOtherCoordinates) {
  open(cell().post());
  show_projection();
  plan();
  settle();
  auto& across = part<QComboBox>("projection_x");
  EXPECT_EQ(across.currentText(), "Along the arm's path, start to goal");
  EXPECT_EQ(part<QComboBox>("projection_y").currentText(), "PMD 1");
  across.setCurrentText("Distance from the arm's path");
  EXPECT_NEAR(plot().roadmap().start.x(), 0.0, 1e-9);
  EXPECT_NEAR(plot().roadmap().goal.x(), 0.0, 1e-9);
  plan();
  settle();
  EXPECT_EQ(across.currentText(), "Distance from the arm's path") << "stays for the next run";
}

TEST_F(ProjectionOfTheRoadmap, CatchesUpWhenItIsShown) {
  open(cell().post());
  plan();
  EXPECT_TRUE(plot().roadmap().nodes.empty()) << "nobody looks";
  show_projection();
  settle();
  EXPECT_FALSE(plot().roadmap().nodes.empty());
  open(cell().wall());
  EXPECT_TRUE(plot().roadmap().nodes.empty()) << "of another scene";
  EXPECT_TRUE(part<QLabel>("projection_empty").isVisible());
}

}  // namespace
}  // namespace handway::test
