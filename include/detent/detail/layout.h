#pragma once
#include <detent/detail/scratch.h>
#include <detent/detail/shared.h>
#include <detent/world.h>

/// The layout of a world's block: one list of arrays, persistent arrays first. world_bytes(), the snapshot, the digest
/// and the step use this list.
namespace detent {
inline namespace DETENT_NAMESPACE {

constexpr uint32_t k_capacity_max = 1u << 20;
/// Capacity of pairs with overlapping bounds, divided by the capacity of contacts. It is above 1, because bounds may
/// overlap without a contact.
constexpr uint32_t k_pairs_per_contact = 2;

/// Byte offsets of the arrays in a block.
struct Layout {
  uint32_t header, world, poses, motions, properties, activities, slots, contacts, assets, manifolds, joints, sensed;
  uint32_t persistent_bytes;  ///< size of a snapshot: it consists of the arrays above
  uint32_t cache, tree_nodes, tree_parents, active, candidates, moving_bodies, awake_contacts;
  uint32_t bounds, bounds_keys, bounds_sort, pairs, pair_sort, contact_work, islands, island_bodies, sweeps;
  uint32_t body_work, contact_order, contact_sort, lane_contacts, impact_pairs, impact_hits, impact_paths;
  uint32_t manifold_work, joint_work, joint_lanes, joint_bodies, joint_order, joint_couplings, joint_numbers;
  uint32_t disabled_pairs;
  uint32_t sensed_work, sensed_passed, changed;
  uint32_t bytes;
};

/// Capacity of stored manifolds: one for each contact, or 0 if Capacity::manifolds is false.
constexpr uint32_t manifold_count(Capacity capacity) { return capacity.manifolds ? capacity.contacts : 0; }

/// Largest number of bodies with joints in a step.
constexpr uint32_t joint_body_count(Capacity capacity) {
  return 2 * capacity.joints < capacity.bodies ? 2 * capacity.joints : capacity.bodies;
}

/// Capacity of couplings, the off-diagonal blocks in the factor of the joints' matrix: 16 for each joint, or, if that
/// is less, one for each pair of joints, which is the largest possible number. A chain of hinges needs 1 for each
/// joint; a net of 10 x 10 ball joints needs 9.
constexpr uint32_t joint_coupling_count(Capacity capacity) {
  constexpr uint32_t k_each = 16;
  const uint32_t joints = capacity.joints;
  return joints > 2 * k_each ? joints * k_each : joints * (joints > 0 ? joints - 1 : 0) / 2;
}
/// Capacity of numbers (matrix elements) in the blocks of all couplings: 256 for each joint, or 36 for each coupling if
/// that is less. A chain of hinges needs 25 to 36 numbers for each joint, a net of 10 x 10 ball joints 81.
constexpr uint32_t joint_number_count(Capacity capacity) {
  constexpr uint32_t k_each = 256, k_block = 36;
  const uint32_t all = joint_coupling_count(capacity) * k_block, most = capacity.joints * k_each;
  return all < most ? all : most;
}

/// The number of Reals that joint_number_count() numbers take in memory. With vector code, each row of a block is
/// padded to 4 or 8 numbers: 256 numbers for a joint, in the blocks of at most 16 couplings, then take at most 544
/// Reals. The factor 9/4 provides 576.
template <bool has_lanes>
constexpr uint32_t joint_number_room(Capacity capacity) {
  const uint32_t count = joint_number_count(capacity);
  return has_lanes && k_may_have_joint_lanes ? count / 4 * 9 : count;
}

/// The largest number of groups of four that `contacts` contacts can form; 0 in builds without vector code. The solver
/// processes the contacts of a group at once.
constexpr uint32_t lane_contact_count(uint32_t contacts) { return k_may_have_lanes ? contacts / 4 : 0; }

constexpr uint32_t slot_words(uint32_t bodies) { return (bodies + 63) / 64 * 2; }

constexpr bool in_range(Capacity capacity) {
  return capacity.bodies >= 1 && capacity.bodies <= k_capacity_max && capacity.contacts <= k_capacity_max &&
         capacity.assets <= k_capacity_max && capacity.joints <= k_capacity_max && capacity.sensed <= k_capacity_max;
}

/// Returns the layout for a capacity in range. Sets `fits` to false if the block would need 2^32 bytes or more, else to
/// true. With `has_lanes` false (no vector code), the layout is the same on every target.
template <bool has_lanes = k_may_have_lanes>
DETENT_SHARED constexpr Layout layout_of(Capacity capacity, bool& fits) {
  uint64_t end = 0;
  const auto place = [&end](uint32_t element_bytes, uint32_t count) {
    const uint64_t start = end;
    end = (end + uint64_t{element_bytes} * count + 7) / 8 * 8;
    return static_cast<uint32_t>(start);
  };
  Layout layout{};
  layout.header = place(sizeof(BlockHeader), 1);
  layout.world = place(sizeof(WorldState), 1);
  layout.poses = place(sizeof(BodyPose), capacity.bodies);
  layout.motions = place(sizeof(BodyMotion), capacity.bodies);
  layout.properties = place(sizeof(BodyProperties), capacity.bodies);
  layout.activities = place(sizeof(BodyActivity), capacity.bodies);
  layout.slots = place(sizeof(uint32_t), slot_words(capacity.bodies));
  layout.contacts = place(sizeof(ContactState), capacity.contacts);
  layout.assets = place(sizeof(AssetState), capacity.assets);
  layout.manifolds = place(sizeof(ManifoldState), manifold_count(capacity));
  layout.joints = place(sizeof(JointState), capacity.joints);
  layout.sensed = place(sizeof(SensedState), capacity.sensed);
  layout.persistent_bytes = static_cast<uint32_t>(end);
  layout.cache = place(sizeof(StepCache), 1);
  layout.tree_nodes = place(sizeof(TreeNode), capacity.bodies);
  layout.tree_parents = place(sizeof(uint32_t), capacity.bodies);
  layout.active = place(sizeof(uint32_t), slot_words(capacity.bodies));
  layout.candidates = place(sizeof(uint32_t), slot_words(capacity.bodies));
  layout.moving_bodies = place(sizeof(uint32_t), capacity.bodies);
  layout.awake_contacts = place(sizeof(uint32_t), capacity.contacts);
  layout.bounds = place(sizeof(Bounds), capacity.bodies);
  layout.pairs = place(sizeof(uint64_t), capacity.contacts * k_pairs_per_contact);
  // After the pairs are found, the contacts use the same memory as the work space of the pair search.
  const uint64_t shared = end;
  layout.bounds_keys = place(sizeof(BoundsKey), capacity.bodies);
  layout.bounds_sort = place(sizeof(BoundsKey), capacity.bodies);
  layout.pair_sort = place(sizeof(uint64_t), capacity.contacts * k_pairs_per_contact);
  const uint64_t pairs_end = end;
  end = shared;
  layout.contact_work = place(sizeof(ContactWork), capacity.contacts);
  end = end > pairs_end ? end : pairs_end;
  layout.islands = place(sizeof(Island), capacity.bodies);
  layout.island_bodies = place(sizeof(uint32_t), capacity.bodies);
  layout.sweeps = place(sizeof(BodySweep), capacity.bodies);
  // Once the sweeps are known, the work space of the substeps is no longer used, and the arrays of the impacts use its
  // memory. The rest of this memory, from the end of these arrays to manifold_work, is their spare memory
  // (step_scratch.h).
  const uint64_t moved = end;
  layout.body_work = place(sizeof(BodyWork), capacity.bodies);
  layout.contact_order = place(sizeof(ContactOrder), capacity.contacts);
  layout.contact_sort = place(sizeof(ContactOrder), capacity.contacts);
  layout.lane_contacts = has_lanes ? place(sizeof(LaneSpace), capacity.contacts / 4) : 0;
  const uint64_t substeps_end = end;
  end = moved;
  layout.impact_pairs = place(sizeof(ImpactPair), capacity.contacts);
  layout.impact_hits = place(sizeof(ImpactHit), capacity.contacts);
  layout.impact_paths = place(sizeof(ImpactPath), capacity.bodies);
  end = end > substeps_end ? end : substeps_end;
  layout.manifold_work = place(sizeof(ManifoldState), manifold_count(capacity));
  layout.joint_work = place(sizeof(JointWork), capacity.joints);
  layout.joint_lanes = has_lanes && k_may_have_joint_lanes ? place(sizeof(JointLanes), capacity.joints) : 0;
  layout.joint_bodies = place(sizeof(JointBody), joint_body_count(capacity));
  layout.joint_order = place(sizeof(uint32_t), capacity.joints);
  layout.joint_couplings = place(sizeof(JointCoupling), joint_coupling_count(capacity));
  layout.joint_numbers = place(sizeof(Real), joint_number_room<has_lanes>(capacity));
  layout.disabled_pairs = place(sizeof(uint64_t), capacity.joints);
  layout.sensed_work = place(sizeof(uint64_t), capacity.sensed);
  layout.sensed_passed = place(sizeof(uint64_t), capacity.sensed);
  layout.changed = place(sizeof(uint32_t), capacity.sensed == 0 ? 0 : slot_words(capacity.bodies));
  layout.bytes = static_cast<uint32_t>(end);
  fits = end <= 0xffffffffu;
  return layout;
}

constexpr uint32_t world_bytes(Capacity capacity) {
  bool fits = false;
  const uint32_t bytes = in_range(capacity) ? layout_of(capacity, fits).bytes : 0;
  return fits ? bytes : 0;
}

constexpr uint32_t snapshot_bytes(Capacity capacity) {
  bool fits = false;
  const uint32_t bytes = in_range(capacity) ? layout_of(capacity, fits).persistent_bytes : 0;
  return fits ? bytes : 0;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
