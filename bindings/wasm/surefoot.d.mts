// Types of surefoot.mjs. tests/wasm holds `Exports` against the module and the rest against what it answers.

/** The module's own functions. Numbers are pointers, sizes in bytes, or what the name says. */
export interface Exports {
  sf_allocate(bytes: number): number;
  sf_free(memory: number): void;
  sf_text(): number;
  sf_text_size(): number;
  sf_scenarios(): number;
  sf_analyze_bvh(text: number, size: number): number;
  sf_space(dimensions: number, values: number, count: number, low: number, high: number): number;
  sf_weights(point: number, samples: number, weights: number): number;
  sf_put_file(name: number, nameSize: number, bytes: number, size: number): void;
  sf_open_project(): number;
  sf_open_default(): number;
  sf_course(name: number, size: number, gradeDeg: number): number;
  sf_mode(mode: number): void;
  sf_steer(speed: number, lateral: number, turn: number): void;
  sf_patrol(speed: number): void;
  sf_restart(): void;
  sf_advance(frames: number, parts: number): void;
  sf_metrics(): number;
  sf_spaces(): number;
  sf_threshold(text: number, size: number): number;
  sf_blend(space: number, at: number, dimensions: number): number;
  sf_gaits(): number;
  sf_gait_source(name: number, size: number): number;
  sf_gait_read(text: number, size: number): number;
  sf_gait_play(values: number, count: number, speed: number, turn: number): number;
  sf_gait_stop(): void;
  sf_gait_file(format: number): number;
  sf_graph_read(text: number, size: number): number;
  sf_graph_set(parameter: number, value: number): void;
  sf_graph_live(): number;
  sf_json_edit(text: number, size: number, pointer: number, pointerSize: number, value: number, valueSize: number): number;
  sf_crowd(count: number): number;
  sf_crowd_advance(seconds: number, eyeX: number, eyeZ: number, lasting: number): number;
  sf_array(array: number): number;
  sf_array_bytes(array: number): number;
}

export type FootMode = 'none' | 'colvin2013' | 'surefoot';

/** A figure of walks: what its columns are called elsewhere, too. */
export interface Figure {
  key: string;
  name: string;
  unit: string;
  /** What is to be met, for people; null where nothing is. */
  mark: string | null;
}

export interface FigureValue {
  text: string;
  value: number | null;
  missed: boolean;
}

/** Where what lies in a frame, in floats; inside a foot relative to its own begin. */
export interface FrameLayout {
  /** [s] since the start of the course */
  time: number;
  /** x, y, z [m], yaw [rad] */
  root: number;
  /** [m/s] */
  speed: number;
  /** [deg/s] */
  turn: number;
  /** [m/s] of foot placement; 0: none */
  speedLimit: number;
  /** [m] of the hips over the ground under the root */
  hips: number;
  /** Share of the cycle of a gait that is shaped; else 0 */
  phase: number;
  /** left, then right; `footFloats` each */
  feet: number;
  footFloats: number;
  /** 16 a joint: 4x4, column-major, world */
  joints: number;
  foot: {
    /** 0 lifted, 1 heel, 2 toes, 3 flat: as the clip means it */
    contact: number;
    /** 1: foot placement holds it */
    planted: number;
    /** 1: its target is out of reach */
    pulledIn: number;
    /** [m] of the lowest point of the sole over the ground under it */
    clearance: number;
    /** [deg] interior */
    knee: number;
    /** 1: the next foothold is known */
    hasNext: number;
    next: number;
    nextNormal: number;
    /** [rad] */
    nextYaw: number;
    /** heel, mid, ball, toe tip */
    sole: number;
    hip: number;
    ankle: number;
  };
}

export interface CharacterFacts {
  name: string;
  joints: string[];
  parents: number[];
  /** How many clips it has. */
  clips: number;
  /** [m] */
  hipHeight: number;
  /** Limits of the axes of its blend spaces, by name: [low, high]. */
  facing: Record<string, [number, number]>;
  lateral: Record<string, [number, number]>;
  courses: string[];
  figures: Figure[];
  warnings: string[];
  layout: FrameLayout;
  /** Joints of the left and the right foot. */
  ankles: [number, number];
}

