// The picture of a crowd: every level of the mesh is drawn once for all who wear it, skinned on the graphics card from one
// texture, into which the engine's frame goes as it comes.
import {
  BufferAttribute, CircleGeometry, Color, CustomBlending, DataTexture, DirectionalLight, DynamicDrawUsage, FloatType, Fog, Frustum, HemisphereLight,
  InstancedBufferAttribute, InstancedBufferGeometry, type Material, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, NearestFilter,
  PerspectiveCamera, RGBAFormat, Scene, Sphere, Vector3, WebGLRenderer, type WebGLProgramParametersWithUniforms,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { k_crowd_row, type CrowdFacts, type CrowdMesh, type TerrainMesh } from '../engine/messages';
import { GroundView } from './ground';
import { Pixels } from './pixels';
import type { Palette } from './theme';

export type CrowdView = 'above' | 'among';

const k_level_distances = [5, 18]; // [m] from the camera up to which a level is worn; the last one beyond
const k_measure_every = 20; // pictures
const k_floats_of_matrix = 12;

const k_place_pars = /* glsl */ `
#include <common>
attribute float character;
uniform highp sampler2D uTexels;
uniform ivec3 uLayout; // characters, texels a character's pose has, texels a row
vec4 texelAt(int index) { return texelFetch(uTexels, ivec2(index % uLayout.z, index / uLayout.z), 0); }
vec3 turned(vec3 v, float yaw) { float c = cos(yaw), s = sin(yaw); return vec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x); }`;

const k_skin_pars = /* glsl */ `
attribute vec4 bones;
attribute vec4 shares;
varying vec3 vTint;
uniform vec3 uTints[5];`;

const k_skin = /* glsl */ `
int poseAt = uLayout.x + int(character) * uLayout.y;
vec4 rootAt = texelAt(int(character));
vec4 rowX = vec4(0.0), rowY = vec4(0.0), rowZ = vec4(0.0);
for (int k = 0; k < 4; ++k) {
  if (shares[k] <= 0.0) break;
  int at = poseAt + 3 * int(bones[k]);
  rowX += shares[k] * texelAt(at);
  rowY += shares[k] * texelAt(at + 1);
  rowZ += shares[k] * texelAt(at + 2);
}
vTint = uTints[int(character * 7.0) % 5];
vec3 objectNormal = turned(vec3(dot(rowX.xyz, normal), dot(rowY.xyz, normal), dot(rowZ.xyz, normal)), rootAt.w);`;

const k_skinned_place = /* glsl */ `
vec4 bound = vec4(position, 1.0);
vec3 transformed = rootAt.xyz + turned(vec3(dot(rowX, bound), dot(rowY, bound), dot(rowZ, bound)), rootAt.w);`;

/** Every skeleton with a mesh and a texture: what all levels and the shadows share. */
interface Shared {
  uTexels: { value: DataTexture };
  uLayout: { value: Int32Array };
  uTints: { value: Color[] };
}

function skinned(material: MeshLambertMaterial, shared: Shared): MeshLambertMaterial {
  material.onBeforeCompile = (shader: WebGLProgramParametersWithUniforms) => {
    Object.assign(shader.uniforms, shared);
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', k_place_pars + k_skin_pars)
      .replace('#include <beginnormal_vertex>', k_skin)
      .replace('#include <begin_vertex>', k_skinned_place);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nvarying vec3 vTint;')
      .replace('#include <color_fragment>', 'diffuseColor.rgb *= vTint;');
  };
  return material;
}

/** A soft round shadow under each: what stands on the ground is seen to. */
function shadow(shared: Shared): MeshBasicMaterial {
  const material = new MeshBasicMaterial({ color: 0x000000, blending: CustomBlending, depthTest: false, depthWrite: false });
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, shared);
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `${k_place_pars}\nvarying float vRim;`)
      .replace('#include <begin_vertex>', `
vec4 rootAt = texelAt(int(character));
vRim = length(position.xy);
vec3 transformed = rootAt.xyz + turned(vec3(0.30 * position.x, 0.005, 0.38 * position.y), rootAt.w);`);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nvarying float vRim;')
      .replace('#include <color_fragment>', 'diffuseColor.a = 0.34 * (1.0 - vRim * vRim);');
  };
  return material;
}

/** One drawn mesh, and who wears it in this picture. */
class Level {
  readonly mesh: Mesh<InstancedBufferGeometry>;
  readonly #characters: InstancedBufferAttribute;
  count = 0;

