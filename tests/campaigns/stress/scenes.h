#pragma once
#include "tests/campaigns/stress/stage.h"

/// The scenes, by their numbers: unit boxes of half extent 0.5 m, a floor of 200 x 2 x 200 m with its top at y = 0,
/// friction 0.6. The same doubles on every machine.
namespace detent_stress {

/// S1: rows of boxes 1.1 m apart, `base` boxes in the lowest row.
Stage pyramid(uint32_t base);
/// S2: boxes on each other, displaced by up to 1 cm and rotated by up to 0.02 rad. 60 s.
Stage tower(uint32_t count, uint64_t seed);
/// S3: a box of `ratio` times the density on three others; a slab of `ratio` kg on four boxes of 1 kg. 20 s.
Stage mass_cube(double ratio);
Stage mass_slab(double ratio);
/// S4: boxes, spheres, capsules and icosahedra alternately, dropped into a pit in layers of `side` x `side` bodies; for
/// 8 the pit has 10 x 10 m. The first five bodies are the pit.
Stage pit(uint32_t bodies, uint64_t seed, uint32_t side = 8);

enum class Target : uint32_t { wall, plate };
enum class Projectile : uint32_t { ball, rod };
/// S5: body 0 is the target, a slab whose normal is its local z; body 1 is shot at it.
Stage paper_shot(Target target, Projectile projectile, double speed, uint64_t seed);

/// S6: links of 0.5 m along x, hung from a fixed ball at the origin, and a cube of `ratio` times a link's mass at the
/// end. 30 s.
Stage chain(uint32_t links, double ratio);
/// S7: one box thrown with an angular velocity about its middle axis.
Stage free_rotation();
/// S8: a row along x, the first domino tilted towards the second.
Stage dominoes(uint32_t count);
/// S9: a box of 1 m on a slope that descends towards +x, tan(slope) = friction x part. 1 s for settling and 60 s.
Stage incline(double friction, double part);
/// S10: stacks on a square grid of 3 m.
Stage sleep_stacks(uint32_t stacks, uint32_t height, bool sleeping);
/// S12: a sphere of radius 0.5 m whose centre starts `height` above the floor, for enough time for `bounces` bounces.
Stage bounce(double height, uint32_t bounces);
/// A sphere of radius 0.5 m on the floor that slides along +x at `speed` and rolls in the end.
Stage slide_and_roll(double speed, double friction);

}  // namespace detent_stress
