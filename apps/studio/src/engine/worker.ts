// The engine off the main thread: the C++ of surefoot.wasm, one character on one stage.
import wasmUrl from '@wasm?url';
import { load, type Surefoot } from '@bindings/surefoot.mjs';
import { k_crowd_row, type Calls, type CharacterMesh, type CrowdMesh, type FromWorker, type TerrainMesh, type ToWorker } from './messages';

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

function ground(): TerrainMesh {
  return { positions: running().array('terrain').slice(), triangles: running().array('terrainTriangles').slice() };
}

async function start(): Promise<void> {
  const response = await fetch(wasmUrl);
  if (!response.ok) throw new Error(`the engine's file could not be fetched (${response.status} ${response.statusText})`);
  engine = await load(await response.arrayBuffer());
}

const calls: { [Name in keyof Calls]: (...args: Parameters<Calls[Name]>) => ReturnType<Calls[Name]> | Promise<void> } = {
  start,
  openDefault: () => ({ facts: running().openDefault(), mesh: mesh() }),
  openProject: (files) => ({ facts: running().openProject(files), mesh: mesh() }),
  setCourse(name, gradeDeg) {
    running().setCourse(name, gradeDeg);
    return ground();
  },
  setMode: (mode) => running().setMode(mode),
  restart: () => running().restart(),
  metrics: () => running().metrics(),
  scenarios: () => running().scenarios(),
  spaces: () => running().spaces(),
  setThreshold: (rule, threshold, value) => running().setThreshold(rule, threshold, value),
  resetThresholds: () => running().resetThresholds(),
  blend: (space, at) => running().blend(space, at),
  gaits: () => running().gaits(),
  gaitSource: (name) => running().gaitSource(name),
  gaitRead: (text) => running().gaitRead(text),
  gaitPlay: (values, speed, turn) => running().gaitPlay(values, speed, turn),
  gaitStop: () => running().gaitStop(),
  gaitFile: (format) => running().gaitFile(format),
  graphRead: (text) => running().graphRead(text),
  graphSet: (parameter, value) => running().graphSet(parameter, value),
  graphLive: () => running().graphLive(),
  jsonEdit: (text, pointer, value) => running().jsonEdit(text, pointer, value),
  ground,
  crowd: (count) => ({ facts: running().crowd(count), mesh: crowdMesh() }),
};

const post = (message: FromWorker, transfer: Transferable[] = []) =>
  (self as unknown as Worker).postMessage(message, transfer);

async function answer(id: number, name: keyof Calls, args: unknown[]): Promise<void> {
  try {
    const call = calls[name] as (...args: unknown[]) => unknown;
    post({ kind: 'answer', id, result: await call(...args) });
  } catch (error) {
    post({ kind: 'failure', id, message: error instanceof Error ? error.message : String(error) });
  }
}

/** The one array that poses are ever copied to: it travels to the page and back again. */
const roomFor = (bytes: number, buffer: ArrayBuffer) => (buffer.byteLength === bytes ? buffer : new ArrayBuffer(bytes));

function advance({ frames, parts, steering, buffer: given }: Extract<ToWorker, { kind: 'advance' }>): void {
  const surefoot = running();
  if ('patrol' in steering) surefoot.patrol(steering.patrol);
  else surefoot.steer(steering.speed, steering.lateral, steering.turn);
  surefoot.advance(frames, parts);
  const frame = surefoot.array('frame');
  const buffer = roomFor(frame.byteLength, given);
  new Float32Array(buffer).set(frame);
  post({ kind: 'frame', buffer }, [buffer]);
}

function advanceCrowd({ seconds, eye, lasting, buffer: given }: Extract<ToWorker, { kind: 'crowd' }>): void {
  const surefoot = running();
  const begun = performance.now();
  const posed = surefoot.crowdAdvance(seconds, eye[0], eye[1], lasting);
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
