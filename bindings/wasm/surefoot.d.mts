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
  sf_open_default(): number;
  sf_open_pack(bytes: number, size: number): number;
  sf_course(name: number, size: number, gradeDeg: number): number;
  sf_mode(mode: number): void;
  sf_steer(speed: number, lateral: number, turn: number): void;
  sf_steer_to(space: number, size: number, at: number, dimensions: number): number;
  sf_patrol(speed: number): void;
  sf_restart(): void;
  sf_advance(frames: number, parts: number): void;
  sf_metrics(): number;
  sf_blend(space: number, size: number, at: number, dimensions: number): number;
  sf_bench_default(): number;
  sf_bench_open(onDisk: number): number;
  sf_bench_author(name: number, size: number): number;
  sf_bench(): number;
  sf_bench_pack(): number;
  sf_bench_threshold(text: number, size: number): number;
  sf_bench_fix(id: number, size: number): number;
  sf_bench_take_back(repair: number, size: number): number;
  sf_bench_leave_out(clip: number, size: number, out: number): number;
  sf_bench_undo(again: number): number;
  sf_bench_probe(grid: number): number;
  sf_bench_heat(): number;
  sf_bench_files(all: number): number;
  sf_bench_file(name: number, size: number): number;
  sf_bench_saved(): void;
  sf_gaits(): number;
  sf_gait_source(name: number, size: number): number;
  sf_gait_read(text: number, size: number): number;
  sf_gait_fitted(name: number, size: number): number;
  sf_gait_play(values: number, count: number, speed: number, turn: number, slope: number): number;
  sf_gait_personality(text: number, size: number): number;
  sf_rigs(): number;
  sf_gait_rig(name: number, size: number, values: number, count: number): number;
  sf_gait_played(): number;
  sf_gait_stop(): number;
  sf_gait_file(format: number): number;
  sf_graph_read(text: number, size: number): number;
  sf_graph_set(parameter: number, value: number): void;
  sf_graph_live(): number;
  sf_json_edit(text: number, size: number, pointer: number, pointerSize: number, value: number, valueSize: number): number;
  sf_json_remove(text: number, size: number, pointer: number, pointerSize: number): number;
  sf_crowd(count: number, ground: number, size: number): number;
  sf_crowd_advance(seconds: number, eyeX: number, eyeZ: number, lasting: number, feet: number): number;
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
  /** The clips that the pose is blended from, heaviest first; `ghostFloats` each, `mostGhosts` of them */
  ghosts: number;
  ghostFloats: number;
  mostGhosts: number;
  /** Inside a ghost, relative to its own begin. */
  ghost: {
    /** index into CharacterFacts.clipNames */
    clip: number;
    /** 0: there is none */
    weight: number;
    /** as of the character */
    joints: number;
  };
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
  /** What its clips are called; none where it goes in a gait on a template's body. */
  clipNames: string[];
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
  /** For `benchFix`. */
  id: string;
  /** What would mend it, in words; null where nothing is known. */
  mend: string | null;
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

/** A clip that is part of no space. */
export interface LeftOut {
  clip: string;
  reason: string;
  byUser: boolean;
  /** It can be taken in again. */
  atHand: boolean;
}

/** A project that is worked on. */
export interface BenchFacts {
  name: string;
  spaces: SpaceFacts[];
  rules: LintRule[];
  /** Worst first. */
  findings: Finding[];
  placeholders: Placeholder[];
  /** Those that were made, in order. */
  repairs: { id: string; rule: string; text: string }[];
  leftOut: LeftOut[];
  /** Files that could not be read, with the reason. */
  failed: string[];
  warnings: string[];
  probed: boolean;
  /** What would be undone or done again, in words; null where nothing is. */
  undo: string | null;
  redo: string | null;
  /** It is not as it was opened or saved. */
  unsaved: boolean;
}

export interface FixAttempt {
  /** Of the finding. */
  id: string;
  rule: string;
  done: boolean;
  /** What was done, or why nothing could be. */
  text: string;
}

