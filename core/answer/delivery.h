// The surfaces that a search found, as the user gets them.
#pragma once

#include "core/model/posed_model.h"
#include "core/model/solid.h"
#include "core/reduced/cavity_search.h"

#include <functional>
#include <optional>
#include <vector>

namespace massprops {

/// In model coordinates; an offset surface in the order of the model's vertices.
struct Delivery {
  /// Without vertices and faces when there is no cavity; normals point into the cavity.
  TriangleMesh inner;
  Vector innerWall;                  ///< of every vertex of `inner`, length
  std::optional<TriangleMesh> outer; ///< when it is not the input's
};

/// `vertexOf`: of an offset surface, for every vertex of what moved that of the posed model, or
/// empty; `representable`: rounds to what the caller can store. Where the search found nothing,
/// nothing but a body with a foot.
Delivery deliver(const Solid& solid, const PosedModel& posed, const CavityTask& task,
                 const CavityResult& cavity, const std::vector<int>& vertexOf,
                 const std::function<Points(const Points&)>& representable);

} // namespace massprops
