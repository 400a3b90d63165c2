#include "ccd/moving_shapes.h"

#include "distance/pair.h"
#include "toi/conservative_advancement.h"
#include "toi/known_axis.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

bool MovingShapes::turn() {
  if (!turned_) {
    if (turning_of(motion_a_, turning_a_) != Status::ok || turning_of(motion_b_, turning_b_) != Status::ok)
      return false;
    turned_ = true;
  }
  pair_.turning_a = rotation_of(*pair_.a, turning_a_);
  pair_.turning_b = rotation_of(*pair_.b, turning_b_);
  return true;
}

bool MovingShapes::find(const Convex& a, const Convex& b, const Vec3<Unit>& axis, Fraction until,
                        TimeOfImpact& impact) {
  pair_.a = &a;
  pair_.b = &b;
  const bool planar = a.type == ShapeType::half_space || b.type == ShapeType::half_space;
  if (planar && !turn()) return false;
  const Status placed = placed_ ? set_block(pair_.offset_whole, pair_.displacement_whole, pair_)
                                : set_displacements(motion_a_, motion_b_, pair_);
  if (placed != Status::ok) return false;
  placed_ = true;
  pair_.last = until.raw;
  if (pair_.from > pair_.to) {
    impact = {};
    set_clear(impact);
    return true;
  }
  if (!planar && !turn()) return false;
  pair_.absolute = moves_both(k_toi_method, pair_);
  Vec32 normal;
  const bool known = raw_from_direction(axis, normal);
  if (known && stays_clear(pair_, normal))
    set_clear(impact);
  else
    conservative_advancement(pair_, k_toi_method, impact, known ? INT32_MAX : enough_apart(pair_));
  return true;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
