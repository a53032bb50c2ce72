#include "core/print/thumbnail.h"

#include "core/answer/cutaway.h"
#include "core/base/triangle.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace massprops {
namespace {

constexpr int kSize = 256;  // pixels, as slicers ask for
constexpr int kSamples = 2; // a pixel's side has so many
constexpr int kGrid = kSize * kSamples;

/// The nearest surface behind the cut for each sample.
struct Canvas {
  std::vector<double> depth = std::vector<double>(kGrid * kGrid, infinity());
  std::vector<Colour> colour = std::vector<Colour>(kGrid * kGrid);

  static double infinity() { return std::numeric_limits<double>::infinity(); }
};

Colour shaded(Colour colour, double light) {
  const auto part = [&](unsigned char value) {
    return static_cast<unsigned char>(std::lround(light * value));
  };
  return {part(colour.red), part(colour.green), part(colour.blue)};
}

/// Corners in samples, to the right and up, and behind the cut. What is seen from its back is the
/// end of material that the cut goes through.
void paint(const std::array<Vec3, 3>& corners, Colour colour, Canvas& canvas) {
  const Vec3 normal = areaNormal(corners[0], corners[1], corners[2]);
  if (normal.z() == 0.0) return;
  const bool isFront = normal.z() > 0.0;
  const double facing = std::abs(normal.z()) / normal.norm();
  const Colour seen = isFront ? shaded(colour, 0.35 + 0.65 * facing) : kCutColour;
  const auto range = [&](int axis) {
    const auto [least, most] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
    return std::pair(std::max(0, static_cast<int>(std::ceil(least - 0.5))),
                     std::min(kGrid - 1, static_cast<int>(std::floor(most - 0.5))));
  };
  const auto [left, right] = range(0);
  const auto [bottom, top] = range(1);
  for (int row = bottom; row <= top; ++row) {
    for (int column = left; column <= right; ++column) {
      const Vec2 p(column + 0.5, row + 0.5);
      Vec3 weights;
      for (int k = 0; k < 3; ++k) {
        const Vec2 a = corners[static_cast<std::size_t>((k + 1) % 3)].head<2>() - p;
        const Vec2 b = corners[static_cast<std::size_t>((k + 2) % 3)].head<2>() - p;
        weights[k] = (a.x() * b.y() - a.y() * b.x()) / normal.z();
      }
      if (weights.minCoeff() < 0.0) continue;
      const double depth =
          weights[0] * corners[0].z() + weights[1] * corners[1].z() + weights[2] * corners[2].z();
      const auto sample = static_cast<std::size_t>(row * kGrid + column);
      if (depth < 0.0 || depth >= canvas.depth[sample]) continue;
      canvas.depth[sample] = depth;
      canvas.colour[sample] = seen;
    }
  }
}

/// RGBA, rows from the top.
std::vector<unsigned char> pixels(const Canvas& canvas) {
  std::vector<unsigned char> image;
  for (int row = kSize - 1; row >= 0; --row) {
    for (int column = 0; column < kSize; ++column) {
      std::array<int, 3> sum{};
      int count = 0;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const auto sample = static_cast<std::size_t>((row * kSamples + i / kSamples) * kGrid +
                                                     column * kSamples + i % kSamples);
        if (canvas.depth[sample] == Canvas::infinity()) continue;
        const Colour colour = canvas.colour[sample];
        sum[0] += colour.red, sum[1] += colour.green, sum[2] += colour.blue;
        ++count;
      }
      for (const int value : sum) {
        image.push_back(static_cast<unsigned char>(count > 0 ? value / count : 0));
      }
      image.push_back(static_cast<unsigned char>(255 * count / (kSamples * kSamples)));
    }
  }
  return image;
}

} // namespace

std::string thumbnail(const TriangleMesh& material, Eigen::Index cavityFaces, const Vec3& point) {
  const Vec3 lowest = material.vertices.colwise().minCoeff().transpose();
  const Vec3 extent = material.vertices.colwise().maxCoeff().transpose() - lowest;
  // The wider side is seen; away from the viewer is y, or x turned to the left.
  const bool isDeep = extent.y() > extent.x();
  const int across = isDeep ? 1 : 0;
  const int away = isDeep ? 0 : 1;
  const double sign = isDeep ? -1.0 : 1.0;
  const double scale = 0.94 * kGrid / std::max(extent[across], extent.z());
  const Vec3 middle = lowest + 0.5 * extent;
  Canvas canvas;
  for (Eigen::Index f = 0; f < material.faces.rows(); ++f) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = material.vertices.row(material.faces(f, static_cast<int>(k))).transpose();
      corners[k] = {0.5 * kGrid + scale * (p[across] - middle[across]),
                    0.5 * kGrid + scale * (p.z() - middle.z()),
                    scale * sign * (p[away] - point[away])};
    }
    paint(corners, f < cavityFaces ? kOuterColour : kCavityColour, canvas);
  }
  const std::vector<unsigned char> image = pixels(canvas);
  std::string png;
  stbi_write_png_to_func(
      [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                                   static_cast<std::size_t>(size));
      },
      &png, kSize, kSize, 4, image.data(), 4 * kSize);
  return png;
}

} // namespace massprops
