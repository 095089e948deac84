// What the page and the engine's worker say to each other.
import type { CharacterFacts, CrowdFacts, Surefoot } from '@bindings/surefoot.mjs';

export type {
  CharacterFacts, CrowdFacts, Figure, FigureValue, Finding, FootMode, FrameLayout, GaitFacts, GaitParameter, GaitPlayed, GraphFacts,
  GraphLive, GraphMachine, GraphParameter, GraphTransition, SpaceFacts, SpacesFacts,
} from '@bindings/surefoot.mjs';

/** Who steers: a patrol up and down the course, or somebody. m/s and deg/s, to the left positive. */
export type Steering = { patrol: number } | { speed: number; lateral: number; turn: number };

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

/** What the module answers is passed on as it is. */
type Forwarded =
  | 'setMode' | 'restart' | 'metrics' | 'scenarios'
  | 'spaces' | 'setThreshold' | 'resetThresholds' | 'blend'
  | 'gaits' | 'gaitSource' | 'gaitRead' | 'gaitPlay' | 'gaitStop' | 'gaitFile'
  | 'graphRead' | 'graphSet' | 'graphLive' | 'jsonEdit';

/** Calls that are answered once, by name. */
export interface Calls extends Pick<Surefoot, Forwarded> {
  start(): void;
  openDefault(): { facts: CharacterFacts; mesh: CharacterMesh };
  openProject(files: [string, Uint8Array][]): { facts: CharacterFacts; mesh: CharacterMesh };
  setCourse(name: string, gradeDeg: number): TerrainMesh;
  ground(): TerrainMesh;
  crowd(count: number): { facts: CrowdFacts; mesh: CrowdMesh };
}

export type CallName = keyof Calls;

export type ToWorker =
  | { kind: 'call'; id: number; name: CallName; args: unknown[] }
  /** Advances; the answer is one frame in `buffer`, which goes back and forth. */
  | { kind: 'advance'; frames: number; parts: number; steering: Steering; buffer: ArrayBuffer }
  /** The same for the crowd. */
  | { kind: 'crowd'; seconds: number; eye: [number, number]; lasting: boolean; buffer: ArrayBuffer };

export type FromWorker =
  | { kind: 'answer'; id: number; result: unknown }
  | { kind: 'failure'; id: number; message: string }
  | { kind: 'frame'; buffer: ArrayBuffer }
  | { kind: 'crowd'; buffer: ArrayBuffer; posed: number; animationMs: number };
