#pragma once
#include <detent/features.h>

#include "contact/manifold.h"

/// Contact functions for pairs of given shape types, in the pair's frame (PairFrame). Each function gets an empty
/// manifold and fills it. The manifold stays without points if the shapes are farther apart than `frame.margin`, or if
/// the contact of two boxes is removed because it lies at a seam (contact_seam.h). Lengths err by at most 2^-26 of the
/// pair's unit of length.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Cosine of 2^-2 rad. In contact_seam.h, two directions at a smaller angle count as the same direction.
inline constexpr Unit k_alike_cosine = 1.0 - 0x1p-5;

/// Entry of FeatureTable (detent/features.h): points to one of the functions below.
struct PairOps {
  void (*collide)(const PairFrame& frame, PairManifold& manifold);
};

/// Two shapes, each a sphere or a capsule: finds the closest points of their cores (a sphere's centre, a capsule's
/// segment).
void collide_round(const PairFrame& frame, PairManifold& manifold);
/// A box (A) and a sphere or capsule (B): finds the closest points of the box and of B's core (its centre or segment).
/// If the core intersects the box, finds the direction of least overlap.
void collide_box_round(const PairFrame& frame, PairManifold& manifold);
/// Two boxes: makes the separating axis test, then clips faces or finds the closest points of two edges.
/// Source: Gottschalk, Lin, Manocha, "OBBTree", 1996 (the fifteen axes); Sutherland, Hodgman 1974 (the clipping).
void collide_boxes(const PairFrame& frame, PairManifold& manifold);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
