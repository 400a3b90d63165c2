#pragma once
#include <detent/features.h>

#include "contact/manifold.h"

/// Contact functions for pairs of given shape types, in the pair's frame. Each function fills an empty manifold, or
/// leaves it empty if the shapes are farther apart than `frame.margin`. Lengths err by at most 2^-26 of the pair's unit
/// of length.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Cosine of 2^-2 rad. Directions at a smaller angle count as the same direction (contact_seam.h).
inline constexpr Unit k_alike_cosine = 1.0 - 0x1p-5;

/// Entry of the feature table: one of the functions below.
struct PairOps {
  void (*collide)(const PairFrame& frame, PairManifold& manifold);
};

/// Spheres and capsules with each other: closest points of their cores.
void collide_round(const PairFrame& frame, PairManifold& manifold);
/// A box (A) and a sphere or capsule (B): closest points of the box and the core, or the direction of least overlap if
/// the box and the core intersect.
void collide_box_round(const PairFrame& frame, PairManifold& manifold);
/// Two boxes: the separating axis test, then clipping of faces or closest points of edges.
/// Source: Gottschalk, Lin, Manocha, "OBBTree", 1996 (the fifteen axes); Sutherland, Hodgman 1974 (the clipping).
void collide_boxes(const PairFrame& frame, PairManifold& manifold);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
