/// Postures by name: kept in the scene, gone to, forgotten.
#include "features/editing/editing_test.h"
#include "handway/geometric/formats/scene_file.h"

#include <QAction>
#include <QComboBox>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QTimer>

namespace handway::test {
namespace {

using ::testing::Contains;
using ::testing::Not;

class NamedPostures : public EditingTest {
 protected:
  /// Fills in the dialog that is about to open, and accepts it.
  void keep(const char* name, int choice = 0) const {
    QTimer::singleShot(0, &window(), [this, name, choice] {
      part_of_dialog<QLineEdit>("posture_name").setText(QString::fromUtf8(name));
      part_of_dialog<QComboBox>("posture_part").setCurrentIndex(choice);
      keep_picture("keep_posture");
      part_of_dialog<QPushButton>("posture_keep").click();
    });
    part<QAction>("keep_posture").trigger();
  }
  [[nodiscard]] std::vector<std::string> listed() const {
    std::vector<std::string> texts;
    for (const QAction* action : part<QPushButton>("postures").menu()->actions()) {
      texts.push_back(action->text().toStdString());
    }
    return texts;
  }
  void go_to(const char* name) const {
    for (QAction* action : part<QPushButton>("postures").menu()->actions()) {
      if (action->text() == QLatin1String(name)) {
        action->trigger();
      }
    }
  }
  void stand(double shoulder, double elbow) const {
    window().document().set_configuration(Eigen::Vector4d(shoulder, elbow, 0.0, 0.0));
  }
  [[nodiscard]] const geometric::Configuration& shown() const {
    return window().document().configuration();
  }

 private:
  template <typename Widget>
  [[nodiscard]] static Widget& part_of_dialog(const char* name) {
    return *QApplication::activeModalWidget()->findChild<Widget*>(QLatin1String(name));
  }
};

TEST_F(NamedPostures, AreKeptGoneToAndForgotten) {
  stand(0.4, 0.9);
  keep("aside");
  EXPECT_EQ(editor().undo_stack().undoText(), "Save posture aside");
  stand(0.0, 0.0);
  go_to("aside");
  EXPECT_EQ(shown(), Eigen::Vector4d(0.4, 0.9, 0.0, 0.0));
  part<QMenu>("forget_posture").actions().front()->trigger();
  EXPECT_THAT(listed(), Not(Contains("aside")));
  editor().undo_stack().undo();
  EXPECT_THAT(listed(), Contains("aside"));
  editor().undo_stack().undo();
  EXPECT_TRUE(scene().postures.empty());
}

TEST_F(NamedPostures, MayBeThoseOfThePartsOfARobot) {
  stand(0.4, 0.9);
  keep("arm aside", 1);
  window().document().set_configuration(Eigen::Vector4d(0.0, 0.0, 0.1, 0.2));
  go_to("arm aside");
  EXPECT_EQ(shown(), Eigen::Vector4d(0.4, 0.9, 0.1, 0.2)) << "the hand stays as it is";
}

TEST_F(NamedPostures, TakeThePlaceOfTheOneOfTheirName) {
  stand(0.4, 0.9);
  keep("aside");
  stand(-0.2, 0.1);
  keep("aside");
  ASSERT_EQ(scene().postures.size(), 1U);
  stand(0.0, 0.0);
  go_to("aside");
  EXPECT_EQ(shown()[0], -0.2);
}

TEST_F(NamedPostures, AreSavedWithTheScene) {
  stand(0.4, 0.9);
  keep("aside");
  const auto file = cell().folder() / "with_posture.yaml";
  geometric::write_scene(scene(), file);
  editor().undo_stack().setClean();
  open(file);
  EXPECT_THAT(listed(), Contains("aside"));
}

TEST_F(NamedPostures, DoNotCostThePath) {
  plan();
  const std::string before = result();
  keep("here");
  EXPECT_EQ(result(), before);
}

}  // namespace
}  // namespace handway::test
