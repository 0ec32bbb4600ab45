/// `handway cloud`: points of a camera in a scene, and its exit codes.
#include "command_line.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/setup/placing.h"
#include "handway_test/paths.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <variant>

namespace handway::test {
namespace {

using testing::HasSubstr;

class CloudCommand : public testing::Test {
 protected:
  static std::string shipped() { return (source_dir() / "scenes" / "can_on_table.yaml").string(); }
  /// The top of a table of 0.5 m, with a block of 100 mm, seen from above; in mm-steps of 5.
  std::string table() const {
    std::string text;
    for (int i = 0; i <= 100; ++i) {
      for (int j = 0; j <= 100; ++j) {
        const bool is_block = i >= 40 && i <= 60 && j >= 20 && j <= 40;
        text += fmt::format("{} {} {}\n", 0.005 * i, 0.005 * j, is_block ? 0.1 : 0.0);
      }
    }
    return line_.write("table.xyz", text + "0.2 0.2 1.5\n").string();
  }

  CommandLine line_;
};

TEST_F(CloudCommand, AddsPointsToAScene) {
  const Outcome run = line_.run("cloud " + table() + " --scene " + shipped() +
                                " --xyz -1 -1 1 --cell-mm 20 --name scan --out seen.yaml");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("10202 points"));
  EXPECT_THAT(run.out, HasSubstr("1 outliers"));
  EXPECT_THAT(run.out, HasSubstr("Object scan: 10201 points in cells of 20 mm"));
  const geometric::Scene scene = geometric::read_scene(line_.folder() / "seen.yaml");
  const geometric::SceneObject* scan = find_object(scene, "scan");
  ASSERT_NE(scan, nullptr);
  EXPECT_EQ(std::get<geometric::Cloud>(scan->shape).cells.size, 0.02);
  EXPECT_TRUE(scan->X_PO.translation().isApprox(Eigen::Vector3d(-1, -1, 1)));
}

TEST_F(CloudCommand, FindsTheTableAndTheBlockOnIt) {
  const Outcome run = line_.run("cloud " + table() + " --scene " + shipped() +
                                " --xyz -1 -1 1 --find-objects --out seen.yaml");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("Object surface: box of 500 × 500 × 20 mm"));
  EXPECT_THAT(run.out,
              HasSubstr("Object object: box of 100 × 100 × 100 mm at (-0.750, -0.850, 1.050) m"));
}

TEST_F(CloudCommand, MakesWhatADepthImageHidesAnObject) {
  // A grey image of 41 x 41 pixels: 1000 mm everywhere, seen from 1.5 m above the floor.
  std::string bytes = "\x93NUMPY\x01";
  const std::string header = "{'descr': '<u2', 'fortran_order': False, 'shape': (41, 41), }";
  bytes += std::string("\0", 1) + static_cast<char>(header.size()) + std::string("\0", 1) + header;
  for (int i = 0; i < 41 * 41; ++i) {
    bytes += "\xE8\x03";
  }
  const std::string image = line_.write("depth.npy", bytes).string();
  const std::string camera = " --camera 100 100 20 20 --xyz -3 0 1.5 --rpy-deg 180 0 0";
  const Outcome run = line_.run("cloud " + image + camera + " --scene " + shipped() +
                                " --box -4 -1 0 -2 1 2 --cell-mm 50 --hidden --out seen.yaml");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("cells of 50 mm"));
  const geometric::Scene scene = geometric::read_scene(line_.folder() / "seen.yaml");
  const geometric::SceneObject* hidden = find_object(scene, "cloud hidden");
  ASSERT_NE(hidden, nullptr);
  const geometric::Aabb box = geometric::bounds(scene, *scene.start, {"cloud hidden"});
  EXPECT_NEAR(box.lower.z(), 0.0, 1e-9);
  EXPECT_LT(box.upper.z(), 0.5) << "the surface is at 0.5 m";
  EXPECT_EQ(
      line_.run("cloud " + table() + " --scene " + shipped() + " --hidden --out s.yaml").exit_code,
      2)
      << "no camera";
}

TEST_F(CloudCommand, RefusesWhatItCannotUse) {
  const std::string points = table();
  const auto refusal = [&](const std::string& arguments, int exit_code) {
    const Outcome run = line_.run("cloud " + arguments);
    EXPECT_EQ(run.exit_code, exit_code) << arguments;
    return run.err;
  };
  EXPECT_THAT(refusal("missing.pcd", 3), HasSubstr("no such file"));
  EXPECT_THAT(refusal(line_.write("depth.png", "x").string(), 3), HasSubstr("--camera"));
  EXPECT_THAT(refusal(points + " --out points.obj", 3), HasSubstr(".ply"));
  EXPECT_THAT(refusal(points + " --scene " + shipped() + " --out s.yaml --cut-out cup", 3),
              HasSubstr("cup"));
  EXPECT_THAT(refusal(points + " --scene " + shipped() + " --out s.yaml --box 5 5 5 6 6 6", 3),
              HasSubstr("no points"));
  EXPECT_THAT(refusal(points + " --scene " + shipped() + " --out s.yaml --radius-mm 200", 3),
              HasSubstr("five times the cell"));
  EXPECT_FALSE(std::filesystem::exists(line_.folder() / "s.yaml"));
}

}  // namespace
}  // namespace handway::test
