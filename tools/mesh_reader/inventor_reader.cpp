#include "handway/geometric/io/existing_file.h"
#include "readers.h"

#include <Inventor/SbMatrix.h>
#include <Inventor/SbString.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/VRMLnodes/SoVRMLCoordinate.h>
#include <Inventor/VRMLnodes/SoVRMLElevationGrid.h>
#include <Inventor/VRMLnodes/SoVRMLIndexedFaceSet.h>
#include <Inventor/VRMLnodes/SoVRMLInline.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/actions/SoSearchAction.h>
#include <Inventor/elements/SoCoordinateElement.h>
#include <Inventor/elements/SoLazyElement.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/lists/SbStringList.h>
#include <Inventor/nodes/SoFaceSet.h>
#include <Inventor/nodes/SoFile.h>
#include <Inventor/nodes/SoIndexedShape.h>
#include <Inventor/nodes/SoQuadMesh.h>
#include <Inventor/nodes/SoScale.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShape.h>
#include <Inventor/nodes/SoTriangleStripSet.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <system_error>

namespace handway::mesh_reader {
namespace {

constexpr double kMillimetre = 1e-3;  // m
constexpr const char* kExpectedInventor = "an Open Inventor or VRML file";

// Receives Coin's messages during its lifetime, instead of stderr.
class CoinMessages {
 public:
  CoinMessages() {
    SoReadError::setHandlerCallback(&CoinMessages::keep, this);
    SoDebugError::setHandlerCallback([](const SoError*, void*) {}, nullptr);
  }

  // Coin's first error about a file; empty if there was none. A missing picture costs no triangle:
  // it is stored separately.
  [[nodiscard]] const std::string& first() const { return first_; }

  // Errors about textures, one a line.
  [[nodiscard]] const std::string& textures() const { return textures_; }

 private:
  static void keep(const SoError* error, void* data) {
    auto& self = *static_cast<CoinMessages*>(data);
    std::string text = error->getDebugString().getString();
    if (is_about_texture(text)) {
      std::ranges::replace(text, '\n', ' ');
      self.textures_ += text + '\n';
    } else if (self.first_.empty()) {
      self.first_ = std::move(text);
    }
  }

  static bool is_about_texture(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text.find("texture file") != std::string::npos ||
           text.find("texture image") != std::string::npos;
  }

  std::string first_;
  std::string textures_;
};

// Parses "Coin read error: WHAT\n\tOccurred at line 4 in FILE".
[[noreturn]] void refuse_as_coin_says(const std::string& coin_message) {
  static const std::regex kForm(
      R"((?:Coin read error:\s*)?([^]*?)\s*Occurred at line\s+(\d+) in (.*)\s*)");
  std::string found = coin_message.empty() ? "something unreadable" : coin_message;
  std::string source;
  if (std::smatch part; std::regex_match(coin_message, part, kForm)) {
    source = part.str(3) + ":" + part.str(2);
    found = part.str(1);
  }
  throw Refusal(source, found, kExpectedInventor, "");
}

/// Reads as SoInput does, but finds included files with differences in case, too, if the exact name
/// is missing.
class LenientInput final : public SoInput {
 public:
  SbBool pushFile(const char* name) override { return SoInput::pushFile(found(name).c_str()); }

  // The file that Coin means by its name, or else the name itself.
  static std::string found(const char* name) {
    const SbStringList& folders = getDirectories();
    for (int i = 0; i < folders.getLength(); ++i) {
      const std::filesystem::path written = std::filesystem::path(folders[i]->getString()) / name;
      const std::filesystem::path file = geometric::existing_file(written);
      std::error_code ignored;
      if (std::filesystem::exists(file, ignored)) {
        if (geometric::differs_in_case(written, file)) {
          in_other_letters().insert(name);
        }
        return file.string();
      }
    }
    return name;
  }

