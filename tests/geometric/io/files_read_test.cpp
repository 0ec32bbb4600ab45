#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/io/text_file.h"
#include "scratch_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::geometric {
namespace {

using test::kSquareObj;
using test::ScratchFiles;
using testing::ElementsAre;

TEST(FilesRead, AreNotedOnceEachWhileAnybodyWantsToKnow) {
  const ScratchFiles files;
  const auto text = files.write("a.txt", "text");
  const auto mesh = files.write("b.obj", kSquareObj);
  const auto held = read_mesh(mesh);
  const FilesRead all;
  static_cast<void>(read_text_file(text, "a text"));
  {
    const FilesRead inner;
    static_cast<void>(read_mesh(mesh));
    static_cast<void>(read_mesh(mesh));
    EXPECT_THAT(inner.files(), ElementsAre(mesh)) << "though it was in memory";
  }
  static_cast<void>(read_text_file(files.folder() / "." / "a.txt", "a text"));
  EXPECT_THAT(all.files(), ElementsAre(text, mesh));
}

// Windows' shells and older editors write these encodings.
TEST(TextFile, IsReadInOtherEncodings) {
  const ScratchFiles files;
  const auto read = [&](const std::string& bytes) {
    return read_text_file(files.write("a.txt", bytes), "a text");
  };
  EXPECT_EQ(read("\xEF\xBB\xBF"
                 "gr\xC3\xB6\xC3\x9F"
                 "e"),
            "gr\u00F6\u00DFe");
  EXPECT_EQ(read("gr\xF6\xDF"
                 "e, 5\xB0"),
            "gr\u00F6\u00DFe, 5\u00B0");
  EXPECT_EQ(read(std::string("\xFF\xFE"
                             "a\0\xF6\0\x3D\xD8\x00\xDE",
                             10)),
            "a\u00F6\U0001F600");
  EXPECT_EQ(read(std::string("\xFE\xFF\0a\0\xF6", 6)), "a\u00F6");
  EXPECT_THAT(test::input_error_of([&] { static_cast<void>(read("a\nb\x01")); }),
              testing::AllOf(testing::HasSubstr("a.txt:2"), testing::HasSubstr("no text")));
}

}  // namespace
}  // namespace handway::geometric
