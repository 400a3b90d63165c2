/** The panel of the selected body: its state, its definition, what it touches. */
import type { BodyId, BodyRow, Contact, Full, JointLine, Shape, WorldView } from '../src/index.js';
import { digits, place, vector } from './numbers.js';

const same = (a: BodyId, b: BodyId) => a.slot === b.slot && a.generation === b.generation;
export const nameOf = (id: BodyId): string => `body ${id.slot}${id.generation > 1 ? `.${id.generation}` : ''}`;

function sizes(shape: Full<Shape>): string {
  const rounding = shape.rounding > 0 ? `, rounding ${digits(shape.rounding)}` : '';
  switch (shape.type) {
    case 'sphere':
      return `radius ${digits(shape.radius)} m`;
    case 'capsule':
    case 'cylinder':
    case 'cone':
      return `radius ${digits(shape.radius)}, half length ${digits(shape.halfLength)}${rounding} m`;
    case 'box':
      return `half extents ${vector(shape.halfExtents)}${rounding} m`;
    case 'half_space':
      return 'y ≤ 0';
    default:
      return `asset ${shape.asset}${rounding}`;
  }
}

/** Rows of a table: a name and a text, or a body that can be chosen. */
type Row = [name: string, text: string, body?: BodyId];

function stateRows(world: WorldView, row: BodyRow): Row[] {
  const { def, mass, inertia, awake } = world.body(row.id);
  const moves = def.type === 'dynamic';
  return [
    ['position', `${place(def.position)} m`],
    ['rotation', vector(def.rotation)],
    ['velocity', `${vector(def.linearVelocity)} m/s`],
    ['speed', `${digits(row.speed)} m/s`],
    ['angular velocity', `${vector(def.angularVelocity)} rad/s`],
    ...(moves ? [['state', awake ? `awake, island ${row.island}` : `asleep, island ${row.island}`] as Row] : []),
    ...(moves ? [['mass', `${digits(mass)} kg`] as Row, ['inertia', `${vector(inertia)} kg m²`] as Row] : []),
  ];
}
function definitionRows(world: WorldView, id: BodyId): Row[] {
  const { def } = world.body(id);
  const { material, filter } = def;
  const hex = (bits: number) => `0x${bits.toString(16)}`;
  const rows: Row[] = [
    ['type', def.type + (def.sensor ? ', sensor' : '')],
    ['shape', def.shape.type.replace('_', '-')],
    ['size', sizes(def.shape)],
    ['friction', digits(material.friction)],
    ['restitution', digits(material.restitution) + (material.restitutionRule === 'smaller' ? ', smaller' : '')],
  ];
  if (material.rollingResistance !== 0) rows.push(['rolling resistance', digits(material.rollingResistance)]);
  if (def.linearDamping !== 0 || def.angularDamping !== 0) {
    rows.push(['damping', `${digits(def.linearDamping)}, angular ${digits(def.angularDamping)} 1/s`]);
  }
  if (def.gravityScale !== 1) rows.push(['gravity scale', digits(def.gravityScale)]);
  if (def.rotationLocks !== 0) {
    rows.push(['rotation locks', ['x', 'y', 'z'].filter((_, i) => (def.rotationLocks >> i) & 1).join(', ')]);
  }
  if (filter.category !== 1 || filter.mask !== 0xffffffff || filter.group !== 0) {
    rows.push(['filter', `category ${hex(filter.category)}, mask ${hex(filter.mask)}, group ${filter.group}`]);
  }
  if (def.userData !== 0) rows.push(['user data', `${def.userData}`]);
  return rows;
}
function contactRows(contacts: Contact[], id: BodyId): Row[] {
  return contacts.map((contact) => {
    const other = same(contact.a, id) ? contact.b : contact.a;
    const gap = Math.min(...contact.points.map((point) => point.separation));
    const points = `${contact.points.length} ${contact.points.length === 1 ? 'point' : 'points'}`;
    const push = contact.touching
      ? `${digits(contact.normalImpulse)} N s, ${digits(contact.normalForce)} N`
      : 'no push';
    return [nameOf(other), contact.points.length === 0 ? 'apart' : `${points}, ${push}, gap ${digits(gap)} m`, other];
  });
}
function jointRows(world: WorldView, joints: JointLine[], id: BodyId): Row[] {
  return joints.map((joint) => {
    const { force } = world.joint(joint.id);
    const other = same(joint.a, id) ? joint.b : joint.a;
    return [nameOf(other), `${joint.type.replace('_', '-')}, ${digits(Math.hypot(...force))} N`, other];
  });
}

export class Inspector {
  constructor(
    private readonly panel: HTMLElement,
    private readonly choose: (id: BodyId | undefined) => void,
  ) {}

  update(world: WorldView, rows: BodyRow[], id: BodyId | undefined): void {
    this.panel.hidden = id === undefined;
    if (id === undefined) return;
    const row = rows.find((each) => same(each.id, id));
    if (row === undefined) {
      this.fill(nameOf(id), [['', [['', 'does not exist at this tick']]]]);
      return;
    }
    const joints = world.jointLines().filter((joint) => same(joint.a, id) || same(joint.b, id));
    const contacts = contactRows(world.contacts(id), id);
    this.fill(nameOf(id), [
      ['State', stateRows(world, row)],
      ['Touches', contacts.length > 0 ? contacts : [['', 'nothing']]],
      ...(joints.length > 0 ? [['Joints', jointRows(world, joints, id)] as [string, Row[]]] : []),
      ['Definition', definitionRows(world, id)],
    ]);
  }

  /** Text only, never markup: names come from a file. */
  private fill(title: string, sections: [title: string, rows: Row[]][]): void {
    const heading = document.createElement('h2');
    heading.textContent = title;
    const close = document.createElement('button');
    close.textContent = '×';
    close.title = 'close (Esc)';
    close.onclick = () => this.choose(undefined);
    heading.append(close);
    this.panel.replaceChildren(heading, ...sections.flatMap(([name, rows]) => this.section(name, rows)));
  }
  private section(name: string, rows: Row[]): HTMLElement[] {
    const title = document.createElement('h3');
    title.textContent = name;
    const table = document.createElement('table');
    for (const [key, text, body] of rows) {
      const line = table.insertRow();
      const cell = line.insertCell();
      cell.textContent = key;
      if (body !== undefined) {
        cell.className = 'link';
        cell.onclick = () => this.choose(body);
      }
      line.insertCell().textContent = text;
    }
    return [title, table];
  }
}
