#include "handway/geometric/io/input_error.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway_test/paths.h"
#include "sah_basis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

namespace handway::sampling {
namespace {

using geometric::InputError;
using ::testing::HasSubstr;

const char* const kBasis = R"(hand: claw
source: "made up"
units: normalised
joints: [base, left, right]
mean: [0.5, 0.25, 0.75]
free_joints:
  - {joint: base, half_side: 0.5, centre: 0.3}
directions:
  - {name: PMD1, half_side: 0.4, variance: 0.1, vector: [0, 0.6, 0.8]}
  - {name: PMD2, half_side: 0.2, vector: [0, 0.8, -0.6]}
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

class PmdBasisIo : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "basis.yaml"; }

  [[nodiscard]] PmdBasis read(const std::string& text) const {
    std::ofstream(file()) << text;
    return read_pmd_basis(file());
  }

  // Returns the message about the text, without the folder's name.
  [[nodiscard]] std::string complaint(const std::string& text) const {
    try {
      static_cast<void>(read(text));
    } catch (const InputError& e) {
      const std::string what = e.what();
      return what.substr(what.find("basis.yaml"));
    }
    return "accepted";
  }

  [[nodiscard]] std::string complaint_after(const std::string& from, const std::string& to) const {
    return complaint(replaced(kBasis, from, to));
  }

 private:
  test::ScratchFolder folder_;
};

void expect_same(const PmdBasis& one, const PmdBasis& two) {
  EXPECT_EQ(one.hand, two.hand);
  EXPECT_EQ(one.source, two.source);
  EXPECT_EQ(one.joints, two.joints);
  EXPECT_EQ(one.mean, two.mean);
  ASSERT_EQ(one.free_joints.size(), two.free_joints.size());
  for (std::size_t i = 0; i < one.free_joints.size(); ++i) {
    EXPECT_EQ(one.free_joints[i].joint, two.free_joints[i].joint);
    EXPECT_EQ(one.free_joints[i].centre, two.free_joints[i].centre);
    EXPECT_EQ(one.free_joints[i].half_side, two.free_joints[i].half_side);
  }
  ASSERT_EQ(one.directions.size(), two.directions.size());
  for (std::size_t i = 0; i < one.directions.size(); ++i) {
    EXPECT_EQ(one.directions[i].name, two.directions[i].name);
    EXPECT_EQ(one.directions[i].vector, two.directions[i].vector);
    EXPECT_EQ(one.directions[i].half_side, two.directions[i].half_side);
    EXPECT_EQ(one.directions[i].variance, two.directions[i].variance);
  }
}

TEST_F(PmdBasisIo, ReadsEveryPart) {
  const PmdBasis basis = read(kBasis);
  EXPECT_EQ(basis.hand, "claw");
  EXPECT_EQ(basis.source, "made up");
  EXPECT_EQ(basis.joints, (std::vector<std::string>{"base", "left", "right"}));
  EXPECT_EQ(basis.mean, Eigen::Vector3d(0.5, 0.25, 0.75));
  ASSERT_EQ(basis.free_joints.size(), 1u);
  EXPECT_EQ(basis.free_joints[0].joint, 0);
  EXPECT_EQ(basis.free_joints[0].half_side, 0.5);
  EXPECT_EQ(basis.free_joints[0].centre, 0.3);
  ASSERT_EQ(basis.directions.size(), 2u);
  EXPECT_EQ(basis.directions[0].name, "PMD1");
  EXPECT_EQ(basis.directions[0].variance, 0.1);
  EXPECT_EQ(basis.directions[1].variance, 0.0);
  EXPECT_EQ(basis.directions[1].vector, Eigen::Vector3d(0, 0.8, -0.6));
}