  // Names, as written, of files found with differences in case; a process reads one file.
  static std::set<std::string>& in_other_letters() {
    static std::set<std::string> names;
    return names;
  }
};

// Refuses indices that would make Coin take points from outside of the file's memory.
class IndexCheck {
 public:
  explicit IndexCheck(SoCallbackAction& action) {
    add<SoIndexedShape>(action, &IndexCheck::check_indexed);
    add<SoVRMLIndexedFaceSet>(action, &IndexCheck::check_vrml);
    add<SoVRMLElevationGrid>(action, &IndexCheck::check_grid);
    add<SoFaceSet>(action, &IndexCheck::check_counts<SoFaceSet>);
    add<SoTriangleStripSet>(action, &IndexCheck::check_counts<SoTriangleStripSet>);
    add<SoQuadMesh>(action, &IndexCheck::check_quads);
  }

 private:
  template <typename Shape>
  using Check = void (*)(const Shape&, std::int64_t points);

  template <typename Shape>
  void add(SoCallbackAction& action, Check<Shape> check) {
    action.addPreCallback(
        Shape::getClassTypeId(),
        [](void* data, SoCallbackAction* running, const SoNode* node) {
          const auto* shape = static_cast<const Shape*>(node);
          reinterpret_cast<Check<Shape>>(data)(*shape, points_of(*running, *shape));
          return SoCallbackAction::CONTINUE;
        },
        reinterpret_cast<void*>(check));
  }

  static std::int64_t points_of(SoCallbackAction& action, const SoNode& shape) {
    if (shape.isOfType(SoVertexShape::getClassTypeId())) {
      const SoNode* own = static_cast<const SoVertexShape&>(shape).vertexProperty.getValue();
      if (own != nullptr && own->isOfType(SoVertexProperty::getClassTypeId())) {
        const int points = static_cast<const SoVertexProperty*>(own)->vertex.getNum();
        if (points > 0) {
          return points;
        }
      }
    }
    const auto* coordinates = SoCoordinateElement::getInstance(action.getState());
    return coordinates == nullptr ? 0 : coordinates->getNum();
  }

  [[noreturn]] static void refuse_index(std::int64_t index, std::int64_t points) {
    throw Refusal(
        "", "the index " + std::to_string(index) + " into " + std::to_string(points) + " points",
        "indices from 0 to one less than there are points", "Export the file again");
  }

  static void check_indices(const SoMFInt32& indices, std::int64_t points) {
    for (int i = 0; i < indices.getNum(); ++i) {
      if (indices[i] < -1 || indices[i] >= points) {
        refuse_index(indices[i], points);
      }
    }
  }

  static void check_indexed(const SoIndexedShape& shape, std::int64_t points) {
    check_indices(shape.coordIndex, points);
  }

  static void check_vrml(const SoVRMLIndexedFaceSet& shape, std::int64_t /*points*/) {
    const SoNode* coord = shape.coord.getValue();
    const bool has_points = coord != nullptr && coord->isOfType(SoVRMLCoordinate::getClassTypeId());
    check_indices(shape.coordIndex,
                  has_points ? static_cast<const SoVRMLCoordinate*>(coord)->point.getNum() : 0);
  }

  static void check_grid(const SoVRMLElevationGrid& grid, std::int64_t /*points*/) {
    const std::int64_t x = grid.xDimension.getValue();
    const std::int64_t z = grid.zDimension.getValue();
    if (x < 0 || z < 0 || x * z > grid.height.getNum()) {
      throw Refusal("",
                    "a grid of " + std::to_string(x) + " × " + std::to_string(z) + " with " +
                        std::to_string(grid.height.getNum()) + " heights",
                    "a height for each of its points", "Export the file again");
    }
  }

  template <typename Shape>
  static void check_counts(const Shape& shape, std::int64_t points) {
    std::int64_t last = shape.startIndex.getValue();
    for (int i = 0; i < shape.numVertices.getNum(); ++i) {
      const std::int64_t count = shape.numVertices[i];
      if (count < -1) {
        refuse_index(count, points);
      }
      last += std::max<std::int64_t>(count, 0);  // -1: all that are left
    }
    if (shape.startIndex.getValue() < 0 || last > points) {
      refuse_index(last - 1, points);
    }
  }

