// Triangles whose corners lie exactly on a line, and those that only nearly do.
#include "core/mesh/degenerate_faces.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace massprops::testing {
namespace {

TEST(FacesWithoutArea, AreThoseOnALineToTheLastBit) {
  Points points(5, 3);
  const double above = std::nextafter(0.5, 1.0);
  points << 0, 0, 0, 1, 1, 1, 0.5, 0.5, 0.5, 0.5, 0.5, above, 0, 0, 0;
  Faces faces(4, 3);
  faces << 0, 1, 2, // its third corner is the middle of the others
      0, 1, 3,      // a bit beside it
      0, 1, 4,      // two corners at one place
      1, 2, 1;      // one corner twice
  EXPECT_EQ(facesWithoutArea(points, faces), (std::vector<int>{0, 2, 3}));
  EXPECT_TRUE(facesWithoutArea(blob(4).vertices, blob(4).faces).empty());
}

} // namespace
} // namespace massprops::testing
