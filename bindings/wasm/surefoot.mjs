// Loads surefoot.wasm, in a browser or in Node, and gives its C functions a JavaScript face. Written by hand: the module
// is stand-alone, so there is no generated code to carry along.
//
//   const surefoot = await load(bytes);            // an ArrayBuffer or a typed array
//   const facts = surefoot.analyzeBvh(text);       // throws Error with Surefoot's message
//   const space = surefoot.space([[0, 0], [1.4, 0], [1.4, 45]], [0, -90], [5, 90]);
//   space.weights([0.7, 10]);                      // [{ sample, weight }, …], adding up to 1
//   surefoot.openDefault();                        // a character on a stage …
//   surefoot.setCourse('stairs_up', 15);
//   surefoot.advance(60);                          // … walks for a second
//   surefoot.array('frame');                       // where its joints are, as a view upon the module's memory
//
// surefoot.d.mts has the types.

const k_no_such_call = 52; // WASI's ENOSYS: the module has no files and no system to call

/** What the module imports: our own word of progress, and a few WASI calls, of which only clocks and output mean anything here. */
function imports(module, memory, onProgress) {
  const print = { 1: '', 2: '' };
  const known = {
    proc_exit(code) {
      throw new Error(`surefoot.wasm ended with code ${code}`);
    },
    fd_write(fd, vectors, count, written) {
      const view = new DataView(memory().buffer);
      let total = 0;
      for (let i = 0; i < count; ++i) {
        const at = view.getUint32(vectors + 8 * i, true);
        const size = view.getUint32(vectors + 8 * i + 4, true);
        print[fd] = (print[fd] ?? '') + new TextDecoder().decode(new Uint8Array(memory().buffer, at, size));
        total += size;
      }
      for (let end; (end = print[fd].indexOf('\n')) >= 0; print[fd] = print[fd].slice(end + 1))
        console.error(print[fd].slice(0, end));
      view.setUint32(written, total, true);
      return 0;
    },
    environ_sizes_get(count, size) {
      const view = new DataView(memory().buffer);
      view.setUint32(count, 0, true);
      view.setUint32(size, 0, true);
      return 0;
    },
    environ_get: () => 0,
    clock_time_get(clock, precision, time) {
      new DataView(memory().buffer).setBigUint64(time, BigInt(Math.round(performance.now() * 1e6)), true);
      return 0;
    },
    emscripten_notify_memory_growth() {},
    progress(label, size, done, total) {
      onProgress?.(new TextDecoder().decode(new Uint8Array(memory().buffer, label, size).slice()), done, total);
    },
  };
  const wanted = {};
  for (const { module: from, name, kind } of WebAssembly.Module.imports(module)) {
    wanted[from] ??= {};
    if (kind === 'function') wanted[from][name] = known[name] ?? (() => k_no_such_call);
  }
  return wanted;
}

const k_modes = ['none', 'colvin2013', 'surefoot'];

// In the order of module.cpp's Array.
const k_arrays = {
  frame: Float32Array,
  positions: Float32Array,
  normals: Float32Array,
  joints: Uint16Array,
  weights: Float32Array,
  triangles: Uint32Array,
  inverseBind: Float32Array,
  terrain: Float32Array,
  terrainTriangles: Uint32Array,
  crowdRoots: Float32Array,
  crowdMatrices: Float32Array,
  crowdPositions: Float32Array,
  crowdNormals: Float32Array,
  crowdJoints: Uint16Array,
  crowdWeights: Float32Array,
  crowdTriangles: Uint32Array,
  crowdTerrain: Float32Array,
  crowdTerrainTriangles: Uint32Array,
  gaitCurves: Float32Array,
};

class Surefoot {
  #c;

  constructor(exports) {
    this.#c = exports;
  }

  /** Hashes of fixed scenarios, as text; a native build gives the same. */
  scenarios() {
    return this.#text(this.#c.sf_scenarios());
  }

