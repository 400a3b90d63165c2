/** The data that the package takes and gives. Units: m, s, kg, N, rad. The headers of the library document each field. */

export type Vec3 = [x: number, y: number, z: number];
/** A rotation, local to world: v_world = q v_local q*. */
export type Quat = [x: number, y: number, z: number, w: number];

/** Names a body. Valid until the body is destroyed. */
export interface BodyId {
  slot: number;
  generation: number;
}
/** Names a joint. */
export interface JointId {
  slot: number;
  generation: number;
}

export type Config = 'fx64' | 'fx32' | 'f32' | 'f64';
export type BodyType = 'fixed' | 'kinematic' | 'dynamic';
export type ShapeType =
  'sphere' | 'capsule' | 'box' | 'half_space' | 'cylinder' | 'cone' | 'hull' | 'terrain' | 'compound';
export type JointType =
  'ball' | 'hinge' | 'slider' | 'distance' | 'fixed' | 'cone_twist' | 'wheel' | 'parallel' | 'filter';

/** A shape in its body's frame. Make one with sphere(), box() and so on. */
export interface Shape {
  type: ShapeType;
  /** Of a sphere, capsule, cylinder, and of a cone's base. */
  radius?: number;
  /** Half the length along y of a capsule's core segment, a cylinder or a cone. */
  halfLength?: number;
  halfExtents?: Vec3;
  /** Radius of the ball that rounds a box, cylinder, cone or hull. */
  rounding?: number;
  /** Of a hull, terrain or compound: index of its asset. */
  asset?: number;
}
export interface Material {
  friction?: number;
  restitution?: number;
  rollingResistance?: number;
  restitutionRule?: 'larger' | 'smaller';
}
export interface Filter {
  category?: number;
  mask?: number;
  group?: number;
}
/** The definition of a body. Every field has a default. */
export interface BodyDef {
  type?: BodyType;
  position?: Vec3;
  rotation?: Quat;
  linearVelocity?: Vec3;
  angularVelocity?: Vec3;
  shape?: Shape;
  material?: Material;
  density?: number;
  /** 0: computed from the density. */
  mass?: number;
  linearDamping?: number;
  angularDamping?: number;
  gravityScale?: number;
  userData?: number;
  /** Bits 1, 2, 4: no rotation about the body's x, y, z axis. */
  rotationLocks?: number;
  filter?: Filter;
  sensor?: boolean;
}
export interface Capacity {
  bodies?: number;
  contacts?: number;
  assets?: number;
  manifolds?: boolean;
  joints?: number;
  sensed?: number;
}
/** The settings of a world. Only the capacity must be given. */
export interface WorldDef {
  capacity?: Capacity;
  gravity?: Vec3;
  tick?: number;
  substeps?: number;
  substepsMax?: number;
  restingPenetration?: number;
  iterations?: number;
  convergence?: number;
  stabilisation?: 'soft' | 'post';
  relaxation?: number;
  contactFrequency?: number;
  dampingRatio?: number;
  restitutionThreshold?: number;
  continuous?: boolean;
  sleeping?: boolean;
  contactMargin?: number;
  contactRecycleDistance?: number;
  reduction?: 'projected_extremes' | 'deepest_area';
}
/** The limits, spring and motor of one free motion of a joint. */
export interface JointAxis {
  limited?: boolean;
  lower?: number;
  upper?: number;
  frequency?: number;
  dampingRatio?: number;
  target?: number;
  speed?: number;
  forceMax?: number;
}
export interface JointDef {
  type?: JointType;
  a?: BodyId;
  b?: BodyId;
  anchorA?: Vec3;
  anchorB?: Vec3;
  frameA?: Quat;
  frameB?: Quat;
  axis?: JointAxis;
  second?: JointAxis;
  frictionForce?: number;
  frictionTorque?: number;
  collide?: boolean;
  breakForce?: number;
  breakTorque?: number;
  userData?: number;
}
export interface Explosion {
  centre?: Vec3;
  radius?: number;
  impulse?: number;
}