/** A figure of the probe over a space. */
export interface Heat {
  space: string;
  title: string;
  unit: string;
  /** The ends of the scale. */
  least: number;
  full: number;
  decimals: number;
  /** From `least` to `full`. */
  scale: string[];
  /** Between neighbours on each axis. */
  steps: number[];
  /** null where nothing could be measured. */
  cells: { at: number[]; value: number | null; text: string }[];
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

/** What a gait can be asked for: from `low` to `high`; `own` is what it does by itself. */
export interface GaitRange {
  own: number;
  low: number;
  high: number;
}

/** A gait as its text says it, or as it was fitted to motion. */
export interface GaitFacts {
  name: string;
  help: string;
  /** To motion: its parameters are sliders of personalities, and its presets bundled ones. */
  fitted: boolean;
  presets: GaitPreset[];
  /** [m/s], [deg/s]; null: it goes as it goes. */
  speed: GaitRange | null;
  turn: GaitRange | null;
  /** It can be asked to go up and down. */
  slopes: boolean;
  warnings: string[];
  parameters: GaitParameter[];
}

/** A template of bodies. */
export interface RigFacts {
  name: string;
  help: string;
  parameters: GaitParameter[];
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
  /** Its controls; what they do over a cycle is the array `gaitCurves`. */
  curves: { name: string; unit: string }[];
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
  /** What they can go on. */
  grounds: string[];
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
  /** The ground that they go on. */
  crowdTerrain: Float32Array;
  crowdTerrainTriangles: Uint32Array;
  /** By control of the gait, in order of GaitPlayed.curves: equally many values each, over one cycle, both ends included; NaN where there is none */
  gaitCurves: Float32Array;
}

export interface Surefoot {
  scenarios(): string;
  analyzeBvh(text: string): Record<string, unknown>;
  space(
    samples: number[][],
    low: number[],
    high: number[],
  ): { weights(point: number[]): { sample: number; weight: number }[] };
  /** Who is on the stage: the character of the bundled gaits, or that of a pack, who goes on from where the one before is. */
  openDefault(): CharacterFacts;
  openPack(bytes: Uint8Array): CharacterFacts;
  setCourse(name: string, gradeDeg: number): void;
  setMode(mode: FootMode): void;
  /** [m/s] ahead and to the left, [deg/s] to the left */
  steer(speed: number, lateral: number, turn: number): void;
  /** As it is at a place of a space, one value an axis. */
  steerTo(space: string, at: number[]): void;
  patrol(speed: number): void;
  restart(): void;
  /** So many frames of 1/60 s, or of a `parts`th of that each. */
  advance(frames: number, parts?: number): void;
  /** In order of CharacterFacts.figures; null before there are two seconds. */
  metrics(): FigureValue[] | null;
  /** Which clips play on the stage at a place of a space, heaviest first. */
  blend(space: string, at: number[]): { clip: string; weight: number }[];
  /** A project on the bench: that of the bundled gaits, one that `surefoot author` wrote, or one made of clips. */
  benchDefault(): BenchFacts;
  benchOpen(files: Iterable<[string, Uint8Array]>, onDisk?: boolean): BenchFacts;
  benchAuthor(files: Iterable<[string, Uint8Array]>, name: string): BenchFacts;
  bench(): BenchFacts;
  /** What plays on the bench, for `openPack`. */
  benchPack(): Uint8Array<ArrayBuffer>;
  benchThreshold(rule: string, threshold: string, value: number): BenchFacts;
  benchResetThresholds(): BenchFacts;
  /** Mends a finding by its id, all that can be mended without. */
  benchFix(id?: string): FixAttempt[];
  /** Takes back a repair and those that build on it. */
  benchTakeBack(repair: string): BenchFacts;
  benchLeaveOut(clip: string, out: boolean): BenchFacts;
  benchUndo(): BenchFacts;
  benchRedo(): BenchFacts;
  /** Plays the spaces and measures them; `grid` points an axis, or as many as is usual. */
  benchProbe(grid?: number): BenchFacts;
  /** What the probe found; empty where nobody probed. */
  benchHeat(): Heat[];
  /** The project's files, all or those that are not saved; and which are saved and not part of it any more. */
  benchFiles(all: boolean): { files: [string, Uint8Array<ArrayBuffer>][]; gone: string[] };
  /** It is on disk as it is now. */
  benchSaved(): void;
  /** The bundled gaits, and the text of one. */
  gaits(): { name: string; help: string; fitted: boolean }[];
  gaitSource(name: string): string;
  /** The character goes in this gait from now on. Throws with line, column and a caret, and all stays as it was. */
  gaitRead(text: string): GaitFacts;
  /** The same of a bundled gait that was fitted to motion. */
  gaitFitted(name: string): GaitFacts;
  /** One value a parameter; a speed of 0 is the gait's own. Turns to the left and slopes uphill are positive. */
  gaitPlay(values: number[], speed: number, turn: number, slope: number): void;
  /** What a personality's text (JSON) sets the parameters of fitted gaits to. */
  gaitPersonality(text: string): number[];
  /** The bundled rig templates. */
  rigs(): RigFacts[];
  /** The gait on the body of a template with one value a parameter, or, without a name, on the character's own, until
   *  `gaitStop`: what the gait is then, and who is seen; null where it is the same body. Throws, and all stays as it was. */
  gaitRig(name: string, values: number[]): { gait: GaitFacts; character: CharacterFacts | null };
  /** What it does now: measured, which takes longer than to play it. */
  gaitPlayed(): GaitPlayed;
  /** By its own clips, on its own body: who is seen then; null where it is the same body. */
  gaitStop(): CharacterFacts | null;
  /** The gait's clip as a file. */
  gaitFile(format: 'bvh' | 'glb'): Uint8Array<ArrayBuffer>;
  /** The character goes as this graph says from now on, until `gaitStop`. Read again with other numbers it goes on where
   *  it was. Throws with the path to the node, and all stays as it was. */
  graphRead(text: string): GraphFacts;
  graphSet(parameter: number, value: number): void;
  graphLive(): GraphLive;
  /** A JSON text with `value` (JSON) at a pointer, and every other byte as it was. */
  jsonEdit(text: string, pointer: string, value: string): string;
  /** The same without what is at a pointer. */
  jsonRemove(text: string, pointer: string): string;
  /** So many of the character on the stage, from the start, on one of CrowdFacts.grounds (without: flat). */
  crowd(count: number, ground?: string): CrowdFacts;
  /** One frame of them; with `lasting`, poses far from the eye last for several frames; without `feet`, roots alone follow
   *  the ground. How many were posed. */
  crowdAdvance(seconds: number, eyeX: number, eyeZ: number, lasting: boolean, feet?: boolean): number;
  array<Name extends keyof Arrays>(name: Name): Arrays[Name];
}

/** Told of long work, step by step: "measuring", 3 of 20. */
export type OnProgress = (label: string, done: number, total: number) => void;

/** Throws Error with a text for people where the module cannot be run, and so do all calls that open or analyze. */
export function load(bytes: BufferSource, onProgress?: OnProgress): Promise<Surefoot>;
