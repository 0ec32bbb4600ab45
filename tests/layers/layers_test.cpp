#include "handway_test/paths.h"
#include "layer_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace handway::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

const LayerRules& sample_rules() {
  static const LayerRules kRules({
      "libs/geometric/robot/tree.h",
      "libs/geometric/robot/tree.cpp",
      "libs/geometric/include/handway/geometric/collision/world.h",
      "libs/geometric/include/handway/geometric/robot/model.h",
      "libs/geometric/collision/cache/table.h",
      "libs/sampling/postures/pca.h",
      "gui/model/document/document.h",
      "gui/view3d/scene_view.h",
      "gui/widgets/style/theme.h",
      "gui/features/glove/glove_panel.h",
      "gui/features/tracker/wrist_page.h",
      "gui/features/workbench.h",
      "gui/app/main_window.h",
      "tools/report.h",
      "plugins/first/reader.h",
      "plugins/first/plugin.cpp",
      "plugins/second/plugin.cpp",
  });
  return kRules;
}

std::vector<Breach> check(const std::string& file, const std::string& text) {
  return sample_rules().check(file, text);
}

auto breach_at(int line, const std::string& words) {
  return AllOf(Field("line", &Breach::line, line), Field("rule", &Breach::rule, HasSubstr(words)));
}

TEST(Layers, AreKeptByTheWholeProject) {
  const std::set<std::string> files = project_sources(source_dir());
  ASSERT_THAT(files, testing::Contains("libs/geometric/robot/robot_model.cpp"));
  const LayerRules rules(files);
  std::vector<Breach> breaches;
  for (const std::string& file : files) {
    std::ifstream stream(source_dir() / file);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    const std::vector<Breach> found = rules.check(file, text);
    breaches.insert(breaches.end(), found.begin(), found.end());
  }
  EXPECT_TRUE(breaches.empty()) << to_text(breaches);
}

TEST(LayerRules, LetEachLayerIncludeThoseBelow) {
  EXPECT_THAT(check("libs/planning/core/a.cpp",
                    "#include \"handway/planning/core/a.h\"\n"
                    "#include \"handway/sampling/postures/pmd_basis.h\"\n"
                    "#include <handway/geometric/scene/scene.h>\n"),
              IsEmpty());
  EXPECT_THAT(check("gui/app/a.cpp", "#include \"handway/planning/planners/planner.h\"\n"),
              IsEmpty());
  EXPECT_THAT(
      check("plugins/first/plugin.cpp", "#include \"handway/planning/extensions/plugin.h\"\n"),
      IsEmpty());
}

TEST(LayerRules, CatchAnIncludeUpwards) {
  EXPECT_THAT(check("libs/geometric/robot/tree.cpp",
                    "#include \"robot/tree.h\"\n"
                    "#include \"handway/sampling/postures/pmd_basis.h\"\n"),
              ElementsAre(breach_at(2, "geometric must not include sampling")));
  EXPECT_THAT(
      check("libs/sampling/postures/pca.h", "#include <handway/planning/planners/planner.h>"),
      ElementsAre(breach_at(1, "sampling must not include planning")));
}

TEST(LayerRules, LetAFolderOfALibraryIncludeThoseBelow) {
  EXPECT_THAT(check("libs/geometric/collision/cache/table.cpp",
                    "#include \"table.h\"\n"
                    "#include \"robot/tree.h\"\n"
                    "#include \"handway/geometric/collision/world.h\"\n"
                    "#include \"handway/geometric/export.h\"\n"),
              IsEmpty());
}

TEST(LayerRules, CatchAFolderOfALibraryThatIncludesOneAbove) {
  EXPECT_THAT(check("libs/geometric/robot/tree.cpp",
                    "#include \"tree.h\"\n"
                    "#include <handway/geometric/collision/world.h>\n"
                    "#include \"collision/cache/table.h\"\n"),
              ElementsAre(breach_at(2, "geometric/robot must not include collision"),
                          breach_at(3, "geometric/robot must not include collision/cache")));
  EXPECT_THAT(check("libs/geometric/include/handway/geometric/robot/model.h",
                    "#include \"handway/geometric/collision/world.h\"\n"),
              ElementsAre(breach_at(1, "geometric/robot must not include collision")));
  EXPECT_THAT(check("libs/geometric/magic/wand.cpp", "#include \"robot/tree.h\"\n"),
              ElementsAre(breach_at(1, "geometric/magic is not laid down")));
}