  constructor(geometry: InstancedBufferGeometry, material: Material, most: number) {
    this.#characters = new InstancedBufferAttribute(new Float32Array(most), 1);
    this.#characters.setUsage(DynamicDrawUsage);
    geometry.setAttribute('character', this.#characters);
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false; // who is out of sight is left out one by one
  }

  add(character: number): void {
    this.#characters.array[this.count++] = character;
  }

  done(): void {
    this.mesh.geometry.instanceCount = this.count;
    this.mesh.visible = this.count > 0;
    this.#characters.clearUpdateRanges();
    this.#characters.addUpdateRange(0, this.count);
    this.#characters.needsUpdate = true;
  }

  get triangles(): number {
    const { drawRange, index } = this.mesh.geometry;
    return Math.min(drawRange.count, index?.count ?? 0) / 3;
  }
}

function levelGeometry(mesh: CrowdMesh, range: { first: number; count: number }): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(mesh.positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(mesh.normals, 3));
  geometry.setAttribute('bones', new BufferAttribute(mesh.joints, 4));
  geometry.setAttribute('shares', new BufferAttribute(mesh.weights, 4));
  geometry.setIndex(new BufferAttribute(mesh.triangles, 1));
  geometry.setDrawRange(range.first, range.count);
  return geometry;
}

