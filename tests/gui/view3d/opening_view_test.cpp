/// Tests how much of the robot is visible when a scene opens: the share of its pixels that nothing
/// covers.
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway_test/paths.h"
#include "view3d/scene_view.h"
#include "view3d/viewpoints.h"
#include "window_test.h"

#include <QImage>

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace handway::test {
namespace {

constexpr int kFewLevels = 6;  // of 255

int pixels_that_differ(const QImage& a, const QImage& b) {
  int differing = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const QColor p = a.pixelColor(x, y), q = b.pixelColor(x, y);
      differing += std::abs(p.red() - q.red()) + std::abs(p.green() - q.green()) +
                               std::abs(p.blue() - q.blue()) >
                           kFewLevels
                       ? 1
                       : 0;
    }
  }
  return differing;
}

class OpeningView : public ::testing::Test {
 protected:
  void SetUp() override {
    HANDWAY_NEED_DISPLAY();
    plugins_.load_plugins(planning::plugin_directory());
    view_ = std::make_unique<gui::SceneView>();
    view_->set_floor_visible(false);
    view_->set_cube_visible(false);
    view_->set_samples(0);
    view_->resize(640, 480);
    view_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(view_.get()));
  }

  [[nodiscard]] geometric::Scene scene(const std::filesystem::path& file) const {
    return *planning::load_scene(file, plugins_).scene;
  }
  [[nodiscard]] geometric::Scene scene_on_table() const {
    return scene(source_dir() / "scenes" / "can_on_table.yaml");
  }

  /// Share of the robot's pixels that are seen when that opens.
  [[nodiscard]] double share_seen(const geometric::Scene& scene, const std::string& name) const {
    const auto show = [this](const geometric::Scene& shown) {
      view_->set_scene(std::make_shared<const geometric::Scene>(shown));
      view_->show_ghosts(false, false);
    };
    show(scene);
    const gui::OrbitCamera::Placement opened = view_->camera().placement();
    const auto picture = [&](bool with_robots, bool with_objects) {
      geometric::Scene shown = scene;
      if (!with_robots) {
        shown.robots.clear();
        shown.start.reset();
        shown.goal.reset();
      }
      if (!with_objects) {
        shown.objects.clear();
      }
      show(shown);
      view_->set_camera(opened);
      view_->settle();
      return view_->grabFramebuffer();
    };
    const QImage all = picture(true, true);
    if (const QString folder = qEnvironmentVariable("HANDWAY_PICTURES"); !folder.isEmpty()) {
      EXPECT_TRUE(all.save(QStringLiteral("%1/opening_%2.png").arg(folder, name.c_str())));
    }
    const int covered = pixels_that_differ(all, picture(false, true));
    const int alone = pixels_that_differ(picture(true, false), picture(false, false));
    EXPECT_GT(alone, 1500) << "the robot is large enough to be looked at";
    return static_cast<double>(covered) / alone;
  }

  planning::PluginManager plugins_;
  std::unique_ptr<gui::SceneView> view_;
};

/// Returns a wall on the floor beside the robot, to that side of it.
geometric::SceneObject wall(const geometric::Scene& scene, int side, double distance,
                            double height) {
  geometric::SceneObject wall;
  wall.name = "wall_" + std::to_string(side);
  wall.shape = geometric::Box{{0.02, 2.0 * distance, height}};
  wall.color = {0.6F, 0.6F, 0.65F, 1.0F};
  wall.X_PO = Eigen::Translation3d(0.0, 0.0, gui::lowest_point(scene) + 0.5 * height) *
              Eigen::AngleAxisd(0.5 * std::numbers::pi * side, Eigen::Vector3d::UnitZ()) *
              Eigen::Translation3d(distance, 0.0, 0.0);
  return wall;
}

