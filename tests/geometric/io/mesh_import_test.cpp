/// Mesh files of others, read by a process of its own that they may crash, stall or fill.
#include "scratch_files.h"

#include <handway/geometric/formats/mesh_import.h>
#include <handway/geometric/formats/mesh_reader.h>

#include <assimp/Importer.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <ostream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace handway::geometric {
namespace {

using test::input_error_of;
using test::kSquareObj;
using test::repeated;
using test::ScratchFiles;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

const std::string kInventor = "#Inventor V2.1 ascii\n";
const std::string kVrml = "#VRML V2.0 utf8\n";

MeshFormat format_of(const std::filesystem::path& file) {
  return file.extension() == ".iv" || file.extension() == ".wrl" ? MeshFormat::kInventor
                                                                 : MeshFormat::kAssimp;
}

std::string refusal(const std::filesystem::path& file) {
  return input_error_of([&] { static_cast<void>(import_mesh(file, format_of(file))); });
}

std::string ply(const std::string& face, const std::string& rows) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list " +
         face + " vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n" + rows;
}

// A cube, twice as many in each group as in the one before it.
std::string cubes(int doublings) {
  std::ostringstream text;
  text << kInventor << "DEF G0 Separator { Cube {} }\n";
  for (int i = 1; i <= doublings; ++i) {
    text << "DEF G" << i << " Separator { USE G" << i - 1 << " USE G" << i - 1 << " }\n";
  }
  return text.str();
}

struct BadMesh {
  std::string name;  ///< Name of the case and of the file.
  std::string content;
  std::vector<std::string> answers;  ///< One of them, or any if there is none.
};

void PrintTo(const BadMesh& mesh, std::ostream* out) { *out << mesh.name; }

class BadMeshes : public testing::TestWithParam<BadMesh> {};

TEST_P(BadMeshes, AreAnsweredByOneMessage) {
  const ScratchFiles files;
  const auto file = files.write(GetParam().name, GetParam().content);
  const std::string message = refusal(file);
  EXPECT_THAT(message, AllOf(HasSubstr(file.string()), HasSubstr("found ")));
  std::vector<testing::Matcher<std::string>> answers;
  for (const std::string& answer : GetParam().answers) {
    answers.emplace_back(HasSubstr(answer));
  }
  if (!answers.empty()) {
    EXPECT_THAT(message, testing::AnyOfArray(answers));
  }
  EXPECT_EQ(import_mesh(files.write("good.obj", kSquareObj), MeshFormat::kAssimp)
                .triangles.triangles.size(),
            2U);
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadMeshes,
    testing::Values(
        BadMesh{"beyond.iv",
                kInventor + "Coordinate3 { point [0 0 0, 1 0 0, 0 1 0] }\n"
                            "IndexedFaceSet { coordIndex [0, 1, 3, -1] }\n",
                {"the index 3 into 3 points"}},
        BadMesh{"beyond.wrl",
                kVrml + "Shape { geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, "
                        "0 1 0] } coordIndex [0 1 3 -1] } }\n",
                {"the index 3 into 3 points"}},
        BadMesh{"below.iv",
                kInventor + "Coordinate3 { point [0 0 0, 1 0 0, 0 1 0] }\n"
                            "IndexedFaceSet { coordIndex [0, 1, -7, 2, -1] }\n",
                {"the index -7 into 3 points"}},
        BadMesh{"strip.iv",
                kInventor + "VertexProperty { vertex [9 9 9] }\nTriangleStripSet { vertexProperty "
                            "VertexProperty { vertex [0 0 0, 1 0 0, 0 1 0] } numVertices [4] }\n",
                {"the index 3 into 3 points"}},
        BadMesh{"faces.iv",
                kInventor + "Coordinate3 { point [0 0 0, 1 0 0, 0 1 0] }\n"
                            "FaceSet { startIndex 1 numVertices [3] }\n",
                {"the index 3 into 3 points"}},
        BadMesh{"quads.iv",
                kInventor + "Coordinate3 { point [0 0 0, 1 0 0, 0 1 0] }\n"
                            "QuadMesh { verticesPerRow 2 verticesPerColumn 2 }\n",
                {"the index 3 into 3 points"}},
        BadMesh{"grid.wrl",
                kVrml + "Shape { geometry ElevationGrid { xDimension 9 zDimension 9 height [1] } }",
                {"a grid of 9 × 9 with 1 heights"}},
        BadMesh{"no_points.wrl",
                kVrml + "Shape { geometry IndexedFaceSet { coordIndex [0 1 2 -1] } }\n",
                {"the index 0 into 0 points"}},
        BadMesh{"in_itself.iv", kInventor + "DEF A Separator { USE A }\n", {}},
        BadMesh{"nested.iv", kInventor + repeated("Separator {", 20000) + repeated("}", 20000), {}},
        BadMesh{"doubled.iv", cubes(40), {"vertices or triangles", "s to read", "of memory"}},
        BadMesh{"count.dae",
                "<?xml version=\"1.0\"?><COLLADA version=\"1.4.1\"><library_geometries><geometry "
                "id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"x\">0 0 0"
                "</float_array></source></mesh></geometry></library_geometries></COLLADA>",
                {}},
        BadMesh{"header.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n", {}},
        BadMesh{"none.ply", ply("uchar int", "0\n"), {}},
        BadMesh{"many.ply", ply("uint int", "4294967295 0 1 2\n"), {}},
        BadMesh{"many_rows.ply",
                "ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\n"
                "property float x\nproperty float y\nproperty float z\nend_header\n",
                {}}),
    [](const auto& test) {
      std::string name = test.param.name;
      std::ranges::replace(name, '.', '_');
      return name;
    });

