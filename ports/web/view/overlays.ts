/** What is drawn over the bodies: contacts, joints, bounds. */
import {
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  Color,
  DynamicDrawUsage,
  Group,
  LineBasicMaterial,
  LineSegments,
  Points,
  PointsMaterial,
} from 'three';
import type { Contact, Vec3, WorldView } from '../src/index.js';
import { palette } from './colours.js';

/** Coloured line segments and points that are made anew for each tick. */
class Strokes {
  readonly group = new Group();
  private readonly ends: number[] = [];
  private readonly endColours: number[] = [];
  private readonly dots: number[] = [];
  private readonly dotColours: number[] = [];
  private readonly lines: LineSegments;
  private readonly points: Points;

  constructor(pixels: number, onTop: boolean) {
    const settings = { vertexColors: true, depthTest: !onTop, transparent: true };
    this.lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial(settings));
    this.points = new Points(
      new BufferGeometry(),
      new PointsMaterial({ ...settings, size: pixels, sizeAttenuation: false, map: disc(), alphaTest: 0.5 }),
    );
    for (const object of [this.lines, this.points]) {
      object.frustumCulled = false;
      object.renderOrder = 1;
      this.group.add(object);
    }
  }
  clear(): void {
    for (const list of [this.ends, this.endColours, this.dots, this.dotColours]) list.length = 0;
  }
  line(from: Vec3, to: Vec3, colour: Color): void {
    this.ends.push(...from, ...to);
    this.endColours.push(...colour.toArray(), ...colour.toArray());
  }
  point(at: Vec3, colour: Color): void {
    this.dots.push(...at);
    this.dotColours.push(...colour.toArray());
  }
  show(): void {
    set(this.lines.geometry, this.ends, this.endColours);
    set(this.points.geometry, this.dots, this.dotColours);
  }
}

/** Points are squares without a map. */
function disc(): CanvasTexture {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 32;
  const to = canvas.getContext('2d')!;
  to.fillStyle = '#fff';
  to.arc(16, 16, 15, 0, 2 * Math.PI);
  to.fill();
  return new CanvasTexture(canvas);
}

/** Buffers are kept while they have room: a new one for each tick would be a new one on the graphics card. */
function set(geometry: BufferGeometry, positions: number[], colours: number[]): void {
  const known = geometry.getAttribute('position') as BufferAttribute | undefined;
  if (known === undefined || known.array.length < positions.length) {
    geometry.dispose();
    for (const name of ['position', 'color']) {
      const attribute = new BufferAttribute(new Float32Array(2 * positions.length + 96), 3);
      geometry.setAttribute(name, attribute.setUsage(DynamicDrawUsage));
    }
  }
  for (const [name, values] of [
    ['position', positions],
    ['color', colours],
  ] as const) {
    const attribute = geometry.getAttribute(name) as BufferAttribute;
    (attribute.array as Float32Array).set(values);
    attribute.needsUpdate = true;
  }
  geometry.setDrawRange(0, positions.length / 3);
}

const minus = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const along = (a: Vec3, d: Vec3, length: number): Vec3 => [
  a[0] + d[0] * length,
  a[1] + d[1] * length,
  a[2] + d[2] * length,
];

export class Overlays {
  readonly group = new Group();
  /** The largest impulse at a contact point, N s, which the longest line stands for. */
  impulseMax = 0;
  private readonly contacts = new Strokes(8, true);
  private readonly joints = new Strokes(9, true);
  private readonly bounds = new Strokes(1, false);
  private readonly pull = new Strokes(9, true);
  private readonly pullColour = new Color(palette.selected);
  private readonly active = new Color(palette.contact);
  private readonly idle = new Color(palette.idleContact);
  private readonly jointColour = new Color(palette.joint);
  private readonly boundsColour = new Color(palette.bounds);

  /** `length`: of the longest line along a normal, m. */
  constructor(private readonly length: number) {
    this.group.add(this.contacts.group, this.joints.group, this.bounds.group, this.pull.group);
  }

  update(
    world: WorldView,
    origin: Vec3,
    shown: { contacts: boolean; joints: boolean; bounds: boolean },
    pull?: [Vec3, Vec3],
  ): void {
    for (const strokes of [this.contacts, this.joints, this.bounds, this.pull]) strokes.clear();
    if (pull !== undefined) this.drawPull(minus(pull[0], origin), minus(pull[1], origin));
    if (shown.contacts) this.drawContacts(world.contacts(), origin);
    if (shown.joints) this.drawJoints(world, origin);
    if (shown.bounds) this.drawBounds(world.boundsEdges(), origin);
    for (const strokes of [this.contacts, this.joints, this.bounds, this.pull]) strokes.show();
  }
  private drawPull(from: Vec3, to: Vec3): void {
    this.pull.line(from, to, this.pullColour);
    this.pull.point(from, this.pullColour);
    this.pull.point(to, this.pullColour);
  }

  private drawContacts(contacts: Contact[], origin: Vec3): void {
    this.impulseMax = 0;
    for (const contact of contacts) {
      for (const point of contact.points) this.impulseMax = Math.max(this.impulseMax, point.normalImpulse);
    }
    for (const { normal, points, touching } of contacts) {
      for (const point of points) {
        const at = minus(point.position, origin);
        const share = this.impulseMax > 0 ? point.normalImpulse / this.impulseMax : 0;
        const colour = touching && share > 0 ? this.active : this.idle;
        this.contacts.point(at, colour);
        this.contacts.line(at, along(at, normal, this.length * (0.12 + 0.88 * share)), colour);
      }
    }
  }

  /** From the centre of A over both anchors to the centre of B: a gap between the anchors shows. */
  private drawJoints(world: WorldView, origin: Vec3): void {
    for (const joint of world.jointLines()) {
      const a = minus(joint.anchorA, origin);
      const b = minus(joint.anchorB, origin);
      const centres = [joint.a, joint.b].map((id) => ({ id, at: minus(world.pose(id).position, origin) }));
      this.joints.line(centres[0]!.at, a, this.jointColour);
      this.joints.line(a, b, this.active);
      this.joints.line(b, centres[1]!.at, this.jointColour);
      this.joints.point(a, this.jointColour);
      this.joints.point(b, this.jointColour);
      const half = this.length / 4;
      if (!['ball', 'distance', 'fixed', 'filter'].includes(joint.type)) {
        this.joints.line(along(a, joint.axis, -half), along(a, joint.axis, half), this.active);
      }
    }
  }

  private drawBounds(edges: Float64Array, origin: Vec3): void {
    for (let i = 0; i < edges.length; i += 6) {
      const end = (k: number): Vec3 => [edges[i + k]!, edges[i + k + 1]!, edges[i + k + 2]!];
      this.bounds.line(minus(end(0), origin), minus(end(3), origin), this.boundsColour);
    }
  }
}
