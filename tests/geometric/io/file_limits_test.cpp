/// Files that would never end, or stand for more than there is memory.
#include "scratch_files.h"

#include <handway/geometric/formats/scene_file.h>
#include <handway/geometric/formats/urdf.h>
#include <handway/geometric/formats/yaml_element.h>
#include <handway/geometric/io/text_file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

namespace handway::geometric {
namespace {

using test::input_error_of;
using test::repeated;
using test::ScratchFiles;
using testing::AllOf;
using testing::HasSubstr;

std::string yaml_refusal(const ScratchFiles& files, const std::string& text) {
  const auto file = files.write("a.yaml", text);
  return input_error_of([&] { static_cast<void>(read_yaml_text(file, "a scene file")); });
}

TEST(FileLimits, AreNotNeededForWhatIsNoFile) {
  const ScratchFiles files;
  const auto pipe = files.folder() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::filesystem::path& path : {std::filesystem::path("/dev/zero"), pipe}) {
    EXPECT_THAT(input_error_of([&] { static_cast<void>(read_text_file(path, "a text")); }),
                AllOf(HasSubstr(path.string()), HasSubstr("no regular file")));
  }
}

TEST(FileLimits, CountWhatAliasesOfYamlStandFor) {
  const ScratchFiles files;
  std::string laughs = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    laughs += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" +
              repeated(before + ", ", 9) + before + "]\n";
  }
  EXPECT_THAT(yaml_refusal(files, laughs),
              AllOf(HasSubstr("a.yaml:6"), HasSubstr("more than 1000000 elements")));
  EXPECT_EQ(yaml_refusal(files, "a: &a [1, 2]\nb: *a\nc: *a\n"), "no error");
}

TEST(FileLimits, RefuseAnAliasWithinWhatItStandsFor) {
  const ScratchFiles files;
  EXPECT_THAT(yaml_refusal(files, "objects: &o\n  - *o\n"),
              AllOf(HasSubstr("a.yaml:2"), HasSubstr("an alias within what it stands for")));
}

TEST(FileLimits, RefuseYamlThatIsNestedTooDeep) {
  const ScratchFiles files;
  EXPECT_THAT(yaml_refusal(files, repeated("[", 20000)), HasSubstr("a.yaml"));
  EXPECT_THAT(yaml_refusal(files, repeated("- ", 20000) + "x"), HasSubstr("a.yaml"));
  // Each alias is as deep as the one before it and a hundred more.
  std::string deep = "a0: &a0 x\n";
  for (int i = 1; i < 8; ++i) {
    deep += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " " + repeated("[", 100) + "*a" +
            std::to_string(i - 1) + repeated("]", 100) + "\n";
  }
  EXPECT_THAT(yaml_refusal(files, deep), HasSubstr("more than 500 levels"));
}

TEST(FileLimits, RefuseXmlThatIsTooDeepWideOrLarge) {
  const ScratchFiles files;
  const auto refusal = [&](const std::string& text) {
    const auto file = files.write("r.urdf", text);
    return input_error_of([&] { static_cast<void>(read_urdf(file)); });
  };
  EXPECT_THAT(refusal(repeated("<robot>", 20000) + repeated("</robot>", 20000)),
              HasSubstr("nested deeper than 100"));
  std::string wide = "<robot name=\"r\"";
  for (int i = 0; i < 20000; ++i) {
    wide += " a" + std::to_string(i) + "=\"\"";
  }
  EXPECT_THAT(refusal(wide + "><link name=\"a\"/></robot>"), HasSubstr("more than 200 attributes"));
  EXPECT_THAT(refusal("<robot name=\"r\">" + repeated("<a/>", 1'000'001) + "</robot>"),
              HasSubstr("more than 1000000 tags"));
}

}  // namespace
}  // namespace handway::geometric
