/** A world that the program changes. */
import { type Codec, number, quat, takeList, vec3 } from './codec.js';
import * as fields from './fields.js';
import type { Module, Place } from './module.js';
import { RollbackSession, type TickMaker } from './rollback.js';
import type * as T from './types.js';
import { WorldView } from './view.js';

/** The numbers of the calls: those of their records in docs/recording.md. */
const calls = {
  createBody: 1,
  destroyBody: 2,
  setPose: 3,
  setVelocity: 4,
  applyForce: 5,
  applyTorque: 6,
  applyImpulse: 7,
  applyImpulseAt: 8,
  applyAngularImpulse: 9,
  setGravity: 10,
  setUserData: 11,
  bindAsset: 12,
  wakeBody: 15,
  sleepBody: 16,
  setType: 32,
  setShape: 33,
  setMass: 34,
  setDensity: 35,
  setMaterial: 36,
  setDamping: 37,
  setGravityScale: 38,
  setRotationLocks: 39,
  setSettings: 40,
  applyForceAt: 41,
  applyForceAtPoint: 42,
  applyImpulseAtPoint: 43,
  explode: 44,
  moveKinematic: 45,
  setSensor: 46,
  setFilter: 48,
  setInertia: 50,
  createJoint: 64,
  destroyJoint: 65,
  setJoint: 66,
} as const;
const queries = { ray: 1, cast: 2, overlap: 3, bounds: 4, closest: 5 } as const;

type Argument<In> = [codec: Codec<In, any>, value: In | undefined];
const bodyId = fields.id();
const three = vec3();
const four = quat();
const one = number();

export class World extends WorldView {
  /** @internal */
  static create(module: Module, def: T.WorldDef, assets: Uint8Array[]): World {
    const stored = assets.map((bytes) => module.store(bytes));
    const table = module.storeTable(stored);
    const values: number[] = [];
    fields.worldDef.put(values, def);
    try {
      module.call('world_create', module.put(values), table, stored.length);
    } catch (error) {
      for (const place of stored) module.free(place.address);
      throw error;
    } finally {
      module.free(table);
    }
    return new World(module, module.desk().next(), stored);
  }
  protected constructor(
    module: Module,
    session: number,
    private readonly stored: Place[],
  ) {
    super(module, session);
  }
  /** Frees the world's memory. No method may be called afterwards. */
  destroy(): void {
    this.release();
    this.module.ask('world_destroy', this.session);
    for (const place of this.stored) this.module.free(place.address);
  }

  private call(name: keyof typeof calls, ...list: Argument<any>[]): void {
    const values: number[] = [];
    for (const [codec, value] of list) codec.put(values, value);
    this.module.call('world_call', this.session, calls[name], this.module.put(values));
  }

  step(): T.StepReport {
    this.module.ask('world_step', this.session);
    return this.module.get(fields.stepReport);
  }

