// What the page and the engine's worker say to each other.
import type { CharacterFacts, CrowdFacts, GaitFacts, Surefoot } from '@bindings/surefoot.mjs';

export type {
  BenchFacts, CharacterFacts, CrowdFacts, Figure, FigureValue, Finding, FixAttempt, FootMode, FrameLayout, GaitFacts, GaitParameter,
  GaitPlayed, GraphFacts, GraphLive, GraphMachine, GraphParameter, GraphTransition, Heat, RigFacts, SpaceFacts,
} from '@bindings/surefoot.mjs';

/** Who steers: a patrol up and down the course, somebody (m/s and deg/s, to the left positive), or a place of a space. */
export type Steering = { patrol: number } | { speed: number; lateral: number; turn: number } | { space: string; at: number[] };

export interface CharacterMesh {
  positions: Float32Array;
  normals: Float32Array;
  joints: Uint16Array;
  weights: Float32Array;
  triangles: Uint32Array;
  inverseBind: Float32Array;
}

/** All levels of a crowd's mesh in one (CrowdFacts.levels). */
export type CrowdMesh = Omit<CharacterMesh, 'inverseBind'>;

/** A crowd's frame is a picture of this many texels a row, four floats each: one a character, its root, then three a
 *  character and joint, the rows of its matrix. So it goes to the graphics card as it comes. */
export const k_crowd_row = 2048;

export interface CrowdFrame {
  texels: Float32Array;
  /** How many were posed, and [ms] what that and moving all of them took. */
  posed: number;
  animationMs: number;
}

export interface TerrainMesh {
  positions: Float32Array;
  triangles: Uint32Array;
}

/** Who is seen. */
export interface Shown {
  facts: CharacterFacts;
  mesh: CharacterMesh;
}

/** What the module answers is passed on as it is. */
type Forwarded =
  | 'setMode' | 'restart' | 'metrics' | 'scenarios'
  | 'blend' | 'bench' | 'benchDefault' | 'benchOpen' | 'benchAuthor' | 'benchPack' | 'benchThreshold' | 'benchResetThresholds'
  | 'benchFix' | 'benchTakeBack' | 'benchLeaveOut' | 'benchUndo' | 'benchRedo' | 'benchProbe' | 'benchHeat' | 'benchFiles'
  | 'benchSaved'
  | 'gaits' | 'gaitSource' | 'gaitRead' | 'gaitFitted' | 'gaitPlayed' | 'gaitPersonality' | 'gaitFile' | 'rigs'
  | 'graphRead' | 'graphSet' | 'graphLive' | 'jsonEdit' | 'jsonRemove';

/** Calls that are answered once, by name. */
export interface Calls extends Pick<Surefoot, Forwarded> {
  start(): void;
  openDefault(): Shown;
  openPack(bytes: Uint8Array): Shown;
  setCourse(name: string, gradeDeg: number): TerrainMesh;
  /** Plays, and gives the frame as it is then, the curves of what the gait does, and the ground where that is another one now. */
  gaitPlay(values: number[], speed: number, turn: number, slope: number): { frame: Float32Array; curves: Float32Array; ground: TerrainMesh | null };
  /** The gait on another body; `shown` is null where that is the same. */
  gaitRig(name: string, values: number[]): { gait: GaitFacts; shown: Shown | null };
  /** By its own clips again: who is seen, where that is somebody else. */
  gaitStop(): Shown | null;
  ground(): TerrainMesh;
  crowd(count: number, ground?: string): { facts: CrowdFacts; mesh: CrowdMesh; ground: TerrainMesh };
}

export type CallName = keyof Calls;

export type ToWorker =
  | { kind: 'call'; id: number; name: CallName; args: unknown[] }
  /** Advances; the answer is one frame in `buffer`, which goes back and forth. */
  | { kind: 'advance'; frames: number; parts: number; steering: Steering; buffer: ArrayBuffer }
  /** The same for the crowd. */
  | { kind: 'crowd'; seconds: number; eye: [number, number]; lasting: boolean; feet: boolean; buffer: ArrayBuffer };

export type FromWorker =
  | { kind: 'answer'; id: number; result: unknown }
  | { kind: 'failure'; id: number; message: string }
  /** Of a call that takes long: "measuring", 3 of 20. */
  | { kind: 'progress'; label: string; done: number; total: number }
  | { kind: 'frame'; buffer: ArrayBuffer }
  | { kind: 'crowd'; buffer: ArrayBuffer; posed: number; animationMs: number };