  static void check_quads(const SoQuadMesh& shape, std::int64_t points) {
    const std::int64_t first = shape.startIndex.getValue();
    const std::int64_t rows = shape.verticesPerRow.getValue();
    const std::int64_t columns = shape.verticesPerColumn.getValue();
    if (first < 0 || rows < 0 || columns < 0 || first + rows * columns > points) {
      refuse_index(first + rows * columns - 1, points);
    }
  }
};

// Collects triangles, with vertices of the same place merged.
struct Collector {
  Mesh& mesh;
  std::map<std::array<float, 3>, std::uint32_t> index_of = {};

  std::uint32_t vertex(const SbMatrix& X, const SoPrimitiveVertex& from) {
    SbVec3f point = from.getPoint();
    X.multVecMatrix(point, point);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2])) {
      throw Refusal("", "a vertex that is not finite", "finite numbers", "");
    }
    const auto [found, is_new] =
        index_of.try_emplace({point[0], point[1], point[2]}, mesh.vertex_count());
    if (is_new) {
      mesh.add_vertex({kMillimetre * static_cast<double>(point[0]),
                       kMillimetre * static_cast<double>(point[1]),
                       kMillimetre * static_cast<double>(point[2])});
      for (int k = 0; k < 3; ++k) {
        mesh.largest =
            std::max(mesh.largest, kMillimetre * std::abs(static_cast<double>(point[k])));
      }
    }
    return found->second;
  }
};

// Colour of the material with that index, or of the first one if the index is too large.
std::array<float, 4> material_color(SoCallbackAction& action, int index) {
  SbColor ambient;
  SbColor diffuse;
  SbColor specular;
  SbColor emission;
  float shininess = 0.0F;
  float transparency = 0.0F;
  const int count = SoLazyElement::getInstance(action.getState())->getNumDiffuse();
  action.getMaterial(ambient, diffuse, specular, emission, shininess, transparency,
                     index >= 0 && index < count ? index : 0);
  return {diffuse[0], diffuse[1], diffuse[2], 1.0F - transparency};
}

void on_triangle(void* data, SoCallbackAction* action, const SoPrimitiveVertex* a,
                 const SoPrimitiveVertex* b, const SoPrimitiveVertex* c) {
  auto& collector = *static_cast<Collector*>(data);
  if (collector.mesh.empty()) {
    collector.mesh.color = material_color(*action, a->getMaterialIndex());
  }
  const SbMatrix& X = action->getModelMatrix();
  const std::uint32_t first = collector.vertex(X, *a);
  const std::uint32_t second = collector.vertex(X, *b);
  collector.mesh.add_triangle({first, second, collector.vertex(X, *c)});
}

bool has(SoNode& root, SoType type) {
  SoSearchAction search;
  search.setType(type);
  search.setSearchingAll(TRUE);
  search.apply(&root);
  return search.getPath() != nullptr;
}

SoSeparator& read_graph(const std::filesystem::path& file, const CoinMessages& messages) {
  SoInput::addDirectoryFirst(file.parent_path().c_str());
  LenientInput input;
  SoSeparator* content = input.openFile(file.c_str(), TRUE) ? SoDB::readAll(&input) : nullptr;
  if (content == nullptr || !messages.first().empty()) {
    refuse_as_coin_says(messages.first());
  }
  return *content;
}

}  // namespace

void prepare_inventor() { SoDB::init(); }

void read_inventor(const std::filesystem::path& file, double scale, Mesh& mesh) {
  const CoinMessages messages;
  auto* root = new SoSeparator;  // is there as long as the process
  root->ref();
  auto* scaling = new SoScale;
  const auto factor = static_cast<float>(scale);
  scaling->scaleFactor.setValue(factor, factor, factor);
  root->addChild(scaling);
  root->addChild(&read_graph(file, messages));
  Collector collector{mesh};
  SoCallbackAction action;
  const IndexCheck indices(action);
  action.addTriangleCallback(SoShape::getClassTypeId(), &on_triangle, &collector);
  action.apply(root);
  if (mesh.empty()) {
    throw Refusal("", "no triangles", "at least one", "");
  }
  mesh.warnings = messages.textures();
  for (const std::string& name : LenientInput::in_other_letters()) {
    mesh.warnings += "the included file " + name + " has other letters on the disk\n";
  }
  mesh.includes_files =
      has(*root, SoFile::getClassTypeId()) || has(*root, SoVRMLInline::getClassTypeId());
}

}  // namespace handway::mesh_reader
