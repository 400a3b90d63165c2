/** The fields of each definition, in the order of native/fields.h, with the defaults of the library's headers. */
import { choice, flag, number, quat, record, vec3 } from './codec.js';
import type * as T from './types.js';

export const id = () => record<T.BodyId, T.BodyId>({ slot: number(), generation: number() });

export const bodyType = () => choice<T.BodyType>({ fixed: 1, kinematic: 2, dynamic: 3 }, 'dynamic');
const shapeTypes: Record<T.ShapeType, number> = {
  sphere: 1,
  capsule: 2,
  box: 3,
  half_space: 4,
  cylinder: 5,
  cone: 6,
  hull: 7,
  terrain: 9,
  compound: 10,
};
const jointTypes: Record<T.JointType, number> = {
  ball: 1,
  hinge: 2,
  slider: 3,
  distance: 4,
  fixed: 5,
  cone_twist: 6,
  wheel: 7,
  parallel: 8,
  filter: 9,
};
export const jointType = () => choice<T.JointType>(jointTypes, 'ball');

export const shape = record<T.Shape, T.Full<T.Shape>>({
  type: choice<T.ShapeType>(shapeTypes, 'sphere'),
  radius: number(0.5),
  halfLength: number(),
  halfExtents: vec3(0.5, 0.5, 0.5),
  rounding: number(),
  asset: number(),
});
export const material = record<T.Material, T.Full<T.Material>>({
  friction: number(0.6),
  restitution: number(),
  rollingResistance: number(),
  restitutionRule: choice({ larger: 0, smaller: 1 }, 'larger'),
});
export const filter = record<T.Filter, T.Full<T.Filter>>({
  category: number(1),
  mask: number(0xffffffff),
  group: number(),
});
export const bodyDef = record<T.BodyDef, T.Full<T.BodyDef>>({
  type: bodyType(),
  position: vec3(),
  rotation: quat(),
  linearVelocity: vec3(),
  angularVelocity: vec3(),
  shape,
  material,
  density: number(1000),
  mass: number(),
  linearDamping: number(),
  angularDamping: number(),
  gravityScale: number(1),
  userData: number(),
  rotationLocks: number(),
  filter,
  sensor: flag(),
});
export const capacity = record<T.Capacity, T.Full<T.Capacity>>({
  bodies: number(),
  contacts: number(),
  assets: number(),
  manifolds: flag(true),
  joints: number(),
  sensed: number(),
});
export const worldDef = record<T.WorldDef, T.Full<T.WorldDef>>({
  capacity,
  gravity: vec3(0, -9.81, 0),
  tick: number(1 / 60),
  substeps: number(),
  substepsMax: number(32),
  restingPenetration: number(1 / 144),
  iterations: number(1),
  convergence: number(12),
  stabilisation: choice({ soft: 1, post: 2 }, 'soft'),
  relaxation: number(1),
  contactFrequency: number(0.14),
  dampingRatio: number(10),
  restitutionThreshold: number(0.25),
  continuous: flag(true),
  sleeping: flag(true),
  contactMargin: number(1 / 64),
  contactRecycleDistance: number(1 / 256),
  reduction: choice({ projected_extremes: 1, deepest_area: 2 }, 'projected_extremes'),
});
const jointAxis = record<T.JointAxis, T.Full<T.JointAxis>>({
  limited: flag(),
  lower: number(),
  upper: number(),
  frequency: number(),
  dampingRatio: number(1),
  target: number(),
  speed: number(),
  forceMax: number(),
});
export const jointDef = record<T.JointDef, T.Full<T.JointDef>>({
  type: jointType(),
  a: id(),
  b: id(),
  anchorA: vec3(),
  anchorB: vec3(),
  frameA: quat(),
  frameB: quat(),
  axis: jointAxis,
  second: jointAxis,
  frictionForce: number(),
  frictionTorque: number(),
  collide: flag(),
  breakForce: number(),
  breakTorque: number(),
  userData: number(),
});
export const explosion = record<T.Explosion, T.Full<T.Explosion>>({
  centre: vec3(),
  radius: number(10),
  impulse: number(100),
});
export const rollbackDef = record<T.RollbackDef & { gameBytes: number }, unknown>({
  players: number(2),
  local: number(1),
  inputBytes: number(1),
  delay: number(),
  window: number(8),
  checksumInterval: number(1),
  gameBytes: number(),
} as never);

