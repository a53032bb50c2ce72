#include "core/base/option_pairs.h"

namespace massprops {
namespace {

bool moves(const Options& options) {
  return options.outerUpperBound > 0.0;
}

bool drains(const Options& options) {
  return options.drainHoles > 0;
}

bool overhangs(const Options& options) {
  return options.overhangAngle > 0.0;
}

bool hasInfill(const Options& options) {
  return options.cavityInfill > 0.0;
}

} // namespace

const std::vector<RefusedPair>& refusedPairs() {
  static const std::vector<RefusedPair> pairs = {
      {[](const Options& o, bool) {
         return hasInfill(o) && o.goal == GoalKind::StandEmptyAndFilled;
       },
       "A cavity that is printed as infill cannot be filled: set cavity_infill to 0 for the goal "
       "Stand empty and filled, or choose the goal Stand."},
      {[](const Options& o, bool) { return hasInfill(o) && o.fillDensity > 0.0; },
       "A cavity that is printed as infill cannot be filled: set cavity_infill or fill_density to "
       "0."},
      {[](const Options& o, bool isOpen) { return isOpen && hasInfill(o); },
       "The cavity of an open surface is not printed: set cavity_infill to 0, or close the surface "
       "with Remeshing > Close Holes."},
      {[](const Options& o, bool isOpen) {
         return isOpen && o.cavityShape == CavityShape::BestPossible;
       },
       "The best possible cavity needs a closed surface: set cavity_shape to Automatic or Offset "
       "surface, or close it with Remeshing > Close Holes."},
      {[](const Options& o, bool) {
         return moves(o) && o.cavityShape == CavityShape::BestPossible;
       },
       "The best possible cavity needs an outer surface that stays: set outer_lower_bound and "
       "outer_upper_bound to 0, or cavity_shape to Automatic or Offset surface."},
      {[](const Options& o, bool) { return overhangs(o) && o.cavityShape == CavityShape::Offset; },
       "Ceilings carry themselves only in the best possible cavity: set cavity_shape to Automatic "
       "or Best possible, or overhang_angle to 0."},
      {[](const Options& o, bool isOpen) { return isOpen && moves(o); },
       "An open surface stays where it is: set outer_lower_bound and outer_upper_bound to 0, or "
       "close it with Remeshing > Close Holes."},
      {[](const Options& o, bool) { return o.keptSolid.faces.rows() > 0 && moves(o); },
       "Selected faces stay solid only where the outer surface stays where it is: set "
       "outer_lower_bound and outer_upper_bound to 0, or switch keep_selected_solid off."},
      {[](const Options& o, bool isOpen) { return isOpen && drains(o); },
       "The cavity of an open surface is open already: set drain_holes to 0, or close the surface "
       "with Remeshing > Close Holes."},
      {[](const Options& o, bool) { return drains(o) && o.goal == GoalKind::StandEmptyAndFilled; },
       "A cavity with drain holes holds nothing: set drain_holes to 0 for the goal Stand empty and "
       "filled, or choose the goal Stand."},
      {[](const Options& o, bool) { return drains(o) && o.fillDensity > 0.0; },
       "A cavity with drain holes holds nothing: set drain_holes or fill_density to 0."},
      {[](const Options& o, bool) { return drains(o) && hasInfill(o); },
       "A cavity that is printed as infill needs no drain holes: set drain_holes or cavity_infill "
       "to 0."},
      {[](const Options& o, bool) { return overhangs(o) && hasInfill(o); },
       "Infill carries the ceiling of its cavity: set overhang_angle or cavity_infill to 0."},
      {[](const Options& o, bool isOpen) { return isOpen && overhangs(o); },
       "The cavity of an open surface has no ceiling to be carried: set overhang_angle to 0, or "
       "close the surface with Remeshing > Close Holes."},
      {[](const Options& o, bool) { return overhangs(o) && moves(o); },
       "Ceilings carry themselves only where the outer surface stays where it is: set "
       "outer_lower_bound and outer_upper_bound to 0, or overhang_angle to 0."},
      {[](const Options& o, bool) { return drains(o) && !o.printFile.empty(); },
       "print_file is a project for filament, whose cavities need no drain holes: set drain_holes "
       "to 0, or leave print_file empty and export the drilled body."},
  };
  return pairs;
}

void requireCompatible(const Options& options, bool isOpen) {
  for (const RefusedPair& pair : refusedPairs()) {
    if (pair.areWished(options, isOpen)) throw InvalidInput(pair.sentence);
  }
}

} // namespace massprops
