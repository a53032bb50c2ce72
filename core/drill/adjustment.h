// A cavity of any shape, moved a little for what the body has lost or gained.
#pragma once

#include "core/reduced/cavity_search.h"

#include <vector>

namespace massprops {

/// The cavity with vertices moved along its normals where the wall has room to spare, so that the
/// body keeps the goal's constraints with what the task's model has attached. It passes inspection;
/// unchanged where it would not or need not. `held`: for every row of `cavity.inner` whether it
/// stays.
CavityResult adjusted(const CavityTask& task, const CavityResult& cavity,
                      const std::vector<char>& held);

} // namespace massprops
