// What the program takes, for other programs.
#pragma once

#include <string>

namespace massprops {

/// `json`: an array with an object a parameter, all that core/parameters.h says of it. `man`: a
/// page of the manual. `bash`: what bash completes words by. `filters`: the coming MeshLab's
/// filters.json.
std::string described(const std::string& form);

} // namespace massprops
