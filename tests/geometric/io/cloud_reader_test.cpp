/// Point clouds of others: every format, damaged files, and the body that is made of points.
#include "scratch_files.h"

#include <handway/geometric/formats/cloud_reader.h>
#include <handway/geometric/formats/depth_image.h>
#include <handway/geometric/formats/scene_file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/OcTree.h>
#include <png.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

using test::input_error_of;
using test::ScratchFiles;
using testing::ElementsAre;
using testing::HasSubstr;

template <typename Number>
std::string bytes_of(const std::vector<Number>& numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

const float kMissing = std::numeric_limits<float>::quiet_NaN();

std::string pcd(const std::string& fields, const std::string& sizes, const std::string& types,
                int points, const std::string& data) {
  std::string counts = "COUNT";
  std::istringstream words(fields);
  for (std::string word; words >> word;) {
    counts += " 1";
  }
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " + sizes + "\nTYPE " + types +
         '\n' + counts + "\nWIDTH " + std::to_string(points) +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + std::to_string(points) + "\nDATA " + data;
}

std::string numpy(const std::string& type, const std::string& shape, const std::string& elements) {
  std::string header =
      "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }\n";
  const auto length = static_cast<std::uint16_t>(header.size());
  return std::string("\x93NUMPY\x01\x00", 8) + bytes_of<std::uint16_t>({length}) + header +
         elements;
}

class CloudFiles : public testing::Test {
 protected:
  PointCloud read(const std::string& name, const std::string& content) const {
    return read_cloud(files_.write(name, content)).cloud;
  }
  std::string refusal(const std::string& name, const std::string& content) const {
    return input_error_of([&] { static_cast<void>(read(name, content)); });
  }

  ScratchFiles files_;
};

// The points (1, 2, 3) and (-1, 0.5, 0), and one that was not measured.
TEST_F(CloudFiles, AreReadInEveryForm) {
  const std::vector<float> points = {1, 2, 3, -1, 0.5, 0, kMissing, kMissing, kMissing};
  const std::string rows = "1 2 3\n-1 0.5 0\nnan nan nan\n";
  const std::string ply =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.pcd", pcd("x y z", "4 4 4", "F F F", 3, "ascii\n" + rows)},
      {"b.pcd", pcd("x y z", "4 4 4", "F F F", 3, "binary\n" + bytes_of(points))},
      {"a.ply", "ply\nformat ascii 1.0\n" + ply + rows},
      {"b.ply", "ply\nformat binary_little_endian 1.0\n" + ply + bytes_of(points)},
      {"a.xyz", rows},
      {"b.xyz", "3\nx y z\n" + rows},
      {"a.csv", "x,y,z\n1,2,3\n-1,0.5,0\n"},
      {"b.csv", "stamp,z,intensity,Y [m],x_mm\n5,3,9,2,1000\n6,0,9,0.5,-1000\n"},
      {"c.xyz", "\xEF\xBB\xBF" + rows},
      {"a.npy", numpy("<f4", "3, 3", bytes_of(points))},
      {"b.npy", numpy("<f4", "1, 3, 3", bytes_of(points))}};
  for (const auto& [name, content] : files) {
    SCOPED_TRACE(name);
    EXPECT_THAT(read(name, content).points,
                ElementsAre(Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(-1, 0.5, 0)));
  }
}

TEST_F(CloudFiles, KeepColours) {
  const auto orange = std::array<std::uint8_t, 3>{255, 128, 0};
  const float packed = std::bit_cast<float>(0x00FF8000U);
  const std::string binary = bytes_of<float>({packed, 1, 2, 3});
  EXPECT_THAT(read("a.pcd", pcd("rgb x y z", "4 4 4 4", "F F F F", 1, "binary\n" + binary)).colors,
              ElementsAre(orange));
  EXPECT_THAT(
      read("b.pcd", pcd("x y z rgba", "4 4 4 4", "F F F U", 1, "ascii\n1 2 3 4294934528\n")).colors,
      ElementsAre(orange));
  EXPECT_THAT(read("a.xyz", "1 2 3 255 128 0\n").colors, ElementsAre(orange));
  EXPECT_THAT(read("b.xyz", "# B x y z R G\n0 1 2 3 255 128\n").colors, ElementsAre(orange));
  EXPECT_THAT(read("c.xyz", "x y z nx ny nz\n1 2 3 0 0 1\n").colors, testing::IsEmpty())
      << "normals";
  EXPECT_THAT(read("a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 1\nproperty uchar red\n"
                   "property uchar green\nproperty uchar blue\nproperty double x\n"
                   "property double y\nproperty double z\nend_header\n255 128 0 1 2 3\n")
                  .colors,
              ElementsAre(orange));
}