  /** What the clip in a BVH text does: one entry of `surefoot analyze --json`. */
  analyzeBvh(text) {
    return JSON.parse(this.#named('sf_analyze_bvh', text));
  }

  /** A blend space: samples and the axes' limits, each an array of as many numbers as there are axes. */
  space(samples, low, high) {
    const arrays = [samples.flat(), low, high].map((numbers) => new Float32Array(numbers));
    this.#with(arrays, (values, lows, highs) =>
      this.#text(this.#c.sf_space(low.length, values, samples.length, lows, highs)),
    );
    return { weights: (point) => this.#weights(point) };
  }

  /** Puts the character of the bundled gaits on the stage. */
  openDefault() {
    return JSON.parse(this.#text(this.#c.sf_open_default()));
  }

  /** The same with that of a pack. */
  openPack(bytes) {
    return this.#with([bytes], (at) => JSON.parse(this.#text(this.#c.sf_open_pack(at, bytes.byteLength))));
  }

  setCourse(name, gradeDeg) {
    this.#named('sf_course', name, gradeDeg);
  }

  setMode(mode) {
    this.#c.sf_mode(k_modes.indexOf(mode));
  }

  steer(speed, lateral, turn) {
    this.#c.sf_steer(speed, lateral, turn);
  }

  /** As it is at a place of a space. */
  steerTo(space, at) {
    this.#placed('sf_steer_to', space, at);
  }

  patrol(speed) {
    this.#c.sf_patrol(speed);
  }

  restart() {
    this.#c.sf_restart();
  }

  advance(frames, parts = 1) {
    this.#c.sf_advance(frames, parts);
  }

  metrics() {
    return JSON.parse(this.#text(this.#c.sf_metrics()));
  }

  /** Which clips play on the stage at a place of a space, heaviest first. */
  blend(space, at) {
    return JSON.parse(this.#placed('sf_blend', space, at));
  }

  /** Puts the project of the bundled gaits on the bench. */
  benchDefault() {
    return JSON.parse(this.#text(this.#c.sf_bench_default()));
  }

  /**
   * The same with one that `author` wrote: the bytes of its files by name, "project.json" and "clips/…". They are as on
   * disk, or unsaved work that was kept elsewhere.
   */
  benchOpen(files, onDisk = true) {
    this.#put(files);
    return JSON.parse(this.#text(this.#c.sf_bench_open(onDisk ? 1 : 0)));
  }

  /** The same with one that is made of clips. */
  benchAuthor(files, name) {
    this.#put(files);
    return JSON.parse(this.#named('sf_bench_author', name));
  }

  bench() {
    return JSON.parse(this.#text(this.#c.sf_bench()));
  }

  benchPack() {
    return this.#bytes(this.#c.sf_bench_pack());
  }

  /** Another threshold of a rule, or all back to the project's own. */
  benchThreshold(rule, threshold, value) {
    return JSON.parse(this.#named('sf_bench_threshold', `${rule}.${threshold}=${value}`));
  }

  benchResetThresholds() {
    return JSON.parse(this.#named('sf_bench_threshold', ''));
  }

  benchFix(id = '') {
    return JSON.parse(this.#named('sf_bench_fix', id));
  }

  benchTakeBack(repair) {
    return JSON.parse(this.#named('sf_bench_take_back', repair));
  }

  benchLeaveOut(clip, out) {
    return JSON.parse(this.#named('sf_bench_leave_out', clip, out ? 1 : 0));
  }

  benchUndo() {
    return JSON.parse(this.#text(this.#c.sf_bench_undo(0)));
  }

  benchRedo() {
    return JSON.parse(this.#text(this.#c.sf_bench_undo(1)));
  }

  benchProbe(grid = 0) {
    return JSON.parse(this.#text(this.#c.sf_bench_probe(grid)));
  }

  benchHeat() {
    return JSON.parse(this.#text(this.#c.sf_bench_heat()));
  }

  benchFiles(all) {
    const { files, gone } = JSON.parse(this.#text(this.#c.sf_bench_files(all ? 1 : 0)));
    return { files: files.map((name) => [name, this.#namedBytes('sf_bench_file', name)]), gone };
  }

  benchSaved() {
    this.#c.sf_bench_saved();
  }

  gaits() {
    return JSON.parse(this.#text(this.#c.sf_gaits()));
  }

  gaitSource(name) {
    return this.#named('sf_gait_source', name);
  }

  /** The character goes in the gait of this text from now on. */
  gaitRead(text) {
    return JSON.parse(this.#named('sf_gait_read', text));
  }

  /** The same of a bundled one that was fitted to motion. */
  gaitFitted(name) {
    return JSON.parse(this.#named('sf_gait_fitted', name));
  }

  /** In the same gait with other values, one a parameter; a speed of 0 is its own. */
  gaitPlay(values, speed, turn, slope) {
    this.#with([new Float64Array(values)], (at) =>
      this.#text(this.#c.sf_gait_play(at, values.length, speed, turn, slope)),
    );
  }

  /** What a personality's text sets the sliders of fitted gaits to. */
  gaitPersonality(text) {
    return JSON.parse(this.#named('sf_gait_personality', text));
  }

  rigs() {
    return JSON.parse(this.#text(this.#c.sf_rigs()));
  }

  /** The gait on the body of a template with these values, one a parameter, or, without a name, on the character's. */
  gaitRig(name, values) {
    const text = new TextEncoder().encode(name);
    return this.#with([text, new Float64Array(values)], (at, numbers) =>
      JSON.parse(this.#text(this.#c.sf_gait_rig(at, text.length, numbers, values.length))),
    );
  }

  /** What it does now: measured, which takes longer than to play it. */
  gaitPlayed() {
    return JSON.parse(this.#text(this.#c.sf_gait_played()));
  }

  /** By its own clips again. */
  gaitStop() {
    return JSON.parse(this.#text(this.#c.sf_gait_stop()));
  }

  /** The gait's clip as the bytes of a file, 'bvh' or 'glb'. */
  gaitFile(format) {
    return this.#bytes(this.#c.sf_gait_file(format === 'bvh' ? 0 : 1));
  }

  /** The character goes as the graph of this text says from now on. */
  graphRead(text) {
    const bytes = new TextEncoder().encode(text);
    return this.#with([bytes], (at) => JSON.parse(this.#text(this.#c.sf_graph_read(at, bytes.length))));
  }

  graphSet(parameter, value) {
    this.#c.sf_graph_set(parameter, value);
  }

  graphLive() {
    return JSON.parse(this.#text(this.#c.sf_graph_live()));
  }

  /** A JSON text with another value at a pointer, and every other byte as it was. */
  jsonEdit(text, pointer, value) {
    const parts = [text, pointer, value].map((each) => new TextEncoder().encode(each));
    return this.#with(parts, (...at) =>
      this.#text(this.#c.sf_json_edit(...at.flatMap((place, i) => [place, parts[i].length]))),
    );
  }

  /** A JSON text without what is at a pointer. */
  jsonRemove(text, pointer) {
    const parts = [text, pointer].map((each) => new TextEncoder().encode(each));
    return this.#with(parts, (...at) =>
      this.#text(this.#c.sf_json_remove(...at.flatMap((place, i) => [place, parts[i].length]))),
    );
  }

  /** So many of the character on the stage, on a ground. */
  crowd(count, ground = 'flat') {
    const name = new TextEncoder().encode(ground);
    return this.#with([name], (at) => JSON.parse(this.#text(this.#c.sf_crowd(count, at, name.length))));
  }

  crowdAdvance(seconds, eyeX, eyeZ, lasting, feet = true) {
    return this.#c.sf_crowd_advance(seconds, eyeX, eyeZ, lasting ? 1 : 0, feet ? 1 : 0);
  }

  /** Gives files to the next call that opens some. */
  #put(files) {
    for (const [name, bytes] of files) {
      const text = new TextEncoder().encode(name);
      this.#with([text, bytes], (at, from) => this.#c.sf_put_file(at, text.length, from, bytes.byteLength));
    }
  }

  /** A call whose first argument is a text. */
  #namedBytes(call, text, ...rest) {
    const bytes = new TextEncoder().encode(text);
    return this.#with([bytes], (at) => this.#bytes(this.#c[call](at, bytes.length, ...rest)));
  }

  /** A call about a place of a space. */
  #placed(call, space, at) {
    const name = new TextEncoder().encode(space), point = new Float32Array(at);
    return this.#with([name, point], (text, place) => this.#text(this.#c[call](text, name.length, place, point.length)));
  }

  #named(call, text, ...rest) {
    return new TextDecoder().decode(this.#namedBytes(call, text, ...rest));
  }

  /** A view upon the module's memory: read it at once, the next call may move it. */
  array(name) {
    const index = Object.keys(k_arrays).indexOf(name), type = k_arrays[name];
    const size = this.#c.sf_array_bytes(index) / type.BYTES_PER_ELEMENT;
    return new type(this.#c.memory.buffer, size ? this.#c.sf_array(index) : 0, size);
  }

  #weights(point) {
    const arrays = [new Float32Array(point), new Int32Array(5), new Float32Array(5)];
    return this.#with(arrays, (at, samples, weights) => {
      const count = this.#c.sf_weights(at, samples, weights);
      const buffer = this.#c.memory.buffer;
      const found = new Int32Array(buffer, samples, count);
      const shares = new Float32Array(buffer, weights, count);
      return Array.from(found, (sample, i) => ({ sample, weight: shares[i] }));
    });
  }

  /** Copies arrays into the module's memory for the time of a call. */
  #with(arrays, call) {
    const places = arrays.map((array) => {
      const at = this.#c.sf_allocate(Math.max(array.byteLength, 1));
      if (at === 0) throw new Error('surefoot.wasm is out of memory');
      new Uint8Array(this.#c.memory.buffer, at, array.byteLength).set(
        new Uint8Array(array.buffer, array.byteOffset, array.byteLength),
      );
      return at;
    });
    try {
      return call(...places);
    } finally {
      places.forEach((at) => this.#c.sf_free(at));
    }
  }

  #text(status) {
    return new TextDecoder().decode(this.#bytes(status));
  }

  #bytes(status) {
    const bytes = new Uint8Array(this.#c.memory.buffer, this.#c.sf_text(), this.#c.sf_text_size()).slice();
    if (status !== 0) throw new Error(new TextDecoder().decode(bytes));
    return bytes;
  }
}

export async function load(bytes, onProgress) {
  const module = await WebAssembly.compile(bytes);
  let instance;
  instance = await WebAssembly.instantiate(
    module,
    imports(module, () => instance.exports.memory, onProgress),
  );
  instance.exports._initialize?.();
  return new Surefoot(instance.exports);
}