TEST_F(PmdBasisIo, ReadsBackTheSameBits) {
  PmdBasis basis = test::sah_thumb_basis();
  basis.source = "quotes \" and: colons # and\nlines";
  for (PrincipalDirection& direction : basis.directions) {
    direction.vector.normalize();
    direction.variance = direction.half_side / 3.0;
  }
  basis.mean[2] = 1e-7 / 3.0;
  write_pmd_basis(basis, file());
  expect_same(read_pmd_basis(file()), basis);
}

TEST_F(PmdBasisIo, WritesLongVectorsAsUnitVectorsThatSpanTheSame) {
  PmdBasis basis = read(kBasis);
  basis.directions[0].vector *= 2.0;
  write_pmd_basis(basis, file());
  const PrincipalDirection direction = read_pmd_basis(file()).directions[0];
  EXPECT_EQ(direction.vector, Eigen::Vector3d(0, 0.6, 0.8));
  EXPECT_DOUBLE_EQ(direction.half_side, 0.8);
  EXPECT_DOUBLE_EQ(direction.variance, 0.4);
}

TEST_F(PmdBasisIo, NamesRecordedPosturesFromItsOwnFolder) {
  const PmdBasis basis = read(replaced(kBasis, "units:", "postures: recorded/claw.csv\nunits:"));
  EXPECT_EQ(basis.postures, file().parent_path() / "recorded" / "claw.csv");
  const std::filesystem::path other = file().parent_path() / "recorded" / "basis.yaml";
  std::filesystem::create_directory(other.parent_path());
  write_pmd_basis(basis, other);
  std::ostringstream text;
  text << std::ifstream(other).rdbuf();
  EXPECT_THAT(text.str(), HasSubstr("postures: \"claw.csv\""));
  EXPECT_EQ(read_pmd_basis(other).postures, basis.postures);
}

TEST_F(PmdBasisIo, ReadsBackABasisWithoutFreeJoints) {
  PmdBasis basis = read(kBasis);
  basis.free_joints.clear();
  write_pmd_basis(basis, file());
  expect_same(read_pmd_basis(file()), basis);
}

TEST_F(PmdBasisIo, WritesNumbersShortly) {
  write_pmd_basis(read(kBasis), file());
  std::ostringstream text;
  text << std::ifstream(file()).rdbuf();
  EXPECT_THAT(text.str(), HasSubstr("vector: [0, 0.6, 0.8]"));
  EXPECT_THAT(text.str(), HasSubstr("variance: 0.1"));
}

TEST_F(PmdBasisIo, RefusesToWriteIntoAFolderThatIsNotThere) {
  EXPECT_THROW(write_pmd_basis(read(kBasis), file().parent_path() / "missing" / "basis.yaml"),
               InputError);
  EXPECT_FALSE(std::filesystem::exists(file().parent_path() / "missing"));
}

TEST_F(PmdBasisIo, NamesAFileThatIsNotThere) {
  try {
    static_cast<void>(read_pmd_basis(file()));
    FAIL() << "read a missing file";
  } catch (const InputError& e) {
    EXPECT_EQ(e.problem().source, file().string());
  }
}

TEST_F(PmdBasisIo, NamesTheLineOfBrokenYaml) {
  EXPECT_THAT(complaint_after("[0.5, 0.25, 0.75]", "[0.5, 0.25"), HasSubstr("basis.yaml:"));
  EXPECT_THAT(complaint(""), HasSubstr("an empty file"));
  EXPECT_THAT(complaint("just words"), HasSubstr("expected a PMD basis"));
}

TEST_F(PmdBasisIo, NamesMissingKeys) {
  EXPECT_THAT(complaint_after("hand: claw\n", ""), HasSubstr("no \"hand\""));
  EXPECT_THAT(complaint_after("units: normalised\n", ""), HasSubstr("no \"units\""));
  EXPECT_THAT(complaint_after("mean: [0.5, 0.25, 0.75]\n", ""), HasSubstr("no \"mean\""));
  EXPECT_THAT(complaint_after(", centre: 0.3", ""),
              HasSubstr("basis.yaml:7: free_joints[0]: found no \"centre\""));
  EXPECT_THAT(complaint_after("half_side: 0.2, ", ""),
              HasSubstr("basis.yaml:10: directions[1]: found no \"half_side\""));
}

