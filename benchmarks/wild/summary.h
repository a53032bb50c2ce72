// What is printed: a line for each trial, and tables for benchmarks/results.md.
#pragma once

#include "wild/trial.h"

#include <utility>
#include <vector>

namespace massprops::wild {

void printHead();
void print(const Case& c, const Trial& trial);
/// For each goal, wall and shape: served, refused by reason, gap, wall, seconds, memory.
void printSummary(const std::vector<std::pair<Case, Trial>>& trials);

} // namespace massprops::wild
