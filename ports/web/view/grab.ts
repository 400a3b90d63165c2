/** A body that the mouse holds: a spring between the point where it was taken and the mouse, as a force of the library. */
import { Matrix3, Quaternion, Vector3 } from 'three';
import type { BodyId, Vec3, World } from '../src/index.js';

/** Of the spring, Hz; it is critically damped. */
const frequency = 4;
/** The greatest acceleration of the point, m/s². */
const accelerationMax = 2000;

const vector = (v: Vec3) => new Vector3(...v);

export class Grab {
  /** Where the mouse is, m. */
  target: Vec3;
  /** From the centre of mass, in the body's axes. */
  private readonly arm: Vector3;

  constructor(
    private readonly world: World,
    readonly id: BodyId,
    point: Vec3,
  ) {
    const { position, rotation } = world.pose(id);
    this.arm = vector(point)
      .sub(vector(position))
      .applyQuaternion(new Quaternion(...rotation).invert());
    this.target = point;
  }

  /** Where the body is held; undefined if it does not exist any more. */
  point(): Vec3 | undefined {
    if (!this.world.has(this.id)) return undefined;
    const { position, rotation } = this.world.pose(this.id);
    return this.arm
      .clone()
      .applyQuaternion(new Quaternion(...rotation))
      .add(vector(position))
      .toArray();
  }

  /** Applies the force of the next tick. The spring is implicit: it is stable at any mass and any tick. */
  pull(tick: number): void {
    const { def, mass, inertia } = this.world.body(this.id);
    const turn = new Quaternion(...def.rotation);
    const arm = this.arm.clone().applyQuaternion(turn);
    const held = arm.clone().add(vector(def.position));
    const speed = vector(def.angularVelocity).cross(arm).add(vector(def.linearVelocity));
    const omega = 2 * Math.PI * frequency;
    const softness = 1 + 2 * omega * tick + omega * omega * tick * tick;
    const acceleration = vector(this.target)
      .sub(held)
      .multiplyScalar(omega * omega)
      .addScaledVector(speed, -(2 * omega + omega * omega * tick))
      .divideScalar(softness)
      .clampLength(0, accelerationMax);
    const force = acceleration.applyMatrix3(mobility(mass, inertia, turn, arm).invert());
    this.world.applyForce(this.id, force.toArray(), held.toArray());
  }
}

/** By how much a force at `arm` accelerates the point there. */
function mobility(mass: number, inertia: Vec3, turn: Quaternion, arm: Vector3): Matrix3 {
  const axes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
  const sum = new Matrix3().multiplyScalar(1 / mass);
  axes.forEach((axis, i) => {
    if (!(inertia[i]! > 0)) return; // a locked axis
    // The part of a rotation about one principal axis: the outer product of axis x arm, over the inertia.
    const along = axis.applyQuaternion(turn).cross(arm);
    const outer = new Matrix3().set(
      along.x * along.x, along.x * along.y, along.x * along.z,
      along.y * along.x, along.y * along.y, along.y * along.z,
      along.z * along.x, along.z * along.y, along.z * along.z,
    );
    outer.elements.forEach((value, k) => (sum.elements[k]! += value / inertia[i]!));
  });
  return sum;
}