/** `T` with every field present, as the getters give it. */
export type Full<T> = T extends Vec3 | Quat | string | number | boolean
  ? T
  : { [K in keyof T]-?: Full<NonNullable<T[K]>> };

export interface Pose {
  position: Vec3;
  rotation: Quat;
}
/** A body's definition with its present pose and velocity, and what follows from it. */
export interface BodyState {
  def: Full<BodyDef>;
  mass: number;
  inertia: Vec3;
  awake: boolean;
}
/** What a viewer colours a body by. */
export interface BodyRow {
  id: BodyId;
  type: BodyType;
  awake: boolean;
  sensor: boolean;
  /** The lowest slot of the body's island. */
  island: number;
  speed: number;
  angularSpeed: number;
  /** Changes only if the body's shape changes. */
  look: number;
}
export interface WorldInfo {
  capacity: Full<Capacity>;
  tick: number;
  bodies: number;
  contacts: number;
  joints: number;
  sensed: number;
  slotsRetired: number;
}

export interface ContactPoint {
  position: Vec3;
  separation: number;
  feature: number;
  childA: number;
  childB: number;
  normalImpulse: number;
}
export interface Contact {
  a: BodyId;
  b: BodyId;
  /** From A to B. */
  normal: Vec3;
  part: number;
  touching: boolean;
  age: number;
  frictionImpulse: Vec3;
  normalImpulse: number;
  normalForce: number;
  points: ContactPoint[];
}
export interface JointState {
  def: Full<JointDef>;
  force: Vec3;
  torque: Vec3;
}
export interface JointLine {
  id: JointId;
  type: JointType;
  a: BodyId;
  b: BodyId;
  anchorA: Vec3;
  anchorB: Vec3;
  /** The x axis of A's joint frame. */
  axis: Vec3;
}
/** A part of a cooked shape: a convex core (the hull of its points, rounded by a ball), or triangles. */
export interface OutlinePart {
  kind: 'convex' | 'triangles';
  radius: number;
  /** x, y, z of each point, in the body's frame. */
  points: Float64Array;
}

/** The counts of one step, as StepReport (world.h) has them. */
export interface StepReport {
  tick: number;
  bodies: number;
  awake: number;
  islands: number;
  substepsMax: number;
  woke: number;
  fellAsleep: number;
  saturations: number;
  contacts: {
    pairs: number;
    count: number;
    points: number;
    recycled: number;
    capped: number;
    sweepsSaved: number;
    colourOverflows: number;
    substeps: number;
  };
  joints: { count: number; broken: number; undecided: number };
  ccd: {
    impacts: number;
    undecided: number;
    overlapsLeft: number;
    bodiesStopped: number;
    tests: number;
    skipped: number;
    keptApart: number;
    lostTime: number;
  };
  lost: {
    pairs: number;
    contacts: number;
    contactParts: number;
    jointCouplings: number;
    impacts: number;
    sensed: number;
    sensedUndecided: number;
  };
  events: {
    contact: number;
    joint: number;
    sensor: number;
    body: number;
    capacity: number;
    contactDropped: number;
    jointDropped: number;
    sensorDropped: number;
    bodyDropped: number;
  };
}

export interface Events {
  contacts: {
    type: 'begin' | 'touch' | 'end' | 'hit';
    a: BodyId;
    b: BodyId;
    normal: Vec3;
    point: Vec3;
    approachSpeed: number;
  }[];
  joints: { joint: JointId; a: BodyId; b: BodyId; userData: number; force: Vec3; torque: Vec3 }[];
  sensors: { type: 'enter' | 'leave'; sensor: BodyId; body: BodyId }[];
  bodies: { type: 'fell_asleep' | 'woke'; body: BodyId }[];
  capacity: { type: 'pair' | 'contact' | 'sensed'; a: BodyId; b: BodyId }[];
}

