// Stand empty and filled: the body stands with its cavity empty, filled, and while it is filled.
// The goal is Stand's, in each of these states.
#pragma once

#include "core/goals/verdict.h"
#include "core/model/contact.h"

#include <memory>

namespace massprops {

/// Stand's, of the empty and the filled body and, where the `cavity` (closed, outward, working
/// frame) is given, at every level of its contents. Of the *empty* body; the filled one has
/// (1 − f) empty + f outer, with f the `filling`'s density as a multiple of the material's.
std::unique_ptr<Verdict> makeStandEmptyAndFilledVerdict(const ContactArea& area,
                                                        const Moments& outer, double filling,
                                                        double lengthUnit,
                                                        const TriangleMesh* cavity = nullptr);

} // namespace massprops