TEST(LayerRules, KeepDevicesApartFromPlanning) {
  EXPECT_THAT(check("libs/device/arm/a.cpp", "#include \"handway/geometric/math/pose.h\"\n"),
              IsEmpty());
  EXPECT_THAT(check("libs/device/arm/a.cpp", "#include \"handway/planning/core/path.h\"\n"),
              ElementsAre(breach_at(1, "device must not include planning")));
}

TEST(LayerRules, CatchATestThatIncludesWhatItsLibraryMustNot) {
  const std::string include = "#include \"handway/sampling/postures/pca.h\"\n";
  EXPECT_THAT(check("tests/planning/a_test.cpp", include), IsEmpty());
  EXPECT_THAT(check("tests/contracts/a_test.cpp", include), IsEmpty());
  EXPECT_THAT(check("tests/device/glove/a_test.cpp", include),
              ElementsAre(breach_at(1, "a test of device must not include sampling")));
}

TEST(LayerRules, CatchQtAndCoinInALibrary) {
  EXPECT_THAT(check("libs/geometric/robot/tree.cpp",
                    "#include <QString>\n"
                    "#include <QtCore/QString>\n"
                    "  #  include <Inventor/nodes/SoSeparator.h>\n"),
              ElementsAre(breach_at(1, "Qt or Coin"), breach_at(2, "Qt or Coin"),
                          breach_at(3, "Qt or Coin")));
  EXPECT_THAT(check("gui/view3d/a.cpp", "#include <Inventor/nodes/SoSeparator.h>\n"), IsEmpty());
}

TEST(LayerRules, CatchNamesOfQtAndCoinInALibraryHeader) {
  EXPECT_THAT(check("libs/geometric/robot/tree.h", "class QWidget;\nclass SoNode;\n"),
              ElementsAre(breach_at(1, "QWidget"), breach_at(2, "SoNode")));
  EXPECT_THAT(check("libs/geometric/robot/tree.h", "// As in QWidget.\nEigen::MatrixXd QR;\n"),
              IsEmpty());
}

TEST(LayerRules, CatchForeignLibrariesInAPublicHeader) {
  const std::string header = "libs/geometric/include/handway/geometric/robot/model.h";
  EXPECT_THAT(check(header,
                    "#include \"handway/geometric/export.h\"\n"
                    "#include <Eigen/Core>\n"
                    "#include <vector>\n"),
              IsEmpty());
  for (const char* foreign :
       {"<fcl/fcl.h>", "<ompl/base/Planner.h>", "<pugixml.hpp>", "<yaml-cpp/yaml.h>",
        "<assimp/scene.h>", "<urdf_model/model.h>", "\"robot/tree.h\""}) {
    EXPECT_THAT(check(header, std::string("#include ") + foreign + "\n"),
                ElementsAre(breach_at(1, "public header")))
        << foreign;
  }
  EXPECT_THAT(check("libs/geometric/robot/tree.cpp", "#include <fcl/fcl.h>\n"), IsEmpty());
}

TEST(LayerRules, CatchAPluginThatUsesAnother) {
  EXPECT_THAT(check("plugins/first/plugin.cpp", "#include \"reader.h\"\n"), IsEmpty());
  for (const char* include : {"reader.h", "first/reader.h", "../first/reader.h"}) {
    EXPECT_THAT(check("plugins/second/plugin.cpp", std::string("#include \"") + include + "\"\n"),
                ElementsAre(breach_at(1, "belongs to plugins/first")))
        << include;
  }
}

