#include "mjcf_text.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/package_path.h"
#include "handway/geometric/io/text_file.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <set>
#include <sstream>
#include <string_view>

namespace handway::import_mjcf {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;

constexpr std::size_t kLargestFile = std::size_t{16} << 20;
constexpr std::size_t kDeepest = 200;
constexpr const char* kWhat = "a robot as MJCF";

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

bool is_left_out(std::string_view parent, std::string_view name) {
  if (parent == "mujoco") {
    return is_one_of(name, {"option", "size", "visual", "statistic", "custom", "actuator", "sensor",
                            "extension", "deformable"});
  }
  if (parent == "default") {
    return !is_one_of(name, {"default", "mesh", "material", "geom", "joint", "site", "pair",
                             "equality", "tendon", "include"});
  }
  if (parent == "body" || parent == "worldbody" || parent == "frame") {
    return is_one_of(name, {"light", "camera", "plugin"});
  }
  return parent == "material" || (parent == "asset" && is_one_of(name, {"texture", "skin"}));
}

bool is_left_out_attribute(std::string_view element, std::string_view name) {
  return element == "key" ? !is_one_of(name, {"name", "qpos"})
                          : element == "material" && name == "texture";
}

using Schema = std::map<std::string, std::set<std::string>>;  // attributes by element

// MuJoCo prints `element (?)  attribute attribute …`, and further attributes on separate lines.
// `body` and `worldbody` are printed as `(world)body`.
Schema printed_schema() {
  constexpr std::size_t kRoom = std::size_t{1} << 18;
  std::vector<char> text(kRoom);
  mj_printSchema(nullptr, text.data(), static_cast<int>(kRoom), 0, 0);
  Schema schema;
  std::set<std::string>* attributes = nullptr;
  std::istringstream lines(text.data());
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    if (line.find('(') != std::string::npos) {
      words >> word;
      attributes = &schema[word.substr(word.find(')') + 1)];
      words >> word;
    }
    while (attributes != nullptr && words >> word) {
      attributes->insert(word);
    }
  }
  return schema;
}

// Returns whether MuJoCo 2.2 knows an attribute of an element, or does not know the element.
bool knows_attribute(const std::string& element, const std::string& attribute) {
  static const Schema kSchema = printed_schema();
  const auto known = kSchema.find(element);
  return known == kSchema.end() || known->second.contains(attribute);
}

// Returns whether an attribute is a misspelt one that changes the robot.
bool is_slip(const std::string& attribute) {
  static const std::vector<std::string> kNeeded = {
      "range",    "axis",      "pos",         "quat",    "euler",      "fromto",   "xyaxes",
      "zaxis",    "axisangle", "type",        "size",    "mesh",       "file",     "scale",
      "limited",  "contype",   "conaffinity", "class",   "childclass", "joint1",   "joint2",
      "polycoef", "coef",      "refpos",      "refquat", "angle",      "eulerseq", "meshdir"};
  return geometric::slip_of(attribute, kNeeded).has_value();
}

std::string escaped(std::string_view value) {
  std::string text;
  for (const char c : value) {
    text += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  }
  return text;
}

std::string stand_in() {
  std::string vertices;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    for (std::size_t axis = 0; axis < kStandIn.size(); ++axis) {
      const double half = kStandIn.at(axis);
      vertices += fmt::format("{} ", (corner >> axis & 1U) != 0 ? half : -half);
    }
  }
  return fmt::format(
      " vertex=\"{}\" face=\"0 2 1 1 2 3 4 5 6 5 7 6 0 1 4 1 5 4 2 6 3 3 6 7 0 4 2 2 4 6 1 3 5 3 7 "
      "5\"",
      vertices);
}

class Writer {
 public:
  Writer(const fs::path& file, const FaultyMeshes& faulty)
      : folder_(fs::absolute(file).parent_path()), faulty_(faulty) {}

  MjcfText write(const fs::path& file) {
    with_document(file, [&](const pugi::xml_node& root) {
      line("<mujoco" + attributes(root) + ">", root);
      // Options that are defaults in later versions of MuJoCo; wrong inertia is corrected, not
      // refused.
      line(
          "<compiler autolimits=\"true\" balanceinertia=\"true\" boundmass=\"0.001\" "
          "boundinertia=\"0.001\"/>",
          root);
      write_children(root, "mujoco");
      line("</mujoco>", root);
    });
    for (auto& [name, mesh] : result_.meshes) {
      mesh.geometries = references_[name];
    }
    return std::move(result_);
  }

