// All goals: what they are called, and how they are made from what the user asks for.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/goals/verdict.h"
#include "core/model/posed_model.h"
#include "core/physics/filling.h"

#include <memory>
#include <string>
#include <vector>

namespace massprops {

/// What a goal is made from.
struct GoalInputs {
  const Options& options;
  const PosedModel& posed;
  const Points& outer; ///< n×3, working frame; the model's own vertices unless they have moved
  const TriangleMesh* cavity = nullptr; ///< outward, working frame; of a hollow body
};

struct GoalEntry {
  GoalKind kind;
  std::string name;    ///< as the dialog shows it
  std::string promise; ///< what the print will do: a sentence without its first letter's capital
  int equalities;      ///< at most; as many basis functions are needed at least
  std::unique_ptr<Goal> (*goal)(const GoalInputs&);
  std::unique_ptr<Verdict> (*verdict)(const GoalInputs&);
};

/// In the order of `GoalKind`.
const std::vector<GoalEntry>& goalRegistry();

/// \throw InvalidInput when there is no such goal
const GoalEntry& goalEntry(GoalKind kind);

/// In the order of `GoalKind`, as the dialog shows them.
const std::vector<std::string>& goalNames();

/// \throw InvalidInput when the basis has fewer functions than the goal has equalities
void requireEnoughFunctions(const Options& options);

/// The goal that the user asks for. \throw InvalidInput when there is no such goal
std::unique_ptr<Goal> makeGoal(const Options& options, const PosedModel& posed,
                               const Points& outer);

/// What is said about it.
std::unique_ptr<Verdict> makeVerdict(const Options& options, const PosedModel& posed,
                                     const Points& outer, const TriangleMesh* cavity = nullptr);

/// The states in which the body is to serve the goal, levels of contents left out.
Fillings fillingsSeenBy(const Options& options);

} // namespace massprops
