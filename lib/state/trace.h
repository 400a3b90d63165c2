#pragma once
#include "state/fields.h"

/// What of a world is compared at the end of each stage of a step, so that the first difference of two machines is
/// found where it arises: the persistent state as it is then, and what in the work space will decide it.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Stored: a value is never reused. Between the first and the last the stages of StepStage; an idle step has none.
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

/// What the elements of a part are.
enum class TraceKind : uint32_t { world, body, slot_word, contact, asset, joint, sensed };

/// A kind of element that is compared.
struct TracePart {
  uint32_t number;  ///< stored: a value is never reused. Those of the state are the indices of its sections
  const char* name;
  const Field* fields;
  uint32_t field_count;
  uint32_t element_bytes;
  TraceKind kind;
  uint32_t key_words;  ///< leading words of four bytes that name the element
  bool sorted;         ///< by them: an element's place in the array means nothing
};
inline constexpr uint32_t k_trace_part_count = 15;
extern const TracePart k_trace_parts[k_trace_part_count];
/// The part of this number, or null.
const TracePart* find_trace_part(uint32_t number);

/// A contact while a step works on it.
struct TraceContact {
  ContactState state;
  Real separation[k_manifold_points_max];  ///< 0 beyond the points, like `approach`
  Real approach[k_manifold_points_max];
  Vec3<Unit> normal;
  Vec3<Unit> middle_a, middle_b;
  Unit inverse_mass[k_manifold_points_max];
  Unit friction_mass[2];
  Unit response[21];
};
/// A body that moves, likewise.
struct TraceBody {
  Vec3<Real> displacement, turn, spin;
  Real extent, fall, speed;
  Quat rotation;
  Matrix3 axes;
  Vec3<Unit> gyration[3];
  int64_t gyration_exponent;
};
struct TraceSweep {
  Fraction from;
  Vec3<Real> displacement, turn;
};

/// Takes an element's canonical bytes. `place`: in its array, of bodies the slot index.
struct TraceVisitor {
  void (*take)(void* context, const TracePart& part, uint32_t place, const uint8_t* bytes);
  void* context;
};
/// Visits all elements that are not all zero. `contacts`: of the step, in its work space.
void visit_trace(const World& world, TraceStage stage, uint32_t contacts, const TraceVisitor& visitor);

/// The digest of an element; a stage's is their sum.
uint64_t trace_digest(const TracePart& part, uint32_t place, const uint8_t* bytes);

/// Of the largest element.
inline constexpr uint32_t k_trace_bytes_max = sizeof(TraceContact) > k_element_bytes_max ? sizeof(TraceContact)
                                                                                         : k_element_bytes_max;
static_assert(sizeof(TraceBody) <= k_trace_bytes_max && sizeof(TraceSweep) <= k_trace_bytes_max);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
