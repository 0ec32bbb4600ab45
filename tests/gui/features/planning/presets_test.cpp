#include "features/planning/preset_bar.h"
#include "handway/geometric/io/input_error.h"
#include "window_test.h"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>

#include <fstream>

namespace handway::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class PresetsInThePanel : public WindowTest {
 protected:
  void SetUp() override {
    forget_presets();
    WindowTest::SetUp();
    if (!IsSkipped()) {
      open(cell().post());
      window().workbench().plan_settings.choose_planner("auto");
    }
  }
  void TearDown() override {
    forget_presets();
    WindowTest::TearDown();
  }

  static void forget_presets() {
    const std::filesystem::path file = gui::PresetStore::file();
    std::filesystem::remove(file);
    std::filesystem::remove(file.string() + ".unreadable");
  }

  [[nodiscard]] gui::PresetBar& bar() const { return tool<gui::PresetBar>(); }
  [[nodiscard]] QComboBox& list() const { return part<QComboBox>("presets"); }
  [[nodiscard]] QSpinBox& checks() const { return part<QSpinBox>("smoothing_checks"); }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const gui::PlannerPreset& preset : bar().store().of("auto")) {
      names.push_back(preset.name.toStdString());
    }
    return names;
  }
  void choose(const char* preset) const {
    const int row = list().findText(QString::fromUtf8(preset));
    ASSERT_GE(row, 0) << preset;
    list().setCurrentIndex(row);
    emit list().activated(row);
  }
  void write_presets(const std::string& text) const {
    std::filesystem::create_directories(gui::PresetStore::file().parent_path());
    std::ofstream(gui::PresetStore::file()) << text;
  }
};

TEST_F(PresetsInThePanel, GiveTheirValuesToTheParameters) {
  EXPECT_EQ(bar().words(), QStringLiteral("Balanced"));
  choose("Thorough");
  EXPECT_EQ(checks().value(), 5000);
  EXPECT_EQ(bar().words(), QStringLiteral("Thorough"));
  EXPECT_FALSE(part<QLabel>("modified").isVisible());
  choose("Balanced");
  EXPECT_TRUE(window().workbench().plan_settings.choice().settings.empty());
}

TEST_F(PresetsInThePanel, SayWhichValuesAreOthersAndTakeThemBack) {
  choose("Thorough");
  checks().setValue(77);
  EXPECT_TRUE(part<QLabel>("modified").isVisible());
  EXPECT_EQ(bar().words(), QStringLiteral("Thorough, modified"));
  EXPECT_THAT(bar().modified_keys(), ElementsAre("smoothing_checks"));
  click("reset_parameters");
  EXPECT_EQ(checks().value(), 5000);
  EXPECT_FALSE(part<QLabel>("modified").isVisible());
}

TEST_F(PresetsInThePanel, FitEveryPlannerThatTheyAreFor) {
  const planning::PlannerRegistry registry;
  for (const std::string& name : registry.names()) {
    const auto planner = registry.create(name);
    const auto fresh = registry.create(name);
    for (const gui::PlannerPreset& preset : gui::built_in_presets(name)) {
      EXPECT_NO_THROW(gui::apply_preset(preset, *fresh, *planner)) << name;
      EXPECT_TRUE(gui::has_values_of(preset, *fresh, *planner)) << name;
      EXPECT_FALSE(preset.purpose.isEmpty()) << name;
    }
  }
}

TEST_F(PresetsInThePanel, AreChosenWhereASceneAsksForTheirValues) {
  window().workbench().plan_settings.apply({"auto", {{"smoothing_checks", "0"}}});
  EXPECT_EQ(bar().words(), QStringLiteral("Fast"));
  window().workbench().plan_settings.apply({"auto", {{"smoothing_checks", "1"}}});
  EXPECT_EQ(bar().words(), QStringLiteral("Balanced, modified"));
}

