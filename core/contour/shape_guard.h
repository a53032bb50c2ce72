// Moves of vertices that keep a surface sound.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// Moves vertices to their targets (n×3), or half way, or not at all, one after the other: no
/// triangle turns by more than 70° in one move, nor gets an angle below 6° that is less than it
/// had. \pre closed manifold components
void moveSoundly(const Points& targets, const Faces& faces, Points& vertices);

} // namespace massprops
