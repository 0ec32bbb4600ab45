/// Point clouds in every format; the first byte chooses it.
#include "handway/geometric/formats/cloud_reader.h"
#include "handway/geometric/formats/depth_image.h"
#include "input_file.h"

#include <array>
#include <memory>
#include <utility>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const std::array<fuzz::InputFile, 7> files = {
      fuzz::InputFile("cloud.pcd"), fuzz::InputFile("cloud.ply"), fuzz::InputFile("cloud.xyz"),
      fuzz::InputFile("cloud.npy"), fuzz::InputFile("cloud.bt"),  fuzz::InputFile("cloud.ot"),
      fuzz::InputFile("depth.png")};
  if (size == 0) {
    return 0;
  }
  const std::size_t format = data[0] % files.size();
  const std::filesystem::path& held = files.at(format).hold(data + 1, size - 1);
  return fuzz::read_or_refuse([&] {
    if (geometric::is_image_file(held)) {
      static_cast<void>(geometric::read_depth_image(held, {{500.0, 500.0}, {320.0, 240.0}}));
      return;
    }
    geometric::ReadCloud read = geometric::read_cloud(held);
    static_cast<void>(
        geometric::make_cloud(std::make_shared<const geometric::PointCloud>(std::move(read.cloud)),
                              {0.05, 0.01}, "cloud"));
  });
}
