/// From a recording to a plan with a basis of one's own, for hands of all kinds, with the mouse
/// alone.
#include "features/glove/glove_panel.h"
#include "features/glove/hand_bases.h"
#include "handway/planning/core/objective.h"
#include "handway/sampling/postures/pmd_basis_io.h"
#include "patience.h"
#include "watched_application.h"
#include "window_test.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QLabel>
#include <QListView>
#include <QPushButton>
#include <QSignalSpy>
#include <QTabBar>
#include <QTabWidget>
#include <QTimer>

#include <algorithm>
#include <fstream>
#include <string>

namespace handway::test {
namespace {

/// Where file dialogs begin, as long as it lives.
class CurrentFolder {
 public:
  explicit CurrentFolder(const std::filesystem::path& folder) : before_(QDir::currentPath()) {
    QDir::setCurrent(QString::fromStdString(folder.string()));
  }
  ~CurrentFolder() { QDir::setCurrent(before_); }
  CurrentFolder(const CurrentFolder&) = delete;
  CurrentFolder& operator=(const CurrentFolder&) = delete;

 private:
  QString before_;
};

/// A hand on an arm that is to reach past a bar for a can.
struct ReachingHand {
  const char* name;
  const char* file;   ///< In the reference robots.
  double offset;      ///< From the arm's link to the hand's root, m.
  const char* first;  ///< A joint of a finger.
};

class HandBasisStory : public WindowTest, public ::testing::WithParamInterface<ReachingHand> {
 protected:
  [[nodiscard]] std::filesystem::path scene(const std::filesystem::path& robots) const {
    const std::filesystem::path file = folder_.path() / "reach.yaml";
    std::ofstream(file) << "handway: 1\nrobots:\n  - {name: arm, model: "
                        << (robots / "iiwa14/iiwa14.urdf").string()
                        << "}\n  - {name: hand, model: " << (robots / GetParam().file).string()
                        << ", mount: {robot: arm, link: ee_link, pose: {xyz: [" << GetParam().offset
                        << ", 0, 0], rpy_deg: [0, 90, 0]}}}\nobjects:\n"
                        << "  - {name: bar, box: {size: [0.05, 0.5, 0.05]}, pose: {xyz: [0.7, 0, "
                           "1.0]}}\nstart: {}\ngoal: {A2: 0.7, A4: -1.57, A6: -0.7}\n";
    return file;
  }

  static void click_middle(QWidget& widget) {
    QTest::mouseClick(&widget, Qt::LeftButton, {}, widget.rect().center());
  }
  static void click_item(QAbstractItemView& view, const QModelIndex& index) {
    view.scrollTo(index);
    QTest::mouseClick(view.viewport(), Qt::LeftButton, {}, view.visualRect(index).center());
  }
  void choose(const char* box, const QString& text) const {
    auto& choices = part<QComboBox>(box);
    click_middle(choices);
    ASSERT_TRUE(QTest::qWaitFor([&] { return choices.view()->isVisible(); }, kPatienceMs));
    const int row = choices.findText(text);
    ASSERT_GE(row, 0) << text.toStdString();
    // A release soon after the list has opened does not choose yet.
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
          click_item(*choices.view(), choices.model()->index(row, choices.modelColumn()));
          return !choices.view()->isVisible();
        },
        kPatienceMs));
  }
  void show_page(const QString& page) const {
    auto& tabs = part<QTabWidget>("control_tabs");
    for (int i = 0; i < tabs.count(); ++i) {
      if (tabs.tabText(i) == QStringLiteral("Glove")) {
        QTest::mouseClick(tabs.tabBar(), Qt::LeftButton, {}, tabs.tabBar()->tabRect(i).center());
      }
    }
    auto& pages = part<QTabBar>("glove_pages");
    for (int i = 0; i < pages.count(); ++i) {
      if (pages.tabText(i) == page) {
        QTest::mouseClick(&pages, Qt::LeftButton, {}, pages.tabRect(i).center());
      }
    }
  }
  /// Clicks on the file of that name (empty: takes the one that is offered) and on the button that
  /// accepts, once the dialog is there.
  static void accept_file(const QString& name) {
    QTimer::singleShot(0, [name] {
      auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (!dialog) {
        accept_file(name);
        return;
      }
      if (!name.isEmpty()) {
        auto* list = dialog->findChild<QListView*>(QStringLiteral("listView"));
        const auto found = [&] {
          return list->model()->match(list->model()->index(0, 0, list->rootIndex()),
                                      Qt::DisplayRole, name, 1, Qt::MatchExactly);
        };
        ASSERT_TRUE(QTest::qWaitFor([&] { return !found().isEmpty(); }, kPatienceMs));
        click_item(*list, found().front());
      }
      auto* buttons = dialog->findChild<QDialogButtonBox*>();
      click_middle(*buttons->button(dialog->acceptMode() == QFileDialog::AcceptSave
                                        ? QDialogButtonBox::Save
                                        : QDialogButtonBox::Open));
    });
  }
  void picture(const char* step) const {
    QTest::qWait(150);
    const WatchedApplication::LooksAway taking_it_is_no_step_of_a_person;
    QDir().mkpath(QStringLiteral(HANDWAY_PICTURES));
    EXPECT_TRUE(
        window().grab().save(QStringLiteral(HANDWAY_PICTURES "/basis_%1_%2.png")
                                 .arg(QLatin1String(GetParam().name), QLatin1String(step))));
  }

  ScratchFolder folder_;
};