TEST_F(PmdBasisIo, NamesUnknownKeys) {
  EXPECT_THAT(complaint_after("half_side: 0.2", "halfside: 0.2"),
              HasSubstr("basis.yaml:10: directions[1].halfside: found the unknown key"));
  EXPECT_THAT(complaint_after("source:", "origin:"),
              HasSubstr("basis.yaml:2: origin: found the unknown key"));
}

TEST_F(PmdBasisIo, RefusesOtherUnits) {
  EXPECT_THAT(complaint_after("normalised", "radians"), HasSubstr("basis.yaml:3: units"));
}

TEST_F(PmdBasisIo, RefusesVectorsOfTheWrongLength) {
  EXPECT_THAT(complaint_after("[0.5, 0.25, 0.75]", "[0.5, 0.25]"),
              HasSubstr("basis.yaml:5: mean: found a list of 2, expected a list of 3"));
  EXPECT_THAT(
      complaint_after("[0, 0.6, 0.8]", "[0, 0.6, 0.8, 0]"),
      HasSubstr("basis.yaml:9: directions[0].vector: found a list of 4, expected a list of 3"));
}

TEST_F(PmdBasisIo, RefusesWhatIsNotAFiniteNumber) {
  EXPECT_THAT(complaint_after("0.25", ".nan"), HasSubstr("basis.yaml:5: mean[1]: found \".nan\""));
  EXPECT_THAT(complaint_after("centre: 0.3", "centre: .inf"), HasSubstr("free_joints[0].centre"));
  EXPECT_THAT(complaint_after("0.25", "much"), HasSubstr("mean[1]: found \"much\""));
  EXPECT_THAT(complaint_after("0.25", "[1]"), HasSubstr("mean[1]: found a list"));
}

TEST_F(PmdBasisIo, RefusesUnknownAndRepeatedJoints) {
  EXPECT_THAT(complaint_after("joint: base", "joint: wrist"),
              HasSubstr("free_joints[0].joint: found the unknown joint \"wrist\", expected one of "
                        "base, left, right"));
  EXPECT_THAT(complaint_after("left", "base"), HasSubstr("joints[1]: found \"base\" a second"));
  EXPECT_THAT(
      complaint_after("directions:", "  - {joint: base, half_side: 0.5, centre: 0.3}\ndirections:"),
      HasSubstr("basis.yaml:8: free_joints[1].joint: found \"base\" a second time"));
}

TEST_F(PmdBasisIo, RefusesHalfSidesAndVariancesOutOfRange) {
  EXPECT_THAT(complaint_after("half_side: 0.4", "half_side: 0"),
              HasSubstr("basis.yaml:9: directions[0].half_side: found \"0\""));
  EXPECT_THAT(complaint_after("half_side: 0.5", "half_side: -1"),
              HasSubstr("free_joints[0].half_side: found \"-1\""));
  EXPECT_THAT(complaint_after("variance: 0.1", "variance: -0.1"), HasSubstr("variance"));
}

TEST_F(PmdBasisIo, RefusesVectorsThatAreNotOfUnitLength) {
  EXPECT_THAT(complaint_after("[0, 0.6, 0.8]", "[0, 0.6, 0.82]"),
              HasSubstr("directions[0].vector: found length 1.01"));
  EXPECT_EQ(complaint_after("[0, 0.6, 0.8]", "[0, 0.6, 0.805]"), "accepted");
}

TEST_F(PmdBasisIo, RefusesABasisWithoutAxes) {
  std::string text = kBasis;
  EXPECT_THAT(complaint(text.substr(0, text.find("free_joints"))), HasSubstr("at least one axis"));
}

}  // namespace
}  // namespace handway::sampling
