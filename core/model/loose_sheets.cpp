#include "core/model/loose_sheets.h"

#include "core/base/triangle.h"
#include "core/mesh/components.h"
#include "core/mesh/patches.h"
#include "core/query/winding_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace massprops {
namespace {

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

/// How many faces run along each edge.
using EdgeUses = std::map<std::pair<int, int>, int>;

std::pair<int, int> edgeOf(const Faces& faces, int f, int k) {
  return std::minmax(faces(f, k), faces(f, (k + 1) % 3));
}

EdgeUses usesOf(const Faces& faces, const std::vector<int>& some) {
  EdgeUses uses;
  for (const int f : some) {
    for (int k = 0; k < 3; ++k) ++uses[edgeOf(faces, f, k)];
  }
  return uses;
}

double areaOf(const TriangleMesh& mesh, const std::vector<int>& some) {
  double area = 0.0;
  for (const int f : some) area += 0.5 * areaNormal(mesh.vertices, mesh.faces, f).norm();
  return area;
}

/// How often the other faces go round the sheet, the mean over its largest faces: a half where the
/// material ends at it.
double windingOfOthers(const TriangleMesh& mesh, std::vector<int> sheet,
                       const WindingNumber& winding) {
  constexpr std::size_t kSome = 32;
  const auto area = [&](int f) { return areaNormal(mesh.vertices, mesh.faces, f).norm(); };
  std::stable_sort(sheet.begin(), sheet.end(), [&](int f, int g) { return area(f) > area(g); });
  sheet.resize(std::min(sheet.size(), kSome));
  const double beside = 10.0 * placeTolerance(mesh.vertices);
  double sum = 0.0;
  double weight = 0.0;
  for (const int f : sheet) {
    const Vec3 normal = areaNormal(mesh.vertices, mesh.faces, f).stableNormalized();
    Vec3 middle = Vec3::Zero();
    for (const int v : mesh.faces.row(f)) middle += mesh.vertices.row(v).transpose() / 3.0;
    // The sheet itself counts for a half on one side and against it on the other.
    sum += area(f) * 0.5 *
           (winding.at(middle + beside * normal) + winding.at(middle - beside * normal));
    weight += area(f);
  }
  return weight > 0.0 ? sum / weight : 0.5;
}

} // namespace

MendedMesh withoutLooseSheets(const TriangleMesh& input, const MendingTask& /*task*/) {
  std::vector<int> all(at(input.faces.rows()));
  for (std::size_t f = 0; f < all.size(); ++f) all[f] = static_cast<int>(f);
  EdgeUses uses = usesOf(input.faces, all);
  const bool isManifold =
      std::all_of(uses.begin(), uses.end(), [](const auto& edge) { return edge.second <= 2; });
  if (isManifold) return {input};

  const WindingNumber winding(input.vertices, input.faces);
  const double area = areaOf(input, all);
  std::vector<char> goes(all.size(), 0);
  std::size_t sheets = 0;
  for (const std::vector<int>& sheet : manifoldPatches(input.faces)) {
    const EdgeUses own = usesOf(input.faces, sheet);
    bool isAttached = false;
    bool isNeeded = false; // by what it ends on
    for (const auto& [edge, count] : own) {
      const int others = uses[edge] - count;
      isAttached = isAttached || others > 1;
      isNeeded = isNeeded || others == 1;
    }
    constexpr double kMost = 0.25; // more is no wall but a body
    if (!isAttached || isNeeded || areaOf(input, sheet) > kMost * area) continue;
    // A flap on the surface ends in the air; a large part of the surface may have a hole.
    constexpr double kSmall = 0.01;
    const bool isFlap = std::any_of(own.begin(), own.end(),
                                    [&](const auto& edge) { return uses[edge.first] == 1; }) &&
                        areaOf(input, sheet) < kSmall * area;
    constexpr double kNearAHalf = 0.3;
    if (!isFlap && std::abs(std::abs(windingOfOthers(input, sheet, winding)) - 0.5) < kNearAHalf)
      continue;
    for (const auto& [edge, count] : own) uses[edge] -= count;
    for (const int f : sheet) goes[at(f)] = 1;
    ++sheets;
  }
  if (sheets == 0) return {input};
  Faces kept(input.faces.rows(), 3);
  Eigen::Index rows = 0;
  for (Eigen::Index f = 0; f < input.faces.rows(); ++f) {
    if (goes[at(f)] == 0) kept.row(rows++) = input.faces.row(f);
  }
  if (rows == 0) return {input};
  return {submesh(input.vertices, kept.topRows(rows)).mesh,
          counted(sheets, "sheet", "sheets") + " that bound no material left out"};
}

} // namespace massprops
