#include "features/glove/mapping_editor.h"

#include "features/glove/joint_mapping_form.h"
#include "features/glove/mapping_wires.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/recording.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "patience.h"
#include "pressed_mouse.h"
#include "window_test.h"

#include <QComboBox>
#include <QLineEdit>
#include <QPushButton>

#include <handway_test/paths.h>

#include <fstream>
#include <sstream>

namespace handway::test {
namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class MappingEditor : public ::testing::Test {
 protected:
  void SetUp() override {
    HANDWAY_NEED_DISPLAY();
    session_ = std::make_unique<gui::GloveSession>();
    editor_ = std::make_unique<gui::MappingEditor>(*session_, history_);
    editor_->resize(340, 700);
    editor_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(editor_.get()));
  }

  template <typename Widget>
  [[nodiscard]] Widget& part(const char* name) const {
    return *editor_->findChild<Widget*>(QLatin1String(name));
  }
  [[nodiscard]] gui::MappingWires& wires() const {
    return part<gui::MappingWires>("mapping_wires");
  }
  void drag(const char* letter, int joint) const {
    const int sensor = device::find_sensor(letter).value();
    QTest::mousePress(&wires(), Qt::LeftButton, {}, wires().sensor_handle(sensor).toPoint());
    move_pressed_mouse(wires(), wires().joint_handle(joint).toPoint());
    QTest::mouseRelease(&wires(), Qt::LeftButton, {}, wires().joint_handle(joint).toPoint());
  }
  void type(const char* field, const char* text) const {
    auto& edit = part<QLineEdit>(field);
    edit.setFocus();
    edit.selectAll();
    QTest::keyClicks(&edit, QLatin1String(text));
    QTest::keyClick(&edit, Qt::Key_Return);
  }

  QUndoStack history_;
  std::unique_ptr<gui::GloveSession> session_;
  std::unique_ptr<gui::MappingEditor> editor_;
};

TEST_F(MappingEditor, RebuildsTable1ByteForByte) {
  editor_->clear();
  EXPECT_EQ(session_->mapping().joints[0].sensor, -1);
  const char* const letters[] = {"c", "c", "e", "f", "j", "g", "h", "", "k", "l", "n", "o", "p"};
  for (int joint = 0; joint < 13; ++joint) {
    if (*letters[joint] == '\0') {
      continue;
    }
    drag(letters[joint], joint);
    if (joint == 1) {
      type("wire_gain", "-1/3");
      type("wire_offset", "15");
    } else if (joint != 10) {
      type("wire_gain", "-1");
    }
  }
  type("mapping_source", device::table1_mapping().source.c_str());
  const ScratchFolder folder;
  editor_->save(folder.path() / "mine.yaml");
  EXPECT_EQ(content_of(folder.path() / "mine.yaml"),
            content_of(source_dir() / "resources/mappings/table1_sah.yaml"));
}

TEST_F(MappingEditor, TakesACurveInPlaceOfGainAndOffset) {
  drag("h", 6);
  type("wire_curve", "0:-4, 45:-52, 97:-75");
  const device::JointMapping& mapped = session_->mapping().joints[6];
  ASSERT_EQ(mapped.curve.size(), 3U);
  EXPECT_NEAR(mapped.curve[1].angle, 45.0 * geometric::kDegree, 1e-12);
  EXPECT_NEAR(mapped.curve[2].joint, -75.0 * geometric::kDegree, 1e-12);
}

TEST_F(MappingEditor, DrawsACurveWithTheMouse) {
  editor_->set_hand(
      geometric::load_robot(geometric::find_resource(geometric::ResourceKind::kRobot, "sah_right",
                                                     std::filesystem::current_path(), "")),
      {});
  drag("h", 6);
  auto* view = editor_->findChild<gui::CurveView*>();
  ASSERT_TRUE(view);
  const auto at = [&](double sensor, double joint) {
    return view->place_of(sensor * geometric::kDegree, joint * geometric::kDegree).toPoint();
  };
  const auto curve = [&] { return session_->mapping().joints[6].curve; };
  QTest::mousePress(view, Qt::LeftButton, {}, at(40, -30));
  ASSERT_EQ(curve().size(), 3U) << "both ends of the straight wire, and the point";
  move_pressed_mouse(*view, at(60, -20));
  QTest::mouseRelease(view, Qt::LeftButton, {}, at(60, -20));
  ASSERT_EQ(curve().size(), 3U);
  EXPECT_NEAR(curve()[1].angle, 60.0 * geometric::kDegree, 1.5 * geometric::kDegree);
  EXPECT_NEAR(curve()[1].joint, -20.0 * geometric::kDegree, 1.5 * geometric::kDegree);
  const ScratchFolder folder;
  editor_->save(folder.path() / "curve.yaml");
  EXPECT_EQ(device::read_mapping(folder.path() / "curve.yaml").joints[6].curve.size(), 3U);
  QTest::mouseClick(view, Qt::RightButton, {}, at(60, -20));
  ASSERT_EQ(curve().size(), 2U);
  QTest::mouseClick(view, Qt::RightButton, {},
                    view->place_of(curve()[0].angle, curve()[0].joint).toPoint());
  EXPECT_TRUE(curve().empty()) << "straight again";
}

