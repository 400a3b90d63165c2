/** The bodies of the scene: one instanced mesh for all bodies that look alike. */
import {
  type BufferGeometry,
  CanvasTexture,
  Color,
  DoubleSide,
  DynamicDrawUsage,
  Group,
  InstancedMesh,
  Matrix4,
  type Material,
  MeshStandardMaterial,
  Quaternion,
  type Raycaster,
  RepeatWrapping,
  SRGBColorSpace,
  Vector3,
} from 'three';
import type { BodyId, BodyRow, Full, Shape, Vec3, WorldView } from '../src/index.js';
import { colourOf, type ColourBy, palette } from './colours.js';
import { geometryOf } from './geometry.js';
import { Rim } from './rim.js';

const floor = new Color('#98a0ab');
const ghost = new Color(palette.ghost);

interface Batch {
  mesh: InstancedMesh;
  shape: Full<Shape>;
  fixed: boolean;
  rows: BodyRow[];
}

export class Bodies {
  readonly group = new Group();
  rows: BodyRow[] = [];
  /** Fixed bodies are transparent, except the ground. */
  glass = false;
  private readonly bySlot = new Map<number, BodyRow>();
  private readonly batches = new Map<string, Batch>();
  private readonly matrices = new Map<number, Matrix4>();
  private readonly chosen = new Rim(palette.selected);
  private readonly marked: Rim[] = [];
  private poses = new Float32Array(0);

  /** `solid`: these bodies are ghosts of its bodies, and are drawn where they differ from them. */
  constructor(
    private readonly planeSize: number,
    private readonly gridStep: number,
    private readonly solid?: Bodies,
  ) {
    this.group.add(this.chosen.group);
  }

  /** Draws the bodies of a world as they are now. */
  update(world: WorldView, origin: Vec3, by: ColourBy, speedMax: number): void {
    this.rows = world.bodies();
    this.bySlot.clear();
    for (const row of this.rows) this.bySlot.set(row.id.slot, row);
    if (this.poses.length < 7 * this.rows.length) this.poses = new Float32Array(14 * this.rows.length);
    world.writePoses(this.poses, origin);
    for (const batch of this.batches.values()) batch.rows.length = 0;
    this.matrices.clear();
    const position = new Vector3();
    const rotation = new Quaternion();
    const one = new Vector3(1, 1, 1);
    this.rows.forEach((row, i) => {
      position.fromArray(this.poses, 7 * i);
      rotation.fromArray(this.poses, 7 * i + 3);
      const matrix = new Matrix4().compose(position, rotation, one);
      this.matrices.set(row.id.slot, matrix);
      if (this.solid === undefined || !this.solid.shows(row, matrix)) this.batchOf(row, world).rows.push(row);
    });
    for (const [key, batch] of this.batches) this.fill(key, batch, by, speedMax);
  }
  /** How many are drawn. */
  get drawn(): number {
    return [...this.batches.values()].reduce((sum, batch) => sum + batch.mesh.count, 0);
  }
  /** Draws nothing. */
  clear(): void {
    this.rows = [];
    this.bySlot.clear();
    this.matrices.clear();
    for (const batch of this.batches.values()) batch.mesh.count = batch.rows.length = 0;
  }
  /** Whether the same body is drawn at the same place. */
  private shows(row: BodyRow, at: Matrix4): boolean {
    const own = this.matrices.get(row.id.slot);
    return own !== undefined && own.equals(at) && this.bySlot.get(row.id.slot)?.look === row.look;
  }

  private batchOf(row: BodyRow, world: WorldView): Batch {
    const fixed = row.type === 'fixed' && !row.sensor;
    const key = `${row.look}${row.sensor ? 'sensor' : fixed ? 'fixed' : ''}`;
    let batch = this.batches.get(key);
    if (batch === undefined) {
      const { shape } = world.body(row.id).def;
      const geometry = geometryOf(shape, world.outline(row.id), this.planeSize);
      batch = { mesh: this.makeMesh(geometry, this.materialOf(shape, row.sensor), 16), shape, fixed, rows: [] };
      this.batches.set(key, batch);
    }
    return batch;
  }
  private makeMesh(geometry: BufferGeometry, material: Material, count: number): InstancedMesh {
    const mesh = new InstancedMesh(geometry, material, count);
    mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    mesh.frustumCulled = false;
    mesh.castShadow = !material.transparent && geometry.type !== 'PlaneGeometry';
    mesh.receiveShadow = !material.transparent;
    this.group.add(mesh);
    return mesh;
  }
  private materialOf(shape: Full<Shape>, sensor: boolean): Material {
    if (this.solid !== undefined) {
      return new MeshStandardMaterial({ transparent: true, opacity: 0.45, depthWrite: false, roughness: 0.5 });
    }
    if (sensor) return new MeshStandardMaterial({ transparent: true, opacity: 0.25, depthWrite: false, roughness: 1 });
    if (shape.type === 'half_space') return this.floorMaterial();
    const side = shape.type === 'terrain' ? DoubleSide : undefined;
    return new MeshStandardMaterial({
      vertexColors: true,
      roughness: 0.62,
      metalness: 0.02,
      flatShading: shape.type === 'terrain',
      ...(side && { side }),
    });
  }
  private floorMaterial(): Material {
    const map = gridTexture();
    map.repeat.setScalar(this.planeSize / (10 * this.gridStep));
    return new MeshStandardMaterial({ map, roughness: 1, side: DoubleSide });
  }

