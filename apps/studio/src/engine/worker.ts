// The engine off the main thread: the C++ of surefoot.wasm, one character on one stage.
import wasmUrl from '@wasm?url';
import { load, type Surefoot } from '@bindings/surefoot.mjs';
import { k_crowd_row, type CallName, type Calls, type CharacterMesh, type CrowdMesh, type FromWorker, type TerrainMesh, type ToWorker } from './messages';

let engine: Surefoot | undefined;

function running(): Surefoot {
  if (!engine) throw new Error('the engine has not started yet');
  return engine;
}

function mesh(): CharacterMesh {
  const surefoot = running();
  return {
    positions: surefoot.array('positions').slice(),
    normals: surefoot.array('normals').slice(),
    joints: surefoot.array('joints').slice(),
    weights: surefoot.array('weights').slice(),
    triangles: surefoot.array('triangles').slice(),
    inverseBind: surefoot.array('inverseBind').slice(),
  };
}

function crowdMesh(): CrowdMesh {
  const surefoot = running();
  return {
    positions: surefoot.array('crowdPositions').slice(),
    normals: surefoot.array('crowdNormals').slice(),
    joints: surefoot.array('crowdJoints').slice(),
    weights: surefoot.array('crowdWeights').slice(),
    triangles: surefoot.array('crowdTriangles').slice(),
  };
}

function crowdGround(): TerrainMesh {
  const surefoot = running();
  return { positions: surefoot.array('crowdTerrain').slice(), triangles: surefoot.array('crowdTerrainTriangles').slice() };
}

/** As it was given last. */
let given = new Float32Array(0);

function ground(): TerrainMesh {
  given = running().array('terrain').slice();
  return { positions: given.slice(), triangles: running().array('terrainTriangles').slice() };
}

function isGiven(): boolean {
  const now = running().array('terrain');
  return now.length === given.length && now.every((value, i) => value === given[i]);
}

async function start(): Promise<void> {
  const response = await fetch(wasmUrl);
  if (!response.ok) throw new Error(`the engine's file could not be fetched (${response.status} ${response.statusText})`);
  engine = await load(await response.arrayBuffer(), tellProgress);
}

const k_told_every_ms = 50;
let told = 0;

/** Not more often than anybody can see. */
function tellProgress(label: string, done: number, total: number): void {
  const now = performance.now();
  if (done > 0 && done < total && now < told + k_told_every_ms) return;
  told = now;
  post({ kind: 'progress', label, done, total });
}

type Own = Exclude<CallName, keyof Surefoot> | 'openDefault' | 'openPack' | 'setCourse' | 'gaitPlay' | 'gaitRig' | 'gaitStop' | 'crowd';

/** Calls that are more than one of the module's; all others are passed on as they are. */
const calls: { [Name in Own]: (...args: Parameters<Calls[Name]>) => ReturnType<Calls[Name]> | Promise<void> } = {
  start,
  openDefault: () => ({ facts: running().openDefault(), mesh: mesh() }),
  openPack: (bytes) => ({ facts: running().openPack(bytes), mesh: mesh() }),
  setCourse(name, gradeDeg) {
    running().setCourse(name, gradeDeg);
    return ground();
  },
  gaitPlay(values, speed, turn, slope) {
    running().gaitPlay(values, speed, turn, slope);
    return { frame: running().array('frame').slice(), curves: running().array('gaitCurves').slice(), ground: isGiven() ? null : ground() };
  },
  gaitRig(name, values) {
    const { gait, character } = running().gaitRig(name, values);
    return { gait, shown: character && { facts: character, mesh: mesh() } };
  },
  gaitStop() {
    const facts = running().gaitStop();
    return facts && { facts, mesh: mesh() };
  },
  ground,
  crowd: (count, on) => ({ facts: running().crowd(count, on), mesh: crowdMesh(), ground: crowdGround() }),
};

const post = (message: FromWorker, transfer: Transferable[] = []) =>
  (self as unknown as Worker).postMessage(message, transfer);

type AnyCall = (...args: unknown[]) => unknown;

async function answer(id: number, name: CallName, args: unknown[]): Promise<void> {
  try {
    const own = (calls as Partial<Record<CallName, AnyCall>>)[name];
    const result = own ? await own(...args) : (running()[name as keyof Surefoot] as AnyCall).apply(running(), args);
    post({ kind: 'answer', id, result });
  } catch (error) {
    post({ kind: 'failure', id, message: error instanceof Error ? error.message : String(error) });
  }
}

function steerTo(space: string, at: number[]): void {
  try {
    running().steerTo(space, at);
  } catch {
    // Somebody else has come on the stage, and where to go in the new spaces is on its way.
  }
}

/** The one array that poses are ever copied to: it travels to the page and back again. */
const roomFor = (bytes: number, buffer: ArrayBuffer) => (buffer.byteLength === bytes ? buffer : new ArrayBuffer(bytes));

function advance({ frames, parts, steering, buffer: given }: Extract<ToWorker, { kind: 'advance' }>): void {
  const surefoot = running();
  if ('patrol' in steering) surefoot.patrol(steering.patrol);
  else if ('space' in steering) steerTo(steering.space, steering.at);
  else surefoot.steer(steering.speed, steering.lateral, steering.turn);
  surefoot.advance(frames, parts);
  const frame = surefoot.array('frame');
  const buffer = roomFor(frame.byteLength, given);
  new Float32Array(buffer).set(frame);
  post({ kind: 'frame', buffer }, [buffer]);
}

function advanceCrowd({ seconds, eye, lasting, feet, buffer: given }: Extract<ToWorker, { kind: 'crowd' }>): void {
  const surefoot = running();
  const begun = performance.now();
  const posed = surefoot.crowdAdvance(seconds, eye[0], eye[1], lasting, feet);
  const animationMs = performance.now() - begun;
  const roots = surefoot.array('crowdRoots'), matrices = surefoot.array('crowdMatrices');
  const rows = Math.ceil((roots.length + matrices.length) / (4 * k_crowd_row));
  const buffer = roomFor(rows * 16 * k_crowd_row, given);
  const texels = new Float32Array(buffer);
  texels.set(roots);
  texels.set(matrices, roots.length);
  post({ kind: 'crowd', buffer, posed, animationMs }, [buffer]);
}

self.onmessage = ({ data }: MessageEvent<ToWorker>) => {
  if (data.kind === 'call') void answer(data.id, data.name, data.args);
  else if (data.kind === 'advance') advance(data);
  else advanceCrowd(data);
};
