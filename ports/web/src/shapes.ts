/** Shapes, as the functions of shape.h make them. */
import type { Shape, Vec3 } from './types.js';

export const sphere = (radius: number): Shape => ({ type: 'sphere', radius });
/** All points within `radius` of the segment from (0, -halfLength, 0) to (0, halfLength, 0). */
export const capsule = (radius: number, halfLength: number): Shape => ({ type: 'capsule', radius, halfLength });
export const box = (halfExtents: Vec3): Shape => ({ type: 'box', halfExtents });
export const cylinder = (radius: number, halfLength: number): Shape => ({ type: 'cylinder', radius, halfLength });
/** Its base is at y = -halfLength / 2, its apex at y = 3 halfLength / 2. */
export const cone = (radius: number, halfLength: number): Shape => ({ type: 'cone', radius, halfLength });
/** The solid half-space y <= 0. */
export const halfSpace = (): Shape => ({ type: 'half_space' });
export const hull = (asset: number): Shape => ({ type: 'hull', asset });
export const terrain = (asset: number): Shape => ({ type: 'terrain', asset });
export const compound = (asset: number): Shape => ({ type: 'compound', asset });
/** `shape`, grown by a ball of this radius. */
export const rounded = (shape: Shape, rounding: number): Shape => ({ ...shape, rounding });
