// The engine off the main thread: the C++ of surefoot.wasm, one character on one stage.
import wasmUrl from '@wasm?url';
import { load, type Surefoot } from '@bindings/surefoot.mjs';
import type { Calls, CharacterMesh, FromWorker, TerrainMesh, ToWorker } from './messages';

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
  ground,
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

self.onmessage = ({ data }: MessageEvent<ToWorker>) => {
  if (data.kind === 'call') {
    void answer(data.id, data.name, data.args);
    return;
  }
  const surefoot = running();
  if ('patrol' in data.steering) surefoot.patrol(data.steering.patrol);
  else surefoot.steer(data.steering.speed, data.steering.lateral, data.steering.turn);
  surefoot.advance(data.frames, data.parts);
  const frame = surefoot.array('frame');
  // The one array that a pose is ever copied to: it travels to the page and back again.
  const buffer = data.buffer.byteLength === frame.byteLength ? data.buffer : new ArrayBuffer(frame.byteLength);
  new Float32Array(buffer).set(frame);
  post({ kind: 'frame', buffer }, [buffer]);
};