  createBody(def: T.BodyDef): T.BodyId {
    this.call('createBody', [fields.bodyDef, def]);
    return this.module.get(bodyId);
  }
  destroyBody(id: T.BodyId): void {
    this.call('destroyBody', [bodyId, id]);
  }
  setPose(id: T.BodyId, position: T.Vec3, rotation?: T.Quat): void {
    this.call('setPose', [bodyId, id], [three, position], [four, rotation]);
  }
  setVelocity(id: T.BodyId, velocity: T.Vec3, angularVelocity: T.Vec3 = [0, 0, 0]): void {
    this.call('setVelocity', [bodyId, id], [three, velocity], [three, angularVelocity]);
  }
  /** Sets the velocities with which a kinematic body reaches the pose in the next step. */
  moveKinematic(id: T.BodyId, position: T.Vec3, rotation?: T.Quat): void {
    this.call('moveKinematic', [bodyId, id], [three, position], [four, rotation]);
  }
  /** N, world frame, during the next step; at the centre of mass if no world point is given. */
  applyForce(id: T.BodyId, force: T.Vec3, point?: T.Vec3): void {
    if (point === undefined) this.call('applyForce', [bodyId, id], [three, force]);
    else this.call('applyForceAtPoint', [bodyId, id], [three, force], [three, point]);
  }
  /** As applyForce(), at `arm` from the centre of mass, world axes. */
  applyForceAt(id: T.BodyId, force: T.Vec3, arm: T.Vec3): void {
    this.call('applyForceAt', [bodyId, id], [three, force], [three, arm]);
  }
  applyTorque(id: T.BodyId, torque: T.Vec3): void {
    this.call('applyTorque', [bodyId, id], [three, torque]);
  }
  /** N s, world frame, at once; at the centre of mass if no world point is given. */
  applyImpulse(id: T.BodyId, impulse: T.Vec3, point?: T.Vec3): void {
    if (point === undefined) this.call('applyImpulse', [bodyId, id], [three, impulse]);
    else this.call('applyImpulseAtPoint', [bodyId, id], [three, impulse], [three, point]);
  }
  /** As applyImpulse(), at `arm` from the centre of mass, world axes. */
  applyImpulseAt(id: T.BodyId, impulse: T.Vec3, arm: T.Vec3): void {
    this.call('applyImpulseAt', [bodyId, id], [three, impulse], [three, arm]);
  }
  applyAngularImpulse(id: T.BodyId, impulse: T.Vec3): void {
    this.call('applyAngularImpulse', [bodyId, id], [three, impulse]);
  }
  explode(explosion: T.Explosion): void {
    this.call('explode', [fields.explosion, explosion]);
  }
  wakeBody(id: T.BodyId): void {
    this.call('wakeBody', [bodyId, id]);
  }
  sleepBody(id: T.BodyId): void {
    this.call('sleepBody', [bodyId, id]);
  }

  setType(id: T.BodyId, type: T.BodyType): void {
    this.call('setType', [bodyId, id], [fields.bodyType(), type]);
  }
  setShape(id: T.BodyId, shape: T.Shape): void {
    this.call('setShape', [bodyId, id], [fields.shape, shape]);
  }
  setMass(id: T.BodyId, mass: number): void {
    this.call('setMass', [bodyId, id], [one, mass]);
  }
  setInertia(id: T.BodyId, inertia: T.Vec3): void {
    this.call('setInertia', [bodyId, id], [three, inertia]);
  }
  setDensity(id: T.BodyId, density: number): void {
    this.call('setDensity', [bodyId, id], [one, density]);
  }
  setMaterial(id: T.BodyId, material: T.Material): void {
    this.call('setMaterial', [bodyId, id], [fields.material, material]);
  }
  setDamping(id: T.BodyId, linear: number, angular: number): void {
    this.call('setDamping', [bodyId, id], [one, linear], [one, angular]);
  }
  setGravityScale(id: T.BodyId, scale: number): void {
    this.call('setGravityScale', [bodyId, id], [one, scale]);
  }
  setRotationLocks(id: T.BodyId, locks: number): void {
    this.call('setRotationLocks', [bodyId, id], [one, locks]);
  }
  setUserData(id: T.BodyId, userData: number): void {
    this.call('setUserData', [bodyId, id], [one, userData]);
  }
  setFilter(id: T.BodyId, filter: T.Filter): void {
    this.call('setFilter', [bodyId, id], [fields.filter, filter]);
  }
  setSensor(id: T.BodyId, sensor: boolean): void {
    this.call('setSensor', [bodyId, id], [one, sensor ? 1 : 0]);
  }

  setGravity(gravity: T.Vec3): void {
    this.call('setGravity', [three, gravity]);
  }
  /** Changes the settings that are given, except the capacity; the others stay. */
  setSettings(changes: T.WorldDef): void {
    this.call('setSettings', [fields.worldDef, { ...this.settings(), ...changes }]);
  }
  /** Makes the asset with this index usable. */
  bindAsset(index: number): void {
    this.call('bindAsset', [one, index]);
  }

