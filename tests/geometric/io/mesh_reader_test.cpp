#include "handway_test/paths.h"
#include "scratch_files.h"

#include <handway/geometric/formats/mesh_reader.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace handway::geometric {
namespace {

using test::input_error_of;
using test::kSquareObj;
using test::ScratchFiles;
using testing::AllOf;
using testing::HasSubstr;

std::string stl_triangle(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 1\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
         "\nendloop\nendfacet\n";
}

std::string stl(const std::string& triangles) { return "solid s\n" + triangles + "endsolid s\n"; }

std::string dae(const std::string& unit, const std::string& up_axis) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><unit meter=")" +
         unit + R"("/><up_axis>)" + up_axis + R"(</up_axis></asset>
 <library_geometries><geometry id="g"><mesh>
  <source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 0 2</float_array>
   <technique_common><accessor source="#a" count="3" stride="3">
    <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
   </accessor></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="s"><node><translate>0 10 0</translate>
  <instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>)";
}

TEST(MeshReader, ReadsPolygonsAsTriangles) {
  const ScratchFiles files;
  const auto mesh = read_mesh(files.write("quad.obj",
                                          "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                          "f 1 2 3 4\n"));
  EXPECT_EQ(mesh->vertices.size(), 4U);
  EXPECT_EQ(mesh->triangles.size(), 2U);
}

TEST(MeshReader, JoinsEqualVertices) {
  const ScratchFiles files;
  const auto mesh = read_mesh(files.write("s.stl", stl(stl_triangle("0 0 0", "1 0 0", "1 1 0") +
                                                       stl_triangle("0 0 0", "1 1 0", "0 1 0"))));
  EXPECT_EQ(mesh->vertices.size(), 4U);
  EXPECT_EQ(mesh->triangles.size(), 2U);
}

TEST(MeshReader, DropsTrianglesWithoutArea) {
  const ScratchFiles files;
  const auto mesh = read_mesh(files.write("s.stl", stl(stl_triangle("0 0 0", "1 0 0", "1 1 0") +
                                                       stl_triangle("0 0 0", "1 0 0", "2 0 0") +
                                                       stl_triangle("5 5 5", "5 5 5", "1 1 0"))));
  EXPECT_EQ(mesh->vertices.size(), 3U);
  EXPECT_EQ(mesh->triangles.size(), 1U);
}

TEST(MeshReader, AppliesTheScale) {
  const ScratchFiles files;
  const auto mesh = read_mesh(files.write("s.obj", kSquareObj), {0.5, 2.0, 1.0});
  EXPECT_TRUE(bounding_box(*mesh).upper.isApprox(Eigen::Vector3d(0.5, 2.0, 0.0)));
}

TEST(MeshReader, KeepsAMirroredSurfaceFacingOutwards) {
  const ScratchFiles files;
  const auto mesh = read_mesh(files.write("s.obj", kSquareObj), {-1.0, 1.0, 1.0});
  for (const auto& triangle : mesh->triangles) {
    const Eigen::Vector3d& a = mesh->vertices[triangle[0]];
    const Eigen::Vector3d& b = mesh->vertices[triangle[1]];
    const Eigen::Vector3d& c = mesh->vertices[triangle[2]];
    EXPECT_GT((b - a).cross(c - a).z(), 0.0);
  }
}

TEST(MeshReader, AppliesTheUnitAndTheNodesOfADaeButNotItsUpAxis) {
  const ScratchFiles files;
  for (const std::string up_axis : {"Z_UP", "Y_UP", "X_UP"}) {
    const auto mesh = read_mesh(files.write(up_axis + ".dae", dae("0.001", up_axis)));
    const Aabb box = bounding_box(*mesh);
    EXPECT_TRUE(box.lower.isApprox(Eigen::Vector3d(0, 0.010, 0), 1e-6)) << up_axis;
    EXPECT_TRUE(box.upper.isApprox(Eigen::Vector3d(0.001, 0.010, 0.002), 1e-6)) << up_axis;
  }
}

TEST(MeshReader, ReadsPly) {
  const ScratchFiles files;
  const auto mesh = read_mesh(files.write(
      "t.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
  EXPECT_EQ(mesh->triangles.size(), 1U);
}

TEST(MeshReader, SharesAMeshWhileSomebodyHoldsIt) {
  const ScratchFiles files;
  const auto file = files.write("s.obj", kSquareObj);
  const auto first = read_mesh(file);
  EXPECT_EQ(read_mesh(files.folder() / "." / "s.obj"), first);
  EXPECT_NE(read_mesh(file, {2, 2, 2}), first);
}

TEST(MeshReader, ReadsAChangedFileAgain) {
  const ScratchFiles files;
  const auto first = read_mesh(files.write("s.obj", kSquareObj));
  const auto second = read_mesh(files.write("s.obj", kSquareObj + "v 0 0 1\nf 1 2 5\n"));
  EXPECT_EQ(first->triangles.size(), 2U);
  EXPECT_EQ(second->triangles.size(), 3U);
}

TEST(MeshReader, GivesThreadsTheSameMesh) {
  const ScratchFiles files;
  const auto file = files.write("s.obj", kSquareObj);
  std::vector<std::shared_ptr<const TriangleMesh>> meshes(8);
  std::vector<std::jthread> threads;
  threads.reserve(meshes.size());
  for (auto& mesh : meshes) {
    threads.emplace_back([&] { mesh = read_mesh(file); });
  }
  threads.clear();
  for (const auto& mesh : meshes) {
    EXPECT_EQ(mesh, meshes.front());
  }
}

TEST(MeshReader, NamesAMissingFileAndWhoNamesIt) {
  const ScratchFiles files;
  const std::string message = input_error_of([&] {
    static_cast<void>(read_mesh(files.folder() / "no.stl", {1, 1, 1}, "robot.urdf:12"));
  });
  EXPECT_THAT(message,
              AllOf(HasSubstr("robot.urdf:12"), HasSubstr("no.stl"), HasSubstr("no such file")));
}

TEST(MeshReader, RefusesWhatIsNoMesh) {
  const ScratchFiles files;
  const auto refused = [](const std::filesystem::path& file, const Eigen::Vector3d& scale) {
    return input_error_of([&] { static_cast<void>(read_mesh(file, scale)); });
  };
  const Eigen::Vector3d one(1, 1, 1);
  std::string garbage;
  for (int i = 0; i < 5000; ++i) {
    garbage += static_cast<char>(i * 7919 % 251);
  }
  for (const std::string extension : {"stl", "obj", "dae", "ply", "gltf", "glb", "xyz", ""}) {
    EXPECT_NE(refused(files.write("garbage." + extension, garbage), one), "no error") << extension;
    EXPECT_NE(refused(files.write("empty." + extension, ""), one), "no error") << extension;
  }
  EXPECT_THAT(refused(files.folder(), one), HasSubstr("not a file"));
  EXPECT_THAT(refused(files.write("p.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), one), HasSubstr("mesh"));
  EXPECT_THAT(refused(files.write("line.stl", stl(stl_triangle("0 0 0", "1 0 0", "2 0 0"))), one),
              HasSubstr("no triangle with an area"));
  EXPECT_THAT(refused(files.write("nan.stl", stl(stl_triangle("0 0 0", "nan 0 0", "0 1 0"))), one),
              HasSubstr("not finite"));
  EXPECT_THAT(refused(files.write("far.stl", stl(stl_triangle("0 0 0", "1e9 0 0", "0 1 0"))), one),
              AllOf(HasSubstr("far.stl"), HasSubstr("single precision")));
  EXPECT_THAT(refused(files.write("s.obj", kSquareObj), {1, 0, 1}), HasSubstr("scale"));
}

TEST(MeshReader, RefusesCoordinatesThatSinglePrecisionRoundsByMoreThanTenMicrometres) {
  const ScratchFiles files;
  const auto message = [&](const std::string& file, const std::string& content,
                           const Eigen::Vector3d& scale) {
    return input_error_of([&] { static_cast<void>(read_mesh(files.write(file, content), scale)); });
  };
  const Eigen::Vector3d metres(1, 1, 1);
  const Eigen::Vector3d millimetres(0.001, 0.001, 0.001);
  const auto triangle_at = [](const std::string& x) {
    return stl(stl_triangle(x + " 0 0", x + " 1 0", x + " 0 1"));
  };
  EXPECT_EQ(message("near.stl", triangle_at("160"), metres), "no error");
  EXPECT_THAT(message("far.stl", triangle_at("170"), metres),
              AllOf(HasSubstr("far.stl"), HasSubstr("170 m"), HasSubstr("up to 166 m")));
  EXPECT_EQ(message("mm.stl", triangle_at("160000"), millimetres), "no error");
  EXPECT_THAT(message("far_mm.stl", triangle_at("170000"), millimetres), HasSubstr("170 m"));
}

TEST(MeshReader, RefusesNodesThatBringFarVerticesBack) {
  const ScratchFiles files;
  std::string brought_back = dae("1", "Z_UP");
  brought_back.replace(brought_back.find("0 10 0"), 6, "0 -5000 0");
  brought_back.replace(brought_back.find("0 0 0 1 0 0 0 0 2"), 17, "0 5000 0 1 5000 0 0 5000 2");
  EXPECT_THAT(
      input_error_of([&] { static_cast<void>(read_mesh(files.write("back.dae", brought_back))); }),
      HasSubstr("5000 m"));
}

// Returns a file of more than a megabyte: points along a line, and one triangle for each of them.
std::string large_obj(int count) {
  std::string text = "v 0 0 1\n";
  for (int i = 0; i < count; ++i) {
    text += "v " + std::to_string(0.002 * i) + " 0 0\n";
  }
  for (int i = 2; i <= count; ++i) {
    text += "f 1 " + std::to_string(i) + " " + std::to_string(i + 1) + "\n";
  }
  return text;
}

class LargeMeshFile : public testing::Test {
 protected:
  LargeMeshFile() { setenv("XDG_CACHE_HOME", cache_.path().c_str(), 1); }
  ~LargeMeshFile() override {
    before_.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", before_.c_str(), 1);
  }

  [[nodiscard]] std::vector<std::filesystem::path> entries() const {
    std::vector<std::filesystem::path> found;
    std::error_code none;
    for (const auto& entry :
         std::filesystem::directory_iterator(cache_.path() / "handway" / "meshes", none)) {
      found.push_back(entry.path());
    }
    return found;
  }

  ScratchFiles files_;
  handway::test::ScratchFolder cache_;
  std::string before_ = std::getenv("XDG_CACHE_HOME") ? std::getenv("XDG_CACHE_HOME") : "";
};

TEST_F(LargeMeshFile, IsReadOnceForAllUniformScales) {
  const std::filesystem::path file = files_.write("large.obj", large_obj(40000));
  const auto first = *read_mesh(file);
  EXPECT_EQ(entries().size(), 1U);
  const auto again = read_mesh(file);
  EXPECT_EQ(again->vertices, first.vertices);
  EXPECT_EQ(again->triangles, first.triangles);
  const auto scaled = read_mesh(file, Eigen::Vector3d::Constant(0.001));
  EXPECT_EQ(entries().size(), 1U);
  EXPECT_EQ(scaled->triangles, first.triangles);
  EXPECT_EQ(scaled->vertices.back(), 0.001 * first.vertices.back());
}

TEST_F(LargeMeshFile, IsReadAgainOnceItHasChanged) {
  const std::filesystem::path file = files_.write("large.obj", large_obj(40000));
  const std::size_t before = read_mesh(file)->triangles.size();
  files_.write("large.obj", large_obj(40001));
  EXPECT_EQ(read_mesh(file)->triangles.size(), before + 1);
}

TEST_F(LargeMeshFile, IsReadAgainWhereTheEntryIsBroken) {
  const std::filesystem::path file = files_.write("large.obj", large_obj(40000));
  const std::size_t triangles = read_mesh(file)->triangles.size();
  ASSERT_EQ(entries().size(), 1U);
  std::filesystem::resize_file(entries().front(), 1000);
  EXPECT_EQ(read_mesh(file)->triangles.size(), triangles);
}

TEST_F(LargeMeshFile, MayBeMirrored) {
  const std::filesystem::path file = files_.write("large.obj", large_obj(40000));
  const auto mirrored = read_mesh(file, {-1.0, 1.0, 1.0});
  const auto [a, b, c] = read_mesh(file)->triangles.front();
  const auto [d, e, f] = mirrored->triangles.front();
  EXPECT_EQ(read_mesh(file)->vertices[b].x(), -mirrored->vertices[f].x());
  EXPECT_EQ(read_mesh(file)->vertices[c].x(), -mirrored->vertices[e].x());
}

}  // namespace
}  // namespace handway::geometric
