#include "glove/rokoko_frame.h"

#include "glove/hand_json.h"
#include "handway/device/core/line_protocol.h"

#include <fmt/format.h>
#include <lz4frame.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <optional>
#include <utility>

namespace handway::device {

const std::array<std::string, 21>& rokoko_bones() {
  static const std::array<std::string, 21> kBones = [] {
    std::array<std::string, 21> bones{"Hand"};
    std::size_t i = 1;
    for (const char* finger : {"Thumb", "Index", "Middle", "Ring", "Little"}) {
      for (const char* bone : {"Proximal", "Medial", "Distal", "Tip"}) {
        bones.at(i++) = fmt::format("{}{}", finger, bone);
      }
    }
    return bones;
  }();
  return kBones;
}

namespace {

constexpr int kLowestVersion = 3;

// Versions are written as 3, 3.0, "3.0" or "3,0".
void check_version(const HandJson& frame) {
  const auto version = frame.find("version");
  if (version == frame.end()) {
    return;
  }
  const double number =
      version->is_string()
          ? std::strtol(version->get_ref<const std::string&>().c_str(), nullptr, 10)
          : finite_number(*version, "version");
  if (number < kLowestVersion) {
    throw LineProtocolError(
        fmt::format("a frame of Rokoko Studio, version {:g}, expected {} or 4: choose JSON v3 in "
                    "its custom streaming",
                    number, kLowestVersion));
  }
}

bool says(const HandJson& meta, const std::string& key, bool otherwise) {
  const auto found = meta.find(key);
  return found != meta.end() && found->is_boolean() ? found->get<bool>() : otherwise;
}

bool has_glove(const HandJson& actor, bool left) {
  if (!actor.is_object() || !actor.contains("body") || !actor.at("body").is_object()) {
    return false;
  }
  const auto meta = actor.find("meta");
  return meta == actor.end() || !meta->is_object() ||
         says(*meta, left ? "hasLeftGlove" : "hasRightGlove", says(*meta, "hasGloves", true));
}

void read_bones(const HandJson& body, HandObservation& hand) {
  HandLandmarks landmarks;
  geometric::Pose wrist = geometric::Pose::Identity();
  Eigen::Index landmark = 0;
  for (const std::string& bone : rokoko_bones()) {
    const std::string name = (hand.left ? "left" : "right") + bone;
    const HandJson& joint = member_of(body, name.c_str());
    if (!joint.is_object()) {
      throw LineProtocolError(name + " is no bone with position and rotation");
    }
    const Eigen::Vector3d p = point_of_json(member_of(joint, "position"), name);
    const Eigen::Vector4d q = quaternion_of_json(member_of(joint, "rotation"), name);
    if (bone == rokoko_bones().front()) {
      wrist.linear() = mirrored_rotation(rotation_of(q, name)).toRotationMatrix();
    }
    landmarks.col(landmark++) = mirrored_point(p);
    hand.raw.insert(hand.raw.end(), p.begin(), p.end());
    hand.raw.insert(hand.raw.end(), q.begin(), q.end());
  }
  check_hand(landmarks);
  hand.landmarks = landmarks;
  wrist.translation() = landmarks.col(kWristLandmark);
  hand.X_SH = wrist;
}

}  // namespace

std::vector<HandObservation> read_rokoko_hands(const HandJson& frame) {
  check_version(frame);
  const HandJson& scene = member_of(frame, "scene");
  if (!scene.is_object()) {
    throw LineProtocolError("the scene is no object with actors");
  }
  std::optional<double> time;
  if (const auto stamp = scene.find("timestamp"); stamp != scene.end()) {
    time = finite_number(*stamp, "timestamp");
  }
  const HandJson& actors = member_of(scene, "actors");
  std::vector<HandObservation> hands;
  for (const bool left : {false, true}) {
    HandObservation hand;
    hand.time = time;
    hand.left = left;
    const auto actor = std::find_if(actors.begin(), actors.end(),
                                    [&](const HandJson& one) { return has_glove(one, left); });
    if (actor != actors.end()) {
      read_bones(actor->at("body"), hand);
    }
    hands.push_back(hand);
  }
  return hands;
}

bool is_lz4_frame(std::string_view bytes) {
  constexpr std::string_view kMagic("\x04\x22\x4d\x18", 4);
  return bytes.starts_with(kMagic);
}

std::string decompressed_lz4_frame(std::string_view bytes) {
  LZ4F_dctx* created = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&created, LZ4F_VERSION)) != 0) {
    throw LineProtocolError("no memory to decompress a frame of LZ4");
  }
  const std::unique_ptr<LZ4F_dctx, std::size_t (*)(LZ4F_dctx*)> context(
      created, LZ4F_freeDecompressionContext);
  std::string output;
  std::size_t expected = 1;  // more input, as LZ4 asks for it; 0 at the end of a frame
  while (!bytes.empty() && expected != 0) {
    const std::size_t before = output.size();
    output.resize(std::min(before + kLongestHandMessage, kLongestHandJson + 1));
    std::size_t written = output.size() - before;
    std::size_t read = bytes.size();
    expected = LZ4F_decompress(context.get(), output.data() + before, &written, bytes.data(), &read,
                               nullptr);
    if (LZ4F_isError(expected) != 0) {
      throw LineProtocolError("a damaged frame of LZ4");
    }
    output.resize(before + written);
    bytes.remove_prefix(read);
    if (output.size() > kLongestHandJson) {
      throw LineProtocolError("a frame of LZ4 with more than 1 MiB");
    }
    if (read == 0 && written == 0) {
      break;
    }
  }
  if (expected != 0) {
    throw LineProtocolError("a frame of LZ4 that is cut off");
  }
  return output;
}

}  // namespace handway::device
