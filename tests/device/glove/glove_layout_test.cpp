#include "handway/device/glove/glove_layout.h"

#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

namespace handway::device {
namespace {

TEST(GloveLayout, NamesEverySensorWithALetterOfThePaper) {
  std::set<char> letters;
  for (const GloveSensor& sensor : cyberglove_sensors()) {
    letters.insert(sensor.letter);
  }
  EXPECT_EQ(cyberglove_sensors().size(), kGloveSensors);
  EXPECT_EQ(letters.size(), kGloveSensors);
  EXPECT_EQ(*letters.begin(), 'a');
  EXPECT_EQ(*letters.rbegin(), 'v');
}

TEST(GloveLayout, IsTheTableOfTheManual) {
  std::ostringstream manual;
  manual << std::ifstream(test::source_dir() / "docs" / "glove-to-pmd.md").rdbuf();
  int place = 0;
  for (const GloveSensor& sensor : cyberglove_sensors()) {
    ++place;
    const std::string row = "\\| `" + std::string(sensor.name) + "` \\| " + sensor.letter +
                            " \\| " + std::string(sensor.measures) + " \\| [^|]* \\| " +
                            std::to_string(place) + " \\| [^|]* \\| " +
                            std::to_string(sensor.slot + 1) + " \\|";
    EXPECT_THAT(manual.str(), testing::ContainsRegex(row));
  }
}

TEST(GloveLayout, FindsASensorByNameOrLetter) {
  EXPECT_EQ(find_sensor("RingMiddleAbduct"), find_sensor("n"));
  EXPECT_EQ(find_sensor("c"), 0);
  EXPECT_EQ(find_sensor("z"), std::nullopt);
  EXPECT_EQ(find_sensor(""), std::nullopt);
}

TEST(GloveLayout, LeavesTheDistalSensorsOutOfTheSmallerGlove) {
  for (const int sensor : cyberglove_wired(18)) {
    EXPECT_FALSE(cyberglove_sensors()[static_cast<std::size_t>(sensor)].name.ends_with("DIJ"));
  }
  EXPECT_EQ(cyberglove_wired(18).size(), 18U);
  EXPECT_EQ(cyberglove_wired(22).size(), 22U);
  EXPECT_THROW((void)cyberglove_wired(20), std::invalid_argument);
}

}  // namespace
}  // namespace handway::device