  createJoint(def: T.JointDef): T.JointId {
    this.call('createJoint', [fields.jointDef, def]);
    return this.module.get(bodyId);
  }
  destroyJoint(id: T.JointId): void {
    this.call('destroyJoint', [bodyId, id]);
  }
  setJoint(id: T.JointId, def: T.JointDef): void {
    this.call('setJoint', [bodyId, id], [fields.jointDef, def]);
  }
  /** `def` with the anchors and frames that place it at a point of the world, with this frame's axes. */
  placeJoint(def: T.JointDef, point: T.Vec3, frame: T.Quat = [0, 0, 0, 1]): T.Full<T.JointDef> {
    const values: number[] = [];
    three.put(values, point);
    four.put(values, frame);
    fields.jointDef.put(values, def);
    this.module.call('world_place_joint', this.session, this.module.put(values));
    return this.module.get(fields.jointDef);
  }

  private query(kind: keyof typeof queries, list: Argument<any>[], options: T.QueryOptions): T.QueryAnswer {
    const values: number[] = [];
    for (const [codec, value] of list) codec.put(values, value);
    fields.queryFilter.put(values, options.filter);
    values.push(options.all ? 1 : 0);
    const hitsMax = options.hitsMax ?? (options.all ? 256 : 1);
    this.module.call('world_query', this.session, queries[kind], this.module.put(values), hitsMax);
    const desk = this.module.desk();
    const [count, dropped, undecided] = [desk.next(), desk.next(), desk.next()];
    return { hits: takeList(desk, fields.queryHit, count), dropped, undecided };
  }
  /** The bodies that the segment from `origin` to `origin + displacement` hits. */
  castRay(origin: T.Vec3, displacement: T.Vec3, options: T.QueryOptions = {}): T.QueryAnswer {
    return this.query(
      'ray',
      [
        [three, origin],
        [three, displacement],
      ],
      options,
    );
  }
  /** The bodies that a shape hits on its way. */
  castShape(
    from: T.Placed,
    displacement: T.Vec3,
    options: T.QueryOptions & { rotationVector?: T.Vec3 } = {},
  ): T.QueryAnswer {
    return this.query('cast', [...placed(from), [three, displacement], [three, options.rotationVector]], options);
  }
  /** The bodies that a shape overlaps or touches. */
  overlap(at: T.Placed, options: T.QueryOptions = {}): T.QueryAnswer {
    return this.query('overlap', placed(at), options);
  }
  /** The bodies whose bounds overlap a box. */
  overlapBounds(lower: T.Vec3, upper: T.Vec3, options: T.QueryOptions = {}): T.QueryAnswer {
    return this.query(
      'bounds',
      [
        [three, lower],
        [three, upper],
      ],
      options,
    );
  }
  /** The nearest body within a distance, or all of them. */
  closest(at: T.Placed, distanceMax = 16, options: T.QueryOptions = {}): T.QueryAnswer {
    return this.query('closest', [...placed(at), [one, distanceMax]], options);
  }

  /** Restores a snapshot of any origin: every byte is checked before the world is changed. */
  load(snapshot: Uint8Array): void {
    const place = this.module.store(snapshot);
    try {
      this.module.call('world_load', this.session, place.address, place.count);
    } finally {
      this.module.free(place.address);
    }
  }

  /**
   * Begins a rollback session with the present state, which must have the same digest on every machine. The session ends
   * with its end(), which must be called before destroy(); until then the world cannot be recorded.
   */
  beginRollback(def: T.RollbackDef, make: TickMaker): RollbackSession {
    return RollbackSession.begin(this, this.module, this.session, def, make);
  }

  /** Records all later calls and steps, until endRecording(). */
  record(options: { digestInterval?: number; keyframeInterval?: number } = {}): void {
    this.module.call('world_record', this.session, options.digestInterval ?? 1, options.keyframeInterval ?? 0);
  }
  endRecording(): Uint8Array {
    this.module.call('world_end_recording', this.session);
    const desk = this.module.desk();
    const bytes = this.module.bytes(desk.next(), desk.next()).slice();
    this.module.ask('world_drop_recording', this.session);
    return bytes;
  }
}

const placed = (at: T.Placed): Argument<any>[] => [
  [fields.shape, at.shape],
  [three, at.position],
  [four, at.rotation],
];
