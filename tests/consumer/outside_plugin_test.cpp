#include "handway/planning/core/planning_problem.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRobot = R"(<robot name="lever">
  <link name="base"/>
  <link name="arm">
    <collision>
      <origin xyz="0.5 0 0"/><geometry><box size="1 0.1 0.1"/></geometry>
    </collision>
  </link>
  <joint name="swing" type="revolute">
    <parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
)";

/// Runs `command` in the shell and expects success.
void run(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string printed;
  std::array<char, 4096> block{};
  while (const std::size_t size = std::fread(block.data(), 1, block.size(), pipe)) {
    printed.append(block.data(), size);
  }
  ASSERT_EQ(pclose(pipe), 0) << command << '\n' << printed;
}

std::string quoted(const fs::path& path) { return '"' + path.string() + '"'; }

/// Installs the libraries of this build into `folder`/prefix.
void install_libraries(const fs::path& folder) {
  run(quoted(HANDWAY_CMAKE) + " --install " + quoted(HANDWAY_BUILD_FOLDER) +
      " --component libraries --prefix " + quoted(folder / "prefix"));
}

/// Configures the project `name` of this folder in `folder`/build.
void configure(const std::string& name, const fs::path& folder, const std::string& options) {
  run(quoted(HANDWAY_CMAKE) + " -G Ninja -S " +
      quoted(test::source_dir() / "tests" / "consumer" / name) + " -B " + quoted(folder / "build") +
      " -DCMAKE_PREFIX_PATH=" + quoted(folder / "prefix") + options);
}

/// Builds the plugin against the installed libraries of this build.
void build_outside(const fs::path& folder) {
  install_libraries(folder);
  configure("straight_planner", folder,
            " -DCMAKE_CXX_COMPILER=" + quoted(HANDWAY_COMPILER) +
                " -DCMAKE_CXX_FLAGS=" HANDWAY_SANITIZER " -DCMAKE_BUILD_TYPE=Debug");
  run(quoted(HANDWAY_CMAKE) + " --build " + quoted(folder / "build"));
}

TEST(InstalledPackage, HasEachLibraryAsAComponent) {
  const test::ScratchFolder scratch;
  ASSERT_NO_FATAL_FAILURE(install_libraries(scratch.path()));
  ASSERT_NO_FATAL_FAILURE(configure("components", scratch.path(), ""));
}

TEST(OutsidePlugin, IsBuiltOnTheInstalledLibrariesAndPlans) {
  const test::ScratchFolder scratch;
  ASSERT_NO_FATAL_FAILURE(build_outside(scratch.path()));

  PluginManager plugins;
  plugins.load_plugins(scratch.path() / "build");
  ASSERT_THAT(plugins.refused(), testing::IsEmpty());
  ASSERT_THAT(plugins.loaded(), testing::SizeIs(1));
  EXPECT_EQ(plugins.loaded().front().version, "1.0");

  const fs::path scene = scratch.path() / "scene.yaml";
  std::ofstream(scratch.path() / "lever.urdf") << kRobot;
  std::ofstream(scene) << "handway: 1\n"
                          "robots:\n  - model: lever.urdf\n"
                          "start: {swing: -2}\ngoal: {swing: 0.5}\n";
  const SceneState loaded = load_scene(scene, plugins);
  const auto planner = plugins.planners().create("straight");
  const PlanResult result = planner->plan(make_problem(loaded.scene, loaded.basis), {});
  EXPECT_TRUE(result.solved()) << result.reason;
  EXPECT_THAT(result.path.waypoints, testing::SizeIs(2));
}

}  // namespace
}  // namespace handway::planning
