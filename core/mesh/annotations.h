// Small coloured meshes that show in the window what the numbers say.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// sRGB, 0…255.
struct Colour {
  unsigned char red, green, blue;
};

/// The solid body, the answer, and what they are judged by.
constexpr Colour kBeforeColour{204, 26, 26};
constexpr Colour kAfterColour{13, 128, 38};
constexpr Colour kGroundColour{13, 77, 191};
constexpr Colour kWaterColour{38, 140, 204};

/// Triangles with a colour for every vertex.
struct ColouredMesh {
  TriangleMesh mesh;
  std::vector<Colour> colours;
};

enum class Pen { Broad, Fine };

/// Marks around a body, each a closed surface, outward oriented.
class Annotations {
public:
  /// `outer`: the body's surface, n×3; pens are as thick as suits its size.
  explicit Annotations(const Points& outer);

  void addBall(const Vec3& centre, Colour colour);
  /// A thin prism; nothing where the ends coincide.
  void addLine(const Vec3& from, const Vec3& to, Colour colour, Pen pen = Pen::Broad);
  /// Lines from each corner to the next, and from the last to the first.
  void addLoop(const std::vector<Vec3>& corners, Colour colour);

  /// The body's bounding box.
  const Eigen::AlignedBox3d& box() const { return box_; }
  ColouredMesh mesh() const;

private:
  int addVertex(const Vec3& point, Colour colour);

  Eigen::AlignedBox3d box_;
  std::vector<Vec3> points_;
  std::vector<Colour> colours_;
  std::vector<Eigen::RowVector3i> faces_;
};

} // namespace massprops
