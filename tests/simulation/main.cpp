// Drops, tilts, spins, hangs and floats bodies in Bullet and compares with what is expected.
//
// usage: simulate method
//          bodies with known behaviour
//        simulate <model.ply> <prefix> <script.mlx>
//          what the filter delivered: <prefix>_report.txt, <prefix>_inner.ply, and
//          <prefix>_outer.ply where the outer surface moved
#include "simulation/delivery.h"
#include "simulation/method.h"

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  simulation::Comparison comparison;
  try {
    if (arguments == std::vector<std::string>{"method"}) {
      simulation::checkMethod(comparison);
    } else if (arguments.size() == 3) {
      comparison.title(arguments[0]);
      simulation::compareDelivery(
          simulation::readDelivery(arguments[0], arguments[1], arguments[2]), comparison);
    } else {
      std::fputs("usage: simulate method | <model.ply> <prefix> <script.mlx>\n", stderr);
      return 2;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "simulate: %s\n", error.what());
    return 2;
  }
  std::printf("\n%d disagreements\n", comparison.disagreements());
  return comparison.disagreements() == 0 ? 0 : 1;
}
