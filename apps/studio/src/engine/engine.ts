// The page's side of the engine: typed calls, and frames that come one at a time.
import type { CallName, Calls, CrowdFrame, FromWorker, Steering, ToWorker } from './messages';

type Waiting = { resolve: (value: never) => void; reject: (error: Error) => void };

/** Why a call failed: somebody wanted no more of it. */
export class Stopped extends Error {}

/** Frames travel in two buffers: one is shown while the other is filled. */
class Exchange<Frame> {
  #spare = new ArrayBuffer(0);
  #shown = new ArrayBuffer(0);
  /** The first one is on its way, the others wait until it is there. */
  readonly #asked: { send: (buffer: ArrayBuffer) => void; resolve: (frame: Frame) => void }[] = [];

  get busy(): boolean {
    return this.#asked.length > 0;
  }

  /** `send` posts the buffer that is free, once the frames that were asked for before have come. */
  ask(send: (buffer: ArrayBuffer) => void): Promise<Frame> {
    return new Promise((resolve) => {
      this.#asked.push({ send, resolve });
      if (this.#asked.length === 1) send(this.#spare);
    });
  }

  arrived(buffer: ArrayBuffer, frame: Frame): void {
    this.#spare = this.#shown;
    this.#shown = buffer;
    this.#asked.shift()?.resolve(frame);
    this.#asked[0]?.send(this.#spare);
  }
}

export class EngineClient {
  readonly #worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'surefoot' });
  readonly #waiting = new Map<number, Waiting>();
  #nextId = 1;
  #stopped = false;
  readonly #frames = new Exchange<Float32Array>();
  readonly #crowds = new Exchange<CrowdFrame>();

  constructor(
    onCrash: (message: string) => void,
    readonly onProgress: (label: string, done: number, total: number) => void = () => {},
  ) {
    this.#worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.#receive(data);
    this.#worker.onerror = (event) => {
      event.preventDefault();
      onCrash(event.message || 'the engine could not be started');
    };
  }

  call<Name extends CallName>(name: Name, ...args: Parameters<Calls[Name]>): Promise<ReturnType<Calls[Name]>> {
    if (this.#stopped) return Promise.reject(new Stopped());
    const id = this.#nextId++;
    this.#post({ kind: 'call', id, name, args });
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
  }

  /** True while a frame is on its way: another would have to wait behind it. */
  get busy(): boolean {
    return this.#frames.busy;
  }

  /** So many frames of 1/60 s, or of a `parts`th of that, on. The frame is valid until the next one has come. */
  advance(frames: number, parts: number, steering: Steering): Promise<Float32Array> {
    return this.#frames.ask((buffer) => this.#post({ kind: 'advance', frames, parts, steering, buffer }, [buffer]));
  }

  get crowdBusy(): boolean {
    return this.#crowds.busy;
  }

  /** One frame of the crowd, seen from x, z [m]. It is valid until the next one has come. */
  advanceCrowd(seconds: number, eye: [number, number], lasting: boolean, feet = true): Promise<CrowdFrame> {
    return this.#crowds.ask((buffer) => this.#post({ kind: 'crowd', seconds, eye, lasting, feet, buffer }, [buffer]));
  }

  get stopped(): boolean {
    return this.#stopped;
  }

  /** Whatever it is at: what was asked of it fails, and what will be. */
  stop(): void {
    this.#stopped = true;
    this.#worker.terminate();
    for (const { reject } of this.#waiting.values()) reject(new Stopped());
    this.#waiting.clear();
  }

  #post(message: ToWorker, transfer: Transferable[] = []): void {
    this.#worker.postMessage(message, transfer);
  }

  #receive(message: FromWorker): void {
    if (message.kind === 'frame') {
      this.#frames.arrived(message.buffer, new Float32Array(message.buffer));
      return;
    }
    if (message.kind === 'crowd') {
      const { buffer, posed, animationMs } = message;
      this.#crowds.arrived(buffer, { texels: new Float32Array(buffer), posed, animationMs });
      return;
    }
    if (message.kind === 'progress') {
      this.onProgress(message.label, message.done, message.total);
      return;
    }
    const waiting = this.#waiting.get(message.id);
    this.#waiting.delete(message.id);
    if (message.kind === 'answer') waiting?.resolve(message.result as never);
    else waiting?.reject(new Error(message.message));
  }
}
