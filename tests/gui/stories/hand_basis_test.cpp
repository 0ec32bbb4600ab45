/// Tests the way from postures to a plan with a user's own basis, for hands of all kinds, with the
/// mouse alone but for the address of a glove, which is typed.
#include "features/glove/glove_panel.h"
#include "features/glove/hand_bases.h"
#include "handway/device/emulators/device_emulator.h"
#include "handway/device/emulators/glove_emulator.h"
#include "handway/device/emulators/glove_signals.h"
#include "handway/device/emulators/landmark_unit.h"
#include "handway/device/glove/hand_exploration.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/landmark_line.h"
#include "handway/device/glove/recording.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/core/objective.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway_test/free_port.h"
#include "patience.h"
#include "watched_application.h"
#include "window_test.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QPushButton>
#include <QSignalSpy>
#include <QTabBar>
#include <QTabWidget>
#include <QTimer>

#include <matio.h>

#include <array>
#include <fstream>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace handway::test {
namespace {

/// Sets the folder in which file dialogs begin, as long as it lives.
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
  const char* mount;  ///< Mount of the hand on the robot `arm`.
  const char* goal;
  const char* finger_joint;
};

/// Sources of the postures. All are of an emulated hand.
enum class Postures {
  kRecording,
  kEmulator,
  kSerialGlove,
  kNetworkGlove,
  kLandmarkStream,
  kLandmarkDatagrams,
  kLandmarkFile,
  kTable,
  kMatlabFile,
};

struct BasisStory {
  ReachingHand hand;
  Postures postures;
  bool by_fingertips = false;  ///< The hand follows by fingertip retargeting.
};

std::string name_of(const BasisStory& story) {
  constexpr std::array kNames{"recording",     "emulator",        "serial_glove",
                              "network_glove", "landmark_stream", "landmark_datagrams",
                              "landmark_file", "table",           "matlab_file"};
  return std::string(story.hand.name) + '_' + kNames.at(static_cast<std::size_t>(story.postures)) +
         (story.by_fingertips ? "_by_fingertips" : "");
}

void PrintTo(const BasisStory& story, std::ostream* out) { *out << name_of(story); }

constexpr int kRows = 1200;
constexpr double kRowRate = 20.0;  // Hz

std::vector<device::GloveAngles> exploring_hand() {
  device::HandExploration hand(1);
  std::vector<device::GloveAngles> rows;
  for (int row = 0; row < kRows; ++row) {
    rows.push_back(hand.at(row / kRowRate));
  }
  return rows;
}

void write_landmark_file(const std::filesystem::path& file) {
  std::ofstream out(file);
  for (const device::GloveAngles& angles : exploring_hand()) {
    out << device::write_landmark_line({angles.time, false, device::hand_landmarks(angles)})
        << '\n';
  }
}

/// Degrees without times, with a label behind each row, and the map that says so.
void write_table(const std::filesystem::path& map) {
  std::ofstream out(map.parent_path() / "postures.txt");
  for (const device::GloveAngles& angles : exploring_hand()) {
    for (const double angle : angles.angles) {
      out << -angle / geometric::kDegree << ';';
    }
    out << "free\r";
  }
  std::ofstream columns(map);
  columns << "table: postures.txt\nseparator: \";\"\nunit: deg\nsigns: negative\nrate: " << kRowRate
          << "\ncolumns:\n";
  for (std::size_t sensor = 0; sensor < device::kGloveSensors; ++sensor) {
    columns << "  " << device::cyberglove_sensors()[sensor].name << ": " << sensor + 1 << '\n';
  }
}

/// Writes a file like Ninapro's: 22 columns of degrees called "angles".
void write_matlab_file(const std::filesystem::path& file) {
  std::vector<double> by_column;
  const std::vector<device::GloveAngles> rows = exploring_hand();
  for (std::size_t sensor = 0; sensor < device::kGloveSensors; ++sensor) {
    for (const device::GloveAngles& angles : rows) {
      by_column.push_back(angles.angles.at(sensor) / geometric::kDegree);
    }
  }
  std::array<std::size_t, 2> size{rows.size(), device::kGloveSensors};
  mat_t* opened = Mat_CreateVer(file.c_str(), nullptr, MAT_FT_MAT5);
  matvar_t* matrix =
      Mat_VarCreate("angles", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), by_column.data(), 0);
  Mat_VarWrite(opened, matrix, MAT_COMPRESSION_ZLIB);
  Mat_VarFree(matrix);
  Mat_Close(opened);
}

