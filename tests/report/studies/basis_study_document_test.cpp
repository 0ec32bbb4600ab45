#include "handway/report/studies/basis_study_document.h"

#include "handway/geometric/math/units.h"
#include "handway/report/rendering/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::test {
namespace {

using geometric::kDegree;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

sampling::BasisStudy small_study() {
  sampling::BasisStudy study;
  study.reconstruction = {{0, {0.020, 0.018, 0.022}, 0.041, 0.0},
                          {1, {0.004, 0.003, 0.0045}, 0.009, 0.75}};
  study.stability = {{12.0, {{5.0 * kDegree, 1.0 * kDegree, 9.0 * kDegree}}}};
  return study;
}

TEST(BasisStudyDocument, AnswersTheQuestionsInMillimetresAndDegrees) {
  const std::string text = report::to_text(report::basis_study_document(small_study(), 0.95));
  EXPECT_THAT(
      text,
      AllOf(HasSubstr("not used for the basis, mm (95 % confidence)"),
            HasSubstr("Enough for 10 mm: 1 PMDs; for 5 mm: 1 PMDs; for 2 mm: all PMDs "
                      "are not enough."),
            HasSubstr("20.0 (18.0 to 22.0)"), HasSubstr("5 (1 to 9)"), Not(HasSubstr("Persons"))));
}

TEST(BasisStudyDocument, ComparesPersons) {
  sampling::BasisStudy study = small_study();
  study.persons = {{"anna.csv", {0.003, 0.002, 0.004}, {0.006, 0.005, 0.007}, {0.5}},
                   {"ben.csv", {0.004, 0.003, 0.005}, {0.007, 0.006, 0.008}, {0.25}}};
  study.newcomer = {0.0065, 0.006, 0.007};
  EXPECT_THAT(report::to_text(report::basis_study_document(study, 0.9)),
              AllOf(HasSubstr("(90 % confidence)"), HasSubstr("anna.csv"),
                    HasSubstr("a new person (estimate)"), HasSubstr("6.5 (6.0 to 7.0)"),
                    HasSubstr("28.6")));
}

}  // namespace
}  // namespace handway::test
