// What the page and the engine's worker say to each other.
import type { CharacterFacts, Surefoot } from '@bindings/surefoot.mjs';

export type {
  CharacterFacts, Figure, FigureValue, Finding, FootMode, FrameLayout, GaitFacts, GaitParameter, GaitPlayed, SpaceFacts,
  SpacesFacts,
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

export interface TerrainMesh {
  positions: Float32Array;
  triangles: Uint32Array;
}

/** What the module answers is passed on as it is. */
type Forwarded =
  | 'setMode' | 'restart' | 'metrics' | 'scenarios'
  | 'spaces' | 'setThreshold' | 'resetThresholds' | 'blend'
  | 'gaits' | 'gaitSource' | 'gaitRead' | 'gaitPlay' | 'gaitStop' | 'gaitFile';

/** Calls that are answered once, by name. */
export interface Calls extends Pick<Surefoot, Forwarded> {
  start(): void;
  openDefault(): { facts: CharacterFacts; mesh: CharacterMesh };
  openProject(files: [string, Uint8Array][]): { facts: CharacterFacts; mesh: CharacterMesh };
  setCourse(name: string, gradeDeg: number): TerrainMesh;
  ground(): TerrainMesh;
}

export type CallName = keyof Calls;

export type ToWorker =
  | { kind: 'call'; id: number; name: CallName; args: unknown[] }
  /** Advances; the answer is one frame in `buffer`, which goes back and forth. */
  | { kind: 'advance'; frames: number; parts: number; steering: Steering; buffer: ArrayBuffer };

export type FromWorker =
  | { kind: 'answer'; id: number; result: unknown }
  | { kind: 'failure'; id: number; message: string }
  | { kind: 'frame'; buffer: ArrayBuffer };
