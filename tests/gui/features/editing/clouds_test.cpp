/// Point clouds and depth images that are dropped onto the window.
#include "dropped_file.h"
#include "features/editing/cloud_import_dialog.h"
#include "features/editing/editing_test.h"
#include "handway/geometric/formats/cloud_reader.h"
#include "handway/geometric/setup/placing.h"
#include "patience.h"

#include <QApplication>
#include <QCheckBox>
#include <QImage>
#include <QLabel>
#include <QPushButton>
#include <QTest>
#include <QTimer>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <variant>

namespace handway::test {
namespace {

class Clouds : public EditingTest {
 protected:
  using EditingTest::type;
  /// Drops a file onto the window, and answers its dialog.
  void drop(const std::filesystem::path& file,
            const std::function<void(gui::CloudImportDialog&)>& answer) const {
    bool was_asked = false;
    QTimer::singleShot(200, [&] {
      auto* dialog = qobject_cast<gui::CloudImportDialog*>(QApplication::activeModalWidget());
      if (dialog != nullptr) {
        was_asked = true;
        answer(*dialog);
      }
    });
    drop_file(window(), file);
    EXPECT_TRUE(was_asked);
  }
  static void click(gui::CloudImportDialog& dialog, const char* name) {
    QTest::mouseClick(dialog.findChild<QPushButton*>(QLatin1String(name)), Qt::LeftButton);
  }
  static void type(gui::CloudImportDialog& dialog, const char* field, const char* text) {
    auto* box = dialog.findChild<QAbstractSpinBox*>(QLatin1String(field));
    box->setFocus();
    box->selectAll();
    QTest::keyClicks(box, QLatin1String(text));
    QTest::keyClick(box, Qt::Key_Tab);
  }
  [[nodiscard]] bool has(const std::string& name) const {
    return find_object(scene(), name) != nullptr;
  }
  [[nodiscard]] bool comes(const std::string& name) const {
    return QTest::qWaitFor([&] { return has(name); }, kPatienceMs);
  }
};

TEST_F(Clouds, BecomeAnObjectWithCellsThatCanBeChanged) {
  const std::filesystem::path file = cell().folder() / "scan.xyz";
  std::ofstream points(file);
  for (int i = 0; i < 2500; ++i) {
    points << -1.0 - 0.005 * (i % 50) << ' ' << -1.0 - 0.005 * (i / 50) << " 0.3 200 30 30\n";
  }
  points.close();
  drop(file, [](gui::CloudImportDialog& dialog) {
    type(dialog, "cloud_cell", "20 mm");
    click(dialog, "cloud_add");
  });
  ASSERT_TRUE(comes("scan"));
  const auto& cloud = std::get<geometric::Cloud>(object("scan").shape);
  EXPECT_EQ(cloud.points->size(), 2500U);
  EXPECT_EQ(cloud.cells.size, 0.02);
  EXPECT_EQ(cloud.points->colors.size(), 2500U);
  editor().undo_stack().undo();
  EXPECT_FALSE(has("scan"));
}

// A camera 1.5 m above the floor looks down at a table of 0.7 m, 0.5 m high, with a block on it.
TEST_F(Clouds, OfDepthImagesBecomeATableAndABlock) {
  QImage image(320, 240, QImage::Format_Grayscale16);
  const double focal = 250.0;
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const double across = std::abs(u - 159.5) / focal;
      const double along = std::abs(v - 119.5) / focal;
      const double depth = std::max(across, along) * 0.9 < 0.04 ? 0.9
                           : std::max(across, along) < 0.35     ? 1.0
                                                                : 0.0;
      reinterpret_cast<quint16*>(image.scanLine(v))[u] = static_cast<quint16>(1000.0 * depth);
    }
  }
  const std::filesystem::path file = cell().folder() / "depth.png";
  ASSERT_TRUE(image.save(QString::fromStdString(file.string())));
  drop(file, [](gui::CloudImportDialog& dialog) {
    type(dialog, "camera_fx", "250");
    type(dialog, "camera_fy", "250");
    type(dialog, "position_x", "-1500");
    type(dialog, "position_y", "-1500");
    type(dialog, "position_z", "1500");
    type(dialog, "pitch", "90");
    QTest::mouseClick(dialog.findChild<QCheckBox*>(QStringLiteral("cloud_find_objects")),
                      Qt::LeftButton, {}, QPoint(8, 8));
    click(dialog, "cloud_add");
  });
  ASSERT_TRUE(comes("object"));
  const Eigen::Vector3d table = std::get<geometric::Box>(object("surface").shape).size;
  EXPECT_NEAR(table.x(), 0.7, 0.02);
  EXPECT_NEAR(table.y(), 0.7, 0.02);
  EXPECT_NEAR(object("surface").X_PO.translation().z() + 0.5 * table.z(), 0.5, 0.002);
  const Eigen::Vector3d block = std::get<geometric::Box>(object("object").shape).size;
  EXPECT_NEAR(block.x(), 0.08, 0.01);
  EXPECT_NEAR(block.z(), 0.1, 0.005);
  EXPECT_TRUE(
      object("object").X_PO.translation().isApprox(Eigen::Vector3d(-1.5, -1.5, 0.55), 0.01));
}

