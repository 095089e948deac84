// What the page and the engine's worker say to each other.
import type { CharacterFacts, FigureValue, FootMode, GaitFacts, GaitPlayed, SpacesFacts } from '@bindings/surefoot.mjs';

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

/** Calls that are answered once, by name. */
export interface Calls {
  start(): void;
  openDefault(): { facts: CharacterFacts; mesh: CharacterMesh };
  openProject(files: [string, Uint8Array][]): { facts: CharacterFacts; mesh: CharacterMesh };
  setCourse(name: string, gradeDeg: number): TerrainMesh;
  setMode(mode: FootMode): void;
  restart(): void;
  metrics(): FigureValue[] | null;
  scenarios(): string;
  spaces(): SpacesFacts;
  setThreshold(rule: string, threshold: string, value: number): SpacesFacts;
  resetThresholds(): SpacesFacts;
  blend(space: number, at: number[]): { clip: string; weight: number }[];
  gaits(): { name: string; help: string }[];
  gaitSource(name: string): string;
  gaitRead(text: string): GaitFacts;
  gaitPlay(values: number[], speed: number, turn: number): GaitPlayed;
  gaitStop(): void;
  gaitFile(format: 'bvh' | 'glb'): Uint8Array<ArrayBuffer>;
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