export interface SpaceAxis {
  name: string;
  unit: string;
  low: number;
  high: number;
}

export interface SpaceFacts {
  /** "facing", "lateral", "style:…" */
  name: string;
  axes: SpaceAxis[];
  /** One value an axis, in its unit. */
  samples: { clip: string; at: number[] }[];
  /** Corners: indices of samples. */
  cells: number[][];
}

export interface LintThreshold {
  name: string;
  unit: string;
  help: string;
  initial: number;
  value: number;
}

export interface LintRule {
  id: string;
  title: string;
  help: string;
  thresholds: LintThreshold[];
}

export interface Finding {
  rule: string;
  severity: 'error' | 'warning' | 'info';
  message: string;
  /** Empty where it is about a clip alone. */
  space: string;
  clips: string[];
  /** Empty where there is no place. */
  at: number[];
}

export interface Placeholder {
  space: string;
  /** Else suggested. */
  needed: boolean;
  axes: string[];
  at: number[];
  rule: string;
  text: string;
}

export interface SpacesFacts {
  spaces: SpaceFacts[];
  rules: LintRule[];
  /** Worst first. */
  findings: Finding[];
  placeholders: Placeholder[];
}

export interface GaitParameter {
  name: string;
  initial: number;
  low: number;
  high: number;
  unit: string;
  group: string;
  help: string;
}

export interface GaitPreset {
  name: string;
  help: string;
  /** One a parameter. */
  values: number[];
}

/** A gait as its text says it. */
export interface GaitFacts {
  name: string;
  help: string;
  parameters: GaitParameter[];
  presets: GaitPreset[];
  warnings: string[];
}

/** What a gait does with the values that it plays with. */
export interface GaitPlayed {
  /** [s] a cycle of the character */
  duration: number;
  /** [m/s] */
  speed: number;
  /** [deg/s] */
  turn: number;
  /** [m] a cycle */
  stride: number;
  /** [m/s] of planted feet; null where none is */
  skate: number | null;
  /** [s] of the curves' values; the last is one period after the first */
  times: number[];
  /** [s] a cycle of the body that the gait is written for */
  period: number;
  /** Its controls over a cycle. */
  curves: { name: string; unit: string; values: (number | null)[] }[];
}

export interface GraphParameter {
  name: string;
  unit: string;
  kind: 'number' | 'flag' | 'trigger';
  initial: number;
  low: number;
  high: number;
  /** [units/s]; 0: at once */
  rate: number;
}

export interface GraphNode {
  /** Where it stands in the file: a JSON pointer, where it has no odd characters. */
  path: string;
  type: string;
  /** What of it matters most. */
  detail: string;
  /** Indices of nodes. */
  children: number[];
}

export interface GraphTransition {
  name: string;
  /** Where it stands in the file. */
  pointer: string;
  /** Indices of states; -1: any but `to` */
  from: number;
  to: number;
  seconds: number;
  curve: string;
  kind: 'feather' | 'inertialize';
  /** Its conditions, in words. */
  when: string;
}

export interface GraphMachine {
  node: number;
  path: string;
  states: { name: string; node: number }[];
  transitions: GraphTransition[];
}

export interface GraphFacts {
  name: string;
  parameters: GraphParameter[];
  /** Children before parents; the last one is the root. */
  nodes: GraphNode[];
  machines: GraphMachine[];
  events: string[];
  /** Of transitions: how each goes from 0 to 1. */
  curves: { name: string; values: number[] }[];
  warnings: string[];
}

export interface GraphLive {
  /** [s] since it began to play */
  time: number;
  /** Values now, by parameter. */
  parameters: number[];
  /** In the whole, by node. */
  weights: number[];
  /** By machine: its state, the running transition or -1, and [s] of it. */
  machines: { state: number; transition: number; elapsed: number }[];
  /** Since the last time that somebody asked: which of GraphFacts.events, and when. */
  events: { event: number; time: number; weight: number }[];
}

