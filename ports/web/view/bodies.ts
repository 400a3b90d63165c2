/** The bodies of the scene: one instanced mesh for all bodies that look alike. */
import {
  BackSide,
  type BufferGeometry,
  CanvasTexture,
  Color,
  DoubleSide,
  DynamicDrawUsage,
  EdgesGeometry,
  Group,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  type Material,
  Mesh,
  MeshBasicMaterial,
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

const rimScale = new Vector3(1.06, 1.06, 1.06);
const floor = new Color('#98a0ab');

interface Batch {
  mesh: InstancedMesh;
  shape: Full<Shape>;
  rows: BodyRow[];
}

export class Bodies {
  readonly group = new Group();
  rows: BodyRow[] = [];
  private readonly batches = new Map<string, Batch>();
  private readonly matrices = new Map<number, Matrix4>();
  private readonly outline: LineSegments;
  /** The chosen body once more, a little larger and seen from inside: its rim shows around it. */
  private readonly rim: Mesh;
  private outlineKey = '';
  private poses = new Float32Array(0);

  constructor(
    private readonly planeSize: number,
    private readonly gridStep: number,
  ) {
    this.outline = new LineSegments(undefined, new LineBasicMaterial({ color: palette.selected }));
    this.outline.renderOrder = 2;
    this.rim = new Mesh(undefined, new MeshBasicMaterial({ color: palette.selected, side: BackSide, fog: false }));
    for (const object of [this.outline, this.rim]) {
      object.matrixAutoUpdate = false;
      object.frustumCulled = false;
      this.group.add(object);
    }
  }

  /** Draws the bodies of a world as they are now. */
  update(world: WorldView, origin: Vec3, by: ColourBy, speedMax: number, selected: BodyId | undefined): void {
    this.rows = world.bodies();
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
      this.matrices.set(row.id.slot, new Matrix4().compose(position, rotation, one));
      this.batchOf(row, world).rows.push(row);
    });
    for (const [key, batch] of this.batches) this.fill(key, batch, by, speedMax);
    this.updateOutline(selected);
  }

  private batchOf(row: BodyRow, world: WorldView): Batch {
    const key = `${row.look}${row.sensor ? 'sensor' : ''}`;
    let batch = this.batches.get(key);
    if (batch === undefined) {
      const { shape } = world.body(row.id).def;
      const geometry = geometryOf(shape, world.outline(row.id), this.planeSize);
      batch = { mesh: this.makeMesh(geometry, this.materialOf(shape, row.sensor), 16), shape, rows: [] };
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
    mesh.count = rows.length;
    rows.forEach((row, i) => {
      mesh.setMatrixAt(i, this.matrices.get(row.id.slot)!);
      mesh.setColorAt(i, batch.shape.type === 'half_space' && !row.sensor ? floor : colourOf(row, by, speedMax));
    });
    mesh.instanceMatrix.needsUpdate = true;
    if (mesh.instanceColor !== null) mesh.instanceColor.needsUpdate = true;
    mesh.boundingSphere = null; // or a ray misses bodies that have moved
  }

  private updateOutline(selected: BodyId | undefined): void {
    const row = selected && this.rows.find((each) => each.id.slot === selected.slot);
    const batch = row && [...this.batches.values()].find((each) => each.rows.includes(row));
    this.outline.visible = batch !== undefined && batch.shape.type !== 'half_space';
    this.rim.visible = this.outline.visible && batch?.shape.type !== 'terrain';
    if (!row || !batch || !this.outline.visible) return;
    this.rim.geometry = batch.mesh.geometry;
    this.rim.matrix.copy(this.matrices.get(row.id.slot)!).scale(rimScale);
    const key = `${row.look}`;
    if (key !== this.outlineKey) {
      this.outline.geometry.dispose();
      this.outline.geometry = new EdgesGeometry(batch.mesh.geometry, 12);
      this.outlineKey = key;
    }
    this.outline.matrix.copy(this.matrices.get(row.id.slot)!);
  }

  /** Where the body is, from the scene's origin. */
  positionOf(slot: number): Vector3 | undefined {
    const matrix = this.matrices.get(slot);
    return matrix && new Vector3().setFromMatrixPosition(matrix);
  }
  /** The first body that the ray meets. */
  pick(ray: Raycaster): BodyId | undefined {
    for (const hit of ray.intersectObjects(
      [...this.batches.values()].filter((b) => b.rows.length > 0).map((b) => b.mesh),
    )) {
      const batch = [...this.batches.values()].find((each) => each.mesh === hit.object);
      const row = batch?.rows[hit.instanceId ?? -1];
      if (row !== undefined) return row.id;
    }
    return undefined;
  }
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
