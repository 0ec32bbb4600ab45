#include "handway/planning/planners/planner.h"
#include "handway_test/input_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

namespace handway::planning {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(PlannerRegistry, StartsWithTheBuiltInPlanners) {
  const PlannerRegistry registry;
  EXPECT_EQ(registry.names().front(), "auto") << "the default";
  EXPECT_THAT(registry.names(), testing::IsSupersetOf({"pmd-prm", "full-prm", "pmd-rrt-connect",
                                                       "pmd-lazy", "rrt-connect"}));
}

TEST(PlannerRegistry, KnowsTheDefaultByItsFormerName) {
  EXPECT_EQ(PlannerRegistry().create("pmd-auto")->name(), "auto");
}

TEST(PlannerRegistry, MakesPlannersThatKnowTheirName) {
  const PlannerRegistry registry;
  for (const std::string& name : registry.names()) {
    const auto planner = registry.create(name);
    EXPECT_EQ(planner->name(), name);
    EXPECT_FALSE(planner->description().empty());
    EXPECT_NE(registry.create(name), planner) << "a new one each time";
  }
}

TEST(PlannerRegistry, DescribesEveryParameter) {
  const PlannerRegistry registry;
  for (const std::string& name : registry.names()) {
    const auto planner = registry.create(name);
    std::set<std::string> keys;
    for (const geometric::Parameter& parameter : planner->parameters()) {
      EXPECT_TRUE(keys.insert(parameter.key).second) << name << " " << parameter.key;
      EXPECT_FALSE(parameter.label.empty() || parameter.help.empty()) << parameter.key;
      EXPECT_NO_THROW(planner->set_parameter(parameter.key, to_text(parameter)))
          << name << ": the default of " << parameter.key << " must be allowed";
    }
  }
}

TEST(PlannerRegistry, NamesThePlannersThereAre) {
  const PlannerRegistry registry;
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(registry.create("pmd-prn")); }),
              AllOf(HasSubstr("pmd-prn"), HasSubstr("pmd-prm"), HasSubstr("rrt-connect")));
}

TEST(PlannerRegistry, TakesANameOnce) {
  PlannerRegistry registry;
  const auto make = [] { return PlannerRegistry().create("rrt-connect"); };
  registry.add("mine", make);
  EXPECT_EQ(registry.names().back(), "mine");
  EXPECT_EQ(registry.create("mine")->name(), "rrt-connect");
  EXPECT_THROW(registry.add("mine", make), std::invalid_argument);
  EXPECT_THROW(registry.add("pmd-prm", make), std::invalid_argument);
}

}  // namespace
}  // namespace handway::planning
