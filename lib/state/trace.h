#pragma once
#include "state/fields.h"

/// The data of a world that tools compare at the end of each stage of a step, to find the stage in which two machines
/// first differ. It consists of the current persistent state, and of the data in the work space that determines the
/// next state.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The times in a tick at which data is traced. Stored in files: a value is never reused. The values between the first
/// and the last are the stages of StepStage. An idle step has only the first and the last.
enum class TraceStage : uint32_t {
  calls = 0,  ///< after the calls, before the step
  find_pairs = 1,
  store = 8,
  end = 9,  ///< after the step
};
inline constexpr uint32_t k_trace_stage_count = 10;
static_assert(static_cast<uint32_t>(TraceStage::store) == k_step_stage_count);
constexpr TraceStage trace_stage(StepStage stage) {
  return static_cast<TraceStage>(static_cast<uint32_t>(stage) + static_cast<uint32_t>(TraceStage::find_pairs));
}

/// What an element of a trace describes.
enum class TraceKind : uint32_t { world, body, slot_word, contact, asset, joint, sensed };

/// The description of one kind of traced element: an array of the state, or data in the work space.
struct TracePart {
  uint32_t number;  ///< stored in files: never reused. For an array of the state, the index of its section
  const char* name;
  const Field* fields;
  uint32_t field_count;
  uint32_t element_bytes;
  TraceKind kind;
  uint32_t key_words;  ///< number of 4-byte words at the start of an element that identify it
  bool sorted;         ///< the array is sorted by the key words, so the index of an element has no meaning
};
inline constexpr uint32_t k_trace_part_count = 15;
extern const TracePart k_trace_parts[k_trace_part_count];
/// The part with this number, or null.
const TracePart* find_trace_part(uint32_t number);

/// The data of a contact in the work space of a step.
struct TraceContact {
  ContactState state;
  Real separation[k_manifold_points_max];  ///< 0 for indices from point_count on; the same holds for `approach`
  Real approach[k_manifold_points_max];
  Vec3<Unit> normal;
  Vec3<Unit> middle_a, middle_b;
  Unit normal_mass[k_manifold_points_max];
  Unit response[21];
};
/// The data of a moving body in the work space of a step.
struct TraceBody {
  Vec3<Real> displacement, rotation_vector, angular_velocity;
  Real extent, fall, speed;
  Quat rotation;
  Matrix3 axes;
  Vec3<Unit> inverse_inertia[3];
  int64_t inverse_inertia_exponent;
};
struct TraceSweep {
  Fraction from;
  Vec3<Real> displacement, rotation_vector;
};

/// Receives the canonical (little-endian) bytes of an element. `place`: the index of the element in its array; for a
/// body, its slot index.
struct TraceVisitor {
  void (*take)(void* context, const TracePart& part, uint32_t place, const uint8_t* bytes);
  void* context;
};
/// Passes all elements that are not zero to `visitor`. `contacts`: number of contacts in the work space of the step.
void visit_trace(const World& world, TraceStage stage, uint32_t contacts, const TraceVisitor& visitor);

/// The digest of an element. The digest of a stage is the sum of the digests of all elements.
uint64_t trace_digest(const TracePart& part, uint32_t place, const uint8_t* bytes);

/// The size of the largest element, bytes.
inline constexpr uint32_t k_trace_bytes_max = sizeof(TraceContact) > k_element_bytes_max ? sizeof(TraceContact)
                                                                                         : k_element_bytes_max;
static_assert(sizeof(TraceBody) <= k_trace_bytes_max && sizeof(TraceSweep) <= k_trace_bytes_max);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
