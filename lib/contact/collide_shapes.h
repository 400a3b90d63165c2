#pragma once
#include <detent/features.h>

#include "contact/manifold.h"

/// Contact of two shapes of given kinds, in the pair's frame. Each fills an empty manifold, or leaves it empty if the
/// shapes are farther apart than `frame.reach`. Lengths err by at most 2^-26 of the pair's unit of length.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Of directions that enclose 2^-2 rad: those of nearer ones count as one (contact_seam.h).
inline constexpr Unit k_alike_cosine = 1.0 - 0x1p-5;

/// One of the functions below, for a feature table.
struct PairOps {
  void (*collide)(const PairFrame& frame, PairManifold& manifold);
};

/// Spheres and capsules with each other: closest points of their cores.
void collide_round(const PairFrame& frame, PairManifold& manifold);
/// A box (A) and a sphere or capsule (B): closest points of the box and the core, the least overlap if they meet.
void collide_box_round(const PairFrame& frame, PairManifold& manifold);
/// Two boxes: the separating axis test, then clipping of faces or closest points of edges.
/// Source: Gottschalk, Lin, Manocha, "OBBTree", 1996 (the fifteen axes); Sutherland, Hodgman 1974 (the clipping).
void collide_boxes(const PairFrame& frame, PairManifold& manifold);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
