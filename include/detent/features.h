#pragma once
#include <detent/shape.h>

/// @file
/// Selects the features that a program links. A world calls the code of its features (shapes, continuous collision,
/// sleeping, joints, sensors) through a table. The table refers only to the selected features. Therefore the linker can
/// remove the code of all other features (-Wl,--gc-sections); the library need not be rebuilt.
///
///     create_world(block, bytes, def, hooks, feature_table<Features::sphere | Features::half_space>, world);
///
/// A call that needs a feature that the table lacks returns feature_missing. The selection never changes what a tick
/// computes.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The features of a world. Combine with |. Stored in snapshots and recordings: a bit is never reused.
enum class Features : uint32_t {
  none = 0,  ///< a world without bodies
  /// The shape of the same name.
  /// @{
  sphere = 1u << static_cast<uint32_t>(ShapeType::sphere),
  capsule = 1u << static_cast<uint32_t>(ShapeType::capsule),
  box = 1u << static_cast<uint32_t>(ShapeType::box),
  half_space = 1u << static_cast<uint32_t>(ShapeType::half_space),
  cylinder = 1u << static_cast<uint32_t>(ShapeType::cylinder),
  cone = 1u << static_cast<uint32_t>(ShapeType::cone),
  hull = 1u << static_cast<uint32_t>(ShapeType::hull),
  terrain = 1u << static_cast<uint32_t>(ShapeType::terrain),
  compound = 1u << static_cast<uint32_t>(ShapeType::compound),
  /// @}
  rounding = 1u << 16,    ///< rounded boxes, cylinders, cones and hulls
  continuous = 1u << 17,  ///< WorldDef::continuous
  sleeping = 1u << 18,    ///< WorldDef::sleeping, sleep_body()
  joints = 1u << 19,      ///< create_joint()
  sensors = 1u << 20,     ///< BodyDef::sensor
  /// All shapes.
  shapes = sphere | capsule | box | half_space | cylinder | cone | hull | terrain | compound | rounding,
  /// All features: the selection of create_world() if no table is given.
  all = shapes | continuous | sleeping | joints | sensors,
};
/// The features that are in `a` or in `b`.
constexpr Features operator|(Features a, Features b) {
  return static_cast<Features>(static_cast<uint32_t>(a) | static_cast<uint32_t>(b));
}
/// The features that are in `a` and in `b`.
constexpr Features operator&(Features a, Features b) {
  return static_cast<Features>(static_cast<uint32_t>(a) & static_cast<uint32_t>(b));
}
/// The features that are in `a` and not in `b`.
constexpr Features without(Features a, Features b) {
  return static_cast<Features>(static_cast<uint32_t>(a) & ~static_cast<uint32_t>(b));
}
/// Whether all features of `some` are in `all`.
constexpr bool contains(Features all, Features some) { return without(some, all) == Features::none; }
/// The feature that a shape of this type needs.
constexpr Features feature_of(ShapeType type) { return static_cast<Features>(1u << static_cast<uint32_t>(type)); }

/// @cond
// Internal to the library: each is the function table of one feature.
struct ShapeOps;
struct PairOps;
struct HalfSpaceOps;
struct ConvexOps;
struct HullOps;
struct TerrainOps;
struct TerrainImpactOps;
struct TerrainDistanceOps;
struct CompoundOps;
struct CompoundImpactOps;
struct ContinuousOps;
struct SleepingOps;
struct JointOps;
struct SensorOps;
extern const ShapeOps k_sphere_ops, k_capsule_ops, k_box_ops, k_half_space_shape_ops, k_cylinder_ops, k_cone_ops,
    k_hull_shape_ops, k_terrain_shape_ops, k_compound_shape_ops;
