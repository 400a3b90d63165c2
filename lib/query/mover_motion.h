#pragma once
#include <detent/mover.h>

#include "query/mover_planes.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Planes of bodies around a mover that it looks at, and turns of a motion, each of which may meet one more plane.
inline constexpr uint32_t k_mover_near_max = 16, k_mover_turns_max = 8;
inline constexpr uint32_t k_mover_planes_max = k_mover_near_max + k_mover_turns_max;

/// A mover on its way: where it is, and what it knows of what is around it. Its questions are those of query.h.
class MoverMotion {
 public:
  /// `settings`: checked, its rotation normalised.
  MoverMotion(const World& world, const MoverSettings& settings, const Position& start, MoverReport& report);

  const Position& position() const { return position_; }
  const Vec3<Unit>& up() const { return up_; }
  /// Of the first query that failed.
  Status status() const { return status_; }

  /// From now on this body is not there; null: all are.
  void pass(BodyId body) {
    passed_ = body;
    known_ = false;
  }
  /// Moves along `way` as far as what it meets allows. Returns what is left of it.
  Vec3<Real> slide(Vec3<Real> way, MoverGait gait);
  /// Moves along `way` until the gap to what it meets.
  void go(const Vec3<Real>& way);
  /// Moves out of what it is too near to; the report tells what is left.
  void recover();
  /// The floor that it stands on, or null. It may stand on an edge that is no floor by its normal.
  const MoverPlane* find_floor();
  /// Moves up against what stopped it, forward along `rest`, and down to a floor; or stays, and returns false.
  bool climb(const Vec3<Real>& rest);
  /// Moves down to the floor below it; or stays, and returns null.
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
  void add_surface(const QueryHit& hit);
  bool passes(const QueryHit& hit, const Vec3<Real>& way) const;
  void step_along(const Vec3<Real>& way);
  void find_footing(MoverPlane& plane);
  void note(uint32_t met);
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
  uint32_t met_count_ = 0;    ///< the first of the planes: met on the motion
  uint32_t plane_count_ = 0;  ///< and those that are near
  bool known_ = false;        ///< the planes that are near are those of the position
  Real free_radius_;          ///< of the part of it that is free
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
