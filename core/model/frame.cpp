#include "core/model/frame.h"

#include <algorithm>
#include <cmath>

namespace massprops {
namespace {

constexpr double kGrid = 4294967296.0;

} // namespace

Mat3 rotationToUp(UpAxis up) {
  Mat3 rotation;
  switch (up) {
  case UpAxis::PlusZ:
    return Mat3::Identity();
  case UpAxis::PlusY:
    rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    return rotation;
  case UpAxis::PlusX:
    rotation << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    return rotation;
  case UpAxis::MinusZ:
    rotation << 0, 1, 0, 1, 0, 0, 0, 0, -1;
    return rotation;
  case UpAxis::MinusY:
    rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    return rotation;
  case UpAxis::MinusX:
    rotation << 0, 0, 1, 0, 1, 0, -1, 0, 0;
    return rotation;
  }
  throw InvalidInput("The up axis must be one of +Z, +Y, +X, -Z, -Y, -X.");
}

Points toWorking(const Frame& frame, const Points& model) {
  return (model.rowwise() - frame.origin.transpose()).lazyProduct(frame.rotation.transpose()) /
         frame.length;
}

Points toModel(const Frame& frame, const Points& working) {
  return (working.lazyProduct(frame.rotation) * frame.length).rowwise() + frame.origin.transpose();
}

Points snapped(Points working) {
  working = (working.array() * kGrid).round() / kGrid;
  return working;
}

double snappedUp(double working) {
  return std::ceil(working * kGrid) / kGrid;
}

double roundOff(const Frame& frame) {
  constexpr double kSnap = 0x1p-33;
  // Eight roundings, four a point, of coordinates up to |origin| + 2 lengths.
  const double rounding = 0x1p-50 * (2.0 + frame.origin.norm() / frame.length);
  // Not less than the snap, so that where the model lies does not show unless that is far away.
  return std::sqrt(3.0) * (kSnap + std::max(kSnap, rounding));
}

} // namespace massprops
