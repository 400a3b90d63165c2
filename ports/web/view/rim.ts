/** A body that is marked: its edges, and once more itself, a little larger and seen from inside, so that a rim shows. */
import {
  BackSide,
  type BufferGeometry,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  type Matrix4,
  Mesh,
  MeshBasicMaterial,
  Vector3,
} from 'three';

const larger = new Vector3(1.06, 1.06, 1.06);

export class Rim {
  readonly group = new Group();
  private readonly edges: LineSegments;
  private readonly shell: Mesh;
  private of: BufferGeometry | undefined;

  constructor(color: string) {
    this.edges = new LineSegments(undefined, new LineBasicMaterial({ color }));
    this.edges.renderOrder = 2;
    this.shell = new Mesh(undefined, new MeshBasicMaterial({ color, side: BackSide, fog: false }));
    for (const object of [this.edges, this.shell]) {
      object.matrixAutoUpdate = false;
      object.frustumCulled = false;
      this.group.add(object);
    }
    this.hide();
  }

  /** `thin`: the body is no solid, and has no shell. */
  show(geometry: BufferGeometry, at: Matrix4, thin: boolean): void {
    this.group.visible = true;
    this.shell.visible = !thin;
    this.shell.geometry = geometry;
    this.shell.matrix.copy(at).scale(larger);
    this.edges.matrix.copy(at);
    if (this.of === geometry) return;
    this.edges.geometry.dispose();
    this.edges.geometry = new EdgesGeometry(geometry, 12);
    this.of = geometry;
  }
  hide(): void {
    this.group.visible = false;
  }
}