// Made by the Point Cloud Library's rule: fields one after the other, then compressed by LZF; here
// all bytes are literal runs, each with its length less one in front.
TEST_F(CloudFiles, AreDecompressed) {
  const std::string columns = bytes_of<float>({1, -1, 2, 0.5, 3, 0});
  const std::string packed = std::string(1, static_cast<char>(columns.size() - 1)) + columns;
  const std::string sizes = bytes_of<std::uint32_t>(
      {static_cast<std::uint32_t>(packed.size()), static_cast<std::uint32_t>(columns.size())});
  const std::string head = "binary_compressed\n";
  EXPECT_THAT(read("a.pcd", pcd("x y z", "4 4 4", "F F F", 2, head + sizes + packed)).points,
              ElementsAre(Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(-1, 0.5, 0)));
  EXPECT_THAT(refusal("b.pcd", pcd("x y z", "4 4 4", "F F F", 2, head + sizes + packed.substr(1))),
              HasSubstr("cut off"));
}

TEST_F(CloudFiles, OfOctomapsAreTheirOccupiedCells) {
  octomap::OcTree tree(0.05);
  tree.updateNode(octomap::point3d(0.31F, 0.02F, -0.01F), true);
  tree.updateNode(octomap::point3d(0.41F, 0.02F, 0.01F), false);
  const std::string file = (files_.folder() / "map").string();
  ASSERT_TRUE(tree.writeBinary(file + ".bt"));
  ASSERT_TRUE(tree.write(file + ".ot"));
  for (const char* ending : {".bt", ".ot"}) {
    const PointCloud cloud = read_cloud(file + ending).cloud;
    EXPECT_EQ(cloud.cell, 0.05);
    ASSERT_EQ(cloud.size(), 1U);
    EXPECT_TRUE(cloud.points[0].isApprox(Eigen::Vector3f(0.325F, 0.025F, -0.025F), 1e-6F));
  }
  EXPECT_THAT(
      refusal("cut.bt", "# Octomap OcTree binary file\nid OcTree\nsize 9\nres 0.1\ndata\n\1"),
      HasSubstr("damaged"));
}

TEST_F(CloudFiles, ThatAreDamagedAreRefused) {
  EXPECT_THAT(refusal("a.pcd", ""), HasSubstr("a.pcd"));
  EXPECT_THAT(refusal("a.pcd", pcd("x y z", "4 4 4", "F F F", 9, "binary\n0123456789ab")),
              HasSubstr("found 1 points, expected 9"));
  EXPECT_THAT(refusal("a.pcd", pcd("x y", "4 4", "F F", 1, "ascii\n1 2\n")), HasSubstr("field z"));
  EXPECT_THAT(refusal("a.pcd", pcd("x y z", "4 4 3", "F F F", 1, "ascii\n1 2 3\n")),
              HasSubstr("type f of 3 bytes"));
  EXPECT_THAT(refusal("a.ply",
                      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                      "property float y\nproperty float z\nend_header\n1 2 3\n"),
              HasSubstr("found 1 vertices, expected 2"));
  EXPECT_THAT(refusal("a.pcd", pcd("x y z", "4 4 4", "F F F", 1, "ascii\n0,5 2 3\n")),
              AllOf(HasSubstr("found \"0,5\""), HasSubstr("a number")));
  EXPECT_THAT(refusal("a.xyz", "1 2 3\n1 2\n"), HasSubstr("a.xyz:2"));
  EXPECT_THAT(refusal("a.xyz", "nan nan nan\n"), HasSubstr("no points that are finite"));
  EXPECT_THAT(refusal("a.xyz", "1 2 1e9\n"), HasSubstr("1e+09 m"));
  EXPECT_THAT(refusal("a.pcd", pcd("x y z", "4 4 4", "\"\" F F", 1, "ascii\n1 2 3\n")),
              HasSubstr("of 4 bytes"));
  EXPECT_THAT(refusal("a.bt", "# Octomap OcTree binary file\n\nres 0.1\n\n"), HasSubstr("data"));
  EXPECT_THAT(refusal("a.npy", numpy("<f4", "1000000, 3", "")), HasSubstr("cut off"));
  EXPECT_THAT(refusal("a.npy", numpy("<f4", "4, 4", std::string(64, '\0'))),
              HasSubstr("float32 of shape 4×4"));
  EXPECT_THAT(refusal("a.las", "LASF"), HasSubstr(".pcd, .ply"));
  EXPECT_THAT(
      refusal("a.ply", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n"),
      HasSubstr("LFS"));
}

TEST_F(CloudFiles, AreToldFromMeshesAndRecordings) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nelement face ";
  EXPECT_FALSE(is_cloud_file(files_.write("mesh.ply", head + "1\nend_header\n")));
  EXPECT_TRUE(is_cloud_file(files_.write("points.ply", head + "0\nend_header\n")));
  EXPECT_TRUE(is_cloud_file(files_.write("points.npy", numpy("<f4", "9, 3", ""))));
  EXPECT_FALSE(is_cloud_file(files_.write("hands.npy", numpy("<f4", "9, 21, 3", ""))));
  EXPECT_FALSE(is_cloud_file(files_.write("joints.npy", numpy("<f4", "9, 16", ""))));
  EXPECT_TRUE(is_cloud_file("scan.PCD"));
  EXPECT_FALSE(is_cloud_file("path.csv"));
}

