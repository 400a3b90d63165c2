/** The drawn scene: light, camera, bodies, overlays. */
import {
  Color,
  DirectionalLight,
  Fog,
  HemisphereLight,
  InstancedMesh,
  type Mesh,
  PCFShadowMap,
  PerspectiveCamera,
  Plane,
  Raycaster,
  Scene,
  type Texture,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { BodyId, Vec3, WorldView } from '../src/index.js';
import { Bodies } from './bodies.js';
import { type ColourBy } from './colours.js';
import { emptyExtent, type Extent } from './extent.js';
import { Overlays } from './overlays.js';

export interface Look {
  colourBy: ColourBy;
  contacts: boolean;
  joints: boolean;
  bounds: boolean;
  follow: boolean;
  /** Fixed bodies are transparent: what they enclose is seen. */
  glass: boolean;
  speedMax: number;
}

/** What is marked and drawn besides the world. */
export interface Beside {
  /** Slots of bodies. */
  marks: number[];
  /** A world whose bodies are ghosts. */
  second?: WorldView | undefined;
  /** A line that is drawn: from where a body is held to the mouse. */
  pull?: [Vec3, Vec3] | undefined;
}
export interface Picked {
  id: BodyId;
  /** In the world, m. */
  point: Vec3;
}

/** The direction from which the camera looks at first. */
const viewFrom = new Vector3(1.25, 1.1, 2.3).normalize();
const background = '#14181e';
/** A body this far from the scene's origin, m, is followed to a new origin: floats stay fine near the camera. */
const originDistanceMax = 4096;
/** So many bodies stand for all of a scene. */
const hiddenBodiesMax = 40;

export class Stage {
  bodies!: Bodies;
  overlays!: Overlays;
  /** The second recording's bodies, where they differ. */
  private ghosts!: Bodies;
  private readonly renderer: WebGLRenderer;
  private readonly camera = new PerspectiveCamera(40);
  private readonly controls: OrbitControls;
  private readonly light = new DirectionalLight('#fff4e0', 2.4);
  private scene = new Scene();
  /** Not drawn any more. Released once the next one has been drawn: it takes over their shaders. */
  private readonly past: Scene[] = [];
  private extent!: Extent;
  private origin: Vec3 = [0, 0, 0];
  private radius = 1;
  private stale = true;

  /** Throws if the browser has no WebGL. */
  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.15;
    this.light.castShadow = true;
    // A window that a browser shows smaller has a smaller shadow map.
    this.light.shadow.mapSize.setScalar(2048 * Math.min(1, window.devicePixelRatio));
    this.open(emptyExtent);
  }

  /** Begins with an empty scene, and looks at where its bodies will be. */
  open(extent: Extent): void {
    this.past.push(this.scene);
    this.extent = extent;
    this.origin = extent.middle;
    this.radius = extent.radius;
    this.camera.near = this.radius / 200;
    this.camera.far = this.radius * 400;
    this.camera.updateProjectionMatrix();
    this.controls.minDistance = this.radius / 100;
    this.controls.maxDistance = this.radius * 100;

    this.scene = new Scene();
    this.scene.background = new Color(background);
    this.scene.fog = new Fog(background, this.radius * 8, this.radius * 40);
    this.scene.add(new HemisphereLight('#e6eeff', '#5a544c', 1.5), this.light, this.light.target);
    this.light.shadow.normalBias = this.radius / 500;
    const gridStep = 10 ** Math.floor(Math.log10(this.radius / 2));
    this.bodies = new Bodies(this.radius * 100, gridStep);
    this.ghosts = new Bodies(this.radius * 100, gridStep, this.bodies);
    this.overlays = new Overlays(this.radius / 5);
    this.scene.add(this.bodies.group, this.ghosts.group, this.overlays.group);
    this.resetCamera();
  }

  /** Looks at where the bodies are now. */
  refit(extent: Extent): void {
    this.extent = extent;
    this.resetCamera();
  }
  /** Looks at the middle again. The next update() draws from there. */
  resetCamera(): void {
    this.origin = this.extent.middle;
    this.controls.enableDamping = false;
    this.controls.update(); // without damping it forgets a turn that is still going on
    this.controls.target.set(0, 0, 0);
    this.camera.position.copy(viewFrom).multiplyScalar(this.fitDistance());
    this.controls.update();
    this.controls.enableDamping = true;
    this.stale = true;
  }

  /** How far from the target the camera sees all bodies of the extent. */
  private fitDistance(): number {
    const aspect = this.canvas.clientWidth / Math.max(1, this.canvas.clientHeight);
    const tangent = Math.tan((this.camera.fov * Math.PI) / 360);
    const right = new Vector3().crossVectors(new Vector3(0, 1, 0), viewFrom).normalize();
    const above = new Vector3().crossVectors(viewFrom, right);
    const needed = this.extent.reached.map(({ offset, size }) => {
      const at = new Vector3(...offset);
      const across = Math.max((Math.abs(at.dot(right)) + size) / aspect, Math.abs(at.dot(above)) + size);
      return across / tangent + at.dot(viewFrom);
    });
    return Math.max(1.08 * Math.max(...needed, this.extent.radius), this.controls.minDistance);
  }

  /** Takes over the world's present tick. */
  update(world: WorldView, look: Look, selected: BodyId | undefined, { marks, second, pull }: Beside): void {
    this.bodies.glass = look.glass;
    this.bodies.update(world, this.origin, look.colourBy, look.speedMax);
    if (look.follow && selected) this.follow(selected, world, look);
    if (second === undefined) this.ghosts.clear();
    else this.ghosts.update(second, this.origin, look.colourBy, look.speedMax);
    this.bodies.rim(selected, marks);
    this.overlays.update(world, this.origin, look, pull);
    this.stale = true;
  }
  private follow(body: BodyId, world: WorldView, look: Look): void {
    const at = this.bodies.positionOf(body.slot);
    if (at === undefined) return;
    this.camera.position.add(at).sub(this.controls.target);
    this.controls.target.copy(at);
    if (at.length() < originDistanceMax) return;
    this.origin = at.toArray().map((x, i) => Math.round(x) + this.origin[i]!) as Vec3;
    const moved = new Vector3(...at.toArray().map(Math.round));
    this.camera.position.sub(moved);
    this.controls.target.sub(moved);
    this.bodies.update(world, this.origin, look.colourBy, look.speedMax);
  }

  /** Draws, if anything has changed since the last time. */
  render(): void {
    if (!this.fit() && !this.controls.update() && !this.stale) return;
    this.stale = false;
    const { target } = this.controls;
    const reach = Math.max(this.radius * 1.5, this.camera.position.distanceTo(target) * 0.9);
    this.light.target.position.copy(target);
    this.light.position
      .set(0.5, 1.2, 0.35)
      .normalize()
      .multiplyScalar(reach * 3)
      .add(target);
    const view = this.light.shadow.camera;
    Object.assign(view, { left: -reach, right: reach, top: reach, bottom: -reach, near: reach / 10, far: reach * 8 });
    view.updateProjectionMatrix();
    this.renderer.shadowMap.needsUpdate = true;
    this.renderer.render(this.scene, this.camera);
    for (const scene of this.past.splice(0)) release(scene);
  }
  /** Takes over the size of the canvas; true if it is new. */
  private fit(): boolean {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const ratio = Math.min(window.devicePixelRatio, 2);
    const size = this.renderer.getSize(new Vector2());
    if (size.x === width && size.y === height && this.renderer.getPixelRatio() === ratio) return false;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
    return true;
  }

  /** How many bodies of the second world are drawn. */
  get ghostsDrawn(): number {
    return this.ghosts.drawn;
  }
  /** Whether fixed bodies hide most of the bodies that move. */
  get hidden(): boolean {
    const moving = this.bodies.rows.filter((row) => row.type !== 'fixed').slice(0, hiddenBodiesMax);
    const hidden = moving.filter(({ id }) => {
      const to = this.bodies.positionOf(id.slot)!.sub(this.camera.position).normalize();
      const first = this.bodies.pick(new Raycaster(this.camera.position, to));
      return first !== undefined && this.bodies.isFixed(first.id.slot);
    });
    return hidden.length > moving.length / 2;
  }

  /** The body at a pixel of the canvas, and the point of it that is seen there. */
  pick(x: number, y: number): Picked | undefined {
    const hit = this.bodies.pick(this.ray(x, y));
    return hit && { id: hit.id, point: this.toWorld(hit.point) };
  }
  /** The point at a pixel that is as far in front of the camera as `point`. */
  across(x: number, y: number, point: Vec3): Vec3 {
    const front = this.camera.getWorldDirection(new Vector3());
    const plane = new Plane().setFromNormalAndCoplanarPoint(front, this.fromWorld(point));
    const at = this.ray(x, y).ray.intersectPlane(plane, new Vector3());
    return at === null ? point : this.toWorld(at);
  }
  /** Whether the mouse turns the camera. */
  set turns(on: boolean) {
    this.controls.enabled = on;
  }

  private ray(x: number, y: number): Raycaster {
    const ray = new Raycaster();
    const at = new Vector2((2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight);
    ray.setFromCamera(at, this.camera);
    return ray;
  }
  private toWorld(at: Vector3): Vec3 {
    return at.toArray().map((x, i) => x + this.origin[i]!) as Vec3;
  }
  private fromWorld(at: Vec3): Vector3 {
    return new Vector3(...at.map((x, i) => x - this.origin[i]!));
  }
}

/** Frees what an old scene holds on the graphics card. */
function release(scene: Scene): void {
  scene.traverse((object) => {
    const { geometry, material } = object as Partial<Mesh>;
    geometry?.dispose();
    for (const each of material === undefined ? [] : [material].flat()) {
      (each as { map?: Texture | null }).map?.dispose();
      each.dispose();
    }
    if (object instanceof InstancedMesh) object.dispose();
  });
}
