#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/grasps/hold_test.h"
#include "model/document/selection.h"

#include <QString>

#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace handway::gui {

/// A moment of a film: a posture of the first robot, and objects elsewhere than in the scene.
struct FilmMoment {
  geometric::Configuration q;
  std::vector<std::pair<SceneItem, geometric::Pose>> X_WO =
      {};                                           ///< Poses of objects that have moved.
  std::vector<planning::ContactForce> forces = {};  ///< The hand's forces, in a simulation.
};

/// A scene over time, of which pictures are taken.
struct Film {
  QString title;  ///< Title of the dialog for the pictures.
  QString name;   ///< Proposed for files.
  std::shared_ptr<const geometric::Scene> scene;
  double seconds = 0.0;
  /// Returns the moment at a fraction of the time, in [0, 1].
  std::function<FilmMoment(double fraction)> at;
};

/// Returns Film::at of frames that are evenly spread over the time: the nearest one, as `moment`
/// shows it. @pre there are frames.
template <typename Frame, typename Moment>
[[nodiscard]] std::function<FilmMoment(double)> nearest_of(std::vector<Frame> frames,
                                                           Moment moment) {
  return [frames = std::move(frames), moment = std::move(moment)](double fraction) {
    const auto last = static_cast<double>(frames.size() - 1);
    return moment(frames[static_cast<std::size_t>(std::lround(fraction * last))]);
  };
}

}  // namespace handway::gui
