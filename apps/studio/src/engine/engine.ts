// The page's side of the engine: typed calls, and frames that come one at a time.
import type { CallName, Calls, FromWorker, Steering, ToWorker } from './messages';

type Waiting = { resolve: (value: never) => void; reject: (error: Error) => void };

export class EngineClient {
  readonly #worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'surefoot' });
  readonly #waiting = new Map<number, Waiting>();
  #nextId = 1;
  // Frames travel in two buffers: one is shown while the other is filled.
  #spare = new ArrayBuffer(0);
  #shown = new ArrayBuffer(0);
  #frameWaiting: ((frame: Float32Array) => void) | undefined;

  constructor(onCrash: (message: string) => void) {
    this.#worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.#receive(data);
    this.#worker.onerror = (event) => {
      event.preventDefault();
      onCrash(event.message || 'the engine could not be started');
    };
  }

  call<Name extends CallName>(name: Name, ...args: Parameters<Calls[Name]>): Promise<ReturnType<Calls[Name]>> {
    const id = this.#nextId++;
    this.#post({ kind: 'call', id, name, args });
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
  }

  /** True while a frame is on its way: another would have to wait behind it. */
  get busy(): boolean {
    return this.#frameWaiting !== undefined;
  }

  /** So many frames of 1/60 s, or of a `parts`th of that, on. The frame is valid until the next one has come. */
  advance(frames: number, parts: number, steering: Steering): Promise<Float32Array> {
    if (this.busy) throw new Error('one frame at a time');
    this.#post({ kind: 'advance', frames, parts, steering, buffer: this.#spare }, [this.#spare]);
    return new Promise((resolve) => (this.#frameWaiting = resolve));
  }

  #post(message: ToWorker, transfer: Transferable[] = []): void {
    this.#worker.postMessage(message, transfer);
  }

  #receive(message: FromWorker): void {
    if (message.kind === 'frame') {
      this.#spare = this.#shown;
      this.#shown = message.buffer;
      const resolve = this.#frameWaiting;
      this.#frameWaiting = undefined;
      resolve?.(new Float32Array(message.buffer));
      return;
    }
    const waiting = this.#waiting.get(message.id);
    this.#waiting.delete(message.id);
    if (message.kind === 'answer') waiting?.resolve(message.result as never);
    else waiting?.reject(new Error(message.message));
  }
}