TEST(MeshImport, RefusesWhatIsNoRegularFileWithoutOpeningIt) {
  const ScratchFiles files;
  const auto pipe = files.folder() / "pipe.stl";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const auto& path : {std::filesystem::path("/dev/zero"), std::filesystem::path("/dev/tty"),
                           pipe, files.folder()}) {
    EXPECT_THAT(refusal(path), HasSubstr("not a file")) << path;
  }
}

TEST(MeshImport, DoesNotOpenAPipeThatAFileNames) {
  const ScratchFiles files;
  ASSERT_EQ(::mkfifo((files.folder() / "pipe.mtl").c_str(), 0600), 0);
  const auto file = files.write("s.obj", "mtllib pipe.mtl\n" + kSquareObj);
  EXPECT_EQ(import_mesh(file, MeshFormat::kAssimp).triangles.triangles.size(), 2U);
}

TEST(MeshImport, FindsIncludedFilesInOtherLetters) {
  const ScratchFiles files;
  files.write("parts/Bolt.IV", kInventor + "Cube {}\n");
  files.write("parts/Nut.WRL", kVrml + "Shape { geometry Box {} }\n");
  files.write("parts/Both.wrl", kVrml + "Inline { url \"nut.wrl\" }\n");
  const ImportedMesh bolt =
      import_mesh(files.write("bolt.iv", kInventor + "File { name \"Parts\\bolt.iv\" }\n"),
                  MeshFormat::kInventor);
  EXPECT_EQ(bolt.triangles.triangles.size(), 12U);
  EXPECT_TRUE(bolt.includes_files);
  EXPECT_THAT(bolt.warnings, testing::ElementsAre(HasSubstr("has other letters on the disk")));
  const ImportedMesh nut = import_mesh(
      files.write("nut.wrl", kVrml + "Inline { url \"PARTS/both.wrl\" }\n"), MeshFormat::kInventor);
  EXPECT_EQ(nut.triangles.triangles.size(), 12U)
      << "a file that includes another from its own folder";
  EXPECT_THAT(nut.warnings, testing::SizeIs(2));
}

TEST(MeshImport, RefusesFilesThatIncludeThemselves) {
  const ScratchFiles files;
  EXPECT_THAT(refusal(files.write("ring.wrl", kVrml + "Inline { url \"ring.wrl\" }\n")),
              HasSubstr("ring.wrl"));
  EXPECT_THAT(refusal(files.write("ring.iv", kInventor + "File { name \"ring.iv\" }\n")),
              HasSubstr("ring.iv"));
  EXPECT_THAT(refusal(files.write("none.iv", kInventor + "File { name \"none here.iv\" }\n")),
              HasSubstr("none here.iv"));
  EXPECT_THAT(refusal(files.write("none.wrl", kVrml + "Inline { url \"none here.wrl\" }\n")),
              HasSubstr("none here.wrl"));
}

TEST(MeshImport, RefusesFilesThatAreTooLarge) {
  const ScratchFiles files;
  const auto file = files.write("large.stl", "solid\n");
  std::filesystem::resize_file(file, (std::uintmax_t{1} << 30) + 1);
  EXPECT_THAT(refusal(file), HasSubstr("at most 1024 MB"));
}

TEST(MeshImport, ReadsInSeveralThreadsAtOnce) {
  const ScratchFiles files;
  const auto file = files.write("s.obj", kSquareObj);
  std::vector<std::size_t> triangles(8);
  std::vector<std::jthread> threads;
  threads.reserve(triangles.size());
  for (std::size_t& count : triangles) {
    threads.emplace_back(
        [&] { count = import_mesh(file, MeshFormat::kAssimp).triangles.triangles.size(); });
  }
  threads.clear();
  EXPECT_THAT(triangles, testing::Each(2U));
}