TEST_F(OpeningView, LooksAcrossTheTaskIfNothingIsInTheWay) {
  const geometric::Scene scene = scene_on_table();
  gui::OrbitCamera across;
  across.look_from(gui::StandardView::kOblique, gui::task_azimuth(scene));
  const gui::OrbitCamera opened = gui::open_view(scene, {}, 1.5).camera;
  EXPECT_DOUBLE_EQ(opened.placement().azimuth, across.placement().azimuth);
  EXPECT_DOUBLE_EQ(opened.placement().elevation, across.placement().elevation);
}

TEST_F(OpeningView, IsThroughTheOpenSideOfACell) {
  for (int open = 0; open < 4; ++open) {
    geometric::Scene cell = scene_on_table();
    for (int side = 0; side < 4; ++side) {
      if (side != open) {
        cell.objects.push_back(wall(scene_on_table(), side, 1.4, 2.6));
      }
    }
    EXPECT_GT(share_seen(cell, "cell_" + std::to_string(open)), 0.8) << "open side " << open;
  }
}

TEST_F(OpeningView, IsOverWallsAllAround) {
  geometric::Scene cage = scene_on_table();
  for (int side = 0; side < 4; ++side) {
    cage.objects.push_back(wall(scene_on_table(), side, 1.4, 2.6));
  }
  EXPECT_GT(share_seen(cage, "cage"), 0.8);
}

TEST_F(OpeningView, IsIntoACageWithARoofThatASectionOpens) {
  geometric::Scene cage = scene_on_table();
  for (int side = 0; side < 4; ++side) {
    cage.objects.push_back(wall(scene_on_table(), side, 1.2, 2.2));
  }
  EXPECT_FALSE(gui::open_view(cage, {}, 1.5).section) << "one looks over them";
  geometric::SceneObject roof;
  roof.name = "roof";
  roof.shape = geometric::Box{{2.4, 2.4, 0.02}};
  roof.X_PO.translation().z() = gui::lowest_point(cage) + 2.2;
  cage.objects.push_back(roof);
  const auto [camera, before] = gui::open_view(cage, {}, 4.0 / 3.0);
  ASSERT_TRUE(before);
  const Eigen::Vector3d towards = camera.orientation().col(2);
  Eigen::Index axis = 0;
  towards.cwiseAbs().maxCoeff(&axis);
  view_->set_section(Eigen::Hyperplane<double, 3>(
      std::copysign(1.0, towards[axis]) * Eigen::Vector3d::Unit(axis), *before));
  EXPECT_GT(share_seen(cage, "cage_with_roof"), 0.8);
  for (geometric::SceneObject& object : cage.objects) {
    object.color.alpha = 0.3F;
  }
  EXPECT_FALSE(gui::open_view(cage, {}, 1.5).section) << "of glass";
}

TEST_F(OpeningView, IsPastAShelfBetween) {
  for (const double azimuth : {-0.9, -0.3, 0.3}) {
    geometric::Scene scene = scene_on_table();
    geometric::SceneObject shelf = wall(scene, 0, 1.2, 2.6);
    shelf.X_PO = Eigen::AngleAxisd(azimuth, Eigen::Vector3d::UnitZ()) * shelf.X_PO;
    scene.objects.push_back(shelf);
    EXPECT_GT(share_seen(scene, "shelf_" + std::to_string(azimuth)), 0.8) << azimuth;
  }
}

TEST_F(OpeningView, OfPublishedProblemsShowsTheRobot) {
  HANDWAY_NEED_REFERENCE(reference);
  for (const char* name : {"-shelfT2", "_CanBox", "_ShelfCan2", "_TwoCanb"}) {
    const std::string file = std::string("TX90_RHand_ICRA10_5PMD") + name + "_new.xml";
    EXPECT_GT(share_seen(scene(reference / "auro" / file), name), 0.8) << name;
  }
  for (const auto& folder :
       std::filesystem::directory_iterator(reference / "moveit" / "panda" / "problems")) {
    const std::string name = folder.path().filename().string();
    EXPECT_GT(share_seen(scene(folder.path() / "request0001.yaml"), name), 0.8) << name;
  }
}

}  // namespace
}  // namespace handway::test