 private:
  template <typename Use>
  void with_document(const fs::path& file, const Use& use) {
    files_.push_back({file, geometric::read_text_file(file, kWhat, kLargestFile)});
    const std::string& text = files_.back().text;
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!parsed) {
      throw InputError({place(parsed.offset), "",
                        std::string("broken XML: ") + parsed.description(), kWhat,
                        "Check the tags around this line"});
    }
    use(document.document_element());
    files_.pop_back();
  }

  [[nodiscard]] std::string place(std::ptrdiff_t offset) const {
    const std::string& text = files_.back().text;
    const auto end = std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text));
    return fmt::format("{}:{}", files_.back().file.string(),
                       1 + std::count(text.begin(), text.begin() + end, '\n'));
  }

  void line(const std::string& text, const pugi::xml_node& node) {
    result_.text += text + '\n';
    result_.places.push_back(place(node.offset_debug()));
  }

  std::string attributes(const pugi::xml_node& node) {
    std::string text;
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const char* name = attribute.name();
      if (!knows_attribute(node.name(), name) && !is_slip(name)) {
        result_.unread.push_back(fmt::format("{} of <{}>", name, node.name()));
      } else if (!is_left_out_attribute(node.name(), name)) {
        text += fmt::format(" {}=\"{}\"", name, escaped(attribute.value()));
      }
    }
    return text;
  }

  void write_children(const pugi::xml_node& node, std::string_view kind) {
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() == pugi::node_element && !is_left_out(kind, child.name())) {
        write_element(child, kind);
      }
    }
  }

  void write_element(const pugi::xml_node& node, std::string_view parent) {
    const std::string_view name = node.name();
    if (name == "include") {
      include(node, parent);
    } else if (parent == "asset" && name == "mesh") {
      write_mesh(node);
    } else if (parent == "equality" && is_one_of(name, {"connect", "weld"})) {
      note_loop(node);
    } else {
      note(node);
      // A frame transforms its contents as a body welded to its parent does.
      const bool is_frame = name == "frame" && !node.child("joint") && !node.child("freejoint");
      const std::string tag(is_frame ? "body" : name);
      line(fmt::format("<{}{}>", tag, attributes(node)), node);
      write_children(node, name);
      line(fmt::format("</{}>", tag), node);
    }
  }

  void note(const pugi::xml_node& node) {
    if (const pugi::xml_attribute folder = node.attribute("meshdir");
        folder && std::string_view(node.name()) == "compiler") {
      mesh_folder_ = folder.value();
    }
    if (const pugi::xml_attribute mesh = node.attribute("mesh")) {
      ++references_[mesh.value()];
    }
  }

  void include(const pugi::xml_node& node, std::string_view parent) {
    const fs::path file = geometric::existing_file(folder_ / node.attribute("file").value());
    if (std::ranges::find(files_, file, &Source::file) != files_.end() ||
        files_.size() > kDeepest) {
      throw InputError({place(node.offset_debug()), "<include>",
                        "\"" + file.string() + "\", which includes this one", "another file", ""});
    }
    const std::string here = place(node.offset_debug());
    if (!fs::exists(file)) {
      throw InputError({here, "<include>", "no such file: " + file.string(), kWhat,
                        "Check the path: it begins at the folder of the first file"});
    }
    with_document(file, [&](const pugi::xml_node& root) { write_children(root, parent); });
  }

  void write_mesh(const pugi::xml_node& node) {
    const fs::path written = node.attribute("file").value();
    std::string name = node.attribute("name").value();
    if (written.empty()) {
      line("<mesh" + attributes(node) + "/>", node);
      return;
    }
    name = name.empty() ? written.stem().string() : name;
    MjcfMesh mesh{geometric::existing_file((folder_ / mesh_folder_ / written).lexically_normal()),
                  place(node.offset_debug())};
    mesh.missing = !fs::exists(mesh.file);
    if (const auto found = geometric::find_in_package_path(written); mesh.missing && found) {
      mesh.file = *found;
      mesh.missing = false;
    }
    pugi::xml_document copy;
    pugi::xml_node element = copy.append_copy(node);
    const bool replaced = mesh.missing || faulty_.contains(name);
    element.remove_attribute("name");
    element.remove_attribute("file");
    std::string text = fmt::format("<mesh name=\"{}\"{}", escaped(name), attributes(element));
    text += replaced ? stand_in() : fmt::format(" file=\"{}\"", escaped(mesh.file.string()));
    line(text + "/>", node);
    result_.meshes[name] = mesh;
  }

  void note_loop(const pugi::xml_node& node) {
    const auto end = [&](const char* body, const char* site) {
      const std::string name = node.attribute(body).value();
      return name.empty() ? std::string(node.attribute(site).value()) : name;
    };
    result_.loops.push_back(
        {end("body1", "site1"), end("body2", "site2"), node.attribute("anchor").value()});
  }

  struct Source {
    fs::path file;
    std::string text;
  };

  fs::path folder_;  ///< Folder of the first file.
  const FaultyMeshes& faulty_;
  std::vector<Source> files_;  ///< Stack of files: the first, and the nested includes.
  std::string mesh_folder_;
  std::map<std::string, int> references_;  ///< Number of geometries per mesh.
  MjcfText result_;
};

}  // namespace

MjcfText mjcf_text(const fs::path& file, const FaultyMeshes& faulty) {
  return Writer(file, faulty).write(file);
}

}  // namespace handway::import_mjcf
