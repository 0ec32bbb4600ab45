#include "widgets/forms/quantity_field.h"

#include "handway/geometric/math/units.h"

#include <gtest/gtest.h>

namespace handway::gui {
namespace {

using Kind = QuantityField::Kind;

class QuantityFields : public ::testing::Test {
 protected:
  void TearDown() override { QuantityField::show_units({}); }
};

TEST_F(QuantityFields, UnderstandSpeedsOfTurningInAnyUnit) {
  QuantityField speed(Kind::kAngularSpeed, 0.0, 10.0);
  for (const char* text : {"90", "90°", "90°/s", "90 deg/s", "90°/s°/s"}) {
    EXPECT_NEAR(speed.valueFromText(QString::fromUtf8(text)), 90.0, 1e-9) << text;
  }
  EXPECT_NEAR(speed.valueFromText(QStringLiteral("2 rad/s")), geometric::degrees(2.0), 1e-9);
}

TEST_F(QuantityFields, KeepTellingThatASpeedIsOne) {
  QuantityField speed(Kind::kAngularSpeed, 0.0, 10.0);
  speed.show_quantity(geometric::radians(60.0));
  EXPECT_EQ(speed.text(), QString::fromUtf8("60°/s"));
  QuantityField::show_units({LengthUnit::kMetre, AngleUnit::kRadian});
  EXPECT_TRUE(speed.text().endsWith(QStringLiteral("rad/s"))) << speed.text().toStdString();
}

}  // namespace
}  // namespace handway::gui
