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

#include <fstream>
#include <ostream>
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

/// A hand on an arm that is to reach past a bar. Names of files and links are as in a scene.
struct ReachingHand {
  const char* name;
  bool is_reference;  ///< Its files are in the reference robots.
  const char* arm;
  const char* hand;
  const char* mount;  ///< Of the hand on the robot `arm`.
  const char* goal;
  const char* finger_joint;
};

void PrintTo(const ReachingHand& hand, std::ostream* out) { *out << hand.name; }

class HandBasisStory : public WindowTest, public ::testing::WithParamInterface<ReachingHand> {
 protected:
  [[nodiscard]] std::filesystem::path scene(const std::string& robots) const {
    const ReachingHand& how = GetParam();
    const std::filesystem::path file = folder() / "reach.yaml";
    std::ofstream(file) << "handway: 1\nrobots:\n  - {name: arm, model: " << robots << how.arm
                        << "}\n  - {name: hand, model: " << robots << how.hand
                        << ", mount: {robot: arm, " << how.mount << "}}\nobjects:\n"
                        << "  - {name: bar, box: {size: [0.05, 0.5, 0.05]}, pose: {xyz: [0.7, 0, "
                           "1.0]}}\nstart: {}\ngoal: {"
                        << how.goal << "}\n";
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

  /// The same for all, as file dialogs go on where the last one ended.
  [[nodiscard]] static const std::filesystem::path& folder() {
    static const ScratchFolder kFolder;
    return kFolder.path();
  }
};

TEST_P(HandBasisStory, MakesABasisOfARecordingAndPlansWithIt) {
  std::string robots;
  if (GetParam().is_reference) {
    HANDWAY_NEED_REFERENCE(reference);
    robots = (reference / "robots").string() + '/';
  }
  const CurrentFolder dialogs_begin_in(folder());
  std::filesystem::copy(source_dir() / "resources/recordings/free_hand.csv",
                        folder() / "my_hand.csv",
                        std::filesystem::copy_options::overwrite_existing);
  open(scene(robots));
  ASSERT_EQ(window().message(), QString());
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
  EXPECT_THAT(basis->joints, ::testing::Contains(GetParam().finger_joint));
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

constexpr const char* kOnFlange = "link: flange_link";
constexpr const char* kAlongX = "link: ee_link, pose: {xyz: [0.1, 0, 0], rpy_deg: [0, 90, 0]}";
constexpr const char* kDown = "joint_2: 0.7, joint_4: -1.57, joint_6: -0.7";
constexpr const char* kReferenceDown = "A2: 0.7, A4: -1.57, A6: -0.7";

INSTANTIATE_TEST_SUITE_P(
    Hands, HandBasisStory,
    ::testing::Values(ReachingHand{"allegro", false, "iiwa14_class", "allegro_class_right",
                                   kOnFlange, kDown, "index_proximal"},
                      ReachingHand{"shadow", false, "iiwa14_class", "shadow_class_right", kOnFlange,
                                   kDown, "little_medial"},
                      ReachingHand{"allegro_reference", true, "iiwa14/iiwa14.urdf",
                                   "allegro_hand/allegro_hand_right.urdf", kAlongX, kReferenceDown,
                                   "joint_1.0"},
                      ReachingHand{"shadow_reference", true, "iiwa14/iiwa14.urdf",
                                   "shadow_hand/shadow_hand_right.urdf", kAlongX, kReferenceDown,
                                   "FFJ3"}),
    [](const auto& made) { return std::string(made.param.name); });

}  // namespace
}  // namespace handway::test
