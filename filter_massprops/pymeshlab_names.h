// What MeshLab's menu items are called in Python.
#pragma once

#include <string>

namespace massprops {

/// The sentence and, if it names filters as MeshLab's menus do, one more with PyMeshLab's names of
/// them (2022.2 and later), in the same order.
std::string withPyMeshLabNames(const std::string& sentence);

} // namespace massprops
