#include "handway/geometric/io/parameter.h"

#include "handway_test/input_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

using test::refusal_of;
using testing::AllOf;
using testing::HasSubstr;

struct Settings {
  bool fast = false;
  int tries = 3;
  double width = 0.25;
  int kind = 1;
};

std::vector<BoundParameter> parameters_of(Settings& settings) {
  return {{"fast", "Fast", "", "", &settings.fast},
          {"tries", "Tries", "", "", &settings.tries, 1, 10},
          {"width", "Width", "m", "", &settings.width, 1e-3, 0.5},
          {"kind", "Kind", "", "", BoundChoice{&settings.kind, {"joint", "cartesian"}}}};
}

class Parameters : public testing::Test {
 protected:
  void set(const std::string& key, const std::string& text) {
    std::vector<Parameter> list = values();
    Parameter& parameter = find_parameter(list, key);
    set_from_text(parameter, text);
    assign(list_[static_cast<std::size_t>(&parameter - list.data())], parameter);
  }
  std::vector<Parameter> values() {
    std::vector<Parameter> list(list_.size());
    std::ranges::transform(list_, list.begin(), value_of);
    return list;
  }
  std::string refusal(const std::string& key, const std::string& text) {
    const Settings before = settings_;
    const std::string message = refusal_of([&] { set(key, text); });
    EXPECT_EQ(settings_.tries, before.tries) << "a refused value changes nothing";
    EXPECT_EQ(settings_.width, before.width);
    EXPECT_EQ(settings_.kind, before.kind);
    EXPECT_EQ(settings_.fast, before.fast);
    return message;
  }

  Settings settings_;
  std::vector<BoundParameter> list_ = parameters_of(settings_);
};

TEST_F(Parameters, AreSetFromText) {
  set("fast", "true");
  set("tries", "10");
  set("width", "1e-3");
  set("kind", "cartesian");
  EXPECT_TRUE(settings_.fast);
  EXPECT_EQ(settings_.tries, 10);
  EXPECT_EQ(settings_.width, 1e-3);
  EXPECT_EQ(settings_.kind, 1);
  set("kind", "joint");
  EXPECT_EQ(settings_.kind, 0);
}

TEST_F(Parameters, ReadBackWhatTheyWrite) {
  settings_.width = 0.1 + 0.2;
  for (Parameter parameter : values()) {
    const std::string text = to_text(parameter);
    set_from_text(parameter, text);
    EXPECT_EQ(to_text(parameter), text);
    set(parameter.key, text);
  }
  EXPECT_EQ(settings_.width, 0.1 + 0.2);
  EXPECT_EQ(to_text(values()[0]), "false");
  EXPECT_EQ(to_text(values()[3]), "cartesian");
}

TEST_F(Parameters, ShowLengthsInMillimetres) {
  double length = 0.003;
  const BoundParameter parameter =
      in_thousandths({"length_mm", "Length", "mm", "", &length, 0.1, 50.0});
  EXPECT_EQ(to_text(value_of(parameter)), "3");
  set_from_text(parameter, "0.1");
  EXPECT_DOUBLE_EQ(length, 1e-4);
  EXPECT_EQ(to_text(value_of(parameter)), "0.1");
  EXPECT_THAT(refusal_of([&] { set_from_text(parameter, "0.05"); }), HasSubstr("from 0.1 to 50"));
  EXPECT_DOUBLE_EQ(length, 1e-4);
}

TEST_F(Parameters, AreOfferedInSiUnits) {
  double period = 0.004;
  const BoundParameter parameter =
      in_si_units(in_thousandths({"period_ms", "Period", "ms", "", &period, 0.1, 1000.0}));
  EXPECT_EQ(parameter.key, "period");
  EXPECT_EQ(parameter.unit, "s");
  EXPECT_EQ(to_text(value_of(parameter)), "0.004");
  set_from_text(parameter, "0.0001");
  EXPECT_EQ(period, 1e-4);
  EXPECT_THAT(refusal_of([&] { set_from_text(parameter, "1.5"); }), HasSubstr("from 0.0001 to 1"));
  EXPECT_EQ(period, 1e-4);
  const std::vector<BoundParameter> others = in_si_units(list_);
  EXPECT_EQ(others[2].key, "width");
  EXPECT_EQ(others[2].upper, 0.5);
}

TEST_F(Parameters, HaveOptionsOfTheirNames) {
  EXPECT_EQ(option_name("period_ms"), "--period-ms");
  EXPECT_EQ(option_name("jerk"), "--jerk");
}

TEST_F(Parameters, KeepAValueOutOfRangeThatIsThere) {
  double limit = std::numeric_limits<double>::infinity();
  const BoundParameter parameter = {"limit", "Limit", "s", "", &limit, 1.0, 10.0};
  set_from_text(parameter, "inf");
  EXPECT_EQ(limit, std::numeric_limits<double>::infinity());
  EXPECT_THAT(refusal_of([&] { set_from_text(parameter, "11"); }), HasSubstr("from 1 to 10"));
  set_from_text(parameter, "10");
  EXPECT_THAT(refusal_of([&] { set_from_text(parameter, "inf"); }), HasSubstr("from 1 to 10"));
}

TEST_F(Parameters, RefuseNumbersOutOfRange) {
  EXPECT_THAT(refusal("tries", "11"),
              AllOf(HasSubstr("tries"), HasSubstr("\"11\""), HasSubstr("from 1 to 10")));
  EXPECT_THAT(refusal("tries", "0"), HasSubstr("from 1 to 10"));
  EXPECT_THAT(refusal("width", "0.6"), HasSubstr("from 0.001 to 0.5"));
  EXPECT_THAT(refusal("width", "-1"), HasSubstr("\"-1\""));
}

TEST_F(Parameters, RefuseWhatIsNoNumber) {
  for (const std::string text :
       {"", " ", "ten", "0x3", "3 ", "nan", "-nan", "inf", "1e999", "3;"}) {
    EXPECT_THAT(refusal("width", text), HasSubstr("a number from")) << text;
  }
  for (const std::string text : {"", "2.5", "1e1", "99999999999999999999", "three"}) {
    EXPECT_THAT(refusal("tries", text), HasSubstr("a whole number from")) << text;
  }
}

TEST_F(Parameters, RefuseOtherWords) {
  EXPECT_THAT(refusal("kind", "spherical"),
              AllOf(HasSubstr("\"spherical\""), HasSubstr("joint, cartesian")));
  EXPECT_THAT(refusal("fast", "yes"), HasSubstr("true or false"));
}

TEST_F(Parameters, NameTheOnesThereAre) {
  EXPECT_THAT(refusal("speed", "1"),
              AllOf(HasSubstr("speed"), HasSubstr("fast, tries, width, kind")));
}

}  // namespace
}  // namespace handway::geometric
