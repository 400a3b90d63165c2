#pragma once
#include "solver/solve.h"

/// The passes of the solver for groups of up to four or eight contacts at once, in vector registers (lanes.h). Each
/// lane executes the same operations as the solver of a single contact, so the results have the same bits
/// (tests/unit/solver/lanes_test.cpp). The contacts stay in lanes while their island is solved.
namespace detent {
inline namespace DETENT_NAMESPACE {

#if DETENT_QUADS
/// The largest number of contacts that are solved at once. DETENT_WIDE_LANES: in fixed point, with registers of 512
/// bits.
#if DETENT_WIDE_LANES || (defined(__x86_64__) && defined(DETENT_F32))
inline constexpr uint32_t k_lanes_max = 8;
#else
inline constexpr uint32_t k_lanes_max = 4;
#endif
/// Returns the largest number of contacts for which this machine has the instructions: 1, 4 or 8, at most k_lanes_max.
/// On a virtual machine this call can take longer than the step of a small world.
uint32_t lanes_of_machine();

// A group has up to 4 contacts and one LaneSpace, or up to 8 contacts and two adjacent LaneSpaces (lane_spaces()).
// `count` is the number of contacts. Range: 1 to k_lanes_max.

/// Puts the contacts of a group into lanes. Range: no dynamic body belongs to two of the contacts; all have equal
/// numbers of angular rows; their numbers of points do not decrease from contact to contact, and are all 1 or all above
/// 1; in each contact, the impulses of absent points are 0.
void put_in_lanes(const SolverBodies& bodies, Span<const ContactWork> contacts, Span<const ContactOrder> group,
                  LaneSpace* lanes);
/// Reads the rows of the contacts and the inverse inertias of their bodies again. The impulses in lanes stay unchanged.
void renew_lanes(const SolverBodies& bodies, Span<const ContactWork> contacts, LaneSpace* lanes, uint32_t count);
/// Writes the impulses of a group from its lanes back to its contacts.
void take_from_lanes(const LaneSpace* lanes, uint32_t count, Span<ContactWork> contacts);

/// The same passes as those of ContactSolver<One>, for a group.
void warm_start_lanes(const StepSettings& settings, const SolverBodies& bodies, LaneSpace* lanes, uint32_t count);
void solve_normals_lanes(const StepSettings& settings, const SolverBodies& bodies, LaneSpace* lanes, uint32_t count);
void relax_lanes(const StepSettings& settings, const SolverBodies& bodies, LaneSpace* lanes, uint32_t count);

/// The functions above, for groups of one size.
struct LanePasses {
  void (*put)(const SolverBodies& bodies, Span<const ContactWork> contacts, Span<const ContactOrder> group,
              LaneSpace* lanes);
  void (*renew)(const SolverBodies& bodies, Span<const ContactWork> contacts, LaneSpace* lanes);
  void (*take)(const LaneSpace* lanes, Span<ContactWork> contacts);
  void (*warm_start)(const StepSettings& settings, const SolverBodies& bodies, LaneSpace* lanes);
  void (*solve_normals)(const StepSettings& settings, const SolverBodies& bodies, LaneSpace* lanes);
  void (*relax)(const StepSettings& settings, const SolverBodies& bodies, LaneSpace* lanes);
};
#if DETENT_WIDE_LANES
extern const LanePasses k_wide_passes;  ///< for groups of 5 to 8 contacts in fixed point
#endif
#else
inline constexpr uint32_t k_lanes_max = 1;
constexpr uint32_t lanes_of_machine() { return 1; }
inline void put_in_lanes(const SolverBodies&, Span<const ContactWork>, Span<const ContactOrder>, LaneSpace*) {}
inline void renew_lanes(const SolverBodies&, Span<const ContactWork>, LaneSpace*, uint32_t) {}
inline void take_from_lanes(const LaneSpace*, uint32_t, Span<ContactWork>) {}
inline void warm_start_lanes(const StepSettings&, const SolverBodies&, LaneSpace*, uint32_t) {}
inline void solve_normals_lanes(const StepSettings&, const SolverBodies&, LaneSpace*, uint32_t) {}
inline void relax_lanes(const StepSettings&, const SolverBodies&, LaneSpace*, uint32_t) {}
#endif

/// The number of LaneSpaces of a group.
constexpr uint32_t lane_spaces(uint32_t count) { return count > 4 ? 2 : 1; }

inline bool uses_lanes(const StepSettings& settings) { return k_lanes_max > 1 && settings.lanes > 1; }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
