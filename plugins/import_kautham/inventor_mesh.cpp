#include "inventor_mesh.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"

#include <Inventor/SbMatrix.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/VRMLnodes/SoVRMLInline.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/actions/SoSearchAction.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/nodes/SoFile.h>
#include <Inventor/nodes/SoScale.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShape.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <regex>
#include <string>
#include <system_error>

namespace handway::import_kautham {
namespace {

using geometric::InputError;

// Takes Coin's messages while it lives, instead of letting them go to stderr.
class CoinMessages {
 public:
  CoinMessages()
      : read_handler_(SoReadError::getHandlerCallback()),
        read_data_(SoReadError::getHandlerData()),
        debug_handler_(SoDebugError::getHandlerCallback()),
        debug_data_(SoDebugError::getHandlerData()) {
    SoReadError::setHandlerCallback(&CoinMessages::keep, this);
    SoDebugError::setHandlerCallback([](const SoError*, void*) {}, nullptr);
  }
  ~CoinMessages() {
    SoReadError::setHandlerCallback(read_handler_, read_data_);
    SoDebugError::setHandlerCallback(debug_handler_, debug_data_);
  }
  CoinMessages(const CoinMessages&) = delete;
  CoinMessages& operator=(const CoinMessages&) = delete;

  // The first complaint about a file as Coin words it; empty if there was none.
  [[nodiscard]] const std::string& first() const { return first_; }

 private:
  static void keep(const SoError* error, void* self) {
    std::string& first = static_cast<CoinMessages*>(self)->first_;
    if (first.empty()) {
      first = error->getDebugString().getString();
    }
  }

  SoErrorCB* read_handler_;
  void* read_data_;
  SoErrorCB* debug_handler_;
  void* debug_data_;
  std::string first_;
};

// "Coin read error: WHAT\n\tOccurred at line 4 in FILE", taken apart.
[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& coin_message) {
  static const std::regex kForm(
      R"((?:Coin read error:\s*)?([^]*?)\s*Occurred at line\s+(\d+) in (.*)\s*)");
  geometric::InputProblem problem{file.string(), "",
                                  coin_message.empty() ? "something unreadable" : coin_message,
                                  "an Open Inventor or VRML file", ""};
  if (std::smatch part; std::regex_match(coin_message, part, kForm)) {
    problem.source = part.str(3) + ":" + part.str(2);
    problem.found = part.str(1);
  }
  throw InputError(std::move(problem));
}

class SearchFolder {
 public:
  explicit SearchFolder(std::string folder) : folder_(std::move(folder)) {
    SoInput::addDirectoryFirst(folder_.c_str());
  }
  ~SearchFolder() { SoInput::removeDirectory(folder_.c_str()); }
  SearchFolder(const SearchFolder&) = delete;
  SearchFolder& operator=(const SearchFolder&) = delete;

 private:
  std::string folder_;
};

// Gathers triangles, vertices of the same place once.
struct Collector {
  geometric::TriangleMesh mesh;
  std::map<std::array<float, 3>, std::uint32_t> index_of;
  std::optional<geometric::Color> color;
  bool finite = true;

  std::uint32_t vertex(const SbMatrix& X, const SoPrimitiveVertex& from) {
    SbVec3f point = from.getPoint();
    X.multVecMatrix(point, point);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2])) {
      finite = false;
      point.setValue(0.0F, 0.0F, 0.0F);
    }
    const auto [found, is_new] = index_of.try_emplace(
        {point[0], point[1], point[2]}, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) {
      mesh.vertices.emplace_back(geometric::kMillimetre *
                                 Eigen::Vector3d(point[0], point[1], point[2]));
    }
    return found->second;
  }
};

geometric::Color material_color(SoCallbackAction& action, int index) {
  SbColor ambient;
  SbColor diffuse;
  SbColor specular;
  SbColor emission;
  float shininess = 0.0F;
  float transparency = 0.0F;
  action.getMaterial(ambient, diffuse, specular, emission, shininess, transparency, index);
  return {diffuse[0], diffuse[1], diffuse[2], 1.0F - transparency};
}

void on_triangle(void* data, SoCallbackAction* action, const SoPrimitiveVertex* a,
                 const SoPrimitiveVertex* b, const SoPrimitiveVertex* c) {
  auto& collector = *static_cast<Collector*>(data);
  if (!collector.color) {
    collector.color = material_color(*action, a->getMaterialIndex());
  }
  const SbMatrix& X = action->getModelMatrix();
  collector.mesh.triangles.push_back(
      {collector.vertex(X, *a), collector.vertex(X, *b), collector.vertex(X, *c)});
}

// A graph that is released with this object.
struct Graph {
  SoSeparator* root = new SoSeparator;
  Graph() { root->ref(); }
  ~Graph() { root->unref(); }
  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;
};

void read_graph(const std::filesystem::path& file, SoSeparator& parent) {
  const CoinMessages messages;
  const SearchFolder folder(std::filesystem::absolute(file).parent_path().string());
  SoInput input;
  SoSeparator* content = nullptr;
  if (input.openFile(file.c_str(), TRUE)) {
    content = SoDB::readAll(&input);
  }
  if (content != nullptr) {
    parent.addChild(content);
  }
  if (content == nullptr || !messages.first().empty()) {
    refuse(file, messages.first());
  }
}

bool has(SoNode& root, SoType type) {
  SoSearchAction search;
  search.setType(type);
  search.setSearchingAll(TRUE);
  search.apply(&root);
  return search.getPath() != nullptr;
}

}  // namespace

InventorMesh read_inventor_mesh(const std::filesystem::path& file, double scale) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    throw InputError({file.string(), "", "no such file", "an Open Inventor or VRML file",
                      "Put the mesh there or correct the name in the file that refers to it"});
  }
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  if (!SoDB::isInitialized()) {
    SoDB::init();
  }
  const Graph graph;
  auto* scaling = new SoScale;
  const auto factor = static_cast<float>(scale);
  scaling->scaleFactor.setValue(factor, factor, factor);
  graph.root->addChild(scaling);
  read_graph(file, *graph.root);

  Collector collector;
  SoCallbackAction action;
  action.addTriangleCallback(SoShape::getClassTypeId(), &on_triangle, &collector);
  action.apply(graph.root);
  if (collector.mesh.empty()) {
    throw InputError({file.string(), "", "no triangles", "at least one", ""});
  }
  if (!collector.finite) {
    throw InputError({file.string(), "", "a vertex that is not finite", "finite numbers", ""});
  }
  return {std::make_shared<const geometric::TriangleMesh>(std::move(collector.mesh)),
          *collector.color,
          has(*graph.root, SoFile::getClassTypeId()) ||
              has(*graph.root, SoVRMLInline::getClassTypeId())};
}

}  // namespace handway::import_kautham
