#include "handway/device/glove/emulated_response.h"

#include <array>

namespace handway::device {

namespace {

constexpr std::array<SensorResponse, kGloveSensors> kResponses{{
    {100.0, 0.01584},                                                       // Thumb
    {90.0, 0.01459},  {85.0, 0.01427}, {75.0, 0.00502},  {75.0, 0.01616},   // Index
    {60.0, 0.01459},  {55.0, 0.00753}, {70.0, 0.01725},                     // Middle
    {65.0, 0.01804},  {55.0, 0.01051}, {130.0, 0.00563}, {80.0, 0.01757},   // Ring
    {62.0, 0.01788},  {50.0, 0.01051}, {130.0, 0.00572}, {85.0, 0.01663},   // Little
    {70.0, 0.01820},  {60.0, 0.00988}, {115.0, 0.01027}, {100.0, 0.00910},  // Palm arch
    {128.0, 0.01380},                                                       // Wrist
    {115.0, 0.00680},
}};

}  // namespace

std::span<const SensorResponse> emulated_response() { return kResponses; }

}  // namespace handway::device