// The left half of the image is 0.3 m nearer than the right one, and hides what is below it.
TEST_F(Clouds, OfDepthImagesHideSpaceThatCanBeSolid) {
  QImage image(160, 120, QImage::Format_Grayscale16);
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      reinterpret_cast<quint16*>(image.scanLine(v))[u] = u < 80 ? 1000 : 1300;
    }
  }
  const std::filesystem::path file = cell().folder() / "steps.png";
  ASSERT_TRUE(image.save(QString::fromStdString(file.string())));
  drop(file, [](gui::CloudImportDialog& dialog) {
    type(dialog, "position_x", "-1500");
    type(dialog, "position_y", "-1500");
    type(dialog, "position_z", "1500");
    type(dialog, "pitch", "90");
    auto& hidden = *dialog.findChild<QCheckBox*>(QStringLiteral("cloud_hidden"));
    EXPECT_TRUE(hidden.isVisible());
    QTest::mouseClick(&hidden, Qt::LeftButton, {}, QPoint(8, 8));
    click(dialog, "cloud_add");
  });
  ASSERT_TRUE(comes("steps hidden"));
  const geometric::Aabb box = geometric::bounds(scene(), *scene().start, {"steps hidden"});
  EXPECT_LT(box.upper.z(), 0.5) << "the near half is at 0.5 m";
  EXPECT_NEAR(box.lower.z(), 0.2, 0.011) << "and the far one at 0.2 m";
  keep_picture("hidden_space");
  editor().undo_stack().undo();
  EXPECT_FALSE(has("steps"));
}

// A loose grid of points: each of 400,000 is a cell of its own if cells are small.
TEST_F(Clouds, KeepTheirCellsWhereSmallerOnesAreTooMany) {
  auto points = std::make_shared<geometric::PointCloud>();
  for (int i = 0; i < 400'000; ++i) {
    const Eigen::Vector3i cell(i % 80, i / 80 % 80, i / 6400);
    points->points.emplace_back((0.02 * cell.cast<double>().array() + 0.005).cast<float>());
  }
  geometric::SceneObject scan;
  scan.name = "scan";
  scan.X_PO.translation() = Eigen::Vector3d(2.0, 2.0, 0.0);
  scan.shape = geometric::make_cloud(points, {0.1, 0.0}, "points");
  editor().add_objects({scan});
  type("cloud_cell", "10");
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return part<QLabel>("banner_text").text().contains(QLatin1String("too many cells")); },
      kPatienceMs));
  EXPECT_EQ(std::get<geometric::Cloud>(object("scan").shape).cells.size, 0.1);
  EXPECT_NEAR(part<gui::QuantityField>("cloud_cell").quantity(), 0.1, 1e-12);
  type("cloud_cell", "200");
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return std::get<geometric::Cloud>(object("scan").shape).cells.size == 0.2; },
      kPatienceMs));
}

// The next copy may overwrite the file of the clipboard.
TEST_F(Clouds, ThatArePastedDoNotNeedTheClipboardsFile) {
  auto points = std::make_shared<geometric::PointCloud>();
  points->points = {{0.0F, 0.0F, 0.0F}, {0.1F, 0.0F, 0.0F}};
  geometric::SceneObject scan;
  scan.name = "scan";
  scan.X_PO.translation() = Eigen::Vector3d(2.0, 2.0, 0.0);
  scan.shape = geometric::make_cloud(points, {}, "points");
  editor().add_objects({scan});
  editor().paste(editor().copied());
  ASSERT_TRUE(has("scan 2"));
  const auto& pasted = std::get<geometric::Cloud>(object("scan 2").shape);
  EXPECT_EQ(pasted.points->points, points->points);
  EXPECT_TRUE(pasted.file.empty()) << pasted.file;
}

TEST_F(Clouds, ThatAreDamagedLeaveTheSceneAsItIs) {
  const std::filesystem::path file = cell().folder() / "cut.pcd";
  std::ofstream(file) << "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
                         "WIDTH 100\nHEIGHT 1\nPOINTS 100\nDATA binary\n";
  const std::size_t before = scene().objects.size();
  drop(file, [](gui::CloudImportDialog& dialog) { click(dialog, "cloud_add"); });
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return part<QLabel>("banner_text").text().contains(QLatin1String("cut.pcd")); },
      kPatienceMs));
  EXPECT_EQ(scene().objects.size(), before);
}

}  // namespace
}  // namespace handway::test
