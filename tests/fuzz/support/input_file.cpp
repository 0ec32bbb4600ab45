#include "input_file.h"

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace handway::fuzz {
namespace {

std::filesystem::path new_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "handway-fuzz-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw std::runtime_error("no folder for inputs in " + name);
  }
  return name;
}

void write(const std::filesystem::path& file, const char* data, std::size_t size) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(data, static_cast<std::streamsize>(size));
  if (!stream.flush()) {
    throw std::runtime_error("can't write " + file.string());
  }
}

}  // namespace

const std::string_view kCraneUrdf = R"(<robot name="crane">
  <link name="base"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <link name="arm"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="slide"/>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/>
  </joint>
  <joint name="lift" type="prismatic">
    <parent link="arm"/><child link="slide"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
)";

const std::string_view kCraneSrdf = R"(<robot name="crane">
  <group name="crane_arm"><joint name="turn"/><joint name="lift"/></group>
</robot>
)";

InputFile::InputFile(const std::string& name) : folder_(new_folder()), file_(folder_ / name) {}

InputFile::~InputFile() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

const std::filesystem::path& InputFile::hold(const std::uint8_t* data, std::size_t size) const {
  write(file_, reinterpret_cast<const char*>(data), size);
  return file_;
}

std::filesystem::path InputFile::add(const std::string& name, std::string_view content) const {
  const std::filesystem::path file = folder_ / name;
  std::filesystem::create_directories(file.parent_path());
  write(file, content.data(), content.size());
  return file;
}

}  // namespace handway::fuzz
