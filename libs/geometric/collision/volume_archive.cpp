#include "collision/volume_archive.h"

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/binary_object.hpp>
#include <fmt/format.h>

#include <cstddef>
#include <sstream>
#include <vector>

namespace handway::geometric {

/// Reads and writes the members of volumes.
class VolumeArchive {
 public:
  template <typename Archive, typename Cover>
  static void cover(Archive& archive, Cover& cover) {
    plain(archive, cover.root_);
    list(archive, cover.nodes_);
    list(archive, cover.leaves_);
    list(archive, cover.triangles_);
  }

  template <typename Archive, typename Hull>
  static void hull(Archive& archive, Hull& hull) {
    plain(archive, hull.middle_);
    plain(archive, hull.margin_);
    plain(archive, hull.count_);
    list(archive, hull.x_);
    list(archive, hull.y_);
    list(archive, hull.z_);
  }

  template <typename Archive, typename Field>
  static void field(Archive& archive, Field& field) {
    plain(archive, field.centre_);
    plain(archive, field.half_);
    plain(archive, field.origin_);
    plain(archive, field.side_);
    plain(archive, field.per_cell_);
    plain(archive, field.counts_);
    list(archive, field.cells_);
    list(archive, field.blocks_);
  }

  template <typename Archive, typename Volumes>
  static void sides(Archive& archive, Volumes& volumes) {
    list(archive, volumes.sides.pieces);
    plain(archive, volumes.sides.has_all);
    plain(archive, volumes.points);
  }

 private:
  template <typename Archive, typename Value>
  static void plain(Archive& archive, Value& value) {
    bytes(archive, &value, sizeof value);
  }

  template <typename Archive, typename Element>
  static void list(Archive& archive, std::vector<Element>& elements) {
    std::size_t count = elements.size();
    archive& count;
    elements.resize(count);
    bytes(archive, elements.data(), count * sizeof(Element));
  }

  template <typename Archive>
  static void bytes(Archive& archive, void* data, std::size_t size) {
    auto object = boost::serialization::make_binary_object(data, size);
    archive& object;
  }
};

std::string archive_layout() {
  constexpr int kRevision = 14;  // to change with what volumes are made of
  return fmt::format("volumes {}, {} {} {} {} {}", kRevision, sizeof(SphereCover::Node),
                     sizeof(ClearanceField::Cell), sizeof(TriangleBlock), sizeof(SidedBoxes),
                     sizeof(SurfacePoints));
}

std::string archive_volumes(const MeshVolumes& volumes) {
  std::ostringstream stream(std::ios::binary);
  boost::archive::binary_oarchive archive(stream, boost::archive::no_header);
  MeshVolumes copy = volumes;  // archives want what they could also write to
  VolumeArchive::cover(archive, copy.cover);
  VolumeArchive::hull(archive, copy.hull);
  VolumeArchive::field(archive, copy.field);
  VolumeArchive::sides(archive, copy);
  return stream.str();
}

MeshVolumes unarchive_volumes(const std::string& bytes) {
  std::istringstream stream(bytes, std::ios::binary);
  boost::archive::binary_iarchive archive(stream, boost::archive::no_header);
  MeshVolumes volumes;
  VolumeArchive::cover(archive, volumes.cover);
  VolumeArchive::hull(archive, volumes.hull);
  VolumeArchive::field(archive, volumes.field);
  VolumeArchive::sides(archive, volumes);
  return volumes;
}

}  // namespace handway::geometric
