// Pi, and degrees in a radian.
#pragma once

namespace massprops {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegrees = 180.0 / kPi;

} // namespace massprops
