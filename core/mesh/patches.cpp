#include "core/mesh/patches.h"

#include <algorithm>
#include <array>
#include <utility>

namespace massprops {
namespace {

std::size_t index(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

} // namespace

std::vector<std::vector<int>> manifoldPatches(const Faces& faces) {
  std::vector<std::array<int, 4>> sides; // edge, face, direction
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = faces(f, k);
      const int b = faces(f, (k + 1) % 3);
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(f), a < b ? 1 : 0});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::vector<int>> next(index(faces.rows()));
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i;
    while (end < sides.size() && sides[end][0] == sides[i][0] && sides[end][1] == sides[i][1])
      ++end;
    if (end - i == 2 && sides[i][3] != sides[i + 1][3]) {
      next[index(sides[i][2])].push_back(sides[i + 1][2]);
      next[index(sides[i + 1][2])].push_back(sides[i][2]);
    }
    i = end;
  }
  std::vector<std::vector<int>> patches;
  std::vector<char> isKnown(index(faces.rows()), 0);
  for (Eigen::Index seed = 0; seed < faces.rows(); ++seed) {
    if (isKnown[index(seed)] != 0) continue;
    std::vector<int> patch{static_cast<int>(seed)};
    isKnown[index(seed)] = 1;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const int g : next[index(patch[i])]) {
        if (isKnown[index(g)] != 0) continue;
        isKnown[index(g)] = 1;
        patch.push_back(g);
      }
    }
    patches.push_back(std::move(patch));
  }
  return patches;
}

} // namespace massprops
