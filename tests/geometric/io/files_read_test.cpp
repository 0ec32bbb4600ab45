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

}  // namespace
}  // namespace handway::geometric