class HandBasisStory : public WindowTest, public ::testing::WithParamInterface<BasisStory> {
 protected:
  [[nodiscard]] std::filesystem::path scene(const std::string& robots) const {
    const ReachingHand& how = GetParam().hand;
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
    constexpr int kArrow = 8;  // px from the right edge, also where a text can be typed
    auto& choices = part<QComboBox>(box);
    QTest::mouseClick(&choices, Qt::LeftButton, {},
                      QPoint(choices.width() - kArrow, choices.height() / 2));
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
  [[nodiscard]] bool retargets() const {
    const gui::GloveSession& session = window().findChild<gui::GlovePanel*>()->session();
    return session.source() && session.method() == gui::PostureMethod::kFingertips;
  }
  void picture(const char* step) const {
    QTest::qWait(150);
    const WatchedApplication::LooksAway taking_it_is_no_step_of_a_person;
    QDir().mkpath(QStringLiteral(HANDWAY_PICTURES));
    EXPECT_TRUE(window().grab().save(
        QStringLiteral(HANDWAY_PICTURES "/basis_%1_%2.png")
            .arg(QString::fromStdString(name_of(GetParam())), QLatin1String(step))));
  }

  static void make_files() {
    for (const auto& left : std::filesystem::directory_iterator(folder())) {
      std::filesystem::remove(left.path());
    }
    device::Recording half_a_minute =
        device::read_recording(source_dir() / "resources/recordings/free_hand.csv");
    constexpr Eigen::Index kRecorded = 3000;
    half_a_minute.times.conservativeResize(kRecorded);
    half_a_minute.values.conservativeResize(kRecorded, Eigen::NoChange);
    device::write_recording(half_a_minute, folder() / "my_hand.csv");
    write_landmark_file(folder() / "camera.jsonl");
    write_table(folder() / "table_map.yaml");
    write_matlab_file(folder() / "data_set.mat");
  }
  void open_file(const QString& file) const {
    accept_file(file);
    choose("explorer_source", QStringLiteral("A recording…"));
  }
  /// Until there are postures enough; then ends the connection.
  void connect_and_wait() const {
    constexpr Eigen::Index kEnough = 100;
    click_middle(part<QPushButton>("glove_connect"));
    const gui::CapturePages& capture = window().findChild<gui::GlovePanel*>()->capture();
    ASSERT_TRUE(QTest::qWaitFor([&] { return capture.postures().count() > kEnough; }, kPatienceMs))
        << part<QLabel>("glove_error").text().toStdString();
    click_middle(part<QPushButton>("glove_connect"));
  }
  /// Types an address over what is in the field.
  void connect_to(const std::string& address) const {
    QLineEdit& field = *part<QComboBox>("glove_device").lineEdit();
    click_middle(field);
    QTest::keyClick(&field, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(&field, QString::fromStdString(address));
    connect_and_wait();
  }
  void connect_to_emulated_glove(const device::GloveEmulatorSettings& settings) const {
    const device::GloveEmulator glove(settings, device::exploring_hand_signal(2));
    connect_to(glove.address());
  }
  /// Connects by datagrams that an emulated camera sends to a free port, or over TCP.
  void connect_to_emulated_camera(bool datagrams) const {
    device::DeviceEmulatorSettings settings;
    const std::string port = free_udp_port();
    if (datagrams) {
      settings.udp_receiver = "localhost:" + port;
    } else {
      settings.tcp_port = 0;
    }
    const auto hand = std::make_shared<device::HandExploration>(2);
    const device::DeviceEmulator camera(
        settings, device::make_landmark_unit({}, [hand](double time) { return hand->at(time); }));
    connect_to(datagrams ? "udp://" + port : "landmarks://" + camera.address());
  }
  void take_postures() const {
    switch (GetParam().postures) {
      case Postures::kRecording:
        return open_file(QStringLiteral("my_hand.csv"));
      case Postures::kEmulator:
        choose("glove_device", QStringLiteral("Emulator: no hardware needed"));
        return connect_and_wait();
      case Postures::kSerialGlove:
        return connect_to_emulated_glove({});
      case Postures::kNetworkGlove: {
        device::GloveEmulatorSettings on_tcp;
        on_tcp.tcp_port = 0;
        return connect_to_emulated_glove(on_tcp);
      }
      case Postures::kLandmarkStream:
        return connect_to_emulated_camera(false);
      case Postures::kLandmarkDatagrams:
        return connect_to_emulated_camera(true);
      case Postures::kLandmarkFile:
        return open_file(QStringLiteral("camera.jsonl"));
      case Postures::kTable:
        return open_file(QStringLiteral("table_map.yaml"));
      case Postures::kMatlabFile:
        return open_file(QStringLiteral("data_set.mat"));
    }
  }
  /// Returns one folder for all, because file dialogs continue where the last one ended.
  [[nodiscard]] static const std::filesystem::path& folder() {
    static const ScratchFolder kFolder;
    return kFolder.path();
  }
};

TEST_P(HandBasisStory, MakesABasisOfPosturesAndPlansWithIt) {
  std::string robots;
  if (GetParam().hand.is_reference) {
    HANDWAY_NEED_REFERENCE(reference);
    robots = (reference / "robots").string() + '/';
  }
  const CurrentFolder dialogs_begin_in(folder());
  make_files();
  open(scene(robots));
  ASSERT_EQ(window().message(), QString());
  ASSERT_FALSE(window().document().loaded().basis);
  picture("1_opened");

  show_page(QStringLiteral("Explore"));
  if (GetParam().by_fingertips) {
    choose("explorer_method", QStringLiteral("Fingertip retargeting"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return retargets(); }, kPatienceMs));
  }
  take_postures();
  ASSERT_FALSE(::testing::Test::HasFatalFailure());
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return part<QPushButton>("basis_use").isEnabled(); }, kPatienceMs))
      << part<QLabel>("glove_error").text().toStdString();
  picture("2_postures");

  accept_file({});
  click_middle(part<QPushButton>("basis_use"));
  const auto basis = window().document().loaded().basis;
  ASSERT_TRUE(basis);
  EXPECT_THAT(basis->joints, ::testing::Contains(GetParam().hand.finger_joint));
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
  // Hardly more than if the hand went straight to the subspace and left it for the goal only.
  ASSERT_TRUE(quality.human_likeness);
  EXPECT_LT(quality.human_likeness->mean - quality.human_likeness->forced, 0.05);
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