// A camera 2 m above a floor sees a pixel at its centre and one at 45 degrees to the right.
TEST_F(CloudFiles, OfDepthImagesFollowThePinhole) {
  const DepthCamera camera{{1.0, 1.0}, {0.0, 0.0}, 0.001, 10.0};
  const auto image =
      files_.write("depth.npy", numpy("<u2", "1, 3", bytes_of<std::uint16_t>({2000, 2000, 0})));
  EXPECT_THAT(read_depth_image(image, camera).points,
              ElementsAre(Eigen::Vector3f(0, 0, 2), Eigen::Vector3f(2, 0, 2)));

  const std::string png = (files_.folder() / "depth.png").string();
  const std::vector<std::uint16_t> depths = {500, 1000};
  std::FILE* file = std::fopen(png.c_str(), "wb");
  png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(writer);
  png_init_io(writer, file);
  png_set_IHDR(writer, info, 2, 1, 16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(writer, info);
  png_set_swap(writer);
  png_write_row(writer, reinterpret_cast<png_const_bytep>(depths.data()));
  png_write_end(writer, info);
  png_destroy_write_struct(&writer, &info);
  static_cast<void>(std::fclose(file));
  EXPECT_THAT(read_depth_image(png, camera).points,
              ElementsAre(Eigen::Vector3f(0, 0, 0.5), Eigen::Vector3f(1, 0, 1)));

  const std::string whole = ScratchFiles::read(png);
  const auto cut = files_.write("cut.png", whole.substr(0, whole.size() - 30));
  EXPECT_THAT(input_error_of([&] { static_cast<void>(read_depth_image(cut, camera)); }),
              HasSubstr("damaged"));
  EXPECT_THAT(input_error_of([&] { static_cast<void>(read_depth_image(png, {})); }),
              HasSubstr("focal length"));
}

// A scene keeps points that no file has beside itself, and reads them back to the bit.
TEST_F(CloudFiles, AreWrittenWithTheirScene) {
  files_.write("scan.xyz", "0.001 0.002 0.003 10 20 30\n0.5 0 0 1 2 3\n");
  const auto file = files_.write(
      "scene.yaml",
      "handway: 1\nrobots:\n  - {name: arm, model: tx90}\nobjects:\n  - name: scan\n"
      "    cloud: {file: scan.xyz, cell: 0.02, radius: 0.01}\n    pose: {xyz: [1, 0, 0]}\n");
  Scene scene = read_scene(file);
  auto& cloud = std::get<Cloud>(scene.objects[0].shape);
  EXPECT_EQ(cloud.cells, (CloudCells{0.02, 0.01}));
  write_scene(scene, files_.folder() / "same.yaml");
  EXPECT_THAT(ScratchFiles::read(files_.folder() / "same.yaml"),
              HasSubstr("cloud: {file: scan.xyz, cell: 0.02, radius: 0.01}"));
  cloud.file.clear();
  write_scene(scene, files_.folder() / "own.yaml");
  const Scene again = read_scene(files_.folder() / "own.yaml");
  const auto& saved = std::get<Cloud>(again.objects[0].shape);
  EXPECT_EQ(saved.file, files_.folder() / "own_meshes" / "scan.ply");
  EXPECT_EQ(saved.points->points, cloud.points->points);
  EXPECT_EQ(saved.points->colors, cloud.points->colors);
  const auto bad = files_.write("bad.yaml",
                                "handway: 1\nrobots:\n  - {name: arm, model: tx90}\n"
                                "objects:\n  - name: scan\n    cloud: {file: scan.xyz, "
                                "cell: 0.00001}\n");
  EXPECT_THAT(
      input_error_of([&] { static_cast<void>(read_scene(bad)); }),
      HasSubstr("bad.yaml:6: objects[0].cloud.cell: found \"0.00001\", expected 0.001 to 1 m"));
}

}  // namespace
}  // namespace handway::geometric
