#pragma once
#include <detent/detail/layout.h>

/// The layout table. It lists every array of the persistent state, and every field of the arrays' elements, once. The
/// byte swap of big-endian machines, the digest, the checks of incoming snapshots and the difference tool use this
/// table.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The type of the words of a field.
enum class WordKind : uint8_t {
  unsigned_integer,
  signed_integer,
  coord,
  real,
  unit,
  fraction,
  scaled,  ///< a mantissa and an exponent: two words per number
};

/// A field: `count` words of `width` bytes that begin at `offset`.
struct Field {
  const char* name;
  uint32_t offset, width, count;
  WordKind kind;
  uint32_t components;  ///< numbers per value: 3 or 4 for a vector or rotation, else 1; a field may hold several values
  const char* measured_in;
};

/// An array of the persistent state.
struct Section {
  uint32_t element_bytes;
  uint32_t Layout::*offset;
};

/// The fields of the elements of a section (an array of the persistent state). They are not part of Section, because a
/// little-endian program does not need them, and so does not store them in flash.
struct SectionFields {
  const char* name;
  const Field* fields;
  uint32_t field_count;
};

template <class T>
struct WordsOf {
  static constexpr uint32_t k_width = sizeof(T), k_components = 1;
  static constexpr WordKind k_kind =
      static_cast<T>(-1) < static_cast<T>(0) ? WordKind::signed_integer : WordKind::unsigned_integer;
};
template <>
struct WordsOf<Config> : WordsOf<uint32_t> {};
template <WordKind kind, uint32_t bytes>
struct WordsOfNumber {
  static constexpr uint32_t k_width = bytes, k_components = 1;
  static constexpr WordKind k_kind = kind;
};
template <>
struct WordsOf<Real> : WordsOfNumber<WordKind::real, sizeof(Real)> {};
template <>
struct WordsOf<Fraction> : WordsOfNumber<WordKind::fraction, sizeof(Fraction)> {};
#if DETENT_FIXED
template <>
struct WordsOf<Unit> : WordsOfNumber<WordKind::unit, sizeof(Unit)> {};
template <>
struct WordsOf<Scaled> : WordsOfNumber<WordKind::scaled, sizeof(int32_t)> {};
#endif
#if !defined(DETENT_F64)
template <>
struct WordsOf<Coord> : WordsOfNumber<WordKind::coord, sizeof(Coord)> {};
#endif
template <class T>
struct WordsOf<Vec3<T>> : WordsOf<T> {
  static constexpr uint32_t k_components = 3;
};
template <>
struct WordsOf<Quat> : WordsOf<Unit> {
  static constexpr uint32_t k_components = 4;
};
template <class T, unsigned long long n>
struct WordsOf<T[n]> : WordsOf<T> {};

