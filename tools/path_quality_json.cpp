#include "path_quality_json.h"

#include "handway/geometric/math/units.h"

#include <nlohmann/json.hpp>

namespace handway::tools {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

nlohmann::ordered_json path_quality_json(const std::optional<planning::PathQuality>& quality) {
  if (!quality) {
    return nullptr;
  }
  Json likeness = nullptr;
  if (const auto& human = quality->human_likeness) {
    likeness = {{"to_subspace",
                 {{"mean", human->mean},
                  {"largest", human->largest},
                  {"share_beyond", human->share_beyond},
                  {"forced", human->forced}}},
                {"mahalanobis",
                 {{"mean", human->mahalanobis_mean}, {"largest", human->mahalanobis_largest}}}};
  }
  return {{"length", quality->length},
          {"human_likeness", likeness},
          {"clearance",
           {{"least_mm", geometric::millimetres(quality->least_clearance)},
            {"mean_mm", geometric::millimetres(quality->mean_clearance)}}},
          {"duration_s", quality->duration}};
}

}  // namespace handway::tools