TEST_P(HandBasisStory, MakesABasisOfARecordingAndPlansWithIt) {
  HANDWAY_NEED_REFERENCE(reference);
  const CurrentFolder dialogs_begin_in(folder_.path());
  std::filesystem::copy(source_dir() / "resources/recordings/free_hand.csv",
                        folder_.path() / "my_hand.csv");
  open(scene(reference / "robots"));
  ASSERT_FALSE(window().document().loaded().basis);
  picture("1_opened");

  show_page(QStringLiteral("Explore"));
  accept_file(QStringLiteral("my_hand.csv"));
  choose("explorer_source", QStringLiteral("A recording…"));
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return part<QPushButton>("basis_use").isEnabled(); }, kPatienceMs))
      << part<QLabel>("glove_error").text().toStdString();
  picture("2_postures");

  accept_file({});
  click_middle(part<QPushButton>("basis_use"));
  const auto basis = window().document().loaded().basis;
  ASSERT_TRUE(basis);
  EXPECT_THAT(basis->joints, ::testing::Contains(GetParam().first));
  EXPECT_EQ(basis->directions.size(), 4U);
  const std::filesystem::path file = window().document().scene()->hand_basis;
  EXPECT_THAT(file.string(), ::testing::EndsWith("_basis.yaml"));
  EXPECT_EQ(sampling::read_pmd_basis(file).joints, basis->joints);
  picture("3_basis");

  plan();
  ASSERT_FALSE(window().player().timeline().empty()) << result();
  const planning::PlanningProblem problem =
      planning::make_problem(window().document().scene(), window().document().loaded().basis);
  const planning::PathQuality quality =
      planning::path_quality(problem, window().player().timeline().path());
  ASSERT_TRUE(quality.human_likeness);
  EXPECT_LT(quality.human_likeness->mean, 1.0);
  picture("4_planned");

  window().editor().undo_stack().undo();
  EXPECT_FALSE(window().document().loaded().basis);
  EXPECT_TRUE(window().document().scene()->hand_basis.empty());
  window().editor().undo_stack().redo();
  EXPECT_EQ(window().document().loaded().basis, basis);
}

INSTANTIATE_TEST_SUITE_P(
    Hands, HandBasisStory,
    ::testing::Values(ReachingHand{"allegro", "allegro_hand/allegro_hand_right.urdf", 0.1,
                                   "joint_1.0"},
                      ReachingHand{"shadow", "shadow_hand/shadow_hand_right.urdf", 0.0, "FFJ3"}),
    [](const auto& made) { return std::string(made.param.name); });

}  // namespace
}  // namespace handway::test