/// The description of a field of type `T`. `measured_in`: its unit.
template <class T>
constexpr Field make_field(const char* name, uint32_t offset, const char* measured_in) {
  return {name,
          offset,
          WordsOf<T>::k_width,
          static_cast<uint32_t>(sizeof(T)) / WordsOf<T>::k_width,
          WordsOf<T>::k_kind,
          WordsOf<T>::k_components,
          measured_in};
}
#define DETENT_FIELD_IN(type, member, measured_in) \
  make_field<decltype(type::member)>(#member, static_cast<uint32_t>(__builtin_offsetof(type, member)), measured_in)
#define DETENT_FIELD(type, member) DETENT_FIELD_IN(type, member, "")

inline constexpr Field k_header_fields[] = {
    DETENT_FIELD(BlockHeader, magic),           DETENT_FIELD(BlockHeader, format),
    DETENT_FIELD(BlockHeader, simulation),      DETENT_FIELD(BlockHeader, config),
    DETENT_FIELD(BlockHeader, capacity_bodies), DETENT_FIELD(BlockHeader, capacity_contacts),
    DETENT_FIELD(BlockHeader, capacity_assets), DETENT_FIELD(BlockHeader, left_out),
    DETENT_FIELD(BlockHeader, manifolds),       DETENT_FIELD(BlockHeader, capacity_joints),
    DETENT_FIELD(BlockHeader, capacity_sensed), DETENT_FIELD(BlockHeader, zero),
};
inline constexpr Field k_world_fields[] = {
    DETENT_FIELD(WorldState, tick),
    DETENT_FIELD(WorldState, body_count),
    DETENT_FIELD(WorldState, slots_used),
    DETENT_FIELD(WorldState, free_word),
    DETENT_FIELD(WorldState, slots_retired),
    DETENT_FIELD(WorldState, contact_count),
    DETENT_FIELD(WorldState, joint_count),
    DETENT_FIELD(WorldState, joints_used),
    DETENT_FIELD(WorldState, sensor_count),
    DETENT_FIELD(WorldState, sensed_count),
    DETENT_FIELD(WorldState, substeps),
    DETENT_FIELD(WorldState, substeps_max),
    DETENT_FIELD(WorldState, iterations),
    DETENT_FIELD(WorldState, sleeping),
    DETENT_FIELD(WorldState, continuous),
    DETENT_FIELD(WorldState, idle),
    DETENT_FIELD(WorldState, reduction),
    DETENT_FIELD(WorldState, stabilisation),
    DETENT_FIELD(WorldState, convergence),
    DETENT_FIELD_IN(WorldState, gravity, "m/s^2"),
    DETENT_FIELD_IN(WorldState, tick_time, "s"),
    DETENT_FIELD(WorldState, relaxation),
    DETENT_FIELD(WorldState, contact_frequency),
    DETENT_FIELD(WorldState, damping_ratio),
    DETENT_FIELD(WorldState, restitution_threshold),
    DETENT_FIELD(WorldState, contact_margin),
    DETENT_FIELD(WorldState, contact_recycle_distance),
    DETENT_FIELD(WorldState, resting_penetration),
#if defined(DETENT_F32)
    DETENT_FIELD(WorldState, zero),
#endif
};
inline constexpr Field k_pose_fields[] = {
    DETENT_FIELD_IN(BodyPose, position, "m"),
#if defined(DETENT_FX32)
    DETENT_FIELD(BodyPose, remainder),
    DETENT_FIELD(BodyPose, zero),
#endif
    DETENT_FIELD(BodyPose, rotation),
};
inline constexpr Field k_motion_fields[] = {
    DETENT_FIELD_IN(BodyMotion, linear_velocity, "m/s"),
    DETENT_FIELD_IN(BodyMotion, angular_momentum, "m/s"),
    DETENT_FIELD_IN(BodyMotion, pending_velocity, "m/s"),
    DETENT_FIELD_IN(BodyMotion, pending_angular_momentum, "m/s"),
};
inline constexpr Field k_properties_fields[] = {
    DETENT_FIELD(BodyProperties, type),
    DETENT_FIELD(BodyProperties, generation),
    DETENT_FIELD(BodyProperties, shape),
    DETENT_FIELD(BodyProperties, size_exponent),
    DETENT_FIELD(BodyProperties, category),
    DETENT_FIELD(BodyProperties, mask),
    DETENT_FIELD(BodyProperties, group),
    DETENT_FIELD(BodyProperties, rule),
    DETENT_FIELD(BodyProperties, size),
    DETENT_FIELD(BodyProperties, bounding_radius),
    DETENT_FIELD(BodyProperties, rounding),
    DETENT_FIELD_IN(BodyProperties, mass, "kg"),
    DETENT_FIELD(BodyProperties, inverse_inertia),
    DETENT_FIELD(BodyProperties, friction),
    DETENT_FIELD(BodyProperties, restitution),
    DETENT_FIELD(BodyProperties, rolling_resistance),
    DETENT_FIELD_IN(BodyProperties, linear_damping, "1/s"),
    DETENT_FIELD_IN(BodyProperties, angular_damping, "1/s"),
    DETENT_FIELD(BodyProperties, gravity_scale),
    DETENT_FIELD(BodyProperties, user_data),
    DETENT_FIELD(BodyProperties, restitution_rule),
    DETENT_FIELD(BodyProperties, asset),
    DETENT_FIELD(BodyProperties, rotation_locks),
    DETENT_FIELD(BodyProperties, sensor),
};
inline constexpr Field k_activity_fields[] = {
    DETENT_FIELD(BodyActivity, substeps),    DETENT_FIELD(BodyActivity, calm_ticks),
    DETENT_FIELD(BodyActivity, still_ticks), DETENT_FIELD(BodyActivity, pending_event),
    DETENT_FIELD(BodyActivity, asleep),
};
inline constexpr Field k_slot_fields[] = {make_field<uint32_t>("taken", 0, "")};
inline constexpr Field k_contact_fields[] = {
    DETENT_FIELD(ContactState, body_a),
    DETENT_FIELD(ContactState, body_b),
    DETENT_FIELD(ContactState, part),
    DETENT_FIELD(ContactState, age),
    DETENT_FIELD(ContactState, touching),
    DETENT_FIELD(ContactState, point_count),
    DETENT_FIELD(ContactState, feature),
    DETENT_FIELD_IN(ContactState, normal_impulse, "m/s"),
    DETENT_FIELD_IN(ContactState, friction_impulse, "m/s"),
    DETENT_FIELD_IN(ContactState, angular_impulse, "m/s"),
    DETENT_FIELD_IN(ContactState, load, "m/s^2"),
};
inline constexpr Field k_asset_fields[] = {
    DETENT_FIELD(AssetState, digest),
    DETENT_FIELD(AssetState, byte_count),
    DETENT_FIELD(AssetState, kind),
};
inline constexpr Field k_manifold_fields[] = {
    DETENT_FIELD(ManifoldState, normal), DETENT_FIELD(ManifoldState, offset), DETENT_FIELD(ManifoldState, rotation),
    DETENT_FIELD(ManifoldState, height), DETENT_FIELD(ManifoldState, anchor),
};
inline constexpr Field k_joint_fields[] = {
    DETENT_FIELD(JointState, type),
    DETENT_FIELD(JointState, generation),
    DETENT_FIELD(JointState, body_a),
    DETENT_FIELD(JointState, body_b),
    DETENT_FIELD(JointState, collide),
    DETENT_FIELD(JointState, user_data),
    DETENT_FIELD_IN(JointState, anchor_a, "m"),
    DETENT_FIELD_IN(JointState, anchor_b, "m"),
    DETENT_FIELD(JointState, frame_a),
    DETENT_FIELD(JointState, frame_b),
    DETENT_FIELD(JointState, lower),
    DETENT_FIELD(JointState, upper),
    DETENT_FIELD_IN(JointState, frequency, "Hz"),
    DETENT_FIELD(JointState, damping_ratio),
    DETENT_FIELD(JointState, target),
    DETENT_FIELD(JointState, speed),
    DETENT_FIELD(JointState, force_max),
    DETENT_FIELD(JointState, limited),
    DETENT_FIELD(JointState, friction),
    DETENT_FIELD_IN(JointState, break_force, "N"),
    DETENT_FIELD_IN(JointState, break_torque, "N m"),
    DETENT_FIELD_IN(JointState, force, "N"),
    DETENT_FIELD_IN(JointState, torque, "N m"),
    DETENT_FIELD_IN(JointState, impulse, "m/s"),
};
inline constexpr Field k_sensed_fields[] = {
    DETENT_FIELD(SensedState, sensor),
    DETENT_FIELD(SensedState, body),
};
/// Whether the fields follow one another without gaps and fill the element, so that the element has no padding.
template <uint32_t n>
constexpr bool tiles(const Field (&fields)[n], uint32_t element_bytes) {
  uint32_t end = 0;
  for (const Field& field : fields) {
    if (field.offset != end || field.offset % field.width != 0) return false;
    end += field.width * field.count;
  }
  return end == element_bytes;
}
static_assert(tiles(k_header_fields, sizeof(BlockHeader)) && tiles(k_world_fields, sizeof(WorldState)));
static_assert(tiles(k_pose_fields, sizeof(BodyPose)) && tiles(k_motion_fields, sizeof(BodyMotion)));
static_assert(tiles(k_properties_fields, sizeof(BodyProperties)) && tiles(k_slot_fields, sizeof(uint32_t)));
static_assert(tiles(k_activity_fields, sizeof(BodyActivity)));
static_assert(tiles(k_contact_fields, sizeof(ContactState)) && tiles(k_asset_fields, sizeof(AssetState)));
static_assert(tiles(k_manifold_fields, sizeof(ManifoldState)) && tiles(k_joint_fields, sizeof(JointState)));
static_assert(tiles(k_sensed_fields, sizeof(SensedState)));

inline constexpr Section k_sections[] = {
    {sizeof(BlockHeader), &Layout::header},
    {sizeof(WorldState), &Layout::world},
    {sizeof(BodyPose), &Layout::poses},
    {sizeof(BodyMotion), &Layout::motions},
    {sizeof(BodyProperties), &Layout::properties},
    {sizeof(BodyActivity), &Layout::activities},
    {sizeof(uint32_t), &Layout::slots},
    {sizeof(ContactState), &Layout::contacts},
    {sizeof(AssetState), &Layout::assets},
    {sizeof(ManifoldState), &Layout::manifolds},
    {sizeof(JointState), &Layout::joints},
    {sizeof(SensedState), &Layout::sensed},
};
inline constexpr uint32_t k_section_count = sizeof k_sections / sizeof k_sections[0];

/// The size of the largest element, bytes.
inline constexpr uint32_t k_element_bytes_max = [] {
  uint32_t most = 0;
  for (const Section& section : k_sections) most = section.element_bytes > most ? section.element_bytes : most;
  return most;
}();

template <uint32_t n>
constexpr SectionFields section_fields(const char* name, const Field (&fields)[n]) {
  return {name, fields, n};
}
inline constexpr SectionFields k_section_fields[k_section_count] = {
    section_fields("header", k_header_fields),
    section_fields("world", k_world_fields),
    section_fields("poses", k_pose_fields),
    section_fields("motions", k_motion_fields),
    section_fields("properties", k_properties_fields),
    section_fields("activities", k_activity_fields),
    section_fields("slots", k_slot_fields),
    section_fields("contacts", k_contact_fields),
    section_fields("assets", k_asset_fields),
    section_fields("manifolds", k_manifold_fields),
    section_fields("joints", k_joint_fields),
    section_fields("sensed", k_sensed_fields),
};

/// The size of a section, bytes, including the fill up to the alignment of the next section. The fill is always zero.
/// If the fill is as long as an element, the quotient of this size and the element size counts the fill as one more
/// element, which is zero.
inline uint32_t section_bytes(const Layout& layout, uint32_t index) {
  const uint32_t end = index + 1 < k_section_count ? layout.*k_sections[index + 1].offset : layout.persistent_bytes;
  return end - layout.*k_sections[index].offset;
}

/// Reverses the bytes of each word of an element, which converts the element between the two byte orders.
void swap_element(uint32_t section_index, uint8_t* element);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
