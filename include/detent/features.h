#pragma once
#include <detent/shape.h>

/// @file
/// What a program links. A world calls the code of shapes, of continuous collision and of sleeping through a table that
/// names only what is asked for, so that the linker drops the rest from the plain library (-Wl,--gc-sections).
///
///     create_world(block, bytes, def, assets, world, feature_table<Features::sphere | Features::half_space>);
///
/// What is not linked is refused by its status, feature_missing; it never alters what a tick computes.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// What a world can do. Combine with |. Stored in snapshots and recordings: a bit is never reused.
enum class Features : uint32_t {
  none = 0,  ///< a world without bodies
  /// The shape of this name.
  /// @{
  sphere = 1u << static_cast<uint32_t>(ShapeType::sphere),
  capsule = 1u << static_cast<uint32_t>(ShapeType::capsule),
  box = 1u << static_cast<uint32_t>(ShapeType::box),
  half_space = 1u << static_cast<uint32_t>(ShapeType::half_space),
  cylinder = 1u << static_cast<uint32_t>(ShapeType::cylinder),
  cone = 1u << static_cast<uint32_t>(ShapeType::cone),
  hull = 1u << static_cast<uint32_t>(ShapeType::hull),
  surface = 1u << static_cast<uint32_t>(ShapeType::surface),
  compound = 1u << static_cast<uint32_t>(ShapeType::compound),
  /// @}
  rounding = 1u << 16,    ///< of boxes, cylinders, cones and hulls
  continuous = 1u << 17,  ///< WorldDef::continuous
  sleeping = 1u << 18,    ///< WorldDef::sleeping, put_to_sleep()
  joints = 1u << 19,      ///< create_joint()
  sensors = 1u << 20,     ///< BodyDef::sensor
  /// Every shape.
  shapes = sphere | capsule | box | half_space | cylinder | cone | hull | surface | compound | rounding,
  /// The default of create_world().
  all = shapes | continuous | sleeping | joints | sensors,
};
/// Those in either.
constexpr Features operator|(Features a, Features b) {
  return static_cast<Features>(static_cast<uint32_t>(a) | static_cast<uint32_t>(b));
}
/// Those in both.
constexpr Features operator&(Features a, Features b) {
  return static_cast<Features>(static_cast<uint32_t>(a) & static_cast<uint32_t>(b));
}
/// Those of `a` that are not in `b`.
constexpr Features without(Features a, Features b) {
  return static_cast<Features>(static_cast<uint32_t>(a) & ~static_cast<uint32_t>(b));
}
/// Whether `all` has each of `some`.
constexpr bool contains(Features all, Features some) { return without(some, all) == Features::none; }
/// The feature that a shape needs.
constexpr Features feature_of(ShapeType type) { return static_cast<Features>(1u << static_cast<uint32_t>(type)); }

/// @cond
// The library's own: each is the way into the code of one feature.
struct ShapeCode;
struct PairCode;
struct HalfSpaceCode;
struct ConvexCode;
struct HullCode;
struct SurfaceCode;
struct SurfaceImpactCode;
struct SurfaceDistanceCode;
struct CompoundCode;
struct CompoundImpactCode;
struct ContinuousCode;
struct SleepingCode;
struct JointCode;
struct SensorCode;
extern const ShapeCode k_sphere_code, k_capsule_code, k_box_code, k_half_space_shape_code, k_cylinder_code, k_cone_code,
    k_hull_shape_code, k_surface_shape_code, k_compound_shape_code;
extern const PairCode k_round_pair_code, k_box_round_pair_code, k_box_pair_code;
extern const HalfSpaceCode k_half_space_code;
extern const ConvexCode k_convex_code;
extern const HullCode k_hull_code;
extern const SurfaceCode k_surface_code;
extern const SurfaceImpactCode k_surface_impact_code;
extern const SurfaceDistanceCode k_surface_distance_code;
extern const CompoundCode k_compound_code;
extern const CompoundImpactCode k_compound_impact_code;
extern const ContinuousCode k_continuous_code;
extern const SleepingCode k_sleeping_code;
extern const JointCode k_joint_code;
extern const SensorCode k_sensor_code;
/// @endcond

/// What a world calls, null where it is not linked. Made by feature_table; must outlive its worlds.
struct FeatureTable {
  Features features;  ///< what it names
  /// @cond
  const ShapeCode *sphere, *capsule, *box, *half_space_shape, *cylinder, *cone, *hull_shape, *surface_shape,
      *compound_shape;
  const PairCode *round_pair, *box_round_pair, *box_pair;
  const HalfSpaceCode* half_space;
  const ConvexCode* convex;  ///< pairs of which one is a cylinder, cone, hull or rounded
  const HullCode* hull;
  const SurfaceCode* surface;
  const SurfaceImpactCode* surface_impact;
  const SurfaceDistanceCode* surface_distance;
  const CompoundCode* compound;
  const CompoundImpactCode* compound_impact;  ///< where it is continuous, or there are sensors
  const ContinuousCode* continuous;
  const SleepingCode* sleeping;
  const JointCode* joints;
  const SensorCode* sensors;
  /// @endcond
};

/// What feature_table is made by.
constexpr FeatureTable make_feature_table(Features features) {
  const auto any = [features](Features some) { return (features & some) != Features::none; };
  const bool box = any(Features::box), round = any(Features::sphere | Features::capsule);
  FeatureTable table{};
  table.features = features & Features::all;
  if (any(Features::sphere)) table.sphere = &k_sphere_code;
  if (any(Features::capsule)) table.capsule = &k_capsule_code;
  if (box) table.box = &k_box_code;
  if (any(Features::half_space)) table.half_space_shape = &k_half_space_shape_code;
  if (any(Features::cylinder)) table.cylinder = &k_cylinder_code;
  if (any(Features::cone)) table.cone = &k_cone_code;
  if (any(Features::hull)) table.hull_shape = &k_hull_shape_code;
  if (any(Features::surface)) table.surface_shape = &k_surface_shape_code;
  if (any(Features::compound)) table.compound_shape = &k_compound_shape_code;
  if (round) table.round_pair = &k_round_pair_code;
  if (box && round) table.box_round_pair = &k_box_round_pair_code;
  if (box) table.box_pair = &k_box_pair_code;
  if (any(Features::half_space)) table.half_space = &k_half_space_code;
  if (any(Features::cylinder | Features::cone | Features::hull | Features::rounding)) table.convex = &k_convex_code;
  if (any(Features::hull)) table.hull = &k_hull_code;
  if (any(Features::surface)) table.surface = &k_surface_code;
  if (any(Features::surface) && any(Features::continuous | Features::sensors))
    table.surface_impact = &k_surface_impact_code;
  if (any(Features::surface) && any(Features::sensors)) table.surface_distance = &k_surface_distance_code;
  if (any(Features::compound)) table.compound = &k_compound_code;
  if (any(Features::compound) && any(Features::continuous | Features::sensors))
    table.compound_impact = &k_compound_impact_code;
  if (any(Features::continuous)) table.continuous = &k_continuous_code;
  if (any(Features::sleeping)) table.sleeping = &k_sleeping_code;
  if (any(Features::joints)) table.joints = &k_joint_code;
  if (any(Features::sensors)) table.sensors = &k_sensor_code;
  return table;
}

/// The table of these features, for create_world().
template <Features features>
inline constexpr FeatureTable feature_table = make_feature_table(features);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
