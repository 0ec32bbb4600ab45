#include "handway/planning/extensions/plugin.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace handway::planning {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

const std::filesystem::path kTestPlugins = TEST_PLUGINS;

std::string reason_of_refusal(const std::filesystem::path& directory) {
  PluginManager plugins;
  plugins.load_plugins(directory);
  EXPECT_THAT(plugins.loaded(), IsEmpty());
  EXPECT_THAT(plugins.refused(), SizeIs(1));
  return plugins.refused().empty() ? "" : plugins.refused().front().reason;
}

TEST(PluginManager, KnowTheBuiltInPlannersWithoutPlugins) {
  const PluginManager plugins;
  EXPECT_EQ(plugins.planners().names().front(), "auto");
}

TEST(PluginManager, TakePlannersAndImportersOfAPlugin) {
  PluginManager plugins;
  plugins.load_plugins(kTestPlugins / "greeting");
  EXPECT_THAT(plugins.refused(), IsEmpty());
  ASSERT_THAT(plugins.loaded(), SizeIs(1));
  EXPECT_EQ(plugins.loaded().front().name, "greeting");
  EXPECT_EQ(plugins.loaded().front().version, "1.2");
  EXPECT_THAT(plugins.planners().names(), Contains("hello-planner"));
  ASSERT_THAT(plugins.importers(), SizeIs(1));
  EXPECT_EQ(plugins.importers().front()->name(), "greetings (.hello)");
}

TEST(PluginManager, RefuseAPluginThatIsLoadedAlready) {
  PluginManager plugins;
  plugins.load_plugins(kTestPlugins / "greeting");
  plugins.load_plugins(kTestPlugins / "greeting");
  EXPECT_THAT(plugins.importers(), SizeIs(1));
  ASSERT_THAT(plugins.refused(), SizeIs(1));
  EXPECT_THAT(plugins.refused().front().reason, HasSubstr("plugin greeting is loaded already"));
}

TEST(PluginManager, NameTheInterfaceVersionOfAnOldPlugin) {
  EXPECT_EQ(reason_of_refusal(kTestPlugins / "old_interface"),
            "made for version " + std::to_string(kPluginApiVersion - 1) +
                " of the plugin interface, not " + std::to_string(kPluginApiVersion));
}

TEST(PluginManager, RefuseAPluginThatSeesOtherStructs) {
  EXPECT_EQ(reason_of_refusal(kTestPlugins / "other_headers"),
            "built against other headers of Handway: build it again");
}

TEST(PluginManager, RefuseALibraryThatIsNoPlugin) {
  EXPECT_THAT(reason_of_refusal(kTestPlugins / "without_entry_point"),
              HasSubstr("no function handway_plugin"));
}

TEST(PluginManager, RefuseAFileThatIsNoLibrary) {
  const test::ScratchFolder scratch;
  std::ofstream(scratch.path() / "text.so") << "not a library";
  EXPECT_THAT(reason_of_refusal(scratch.path()), HasSubstr("not a library that can be loaded"));
}

TEST(PluginManager, TakeNothingOfAPluginThatFails) {
  PluginManager plugins;
  plugins.load_plugins(kTestPlugins / "failing");
  ASSERT_THAT(plugins.refused(), SizeIs(1));
  EXPECT_EQ(plugins.refused().front().reason, "no licence for half-done");
  EXPECT_EQ(plugins.refused().front().file.filename(), "test_plugin_failing.so");
  EXPECT_THAT(plugins.planners().names(), Not(Contains("half-done")));
}

TEST(PluginManager, PassOverFoldersThatAreMissingAndOtherFiles) {
  const test::ScratchFolder scratch;
  std::ofstream(scratch.path() / "README.md") << "about plugins";
  PluginManager plugins;
  plugins.load_plugins(scratch.path());
  plugins.load_plugins(scratch.path() / "absent");
  EXPECT_THAT(plugins.refused(), IsEmpty());
}

/// A copy of a plugin, whose rights a test may change.
class PluginsOfOthers : public testing::Test {
 protected:
  PluginsOfOthers() {
    std::filesystem::copy(kTestPlugins / "greeting" / "test_plugin_greeting.so", file_);
  }

  test::ScratchFolder scratch_;
  std::filesystem::path file_ = scratch_.path() / "greeting.so";
};

TEST_F(PluginsOfOthers, AreRefusedInAFolderThatEveryoneMayWriteTo) {
  std::filesystem::permissions(scratch_.path(), std::filesystem::perms::others_write,
                               std::filesystem::perm_options::add);
  EXPECT_EQ(reason_of_refusal(scratch_.path()),
            "every user may write to " + scratch_.path().string() +
                ": remove this permission (chmod o-w " + scratch_.path().string() + ")");
}

TEST_F(PluginsOfOthers, AreRefusedIfEveryoneMayWriteToTheFile) {
  std::filesystem::permissions(file_, std::filesystem::perms::others_write,
                               std::filesystem::perm_options::add);
  EXPECT_THAT(reason_of_refusal(scratch_.path()),
              HasSubstr("every user may write to " + file_.string()));
}

TEST_F(PluginsOfOthers, AreRefusedIfTheyBelongToAnotherUser) {
  constexpr uid_t kNobody = 65534;
  if (::chown(file_.c_str(), kNobody, kNobody) != 0) {
    GTEST_SKIP() << "only root can give a file to another user";
  }
  EXPECT_THAT(reason_of_refusal(scratch_.path()), HasSubstr("belongs to another user (65534)"));
  ASSERT_EQ(::chown(scratch_.path().c_str(), kNobody, kNobody), 0);
  EXPECT_THAT(reason_of_refusal(scratch_.path()),
              HasSubstr(scratch_.path().string() + " belongs to another user"));
}

TEST(PluginManager, TakeThePluginsOfTheProject) {
  PluginManager plugins;
  plugins.load_plugins(HANDWAY_PLUGINS);
  for (const RefusedPlugin& refused : plugins.refused()) {
    ADD_FAILURE() << refused.file << ": " << refused.reason;
  }
  EXPECT_THAT(plugins.loaded(), Contains(testing::Field(&LoadedPlugin::name, "import_kautham")));
}

TEST(PluginDirectory, LiesBesideTheProgramsFolderUnlessTold) {
  EXPECT_EQ(plugin_directory(), HANDWAY_PLUGINS);
  ::setenv("HANDWAY_PLUGIN_DIR", "/somewhere", 1);
  EXPECT_EQ(plugin_directory(), "/somewhere");
  ::unsetenv("HANDWAY_PLUGIN_DIR");
}

}  // namespace
}  // namespace handway::planning