TEST_F(MappingEditor, KeepsTheWireIfANumberIsNone) {
  drag("h", 6);
  type("wire_gain", "much");
  EXPECT_EQ(session_->mapping().joints[6].gain, -1.0);
}

TEST_F(MappingEditor, OpensWhatItSaved) {
  drag("d", 1);
  const ScratchFolder folder;
  editor_->save(folder.path() / "d.yaml");
  editor_->clear();
  editor_->open(folder.path() / "d.yaml");
  EXPECT_EQ(session_->mapping().joints[1].sensor, device::find_sensor("d").value());
}

TEST_F(MappingEditor, AsksForMotionBeforeItCompares) {
  editor_->compare_with(device::table1_mapping(), "Table 1");
  EXPECT_TRUE(editor_->comparison().contains(QStringLiteral("Move the glove")));
}

class FittedInTheWindow : public MappingEditor {
 protected:
  void SetUp() override {
    MappingEditor::SetUp();
    if (!IsSkipped()) {
      editor_->set_hand(hand("sah_right"), {});
      motion_ = device::to_angles(
          device::read_recording(source_dir() / "resources/recordings/free_hand.csv"),
          device::typical_calibration());
    }
  }
  static std::shared_ptr<const geometric::RobotModel> hand(const char* name) {
    return geometric::load_robot(geometric::find_resource(geometric::ResourceKind::kRobot, name,
                                                          std::filesystem::current_path(), ""));
  }
  /// The session's mapping as its file would be.
  [[nodiscard]] std::string mapping() const {
    const ScratchFolder folder;
    device::write_mapping(session_->mapping(), folder.path() / "mapping.yaml");
    return content_of(folder.path() / "mapping.yaml");
  }
  [[nodiscard]] QPushButton& choices() const { return part<QPushButton>("mapping_choices"); }
  void wait_for_the_end() const {
    ASSERT_TRUE(QTest::qWaitFor([this] { return choices().isEnabled(); }, kPatienceMs));
  }

  device::Recording motion_;
};

TEST_F(FittedInTheWindow, ItsChoicesWaitUntilItIsDoneInTheBackground) {
  const std::string before = mapping();
  editor_->fit(motion_);
  EXPECT_FALSE(choices().isEnabled());
  EXPECT_EQ(choices().text(), QStringLiteral("Fitting…"));
  EXPECT_EQ(mapping(), before) << "nothing was done on the window's thread";
  wait_for_the_end();
  EXPECT_NE(mapping(), before);
  EXPECT_TRUE(editor_->comparison().contains(QStringLiteral("Fitted to")));
  EXPECT_EQ(choices().text(), QStringLiteral("Mapping"));
  history_.undo();
  EXPECT_EQ(mapping(), before);
}

TEST_F(FittedInTheWindow, AnotherHandOrMappingEndsItWithoutEffect) {
  const std::string before = mapping();
  editor_->fit(motion_);
  editor_->set_hand(hand("allegro_class_right"), {});
  EXPECT_TRUE(choices().isEnabled());
  editor_->set_hand(hand("sah_right"), {});
  editor_->fit(motion_);
  editor_->clear();
  EXPECT_TRUE(choices().isEnabled());
  const std::string cleared = mapping();
  QTest::qWait(400);  // longer than a fit
  EXPECT_EQ(mapping(), cleared);
  EXPECT_EQ(history_.count(), 1);
}

TEST_F(FittedInTheWindow, AsksForMoreMotionThanAFewFrames) {
  motion_.times.conservativeResize(50);
  motion_.values.conservativeResize(50, Eigen::NoChange);
  editor_->fit(motion_);
  wait_for_the_end();
  EXPECT_TRUE(editor_->comparison().contains(QStringLiteral("make a fist")));
}

TEST(WireNumbers, MayBeRatios) {
  EXPECT_EQ(gui::parse_ratio("-1/3"), -1.0 / 3.0);
  EXPECT_EQ(gui::parse_ratio(" 0.5 "), 0.5);
  EXPECT_FALSE(gui::parse_ratio("1/0"));
  EXPECT_FALSE(gui::parse_ratio("1/2/3"));
  EXPECT_FALSE(gui::parse_ratio("a"));
}

TEST(WireCurves, NeedRisingAngles) {
  EXPECT_FALSE(gui::parse_curve("0:1"));
  EXPECT_FALSE(gui::parse_curve("0:1, 0:2"));
  EXPECT_FALSE(gui::parse_curve("0:1, x:2"));
  EXPECT_EQ(gui::curve_text(gui::parse_curve("0:-4, 45:-52").value()), "0:-4, 45:-52");
}

}  // namespace
}  // namespace handway::test
