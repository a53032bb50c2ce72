#include "core/model/frame.h"

namespace massprops {

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
  return ((model.rowwise() - frame.origin.transpose()) * frame.rotation.transpose()) / frame.length;
}

Points toModel(const Frame& frame, const Points& working) {
  return ((working * frame.rotation) * frame.length).rowwise() + frame.origin.transpose();
}

Points snapped(const Points& working) {
  constexpr double kGrid = 4294967296.0;
  return (working.array() * kGrid).round().matrix() / kGrid;
}

} // namespace massprops
