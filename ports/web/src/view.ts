/** All that a world says of itself, without a change. A world that is replayed has this, too. */
import { takeList } from './codec.js';
import * as fields from './fields.js';
import { type Module, spread } from './module.js';
import type * as T from './types.js';

export class WorldView {
  private poses = 0;
  private posesFloats = 0;

  /** @internal */
  constructor(
    protected readonly module: Module,
    protected readonly session: number,
  ) {}

  /** A hash of the state, the same on every machine. */
  digest(): bigint {
    return this.module.askBig('world_digest', this.session);
  }
  info(): T.WorldInfo {
    this.module.ask('world_info', this.session);
    return this.module.get(fields.worldInfo);
  }
  settings(): T.Full<T.WorldDef> {
    this.module.ask('world_settings', this.session);
    return this.module.get(fields.worldDef);
  }
  /** The report of the last step. */
  report(): T.StepReport {
    this.module.ask('world_report', this.session);
    return this.module.get(fields.stepReport);
  }

  /** All bodies, by slot. */
  bodies(): T.BodyRow[] {
    const count = this.module.ask('world_bodies', this.session);
    return takeList(this.module.desk(), fields.bodyRow, count);
  }
  body(id: T.BodyId): T.BodyState {
    this.module.call('world_body', this.session, id.slot, id.generation);
    return this.module.get(fields.bodyState);
  }
  /** Whether the id names a body of this world. */
  has(id: T.BodyId): boolean {
    return this.module.ask('world_body', this.session, id.slot, id.generation) === 0;
  }
  pose(id: T.BodyId): T.Pose {
    const { position, rotation } = this.body(id).def;
    return { position, rotation };
  }

  /**
   * Writes the poses of all bodies, by slot, relative to a camera: x, y, z and the rotation's x, y, z, w, every
   * `stride` floats. The difference of the positions is exact before it is rounded to a float. Returns the number of
   * bodies written, as many as `to` has room for.
   */
  writePoses(to: Float32Array, camera: T.Vec3 = [0, 0, 0], stride = 7): number {
    if (stride < 7) throw new RangeError('the stride of a pose is at least 7 floats');
    const room = Math.floor((to.length + stride - 7) / stride);
    if (this.posesFloats < room * stride) {
      if (this.poses !== 0) this.module.free(this.poses);
      this.posesFloats = room * stride;
      this.poses = this.module.allocate(4 * this.posesFloats);
    }
    const count = this.module.ask('world_poses', this.session, this.poses, stride, room, ...spread(camera));
    const from = this.module.floats(this.poses, count * stride);
    if (stride === 7) to.set(from);
    else for (let i = 0; i < count; ++i) to.set(from.subarray(i * stride, i * stride + 7), i * stride);
    return count;
  }

  /** All contacts, or those of one body. */
  contacts(of: T.BodyId = { slot: 0, generation: 0 }): T.Contact[] {
    const count = this.module.ask('world_contacts', this.session, of.slot, of.generation);
    const desk = this.module.desk();
    const list: T.Contact[] = [];
    for (let i = 0; i < count; ++i) {
      const head = fields.contactHead.take(desk);
      list.push({ ...head, points: takeList(desk, fields.contactPoint) });
    }
    return list;
  }
  joints(): T.JointId[] {
    const count = this.module.ask('world_joints', this.session);
    return takeList(this.module.desk(), fields.id(), count);
  }
  /** The joint's definition, and its force and torque in the last step. */
  joint(id: T.JointId): T.JointState {
    this.module.call('world_joint', this.session, id.slot, id.generation);
    return this.module.get(fields.jointState);
  }
  /** The anchors of all joints, for drawing. */
  jointLines(): T.JointLine[] {
    const count = this.module.ask('world_joint_lines', this.session);
    return takeList(this.module.desk(), fields.jointLine, count);
  }
  /** The bodies within a sensor. */
  sensed(sensor: T.BodyId): T.BodyId[] {
    this.module.call('world_sensed', this.session, sensor.slot, sensor.generation);
    return takeList(this.module.desk(), fields.id());
  }
  /** The events of the last step. */
  events(): T.Events {
    this.module.ask('world_events', this.session);
    const desk = this.module.desk();
    return {
      contacts: takeList(desk, fields.contactEvent),
      joints: takeList(desk, fields.jointEvent),
      sensors: takeList(desk, fields.sensorEvent),
      bodies: takeList(desk, fields.bodyEvent),
      capacity: takeList(desk, fields.capacityEvent),
    };
  }

  /** The parts of a hull, compound or terrain, in the body's frame; no part for other shapes. */
  outline(id: T.BodyId): T.OutlinePart[] {
    let left = this.module.ask('world_outline', this.session, id.slot, id.generation);
    const desk = this.module.desk();
    const parts: T.OutlinePart[] = [];
    while (left > 0) {
      const kind = desk.next() === 1 ? 'convex' : 'triangles';
      const radius = desk.next();
      const count = 3 * desk.next();
      parts.push({ kind, radius, points: desk.numbers(count) });
      left -= 3 + count;
    }
    return parts;
  }
  /** The edges of the bodies' bounds: x, y, z of both ends of each. */
  boundsEdges(): Float64Array {
    const edges = this.module.ask('world_bounds', this.session);
    return this.module.desk().numbers(6 * edges);
  }

  /** The state as bytes; World.load() takes it back. */
  save(): Uint8Array {
    const count = this.module.ask('world_snapshot_bytes', this.session);
    const address = this.module.allocate(count);
    try {
      this.module.call('world_save', this.session, address, count);
      return this.module.bytes(address, count).slice();
    } finally {
      this.module.free(address);
    }
  }

  /** @internal */
  protected release(): void {
    if (this.poses !== 0) this.module.free(this.poses);
    this.poses = this.posesFloats = 0;
  }
}
