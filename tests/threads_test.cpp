// The number of threads shows in no result.
#include "core/pipeline.h"

#include "large_test.h"
#include "shapes.h"
#include "thread_count.h"

#include <gtest/gtest.h>

namespace massprops::testing {
namespace {

TEST(Threads, DoNotChangeASingleBitOfTheCavity) {
  LARGE_TEST();
  // Large enough for two decimated copies.
  const TriangleMesh mesh = transformed(blob(38), someRotation());
  Options options;
  options.radiusX = options.radiusY = 0.5;
  const auto cavity = [&](int threads) {
    const ThreadCount count(threads);
    return optimizeMassProperties(mesh, options).inner;
  };
  const TriangleMesh one = cavity(1);
  ASSERT_GT(one.faces.rows(), 0);
  for (const int threads : {2, 4}) {
    const TriangleMesh other = cavity(threads);
    EXPECT_EQ(one.vertices, other.vertices);
    EXPECT_EQ(one.faces, other.faces);
  }
}

} // namespace
} // namespace massprops::testing