TEST(MeshImport, GoesOnInAForkAndInItsParent) {
  const ScratchFiles files;
  const auto file = files.write("s.obj", kSquareObj);
  const auto reads = [&] {
    return import_mesh(file, MeshFormat::kAssimp).triangles.triangles.size() == 2;
  };
  ASSERT_TRUE(reads());
  const pid_t child = ::fork();
  if (child == 0) {
    ::_exit(reads() ? 0 : 1);
  }
  EXPECT_TRUE(reads());
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(reads());
}

TEST(MeshImport, KnowsTheEndingsThatAssimpKnows) {
  aiString list;
  Assimp::Importer().GetExtensionList(list);
  std::istringstream endings(list.C_Str());
  for (std::string ending; std::getline(endings, ending, ';');) {
    EXPECT_TRUE(is_mesh_file("mesh" + ending.substr(1))) << ending;
  }
  EXPECT_TRUE(is_mesh_file("MESH.STL"));
  EXPECT_FALSE(is_mesh_file("scene.yaml"));
  EXPECT_FALSE(is_mesh_file("stl"));
}

/// Programs that answer otherwise than they should.
class StrangeMeshReader : public testing::Test {
 protected:
  ~StrangeMeshReader() override { ::unsetenv("HANDWAY_MESH_READER"); }

  // A reader that does as this Python code says, with `path` and the descriptor `pipe`.
  std::string answer_of(const std::string& code) {
    const auto program = files_.write(
        "reader" + std::to_string(++readers_),
        "#!/usr/bin/python3\nimport os, socket, struct\n"
        "s = socket.socket(fileno=3)\n"
        "request, (pipe,), _, _ = socket.recv_fds(s, 8192, 1)\n"
        "def reply(vertices, triangles, mark=0x48574D34):\n"
        "  os.write(pipe, struct.pack('<2I4f2I2Qd', mark, 0, 0, 0, 0, 1, 0, 0, vertices, "
        "triangles, 0))\n"
        "def end(outcome=0, signal=0):\n"
        "  os.close(pipe)\n"
        "  s.send(struct.pack('<2Ii', 0x48574D34, outcome, signal))\n" +
            code);
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    return answer_of_program(program);
  }

  std::string answer_of_program(const std::filesystem::path& program) const {
    ::setenv("HANDWAY_MESH_READER", program.c_str(), 1);
    return refusal(files_.write("s.obj", kSquareObj));
  }

 private:
  ScratchFiles files_;
  int readers_ = 0;
};

TEST_F(StrangeMeshReader, IsNamedIfThereIsNone) {
  EXPECT_THAT(answer_of_program("/nowhere/reader"),
              AllOf(HasSubstr("/nowhere/reader can't be started"), HasSubstr("s.obj")));
}

TEST(MeshImport, StartsAnotherProgramForOneThatWasKilled) {
  const ScratchFiles files;
  const auto file = files.write("s.obj", kSquareObj);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(import_mesh(file, MeshFormat::kAssimp).triangles.triangles.size(), 2U);
    EXPECT_EQ(
        std::system(("pkill -KILL -P " + std::to_string(::getpid()) + " handway-mesh").c_str()), 0);
  }
}

TEST_F(StrangeMeshReader, MayEndAtOnce) {
  EXPECT_THAT(answer_of_program("/bin/true"), HasSubstr("the program that reads it ended"));
  EXPECT_THAT(answer_of(""), HasSubstr("the program that reads it ended"));
}

TEST_F(StrangeMeshReader, MayAnswerNonsense) {
  EXPECT_THAT(answer_of("os.write(pipe, b'x' * 5000)\nend()\n"), HasSubstr("crashed"));
  EXPECT_THAT(answer_of("reply(3, 1, mark=1)\nend()\n"), HasSubstr("crashed"));
  EXPECT_THAT(answer_of("reply(1 << 40, 1 << 40)\nend()\n"), HasSubstr("crashed"));
  EXPECT_THAT(answer_of("reply(3, 1)\nend()\n"), HasSubstr("crashed"));
  EXPECT_THAT(answer_of("reply(1, 1)\nos.write(pipe, struct.pack('<3d3I', 0, 0, 0, 0, 0, 1))\n"
                        "end()\n"),
              HasSubstr("names a vertex which the file does not have"));
  EXPECT_THAT(answer_of("reply(1, 1)\n"
                        "os.write(pipe, struct.pack('<3d3I', 0, float('nan'), 0, 0, 0, 0))\n"
                        "end()\n"),
              HasSubstr("not finite"));
}

TEST_F(StrangeMeshReader, TellsWhatEndedTheReading) {
  EXPECT_THAT(answer_of("end(outcome=2, signal=11)\n"), HasSubstr("crashed (SIGSEGV)"));
  EXPECT_THAT(answer_of("end(outcome=1, signal=27)\n"), HasSubstr("longer than 0.8 s"));
}

}  // namespace
}  // namespace handway::geometric
