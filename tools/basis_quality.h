#pragma once

#include "handway/device/glove/posture_source.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/sampling/postures/basis_study.h"
#include "mapped_recording.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace handway::tools {

/// Studies the quality of a basis from these recordings, at the fingertips of the hand.
/// @throws InputError if the hand has no fingers, or a recording is too short.
[[nodiscard]] sampling::BasisStudy study_recordings(
    const std::vector<MappedRecording>& recordings,
    const std::shared_ptr<const geometric::RobotModel>& hand, const device::PostureSource& mapper,
    Normalisation normalisation, const sampling::BasisStudySettings& settings);

/// Writes the study with its inputs as a JSON file.
/// @throws InputError if it can't be written.
void write_study(const sampling::BasisStudy& study, const sampling::BasisStudySettings& settings,
                 const std::vector<MappedRecording>& recordings, const std::string& hand,
                 const device::PostureSource& mapper, const std::filesystem::path& file);

}  // namespace handway::tools
