// Whether a surface stays sound around a vertex that moves.
#pragma once

#include "core/base/types.h"
#include "core/mesh/connectivity.h"

namespace massprops {

/// Whether no triangle around vertex v turns by more than 70° when v goes to x, nor gets an angle
/// below 10° that is less than it had.
bool staysSound(const Points& vertices, const Faces& faces, IndexRange corners, const Vec3& x);

/// Moves vertices to their targets, or half way, or not at all, whatever stays sound; one after the
/// other.
void moveSoundly(const Points& targets, const Faces& faces, Points& vertices);

} // namespace massprops