  private fill(key: string, batch: Batch, by: ColourBy, speedMax: number): void {
    if (batch.rows.length > batch.mesh.instanceMatrix.count) {
      const { geometry, material } = batch.mesh;
      this.group.remove(batch.mesh);
      batch.mesh.dispose();
      batch.mesh = this.makeMesh(geometry, material as Material, 2 * batch.rows.length);
      this.batches.set(key, batch);
    }
    const { mesh, rows } = batch;
    if (batch.fixed && batch.shape.type !== 'half_space' && this.solid === undefined) setGlass(mesh, this.glass);
    mesh.count = rows.length;
    rows.forEach((row, i) => {
      mesh.setMatrixAt(i, this.matrices.get(row.id.slot)!);
      mesh.setColorAt(i, this.colourOf(batch, row, by, speedMax));
    });
    mesh.instanceMatrix.needsUpdate = true;
    if (mesh.instanceColor !== null) mesh.instanceColor.needsUpdate = true;
    mesh.boundingSphere = null; // or a ray misses bodies that have moved
  }

  private colourOf(batch: Batch, row: BodyRow, by: ColourBy, speedMax: number): Color {
    if (this.solid !== undefined) return ghost;
    return batch.shape.type === 'half_space' && !row.sensor ? floor : colourOf(row, by, speedMax);
  }

  /** Rims the chosen body, and those that are marked, by their slots. */
  rim(selected: BodyId | undefined, marks: number[]): void {
    this.rimBody(this.chosen, selected?.slot);
    while (this.marked.length < marks.length) {
      const rim = new Rim(palette.marked);
      this.marked.push(rim);
      this.group.add(rim.group);
    }
    this.marked.forEach((rim, i) => this.rimBody(rim, marks[i] === selected?.slot ? undefined : marks[i]));
  }
  private rimBody(rim: Rim, slot: number | undefined): void {
    const row = slot === undefined ? undefined : this.bySlot.get(slot);
    const batch = row && [...this.batches.values()].find((each) => each.rows.includes(row));
    if (!row || !batch || batch.shape.type === 'half_space') return rim.hide();
    rim.show(batch.mesh.geometry, this.matrices.get(row.id.slot)!, batch.shape.type === 'terrain');
  }

  /** Whether it is fixed, and no sensor. */
  isFixed(slot: number): boolean {
    const row = this.bySlot.get(slot);
    return row?.type === 'fixed' && !row.sensor;
  }
  /** Where the body is, from the scene's origin. */
  positionOf(slot: number): Vector3 | undefined {
    const matrix = this.matrices.get(slot);
    return matrix && new Vector3().setFromMatrixPosition(matrix);
  }
  /** The first body that the ray meets, and where, from the scene's origin. It goes through sensors to a body that moves. */
  pick(ray: Raycaster): { id: BodyId; point: Vector3 } | undefined {
    let sensor: { id: BodyId; point: Vector3 } | undefined;
    for (const { object, instanceId, point } of ray.intersectObjects(
      [...this.batches.values()].filter((b) => b.rows.length > 0).map((b) => b.mesh),
    )) {
      const batch = [...this.batches.values()].find((each) => each.mesh === object);
      const row = batch?.rows[instanceId ?? -1];
      if (row === undefined) continue;
      if (!row.sensor) return row.type === 'fixed' && sensor !== undefined ? sensor : { id: row.id, point };
      sensor ??= { id: row.id, point };
    }
    return sensor;
  }
}

function setGlass(mesh: InstancedMesh, on: boolean): void {
  const material = mesh.material as MeshStandardMaterial;
  if (material.transparent === on) return;
  material.transparent = on;
  material.opacity = on ? 0.25 : 1;
  material.depthWrite = !on;
  material.needsUpdate = true;
  mesh.castShadow = !on;
}

/** Ten by ten cells, every tenth line stronger. */
function gridTexture(): CanvasTexture {
  const size = 1000;
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = size;
  const to = canvas.getContext('2d')!;
  to.fillStyle = '#8a8f98';
  to.fillRect(0, 0, size, size);
  for (let i = 0; i <= 10; ++i) {
    to.fillStyle = i % 10 === 0 ? '#5b626d' : '#787e88';
    const width = i % 10 === 0 ? 6 : 3;
    to.fillRect((i * size) / 10 - width / 2, 0, width, size);
    to.fillRect(0, (i * size) / 10 - width / 2, size, width);
  }
  const texture = new CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 8;
  return texture;
}
