/// The image of a depth camera becomes a table and a can, which the hand grasps: by mouse and keys.
#include "dropped_file.h"
#include "features/editing/cloud_import_dialog.h"
#include "hands_on.h"
#include "handway_test/paths.h"

#include <QCheckBox>
#include <QImage>
#include <QPushButton>
#include <QTimer>
#include <QTreeWidget>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace handway::test {
namespace {

using Eigen::Vector3d;

constexpr double kMiss = std::numeric_limits<double>::infinity();

/// A ray p + t d; hits are values of t.
struct Ray {
  Vector3d p;
  Vector3d d;

  [[nodiscard]] double hit_box(const Vector3d& lower, const Vector3d& upper) const {
    const Eigen::Array3d a = (lower - p).array() / d.array(), b = (upper - p).array() / d.array();
    const double in = a.min(b).maxCoeff(), out = a.max(b).minCoeff();
    return in > 0.0 && in <= out ? in : kMiss;
  }
  /// The side or the top of an upright cylinder that stands at `foot`.
  [[nodiscard]] double hit_can(const Vector3d& foot, double radius, double height) const {
    const Eigen::Vector2d o = (p - foot).head<2>(), e = d.head<2>();
    const double half = o.dot(e),
                 root = half * half - e.squaredNorm() * (o.squaredNorm() - radius * radius);
    const double side = root < 0.0 ? kMiss : (-half - std::sqrt(root)) / e.squaredNorm();
    const double z = p.z() + side * d.z() - foot.z();
    const double top = (foot.z() + height - p.z()) / d.z();
    const bool on_top = (o + top * e).norm() <= radius;
    return std::min(z > 0.0 && z < height ? side : kMiss, on_top && top > 0.0 ? top : kMiss);
  }
};

/// A camera of 640 x 480 pixels with a focal length of 525 that looks down at 30 degrees.
class DepthCameraOnTable {
 public:
  /// Depths of the optical frame, mm: a table 0.7 m high, a can of 66 mm, and a box.
  [[nodiscard]] static QImage image() {
    QImage image(640, 480, QImage::Format_Grayscale16);
    const Eigen::Matrix3d R_WBody = geometric::pose_from_rpy({0, 0, 0}, 0.0, kPitch, kYaw).linear();
    for (int v = 0; v < image.height(); ++v) {
      auto* row = reinterpret_cast<quint16*>(image.scanLine(v));
      for (int u = 0; u < image.width(); ++u) {
        const Vector3d forwards(1.0, -(u - 319.5) / 525.0, -(v - 239.5) / 525.0);
        const Ray ray{{1.9, 0.9, 1.5}, R_WBody * forwards};
        const double depth = std::min({ray.hit_box({0.5, -0.6, 0.67}, {1.2, 0.8, 0.7}),
                                       ray.hit_box({0.55, 0.45, 0.7}, {0.75, 0.65, 0.9}),
                                       ray.hit_can({0.76, 0.14, 0.7}, 0.033, 0.12)});
        row[u] = static_cast<quint16>(depth < 5.0 ? std::round(1000.0 * depth) : 0.0);
      }
    }
    return image;
  }
  static constexpr double kPitch = 30.0 * std::numbers::pi / 180.0;
  static constexpr double kYaw = -144.0 * std::numbers::pi / 180.0;
};

class CameraStory : public HandsOn {
 protected:
  /// The shipped scene with the robot on its pedestal, and nothing else.
  [[nodiscard]] std::filesystem::path empty_cell() const {
    geometric::Scene scene = geometric::read_scene(source_dir() / "scenes" / "can_on_table.yaml");
    std::erase_if(scene.objects, [](const auto& object) { return object.name != "pedestal"; });
    scene.goal.reset();
    scene.programs.clear();
    scene.name = "Cell with a camera";
    geometric::write_scene(scene, folder_.path() / "cell.yaml");
    return folder_.path() / "cell.yaml";
  }

  void fill(gui::CloudImportDialog& dialog) const {
    const auto field = [&](const char* name, const char* text) {
      auto* box = dialog.findChild<QAbstractSpinBox*>(QLatin1String(name));
      click(*box);
      box->selectAll();
      QTest::keyClicks(box, QLatin1String(text));
      QTest::keyClick(box, Qt::Key_Tab);
    };
    field("position_x", "1.9 m");
    field("position_y", "0.9 m");
    field("position_z", "1.5 m");
    field("pitch", "30");
    field("yaw", "-144");
    QTest::mouseClick(dialog.findChild<QCheckBox*>(QStringLiteral("cloud_find_objects")),
                      Qt::LeftButton, {}, QPoint(8, 8));
    picture("camera_1_dialog", dialog);
    click(*dialog.findChild<QPushButton*>(QStringLiteral("cloud_add")));
  }
};

TEST_F(CameraStory, PlansAroundATableAndGraspsTheCanOnIt) {
  open(empty_cell());
  const std::filesystem::path image = folder_.path() / "depth.png";
  ASSERT_TRUE(DepthCameraOnTable::image().save(QString::fromStdString(image.string())));
  QTimer::singleShot(300, &window(), [&] {
    if (auto* dialog = qobject_cast<gui::CloudImportDialog*>(QApplication::activeModalWidget())) {
      fill(*dialog);
    }
  });
  drop_file(window(), image);
  ASSERT_TRUE(wait_for([&] { return find_object(scene(), "object 2") != nullptr; }));
  const auto can = std::ranges::find_if(scene().objects, [](const auto& each) {
    return std::holds_alternative<geometric::Cylinder>(each.shape);
  });
  ASSERT_NE(can, scene().objects.end());
  EXPECT_NEAR(std::get<geometric::Cylinder>(can->shape).radius, 0.033, 0.002);
  EXPECT_TRUE(can->X_PO.translation().isApprox(Vector3d(0.76, 0.14, 0.76), 0.005));
  const std::string name = can->name;
  QTest::qWait(800);  // the view turns to what is new
  picture("camera_2_objects");

  activate();  // a window manager does it when a dialog closes
  click_object(name.c_str());
  ASSERT_EQ(editor().selection().name, name);
  press(Qt::Key_G, Qt::ControlModifier);
  auto& list = part<QTreeWidget>("grasp_list");
  ASSERT_TRUE(wait_for([&] { return list.isVisible() && list.topLevelItemCount() > 1; }));
  QSignalSpy ended(&window().session(), &gui::PlanningSession::ended);
  click(part<QPushButton>("grasp_plan"));
  ASSERT_TRUE(wait_for([&] { return !ended.isEmpty(); }));
  EXPECT_TRUE(ended.front().front().toBool());
  picture("camera_3_path");
}

}  // namespace
}  // namespace handway::test