/** No graphics card: smooth edges would double what a picture of hundreds costs. */
function drawsInSoftware(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = info ? String(gl!.getParameter(info.UNMASKED_RENDERER_WEBGL)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

/** Its x and y are the shadow's x and z; seen from above that is from behind. */
function discGeometry(): InstancedBufferGeometry {
  const disc = new CircleGeometry(1, 10), geometry = new InstancedBufferGeometry();
  geometry.setAttribute('position', disc.getAttribute('position'));
  geometry.setIndex([...disc.getIndex()!.array].reverse());
  return geometry;
}

export class CrowdPicture {
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  readonly #camera = new PerspectiveCamera(42, 1, 0.1, 600);
  readonly #controls: OrbitControls;
  readonly #sun = new DirectionalLight();
  readonly #fill = new HemisphereLight();
  readonly #ground = new GroundView();
  readonly #fog = new Fog(0, 20, 90);
  readonly #pixels = new Pixels();
  readonly #shared: Shared = {
    uTexels: { value: new DataTexture(new Float32Array(4), 1, 1, RGBAFormat, FloatType) },
    uLayout: { value: new Int32Array([0, 0, k_crowd_row]) },
    uTints: { value: [0, 1, 2, 3, 4].map(() => new Color()) },
  };
  readonly #body = skinned(new MeshLambertMaterial(), this.#shared);
  readonly #shadow = shadow(this.#shared);
  #levels: Level[] = [];
  #shadows: Level | undefined;
  #facts: CrowdFacts | undefined;
  #view: CrowdView = 'above';
  #pictures = 0;
  /** [ms] that drawing took when it was last measured, to the last pixel. */
  renderingMs = 0;

  /** Throws where the browser has no WebGL 2. */
  constructor(canvas: HTMLCanvasElement) {
    this.#renderer = new WebGLRenderer({ canvas, antialias: !drawsInSoftware(), powerPreference: 'high-performance' });
    this.#controls = new OrbitControls(this.#camera, canvas);
    this.#controls.maxPolarAngle = 0.49 * Math.PI;
    this.#controls.minDistance = 2;
    this.#controls.maxDistance = 220;
    this.#scene.fog = this.#fog;
    this.#scene.background = new Color();
    this.#sun.position.set(4.2, 8, -3);
    this.#scene.add(this.#ground.mesh, this.#sun, this.#fill);
  }

  resize(width: number, height: number, pixelRatio: number): void {
    this.#renderer.setPixelRatio(Math.min(pixelRatio, 2) * this.#pixels.scale);
    this.#renderer.setSize(width, height, false);
    this.#camera.aspect = width / Math.max(height, 1);
    this.#camera.updateProjectionMatrix();
  }

  paint(palette: Palette): void {
    (this.#scene.background as Color).set(palette.sky);
    this.#fog.color.set(palette.sky);
    this.#sun.color.set(palette.sun);
    this.#sun.intensity = palette.sunStrength;
    this.#fill.color.set(palette.fillSky);
    this.#fill.groundColor.set(palette.fillGround);
    this.#fill.intensity = palette.fillStrength;
    this.#ground.paint(palette);
    palette.crowd.forEach((color, i) => this.#shared.uTints.value[i]!.set(color));
  }

  show(facts: CrowdFacts, mesh: CrowdMesh, ground: TerrainMesh): void {
    this.#clear();
    this.#facts = facts;
    this.#shared.uLayout.value.set([facts.count, (k_floats_of_matrix / 4) * facts.joints, k_crowd_row]);
    this.#levels = facts.levels.map((range) => new Level(levelGeometry(mesh, range), this.#body, facts.count));
    this.#shadows = new Level(discGeometry(), this.#shadow, facts.count);
    // Flat discs under who stands on a slope: they are drawn upon the ground whatever its height, and all else upon them.
    this.#ground.mesh.renderOrder = -2;
    this.#shadows.mesh.renderOrder = -1;
    this.#scene.add(...this.#levels.map((level) => level.mesh), this.#shadows.mesh);
    this.#ground.show(ground);
    this.#fog.near = 12 + facts.radius;
    this.#fog.far = 60 + 1.9 * facts.radius;
    this.look(this.#view);
  }

  look(view: CrowdView): void {
    this.#view = view;
    const radius = Math.min(this.#facts?.radius ?? 10, 40);
    if (view === 'above') {
      this.#controls.target.set(0, 0.6, -0.1 * radius);
      this.#camera.position.set(0.45 * radius + 1, 0.42 * radius + 2, -1.15 * radius - 3.5);
    } else {
      this.#controls.target.set(0, 1.1, 0);
      this.#camera.position.set(0.7, 1.55, -Math.min(radius + 2.5, 10.3));
    }
    this.#controls.update();
  }

  /** Where it is seen from, on the ground. */
  get eye(): [number, number] {
    return [this.#camera.position.x, this.#camera.position.z];
  }

  /** How many are drawn with how many triangles each, finest first. */
  get drawn(): { triangles: number; characters: number }[] {
    return this.#levels.map((level) => ({ triangles: level.triangles, characters: level.count }));
  }

  /** Draws a frame, `seconds` after the last picture. True where the machine is so slow that it should be resized. */
  draw(texels: Float32Array, seconds: number): boolean {
    const facts = this.#facts;
    if (!facts || texels.length < 4 * facts.count * (1 + 3 * facts.joints)) return false;
    this.#take(texels);
    this.#controls.update();
    this.#dress(texels, facts);
    const begun = performance.now();
    this.#renderer.render(this.#scene, this.#camera);
    if (this.#pictures++ % k_measure_every === 2) {
      // Reading a pixel waits until all of them are there.
      const gl = this.#renderer.getContext();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      this.renderingMs = performance.now() - begun;
    }
    return this.#pixels.judge(seconds);
  }

  #take(texels: Float32Array): void {
    const { uTexels } = this.#shared;
    const rows = texels.length / (4 * k_crowd_row);
    if (uTexels.value.image.height !== rows) {
      uTexels.value.dispose();
      uTexels.value = new DataTexture(texels, k_crowd_row, rows, RGBAFormat, FloatType);
      uTexels.value.magFilter = uTexels.value.minFilter = NearestFilter;
    }
    uTexels.value.image.data = texels;
    uTexels.value.needsUpdate = true;
  }

  /** Who is in sight wears the level of their distance. */
  #dress(texels: Float32Array, facts: CrowdFacts): void {
    this.#camera.updateMatrixWorld();
    const sight = new Frustum().setFromProjectionMatrix(
      new Matrix4().multiplyMatrices(this.#camera.projectionMatrix, this.#camera.matrixWorldInverse),
    );
    const body = new Sphere(new Vector3(), 1.3), eye = this.#camera.position;
    for (const level of [...this.#levels, this.#shadows!]) level.count = 0;
    for (let c = 0; c < facts.count; ++c) {
      body.center.set(texels[4 * c]!, texels[4 * c + 1]! + 0.9, texels[4 * c + 2]!);
      if (!sight.intersectsSphere(body)) continue;
      const distance = body.center.distanceTo(eye);
      const level = k_level_distances.findIndex((end) => distance < end);
      this.#levels[level < 0 ? this.#levels.length - 1 : level]!.add(c);
      this.#shadows!.add(c);
    }
    for (const level of [...this.#levels, this.#shadows!]) level.done();
  }

  #clear(): void {
    for (const level of [...this.#levels, ...(this.#shadows ? [this.#shadows] : [])]) {
      this.#scene.remove(level.mesh);
      level.mesh.geometry.dispose();
    }
    this.#levels = [];
    this.#shadows = undefined;
  }

  dispose(): void {
    this.#clear();
    this.#shared.uTexels.value.dispose();
    this.#body.dispose();
    this.#shadow.dispose();
    this.#controls.dispose();
    this.#renderer.dispose();
    this.#renderer.forceContextLoss();
  }
}