export interface QueryOptions {
  filter?: { category?: number; mask?: number; ignore?: BodyId };
  /** False: only the first or nearest hit. */
  all?: boolean;
  /** Room for hits; those beyond it are counted as dropped. */
  hitsMax?: number;
}
/** A shape at rest at a place. */
export interface Placed {
  shape: Shape;
  position?: Vec3;
  rotation?: Quat;
}
export interface QueryHit {
  body: BodyId;
  undecided: boolean;
  fraction: number;
  distance: number;
  point: Vec3;
  normal: Vec3;
  triangle: number;
  material: number;
}
export interface QueryAnswer {
  hits: QueryHit[];
  dropped: number;
  undecided: number;
}

/** The header of a recording. */
export interface RecordingInfo {
  formatVersion: number;
  simulationVersion: number;
  config: Config;
  capacity: Full<Capacity>;
  traceLevel: 'digests' | 'stages' | 'full';
  digestInterval: number;
  /** Ticks that the world had completed when the recording began. */
  tick: number;
  snapshotBytes: number;
  keyframeInterval: number;
}
/** One tick of a replay. */
export interface TickResult {
  /** The recording has ended: no tick was made. */
  finished: boolean;
  /** The recording has a digest of this tick, and the replayed state has the same. */
  compared: boolean;
  tick: number;
  calls: number;
  report: StepReport;
}
/** Where and why a replay stopped. */
export interface ReplayProblem {
  status: Status;
  /** One line. */
  text: string;
  /** The first tick that may be wrong. */
  tick: number;
  /** Bytes from the recording's start. */
  offset: number;
  field: string;
  digestRecorded: bigint;
  digestReplayed: bigint;
}

/** The settings of a rollback session. All but `local` and `delay` must be the same on every machine. */
export interface RollbackDef {
  /** 1 to 16; 2 if it is left out. */
  players?: number;
  /** Bit p: player p plays on this machine; 0: the machine only watches. Player 0 if it is left out. */
  local?: number;
  /** Bytes of a player's input for a tick, 1 to 1024; 1 if it is left out. */
  inputBytes?: number;
  /** Ticks from a local input to the tick that uses it, at most the window; 0 if it is left out. */
  delay?: number;
  /** Ticks that may be made with predicted inputs, 1 to 64; 8 if it is left out. */
  window?: number;
  /** A checksum is taken before every tick that is a multiple of it; 0: none; 1 if it is left out. */
  checksumInterval?: number;
  /** The game's own state at the start: the session copies it, restores it with the world, and has it in its checksums. */
  game?: Uint8Array;
}
/** The inputs of a tick. */
export interface TickInputs {
  /** Ticks that the world has completed. */
  tick: number;
  /** The input of each player. */
  inputs: Uint8Array[];
  /** Bit p: the input of player p is a prediction, because it has not arrived. */
  predicted: number;
  /** The tick was made before: the game must not repeat sounds and other effects. */
  again: boolean;
  /** The game's own state, to read and to change; it is valid until the next call that allocates memory. */
  game: Uint8Array;
}
/** Ticks that one call has made or repeated. */
export interface RollbackReport {
  /** Ticks that the world has completed. */
  tick: number;
  ticksAgain: number;
  /** The first repeated tick, if there is one. */
  wentBack: number;
}
/** A checksum of 32 bits of the state after `tick` ticks. */
export interface TickChecksum {
  tick: number;
  checksum: number;
}
/** The first compared tick after which another player's state differs from this machine's. */
export interface Desync {
  /** Ticks completed. */
  tick: number;
  player: number;
  own: number;
  theirs: number;
}

/** Names of Status (status.h). */
export const statuses = [
  'ok',
  'bad_id',
  'bad_argument',
  'out_of_range',
  'not_normalised',
  'pool_full',
  'buffer_too_small',
  'buffer_misaligned',
  'asset_missing',
  'asset_mismatch',
  'not_detent',
  'format_unknown',
  'simulation_differs',
  'config_differs',
  'capacity_differs',
  'corrupt',
  'truncated',
  'digest_differs',
  'sink_failed',
  'feature_missing',
  'rule_missing',
  'waiting',
] as const;
export type Status = (typeof statuses)[number];
