// What the user asks for: one field per parameter of the dialog.
#pragma once

#include "core/base/types.h"

#include <functional>
#include <optional>
#include <string>

namespace massprops {

/// In the order of the dialog; goals/registry.h says what they are.
enum class GoalKind {
  Stand,
  Spin,
  YoYo,
  StandEmptyAndFilled,
  RollUpright,
  Float,
  Hang,
  Mass,
  PublishedStand,
};

/// How the cavity is found, in the order of the dialog.
enum class CavityShape {
  Automatic,    ///< the offset surface, and the best possible one where that falls short
  Offset,       ///< the outer surface moved inwards
  BestPossible, ///< what lies behind the walls on one side of a quadric
};

/// Whether the model is cut flat a little above its lowest point, in the order of the dialog.
enum class FootCut {
  Automatic, ///< where it has too little to stand on
  Never,
  Given, ///< by `footDepth`
};

/// In the order of the dialog.
enum class UpAxis { PlusZ, PlusY, PlusX, MinusZ, MinusY, MinusX };

/// Which way is up in the printer, in the order of the dialog; `AsUsed`: as `UpAxis` says.
enum class BuildAxis { AsUsed, PlusZ, PlusY, PlusX, MinusZ, MinusY, MinusX };

/// Dimensionless factors of the objective's terms (docs/math.md, "Objective"). The defaults give
/// the goal's published objective.
struct Weights {
  double volume = 0.0;       ///< opt_weight_1: material volume / volume of the solid
  double centerOfMass = 1.0; ///< opt_weight_2: the goal's terms in mass and centre of mass
  double inertia = 1.0;      ///< opt_weight_3: the goal's terms in the moments of inertia
  double smoothness = 0.0;   ///< opt_weight_4: Dirichlet energy of the offsets
  double constraints = 1.0;  ///< opt_weight_5: squared violation; 0 leaves the constraints out
  double outer = 0.0;        ///< opt_weight_6: mean squared displacement of the outer surface
};

struct Options {
  GoalKind goal = GoalKind::Stand;
  CavityShape cavityShape = CavityShape::Automatic;
  /// k, the number of harmonic basis functions; less than the vertices of what moves inwards and at
  /// least the number of the goal's equalities (goals/registry.h).
  int basisSize = 36;
  /// Half axes of the elliptic contact area along the two horizontal axes that follow the up axis
  /// cyclically (x, y for +Z); length. Empty: taken from the model's ground contacts.
  std::optional<double> radiusX, radiusY;
  /// Minimum wall, perpendicular to the surface; length. Empty: 1 % of the diagonal.
  std::optional<double> innerLowerBound;
  /// Greatest offset as a fraction of the distance to the skeleton, in (0, 1).
  double innerUpperBound = 0.9;
  /// Range of the outward displacement of the outer surface; lengths. Both 0: it stays.
  double outerLowerBound = 0.0;
  double outerUpperBound = 0.0;
  Weights weights;
  UpAxis upAxis = UpAxis::PlusZ;
  double density = 1.24;    ///< of the material, g/cm³; the default is PLA
  double fillDensity = 0.0; ///< of what fills the cavity, g/cm³
  /// Share of the material that the cavity is printed with, as sparse infill; 0: left empty.
  double cavityInfill = 0.0;
  /// Spin: any point of the axis; Yo-yo: the middle of the axle; Hang: the point it hangs from. In
  /// model coordinates. Empty: Spin takes the centre of the ground contact, Yo-yo the point above
  /// it at half the height, Hang the middle of the topmost vertices.
  std::optional<Vec3> pivot;
  /// Spin: what a hand gives the top, rpm. Thumb and finger bring a stem to more than 1000 rpm
  /// [SHR97]; a string to a multiple of that.
  double spinSpeed = 1000.0;
  /// Float: how deep it shall lie in the water, as a share of its height; 1 is neutral, under
  /// water.
  double waterLevel = 0.5;
  double waterDensity = 1.0; ///< Float: g/cm³
  double targetMass = 0.0;   ///< Mass: g; 0 is as light as possible
  double tippingAngle = 0.0; ///< Stand: wanted, degrees; 0 is as large as possible
  /// Stand, Stand (published), Stand empty and filled, and only without radii (model/foot.h).
  FootCut foot = FootCut::Automatic;
  double footDepth = 0.0; ///< length, only where the foot is `Given`
  /// Triangles, in model coordinates, that no point of the cavity comes nearer to than
  /// `solidDepth`: around screw holes and joints, say. Often none.
  TriangleMesh keptSolid;
  std::optional<double> solidDepth; ///< length; empty: four walls
  /// Whether a surface with boundary loops is taken as one side of a shell; otherwise it is
  /// refused.
  bool openSurface = false;
  /// Whether a surface that bounds no solid is mended (model/mending.h); otherwise it is refused.
  bool mend = true;
  /// Whether the result brings a picture of the answer.
  bool showAnswer = false;
  BuildAxis buildAxis = BuildAxis::AsUsed; ///< what is printed is turned so that this one is up
  /// Least slope of the cavity's ceiling against the horizontal in the printer, degrees, so that it
  /// prints without support; 0: any.
  double overhangAngle = 0.0;
  std::string printFile; ///< path, UTF-8, of a 3MF project for a slicer; empty: none
  int drainHoles = 0;    ///< least number for each cavity; 0: none are drilled
  /// Least diameter of a drain hole, mm: what printing guides ask for, for resin and for powder
  /// [All3DP, Addema].
  double drainDiameter = 3.5;
  /// Rounds points to what the caller can store (a float mesh, say). What is delivered, checked
  /// and reported is the rounded surface. Empty: double precision.
  std::function<Points(const Points&)> representable;
};

/// Whether the goal is one of standing on the model's contact area.
inline bool standsOnContacts(GoalKind goal) {
  return goal == GoalKind::Stand || goal == GoalKind::PublishedStand ||
         goal == GoalKind::StandEmptyAndFilled;
}

/// \throw InvalidInput when an option is absurd in itself or for a model of that size
void requireSensible(const Options& options, double diagonal);
/// Density of what is in the cavity once it is printed and filled, g/cm³.
double contentsDensity(const Options& options);

/// `AsUsed` resolved.
UpAxis buildAxisOf(const Options& options);

} // namespace massprops