TEST_F(PresetsInThePanel, OfAPersonAreKeptRenamedAndDeleted) {
  checks().setValue(77);
  bar().save_as(QStringLiteral("My \"own\": 1"));
  EXPECT_EQ(list().currentText(), QStringLiteral("My \"own\": 1"));
  EXPECT_FALSE(part<QLabel>("modified").isVisible());
  EXPECT_EQ(gui::PresetStore().of("auto").back().settings,
            (std::vector<std::pair<std::string, std::string>>{{"smoothing_checks", "77"}}));

  choose("Balanced");
  choose("My \"own\": 1");
  EXPECT_EQ(checks().value(), 77);
  bar().rename(QStringLiteral("Mine"));
  EXPECT_EQ(list().currentText(), QStringLiteral("Mine"));
  EXPECT_EQ(gui::PresetStore().of("auto").back().name, QStringLiteral("Mine"));
  bar().remove();
  EXPECT_THAT(names(), Not(Contains("Mine")));
  EXPECT_EQ(checks().value(), 77) << "values stay";
  EXPECT_EQ(bar().words(), QStringLiteral("Balanced, modified"));
}

TEST_F(PresetsInThePanel, KeepTheNamesOfTheProgramApart) {
  EXPECT_THROW(bar().save_as(QStringLiteral("Fast")), geometric::InputError);
  EXPECT_THROW(bar().save_as(QStringLiteral("  ")), geometric::InputError);
  bar().save_as(QStringLiteral("One"));
  checks().setValue(5);
  bar().save_as(QStringLiteral("Two"));
  EXPECT_THROW(bar().rename(QStringLiteral("One")), geometric::InputError);
  EXPECT_THAT(names(), ElementsAre("Balanced", "Fast", "Thorough", "Shortest", "Safest", "Fastest",
                                   "One", "Two"));
}

TEST_F(PresetsInThePanel, OfSeveralWindowsAreAllKept) {
  gui::PresetStore other;
  bar().save_as(QStringLiteral("Here"));
  other.save("auto", {QStringLiteral("There"), {}, {}, false});
  EXPECT_EQ(gui::PresetStore().of("auto").size(), 8U);
}

TEST_F(PresetsInThePanel, InABrokenFileAreToldOfAndNotLost) {
  const std::string broken = "handway_presets: 1\npresets:\n  - planer: pmd-prm\n";
  write_presets(broken);
  gui::MainWindow second(std::make_shared<planning::PluginManager>());
  second.show();
  EXPECT_THAT(second.message().toStdString(), HasSubstr("presets.yaml:3"));
  gui::PresetBar& presets = *second.findChild<gui::PresetBar*>();
  EXPECT_EQ(presets.store().of("auto").size(), 6U);

  presets.save_as(QStringLiteral("New"));
  EXPECT_TRUE(presets.store().fault().isEmpty());
  std::ifstream in(gui::PresetStore::file().string() + ".unreadable");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), broken);
  EXPECT_EQ(gui::PresetStore().of("auto").size(), 7U);
}

TEST_F(PresetsInThePanel, ThatDoNotFitThePlannerChangeNothing) {
  write_presets(
      "handway_presets: 1\npresets:\n  - planner: auto\n    name: Old\n"
      "    parameters: {smoothing_checks: 5, nonsense: 3}\n");
  gui::MainWindow second(std::make_shared<planning::PluginManager>());
  gui::PresetBar& presets = *second.findChild<gui::PresetBar*>();
  QSignalSpy failed(&presets, &gui::PresetBar::failed);
  auto* list = second.findChild<QComboBox*>(QStringLiteral("presets"));
  emit list->activated(list->findText(QStringLiteral("Old")));
  ASSERT_EQ(failed.size(), 1);
  EXPECT_THAT(failed.front().at(1).toString().toStdString(), HasSubstr("nonsense"));
  EXPECT_EQ(presets.words(), QStringLiteral("Balanced"));
}

}  // namespace
}  // namespace handway::test