export const bodyState = record<never, T.BodyState>({
  def: bodyDef,
  mass: number(),
  inertia: vec3(),
  awake: flag(),
});
export const bodyRow = record<never, T.BodyRow>({
  id: id(),
  type: bodyType(),
  awake: flag(),
  sensor: flag(),
  island: number(),
  speed: number(),
  angularSpeed: number(),
  look: number(),
});
export const worldInfo = record<never, T.WorldInfo>({
  capacity,
  tick: number(),
  bodies: number(),
  contacts: number(),
  joints: number(),
  sensed: number(),
  slotsRetired: number(),
});
export const jointState = record<never, T.JointState>({ def: jointDef, force: vec3(), torque: vec3() });
export const jointLine = record<never, T.JointLine>({
  id: id(),
  type: jointType(),
  a: id(),
  b: id(),
  anchorA: vec3(),
  anchorB: vec3(),
  axis: vec3(),
});
export const contactHead = record<never, Omit<T.Contact, 'points'>>({
  a: id(),
  b: id(),
  normal: vec3(),
  part: number(),
  touching: flag(),
  age: number(),
  frictionImpulse: vec3(),
  normalImpulse: number(),
  normalForce: number(),
});
export const contactPoint = record<never, T.ContactPoint>({
  position: vec3(),
  separation: number(),
  feature: number(),
  childA: number(),
  childB: number(),
  normalImpulse: number(),
});

const counts = <Name extends string>(...names: Name[]) =>
  record<never, Record<Name, number>>(Object.fromEntries(names.map((name) => [name, number()])) as never);
export const stepReport = record<never, T.StepReport>({
  ...Object.fromEntries(
    ['tick', 'bodies', 'awake', 'islands', 'substepsMax', 'woke', 'fellAsleep', 'saturations'].map((name) => [
      name,
      number(),
    ]),
  ),
  contacts: counts('pairs', 'count', 'points', 'recycled', 'capped', 'sweepsSaved', 'colourOverflows', 'substeps'),
  joints: counts('count', 'broken', 'undecided'),
  ccd: counts('impacts', 'undecided', 'overlapsLeft', 'bodiesStopped', 'tests', 'skipped', 'keptApart', 'lostTime'),
  lost: counts('pairs', 'contacts', 'contactParts', 'jointCouplings', 'impacts', 'sensed', 'sensedUndecided'),
  events: counts(
    'contact',
    'joint',
    'sensor',
    'body',
    'capacity',
    'contactDropped',
    'jointDropped',
    'sensorDropped',
    'bodyDropped',
  ),
} as never);

const pair = <A extends string, B extends string>(a: A, b: B) =>
  ({ [a]: id(), [b]: id() }) as Record<A | B, ReturnType<typeof id>>;
export const contactEvent = record<never, T.Events['contacts'][0]>({
  type: choice({ begin: 1, touch: 2, end: 3, hit: 4 }, 'begin'),
  ...pair('a', 'b'),
  normal: vec3(),
  point: vec3(),
  approachSpeed: number(),
});
export const jointEvent = record<never, T.Events['joints'][0]>({
  joint: id(),
  ...pair('a', 'b'),
  userData: number(),
  force: vec3(),
  torque: vec3(),
});
export const sensorEvent = record<never, T.Events['sensors'][0]>({
  type: choice({ enter: 1, leave: 2 }, 'enter'),
  ...pair('sensor', 'body'),
});
export const bodyEvent = record<never, T.Events['bodies'][0]>({
  type: choice({ fell_asleep: 1, woke: 2 }, 'woke'),
  body: id(),
});
export const capacityEvent = record<never, T.Events['capacity'][0]>({
  type: choice({ pair: 1, contact: 2, sensed: 3 }, 'contact'),
  ...pair('a', 'b'),
});

export const queryFilter = record<NonNullable<T.QueryOptions['filter']>, unknown>({
  category: number(1),
  mask: number(0xffffffff),
  ignore: id(),
} as never);
export const queryHit = record<never, T.QueryHit>({
  body: id(),
  undecided: flag(),
  fraction: number(),
  distance: number(),
  point: vec3(),
  normal: vec3(),
  triangle: number(),
  material: number(),
});

export const recordingInfo = record<never, T.RecordingInfo>({
  formatVersion: number(),
  simulationVersion: number(),
  config: choice<T.Config>({ fx64: 1, fx32: 2, f32: 3, f64: 4 }, 'fx64'),
  capacity,
  traceLevel: choice({ digests: 0, stages: 1, full: 2 }, 'digests'),
  digestInterval: number(),
  tick: number(),
  snapshotBytes: number(),
  keyframeInterval: number(),
});
export const tickResult = record<never, T.TickResult>({
  finished: flag(),
  compared: flag(),
  tick: number(),
  calls: number(),
  report: stepReport,
});

export const rollbackReport = record<never, T.RollbackReport>({
  tick: number(),
  ticksAgain: number(),
  wentBack: number(),
});
export const tickChecksum = record<never, T.TickChecksum>({ tick: number(), checksum: number() });
export const desync = record<never, T.Desync>({ tick: number(), player: number(), own: number(), theirs: number() });