TEST(LayerRules, CatchPrivateHeadersOfAnotherPart) {
  EXPECT_THAT(check("tools/main.cpp", "#include \"report.h\"\n#include \"version.h\"\n"),
              IsEmpty());
  EXPECT_THAT(check("tools/main.cpp",
                    "#include \"app/main_window.h\"\n"
                    "#include \"robot/tree.h\"\n"
                    "#include \"../libs/sampling/postures/pca.h\"\n"),
              ElementsAre(breach_at(1, "belongs to gui"), breach_at(2, "libs/geometric"),
                          breach_at(3, "libs/sampling")));
}

TEST(LayerRules, CatchALayerThatIsNotLaidDown) {
  EXPECT_THAT(check("libs/geometric/robot/tree.cpp", "#include \"handway/magic/wand.h\"\n"),
              ElementsAre(breach_at(1, "no library magic")));
}

TEST(LayerRules, LetTheWindowsLayersIncludeThoseBelow) {
  EXPECT_THAT(check("gui/features/glove/a.cpp",
                    "#include \"features/glove/glove_panel.h\"\n"
                    "#include \"features/workbench.h\"\n"
                    "#include \"model/document/document.h\"\n"
                    "#include \"view3d/scene_view.h\"\n"
                    "#include \"widgets/style/theme.h\"\n"
                    "#include <QWidget>\n"),
              IsEmpty());
  EXPECT_THAT(check("gui/app/features.cpp", "#include \"features/glove/glove_panel.h\"\n"),
              IsEmpty());
}

TEST(LayerRules, CatchAnIncludeUpwardsInTheWindow) {
  EXPECT_THAT(check("gui/model/document/a.cpp", "#include \"view3d/scene_view.h\"\n"),
              ElementsAre(breach_at(1, "gui/model/document must not include view3d")));
  EXPECT_THAT(check("gui/view3d/a.cpp", "#include \"widgets/style/theme.h\"\n"),
              ElementsAre(breach_at(1, "gui/view3d must not include widgets")));
  EXPECT_THAT(check("gui/widgets/style/a.cpp", "#include \"view3d/scene_view.h\"\n"),
              ElementsAre(breach_at(1, "gui/widgets/style must not include view3d")));
  EXPECT_THAT(check("gui/features/glove/a.cpp", "#include \"app/main_window.h\"\n"),
              ElementsAre(breach_at(1, "gui/features must not include app")));
}

TEST(LayerRules, CatchAFeatureThatKnowsAnother) {
  EXPECT_THAT(check("gui/features/glove/a.cpp", "#include \"features/tracker/wrist_page.h\"\n"),
              ElementsAre(breach_at(1, "must not include features/tracker/wrist_page.h")));
  EXPECT_THAT(check("gui/features/workbench.cpp", "#include \"features/tracker/wrist_page.h\"\n"),
              ElementsAre(breach_at(1, "must not include features/tracker/wrist_page.h")));
}

TEST(LayerRules, CatchAFeatureNamedOutsideTheList) {
  EXPECT_THAT(check("gui/app/a.cpp", "#include \"features/glove/glove_panel.h\"\n"),
              ElementsAre(breach_at(1, "only gui/app/features.cpp must include features")));
}

TEST(LayerRules, CatchCoinOutsideTheViewAndWidgetsInTheModel) {
  const std::string coin = "#include <Inventor/nodes/SoSeparator.h>\n";
  EXPECT_THAT(check("gui/view3d/a.cpp", coin), IsEmpty());
  EXPECT_THAT(check("gui/features/glove/a.cpp", coin), ElementsAre(breach_at(1, "knows Coin")));
  for (const char* widget : {"QWidget", "QLabel", "QComboBox", "QAction", "QFormLayout"}) {
    EXPECT_THAT(check("gui/model/document/a.cpp", "#include <" + std::string(widget) + ">\n"),
                ElementsAre(breach_at(1, "must not know widgets")))
        << widget;
  }
  EXPECT_THAT(check("gui/model/document/a.cpp", "#include <QObject>\n#include <QUndoStack>\n"),
              IsEmpty());
}

TEST(LayerRules, CatchUsingNamespaceStd) {
  EXPECT_THAT(check("gui/app/a.cpp", "// using namespace std\nusing  namespace std;\n"),
              ElementsAre(breach_at(2, "using namespace std")));
}

}  // namespace
}  // namespace handway::test