/** Many of the character on the stage. */
export interface CrowdFacts {
  count: number;
  joints: number;
  /** [m] of the outermost ring that they go around in */
  radius: number;
  /** The mesh at several levels, finest first: which of `crowdTriangles` are each one's. */
  levels: { first: number; count: number }[];
}

export interface Arrays {
  frame: Float32Array;
  positions: Float32Array;
  normals: Float32Array;
  joints: Uint16Array;
  weights: Float32Array;
  triangles: Uint32Array;
  inverseBind: Float32Array;
  terrain: Float32Array;
  terrainTriangles: Uint32Array;
  /** By character: x, y, z [m], yaw [rad] */
  crowdRoots: Float32Array;
  /** By character and joint: 3x4, row-major, for skinning; relative to the character's root */
  crowdMatrices: Float32Array;
  crowdPositions: Float32Array;
  crowdNormals: Float32Array;
  crowdJoints: Uint16Array;
  crowdWeights: Float32Array;
  crowdTriangles: Uint32Array;
}

export interface Surefoot {
  scenarios(): string;
  analyzeBvh(text: string): Record<string, unknown>;
  space(
    samples: number[][],
    low: number[],
    high: number[],
  ): { weights(point: number[]): { sample: number; weight: number }[] };
  openDefault(): CharacterFacts;
  openProject(files: Iterable<[string, Uint8Array]>): CharacterFacts;
  setCourse(name: string, gradeDeg: number): void;
  setMode(mode: FootMode): void;
  /** [m/s] ahead and to the left, [deg/s] to the left */
  steer(speed: number, lateral: number, turn: number): void;
  patrol(speed: number): void;
  restart(): void;
  /** So many frames of 1/60 s, or of a `parts`th of that each. */
  advance(frames: number, parts?: number): void;
  /** In order of CharacterFacts.figures; null before there are two seconds. */
  metrics(): FigureValue[] | null;
  spaces(): SpacesFacts;
  setThreshold(rule: string, threshold: string, value: number): SpacesFacts;
  resetThresholds(): SpacesFacts;
  /** Which clips play at a place of a space, heaviest first. */
  blend(space: number, at: number[]): { clip: string; weight: number }[];
  /** The bundled gaits, and the text of one. */
  gaits(): { name: string; help: string }[];
  gaitSource(name: string): string;
  /** The character goes in this gait from now on. Throws with line, column and a caret, and all stays as it was. */
  gaitRead(text: string): GaitFacts;
  /** One value a parameter; speeds of 0 are the gait's own. */
  gaitPlay(values: number[], speed: number, turn: number): GaitPlayed;
  gaitStop(): void;
  /** The gait's clip as a file. */
  gaitFile(format: 'bvh' | 'glb'): Uint8Array<ArrayBuffer>;
  /** The character goes as this graph says from now on, until `gaitStop`. Read again with other numbers it goes on where
   *  it was. Throws with the path to the node, and all stays as it was. */
  graphRead(text: string): GraphFacts;
  graphSet(parameter: number, value: number): void;
  graphLive(): GraphLive;
  /** A JSON text with `value` (JSON) at a pointer, and every other byte as it was. */
  jsonEdit(text: string, pointer: string, value: string): string;
  /** So many of the character on the stage, from the start. */
  crowd(count: number): CrowdFacts;
  /** One frame of them; with `lasting`, poses far from the eye last for several frames. How many were posed. */
  crowdAdvance(seconds: number, eyeX: number, eyeZ: number, lasting: boolean): number;
  array<Name extends keyof Arrays>(name: Name): Arrays[Name];
}

/** Throws Error with a text for people where the module cannot be run, and so do all calls that open or analyze. */
export function load(bytes: BufferSource): Promise<Surefoot>;
