// The three-dimensional picture: one scene, one camera that goes along with the character.
import {
  Color, DirectionalLight, Fog, HemisphereLight, PCFShadowMap, PerspectiveCamera, Scene, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { CharacterFacts, CharacterMesh, TerrainMesh } from '../engine/messages';
import type { CameraView } from '../settings';
import { CharacterView } from './character';
import { Ghosts } from './ghosts';
import { GroundView } from './ground';
import { Overlays } from './overlays';
import { Pixels } from './pixels';
import type { Palette } from './theme';

// Where the camera stands about the point it looks at, in the character's frame [m], and how high that is.
const k_views: Record<CameraView, { offset: [number, number, number]; height: number }> = {
  follow: { offset: [2.0, 0.85, -2.6], height: 0.86 },
  side: { offset: [3.7, 0.3, 0.2], height: 0.85 },
  front: { offset: [0.9, 0.5, 3.9], height: 0.9 },
  feet: { offset: [1.5, 0.5, -0.7], height: 0.25 },
};
const k_adult_hips = 0.93; // [m] for whom these are
const k_follow_rate = 7; // [1/s] of the camera after the character

export class Picture {
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  readonly #camera = new PerspectiveCamera(38, 1, 0.05, 160);
  readonly #controls: OrbitControls;
  readonly #sun = new DirectionalLight();
  readonly #fill = new HemisphereLight();
  readonly #ground = new GroundView();
  readonly #overlays = new Overlays();
  readonly #ghosts = new Ghosts();
  #character: CharacterView | undefined;
  #facts: CharacterFacts | undefined;
  #palette: Palette | undefined;
  #view: CameraView = 'follow';
  #settled = false; // false: the camera jumps to its place
  readonly #pixels = new Pixels();
  /** What the last picture shows; where nothing of it has changed there is none to draw. */
  #drawn: unknown[] = [];
  #isStale = true;
  #drewLast = false;

  /** Throws where the browser has no WebGL 2. */
  constructor(canvas: HTMLCanvasElement) {
    this.#renderer = new WebGLRenderer({ canvas, antialias: true, stencil: true, powerPreference: 'high-performance' });
    this.#renderer.shadowMap.enabled = true;
    this.#renderer.shadowMap.type = PCFShadowMap;
    this.#controls = new OrbitControls(this.#camera, canvas);
    this.#controls.enablePan = false;
    this.#controls.minDistance = 0.8;
    this.#controls.maxDistance = 18;
    this.#controls.maxPolarAngle = 0.53 * Math.PI;
    this.#controls.addEventListener('change', () => (this.#isStale = true));
    canvas.addEventListener('webglcontextrestored', () => (this.#isStale = true));
    this.#sun.castShadow = true;
    this.#sun.shadow.mapSize.set(1024, 1024);
    this.#sun.shadow.bias = -0.0004;
    this.#sun.shadow.normalBias = 0.012;
    this.#scene.fog = new Fog(0, 16, 52);
    this.#scene.background = new Color();
    this.#scene.add(this.#ground.mesh, this.#overlays.group, this.#ghosts.group, this.#sun, this.#sun.target, this.#fill);
  }

  get size(): [number, number] {
    return [this.#renderer.domElement.width, this.#renderer.domElement.height];
  }

  resize(width: number, height: number, pixelRatio: number): void {
    this.#renderer.setPixelRatio(Math.min(pixelRatio, 2) * this.#pixels.scale);
    this.#renderer.setSize(width, height, false);
    this.#camera.aspect = width / Math.max(height, 1);
    this.#camera.updateProjectionMatrix();
    this.#isStale = true;
  }

  paint(palette: Palette): void {
    this.#isStale = true;
    this.#palette = palette;
    (this.#scene.background as Color).set(palette.sky);
    this.#scene.fog!.color.set(palette.sky);
    this.#sun.color.set(palette.sun);
    this.#sun.intensity = palette.sunStrength;
    this.#fill.color.set(palette.fillSky);
    this.#fill.groundColor.set(palette.fillGround);
    this.#fill.intensity = palette.fillStrength;
    this.#ground.paint(palette);
    this.#character?.paint(palette);
  }

  showCharacter(facts: CharacterFacts, mesh: CharacterMesh): void {
    this.#isStale = true;
    if (this.#character) {
      this.#scene.remove(this.#character.mesh);
      this.#character.dispose();
    }
    this.#facts = facts;
    this.#character = new CharacterView(mesh);
    if (this.#palette) this.#character.paint(this.#palette);
    this.#scene.add(this.#character.mesh);
    this.#ghosts.show(mesh, facts.layout.mostGhosts);
    this.#makeRoom();
  }

  get #size(): number {
    return (this.#facts?.hipHeight ?? k_adult_hips) / k_adult_hips;
  }

  /** Who has grown out of the picture is looked at from farther away; nearer is where the user goes. */
  #makeRoom(): void {
    const reach = 1.7 * this.#size, shadow = this.#sun.shadow.camera;
    Object.assign(shadow, { left: -reach, right: reach, top: reach, bottom: -reach, near: 1, far: 20 * Math.max(this.#size, 1) });
    shadow.updateProjectionMatrix();
    const away = this.#camera.position.clone().sub(this.#controls.target);
    const least = 0.8 * this.#size * Math.hypot(...k_views[this.#view].offset);
    if (this.#settled && away.length() < least) this.#camera.position.add(away.multiplyScalar(least / away.length() - 1));
  }

  showTerrain(terrain: TerrainMesh): void {
    this.#ground.show(terrain);
    this.#settled = false;
    this.#isStale = true;
  }

  look(view: CameraView): void {
    this.#view = view;
    this.#settled = false;
    this.#isStale = true;
  }

  /** Draws a frame, `seconds` after the last time, unless it is drawn. True where the machine is so slow that it should be resized. */
  draw(frame: Float32Array, seconds: number, shown: Parameters<Overlays['update']>[3] & { ghosts: readonly string[] | null }): boolean {
    if (!this.#facts || !this.#character || frame.length === 0) return false;
    const { layout, ankles } = this.#facts;
    this.#follow(new Vector3().fromArray(frame, layout.root), frame[layout.root + 3] ?? 0, seconds);
    if (!this.#isNews([frame, ...Object.values(shown)])) return (this.#drewLast = false);
    this.#character.pose(frame, layout.joints);
    this.#overlays.update(frame, layout, ankles, shown);
    this.#ghosts.update(frame, layout, shown.ghosts);
    this.#renderer.render(this.#scene, this.#camera);
    const isJudged = this.#drewLast; // else the time went by without a picture
    this.#drewLast = true;
    return isJudged && this.#pixels.judge(seconds);
  }

  /** Where a point of the world is in the last picture, from its upper left [px of the page]; null: behind it. */
  place(at: Vector3): [number, number] | null {
    const { clientWidth, clientHeight } = this.#renderer.domElement, seen = at.clone().project(this.#camera);
    return seen.z > 1 ? null : [((1 + seen.x) / 2) * clientWidth, ((1 - seen.y) / 2) * clientHeight];
  }

  #isNews(shown: unknown[]): boolean {
    const isNews = this.#isStale || shown.some((each, i) => each !== this.#drawn[i]);
    this.#drawn = shown;
    this.#isStale = false;
    return isNews;
  }

  #follow(root: Vector3, yaw: number, seconds: number): void {
    const view = k_views[this.#view], size = this.#size;
    const goal = root.clone();
    goal.y += view.height * size;
    const target = this.#controls.target;
    if (!this.#settled) {
      target.copy(goal);
      this.#camera.position.fromArray(view.offset).multiplyScalar(size).applyAxisAngle(new Vector3(0, 1, 0), yaw).add(goal);
      this.#settled = true;
    } else {
      const step = goal.sub(target);
      const share = step.length() > 3 ? 1 : 1 - Math.exp(-k_follow_rate * seconds);
      step.multiplyScalar(share);
      target.add(step);
      this.#camera.position.add(step);
    }
    this.#controls.update();
    this.#sun.target.position.copy(root).y += 0.8 * size;
    this.#sun.position.copy(this.#sun.target.position).add(new Vector3(4.2, 8, -3).multiplyScalar(Math.max(size, 1)));
  }

  dispose(): void {
    this.#controls.dispose();
    this.#renderer.dispose();
    this.#renderer.forceContextLoss(); // browsers keep few contexts, and not all give back those of gone canvases
  }
}