extern const PairOps k_round_pair_ops, k_box_round_pair_ops, k_box_pair_ops;
extern const HalfSpaceOps k_half_space_ops;
extern const ConvexOps k_convex_ops;
extern const HullOps k_hull_ops;
extern const TerrainOps k_terrain_ops;
extern const TerrainImpactOps k_terrain_impact_ops;
extern const TerrainDistanceOps k_terrain_distance_ops;
extern const CompoundOps k_compound_ops;
extern const CompoundImpactOps k_compound_impact_ops;
extern const ContinuousOps k_continuous_ops;
extern const SleepingOps k_sleeping_ops;
extern const JointOps k_joint_ops;
extern const SensorOps k_sensor_ops;
/// @endcond

/// Pointers to the function tables of the features; null for a feature that is not selected. Use the variable template
/// feature_table to make one. The table must outlive the worlds that use it.
struct FeatureTable {
  Features features;  ///< the features that are linked
  /// @cond
  const ShapeOps *sphere, *capsule, *box, *half_space_shape, *cylinder, *cone, *hull_shape, *terrain_shape,
      *compound_shape;
  const PairOps *round_pair, *box_round_pair, *box_pair;
  const HalfSpaceOps* half_space;
  const ConvexOps* convex;  ///< pairs in which a shape is a cylinder, cone, hull or rounded shape
  const HullOps* hull;
  const TerrainOps* terrain;
  const TerrainImpactOps* terrain_impact;
  const TerrainDistanceOps* terrain_distance;
  const CompoundOps* compound;
  const CompoundImpactOps* compound_impact;  ///< compounds with continuous collision or sensors
  const ContinuousOps* continuous;
  const SleepingOps* sleeping;
  const JointOps* joints;
  const SensorOps* sensors;
  /// @endcond
};

/// Returns the table for `features`. Use feature_table instead.
constexpr FeatureTable make_feature_table(Features features) {
  const auto any = [features](Features some) { return (features & some) != Features::none; };
  const bool box = any(Features::box), round = any(Features::sphere | Features::capsule);
  FeatureTable table{};
  table.features = features & Features::all;
  if (any(Features::sphere)) table.sphere = &k_sphere_ops;
  if (any(Features::capsule)) table.capsule = &k_capsule_ops;
  if (box) table.box = &k_box_ops;
  if (any(Features::half_space)) table.half_space_shape = &k_half_space_shape_ops;
  if (any(Features::cylinder)) table.cylinder = &k_cylinder_ops;
  if (any(Features::cone)) table.cone = &k_cone_ops;
  if (any(Features::hull)) table.hull_shape = &k_hull_shape_ops;
  if (any(Features::terrain)) table.terrain_shape = &k_terrain_shape_ops;
  if (any(Features::compound)) table.compound_shape = &k_compound_shape_ops;
  if (round) table.round_pair = &k_round_pair_ops;
  if (box && round) table.box_round_pair = &k_box_round_pair_ops;
  if (box) table.box_pair = &k_box_pair_ops;
  if (any(Features::half_space)) table.half_space = &k_half_space_ops;
  if (any(Features::cylinder | Features::cone | Features::hull | Features::rounding)) table.convex = &k_convex_ops;
  if (any(Features::hull)) table.hull = &k_hull_ops;
  if (any(Features::terrain)) table.terrain = &k_terrain_ops;
  if (any(Features::terrain) && any(Features::continuous | Features::sensors))
    table.terrain_impact = &k_terrain_impact_ops;
  if (any(Features::terrain) && any(Features::sensors)) table.terrain_distance = &k_terrain_distance_ops;
  if (any(Features::compound)) table.compound = &k_compound_ops;
  if (any(Features::compound) && any(Features::continuous | Features::sensors))
    table.compound_impact = &k_compound_impact_ops;
  if (any(Features::continuous)) table.continuous = &k_continuous_ops;
  if (any(Features::sleeping)) table.sleeping = &k_sleeping_ops;
  if (any(Features::joints)) table.joints = &k_joint_ops;
  if (any(Features::sensors)) table.sensors = &k_sensor_ops;
  return table;
}

/// The table for `features`, for create_world().
template <Features features>
inline constexpr FeatureTable feature_table = make_feature_table(features);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