const std::array kShipped{ReachingHand{"allegro", false, "iiwa14_class", "allegro_class_right",
                                       kOnFlange, kDown, "index_proximal"},
                          ReachingHand{"shadow", false, "iiwa14_class", "shadow_class_right",
                                       kOnFlange, kDown, "little_medial"}};
const std::array kOfReference{
    ReachingHand{"allegro_reference", true, "iiwa14/iiwa14.urdf",
                 "allegro_hand/allegro_hand_right.urdf", kAlongX, kReferenceDown, "joint_1.0"},
    ReachingHand{"shadow_reference", true, "iiwa14/iiwa14.urdf",
                 "shadow_hand/shadow_hand_right.urdf", kAlongX, kReferenceDown, "FFJ3"}};

std::vector<BasisStory> stories() {
  std::vector<BasisStory> all;
  for (const ReachingHand& hand : kShipped) {
    for (int postures = 0; postures <= static_cast<int>(Postures::kMatlabFile); ++postures) {
      all.push_back({hand, static_cast<Postures>(postures)});
    }
    all.push_back({hand, Postures::kRecording, true});
    all.push_back({hand, Postures::kLandmarkStream, true});
  }
  for (const ReachingHand& hand : kOfReference) {
    all.push_back({hand, Postures::kRecording});
    all.push_back({hand, Postures::kRecording, true});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Hands, HandBasisStory, ::testing::ValuesIn(stories()),
                         [](const auto& made) { return name_of(made.param); });

}  // namespace
}  // namespace handway::test
