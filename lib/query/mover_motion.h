#pragma once
#include <detent/mover.h>

#include "query/mover_planes.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Limits of a motion: the number of planes of nearby bodies, and the number of rounds. In each round the mover may hit
/// an obstacle, whose plane is added, and change its direction.
inline constexpr uint32_t k_mover_near_max = 16, k_mover_rounds_max = 8;
inline constexpr uint32_t k_mover_planes_max = k_mover_near_max + k_mover_rounds_max;

/// A mover during a motion: its position and the planes of the bodies around it, found by the queries of query.h.
class MoverMotion {
 public:
  /// Range: `settings` are in range, and their rotation is normalised.
  MoverMotion(const World& world, const MoverSettings& settings, const Position& start, MoverReport& report);

  const Position& position() const { return position_; }
  const Vec3<Unit>& up() const { return up_; }
  /// ok, or the status of the last query that failed.
  Status status() const { return status_; }

  /// From now on the mover passes through this body. If `body` is null, it passes through no body.
  void pass(BodyId body) {
    passed_ = body;
    known_ = false;
  }
  /// Moves by `displacement`, sliding along obstacles. Returns the part of the displacement that is left.
  Vec3<Real> slide(Vec3<Real> displacement, MoverGait gait);
  /// Moves along `displacement`, without sliding, until only the gap (MoverSettings::gap) is left to the first
  /// obstacle.
  void go(const Vec3<Real>& displacement);
  /// Moves away from bodies that are nearer than the gap. Stores the remaining overlap in the report.
  void recover();
  /// The plane of the floor that the mover stands on, or null. The plane may belong to the edge of a floor. It may then
  /// be steeper than a floor.
  const MoverPlane* find_floor();
  /// Steps over an obstacle: moves up, forward along `rest`, and down to a floor. If that fails, restores the position
  /// and returns false.
  bool climb(const Vec3<Real>& rest);
  /// Moves down to the floor below. If there is none, restores the position and returns null.
  const MoverPlane* descend();

 private:
  struct Place {
    Position position;
    uint32_t contact_count, contacts_dropped;
  };
  Place place() const { return {position_, report_.contact_count, report_.contacts_dropped}; }
  void go_back(const Place& place);
  bool caught() const;
  MoverPlane plane_at(const QueryHit& hit, Real room) const;
  void look_around();
  void add_plane(const MoverPlane& plane);
  void add_near(const QueryHit& hit, const Shape& core);
  void add_terrain(const QueryHit& hit);
  bool passes(const QueryHit& hit, const Vec3<Real>& displacement) const;
  void step_along(const Vec3<Real>& displacement);
  void find_footing(MoverPlane& plane);
  void note(uint32_t touched);
  template <class Query>
  QueryReport ask(Status (*call)(const World&, const Query&, QueryHits, QueryReport&), const Query& query,
                  QueryHits hits);

  const World& world_;
  const MoverSettings& settings_;
  MoverReport& report_;
  Vec3<Unit> up_;
  Position position_;
  BodyId passed_ = {};
  Status status_ = Status::ok;
  MoverPlane planes_[k_mover_planes_max];
  uint32_t hit_count_ = 0;  ///< number of planes hit during the motion; they come first in `planes_`
  /// Number of all planes in `planes_`. The planes of nearby bodies come after those hit during the motion.
  uint32_t plane_count_ = 0;
  bool known_ = false;  ///< the planes of nearby bodies are valid for the position
  /// Radius, m, of the thickest capsule that keeps half the gap to all bodies; at most the mover's radius.
  Real free_radius_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
