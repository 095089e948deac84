// How a blend of clips moves, in the page as in the runtime (graph/locomotion.cpp, clip/sample.cpp, space/lookup.cpp):
// barycentric weights of the simplex around a point, one shared phase for all clips that step, its rate
// |sum w v| / |sum w s|, rotations as one weighted sum and one normalisation, feet as feet (report_feet.js).
//
// Nothing in this file knows of a page: Node runs it too and holds it against the C++ (tests/judges/preview.mjs). The data
// are what author/report_preview.cpp writes. Metres, seconds, radians; y up, +z ahead, +x to the left.
'use strict';
const surefootBlend = (() => {
  const k_foot_lever = 0.15; // [m] turning counts by the distance of a foot from the root
  const k_least_weight = 1e-4;
  const k_full_scale = 32767, k_translation_unit = 1e-4; // [m]
  const { dot, plus, minus, length, clamp, normalized, k_identity, product, rotate, solve } = surefootMath;

  // --- reading

  function int16s(base64) {
    const text = atob(base64), bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    const view = new DataView(bytes.buffer), numbers = new Int16Array(bytes.length / 2);
    for (let i = 0; i < numbers.length; ++i) numbers[i] = view.getInt16(2 * i, true);
    return numbers;
  }

  /// Footprints of a side: keys as numbers, [rotation, translation, toes, age] each.
  function footprints({ keys, steps }) {
    const k_units = [1, 1, 1, 1, 0, 0, 0, 1, 1, 1, 1, 0].map((turns) => (turns ? 1 / k_full_scale : k_translation_unit));
    return { keys: Float64Array.from(int16s(keys), (v, i) => v * k_units[i % k_units.length]), steps };
  }

  /// The page's data with its numbers unpacked.
  function read(data) {
    const clips = data.clips.map((clip) => ({
      ...clip,
      feet: clip.feet && { left: footprints(clip.feet.left), right: footprints(clip.feet.right) },
      rotations: int16s(clip.rotations),
      translations: int16s(clip.translations),
      turning: new Set(clip.turning),
    }));
    return { ...data, clips };
  }

  // --- where: weights of the samples around a point

  /// Weights of the corners whose point is nearest to p within their simplex, and how far (squared) it is.
  function nearest(p, corners) {
    const n = corners.length - 1;
    const edges = corners.slice(1).map((corner) => minus(corner, corners[0]));
    const rest = solve(edges.map((a) => [...edges.map((b) => dot(a, b)), dot(a, minus(p, corners[0]))]), n);
    const weights = rest && [1 - rest.reduce((a, b) => a + b, 0), ...rest];
    if (weights && weights.every((w) => w >= -1e-9)) {
      const at = p.map((_, k) => corners.reduce((sum, corner, i) => sum + weights[i] * corner[k], 0));
      const away = minus(p, at);
      return { weights: weights.map((w) => Math.max(w, 0)), square: dot(away, away) };
    }
    let best = { square: Infinity };
    for (let drop = 0; drop <= n; ++drop) {
      if (weights && weights[drop] >= 0) continue; // the nearest face lies opposite a corner of negative weight
      const face = nearest(p, corners.filter((_, k) => k !== drop));
      if (face.square < best.square) best = { square: face.square, weights: [...face.weights.slice(0, drop), 0, ...face.weights.slice(drop)] };
    }
    return best;
  }

  /// { shares: [{ sample, weight }], at, outside, simplex } at a point in axis units; outside the hull, at its nearest point.
  function weightsAt(space, point) {
    const range = space.axes.map((axis) => axis.high - axis.low);
    const tamed = point.map((v, k) =>
      space.axes[k].wraps ? v - Math.floor((v - space.axes[k].low) / range[k]) * range[k] : v);
    const p = tamed.map((v, k) => v / range[k]);
    let best = { square: Infinity };
    for (const simplex of space.simplices) {
      const corners = simplex.map((sample) => space.samples[sample].map((v, k) => v / range[k]));
      const found = nearest(p, corners);
      if (found.square < best.square) best = { ...found, simplex };
      if (best.square === 0) break;
    }
    if (!best.simplex) return { shares: [{ sample: 0, weight: 1 }], at: space.samples[0], outside: true, simplex: [0] };
    const kept = best.weights.map((w) => (w >= k_least_weight ? w : 0));
    const total = kept.reduce((a, b) => a + b, 0);
    const shares = best.simplex.map((sample, k) => ({ sample, weight: kept[k] / total })).filter((s) => s.weight > 0);
    const at = tamed.map((_, k) => shares.reduce((sum, s) => sum + s.weight * space.samples[s.sample][k], 0));
    return { shares, at, outside: best.square > 1e-12, simplex: best.simplex };
  }

  function subsets(items, size) {
    if (size === 0) return [[]];
    return items.flatMap((item, i) => subsets(items.slice(i + 1), size - 1).map((rest) => [item, ...rest]));
  }

  /// What a plane through `point` along two axes cuts out of a space of more: a polygon a simplex that it meets, as points
  /// of all axes in order around their middle. Where the plane meets a face of as many corners as it has fixed axes and one
  /// more, there is a corner of the polygon.
  function slice(space, point, across, up) {
    const fixed = space.axes.map((_, k) => k).filter((k) => k !== across && k !== up);
    const range = space.axes.map((axis) => axis.high - axis.low);
    return space.simplices.flatMap((simplex) => {
      const corners = [];
      for (const face of subsets(simplex, fixed.length + 1)) {
        const at = (sample) => space.samples[sample];
        const rows = fixed.map((k) => [...face.map((sample) => at(sample)[k] / range[k]), point[k] / range[k]]);
        const weights = solve([...rows, [...face.map(() => 1), 1]], face.length);
        if (!weights || weights.some((w) => w < -1e-9)) continue;
        corners.push(point.map((_, k) => face.reduce((sum, sample, i) => sum + weights[i] * at(sample)[k], 0)));
      }
      if (corners.length < 3) return [];
      const middle = point.map((_, k) => corners.reduce((sum, corner) => sum + corner[k] / corners.length, 0));
      const angle = (corner) => Math.atan2((corner[up] - middle[up]) / range[up], (corner[across] - middle[across]) / range[across]);
      return [corners.sort((a, b) => angle(a) - angle(b))];
    });
  }

  // --- when: the shared phase

  /// Time in a clip at a phase, and seconds a cycle just there.
  function phaseTime(clip, phase) {
    const map = clip.phase_map;
    phase -= Math.floor((phase - map[0][1]) / clip.cycles) * clip.cycles;
    let i = 1;
    while (i + 1 < map.length && map[i][1] < phase) ++i;
    const [a, b] = [map[i - 1], map[i]];
    const slope = ((b[0] - a[0]) / (b[1] - a[1])) * clip.seconds;
    return { time: Math.min(Math.max(a[0] * clip.seconds + (phase - a[1]) * slope, 0), clip.seconds), slope };
  }

  const stride = (velocity, turn) => [velocity[0], velocity[2], turn * k_foot_lever];
  const footSpeed = (clip) => length(stride(clip.velocity, clip.turn_rate));
  const phaseIn = (clip, state) => state.phase + (state.cycle % Math.max(clip.cycles, 1));

  /// Velocity, turn and phase rate [cycles/s] of a blend, and the phase that the rate is told for; shares as weightsAt
  /// gives them.
  function motion(data, space, shares, state) {
    const velocity = [0, 0, 0], moved = [0, 0, 0], strides = [0, 0, 0];
    let turn = 0, sizes = 0, stepping = 0, mean = 0, slowest = Infinity, fastest = 0;
    for (const { sample, weight } of shares) {
      const clip = data.clips[space.clips[sample]], v = space.velocities[sample], w = space.turns[sample];
      const placed = stride(v, w);
      for (let k = 0; k < 3; ++k) {
        velocity[k] += weight * v[k];
        moved[k] += weight * placed[k];
      }
      turn += weight * w;
      if (clip.cycles === 0) continue;
      const seconds = phaseTime(clip, phaseIn(clip, state)).slope;
      const own = stride(clip.velocity, clip.turn_rate);
      for (let k = 0; k < 3; ++k) strides[k] += weight * own[k] * seconds;
      sizes += weight * length(own) * seconds;
      stepping += weight;
      // A clip placed at another speed than its own is played that much faster.
      const ratio = length(own) > 0.02 ? clamp(length(placed) / length(own), 0.5, 2) : 1;
      mean += (weight * ratio) / seconds;
      slowest = Math.min(slowest, ratio / seconds);
      fastest = Math.max(fastest, ratio / seconds);
    }
    if (!space.axes.some(({ name }) => name === 'turn')) turn = 0; // the host turns such a character
    const from = { phase: state.phase, cycle: state.cycle };
    if (!(stepping > 0)) return { velocity, turn, rate: 0, from };
    mean /= stepping;
    // Strides that cancel (forward against backward) say nothing about the rate: fade to the mean rate there.
    const told = sizes > 0 ? length(strides) / sizes : 0, t = clamp((told - 0.2) / 0.3, 0, 1), trust = t * t * (3 - 2 * t);
    const rate = trust > 0 ? mean + (clamp(length(moved) / length(strides), slowest, fastest) - mean) * trust : mean;
    return { velocity, turn, rate, from };
  }

  const start = () => ({ phase: 0, cycle: 0, clock: 0, x: 0, z: 0, yaw: 0 });

  /// Where a steady motion leads from the origin.
  function integrate([vx, vy, vz], turn, seconds) {
    const angle = turn * seconds, small = Math.abs(angle) < 1e-4;
    const along = small ? 1 : Math.sin(angle) / angle, across = small ? angle / 2 : (1 - Math.cos(angle)) / angle;
    return { x: seconds * (vx * along + vz * across), y: seconds * vy, z: seconds * (vz * along - vx * across), yaw: angle };
  }

  /// One step of a character; changes `state` and returns what it did.
  function advance(data, space, shares, state, dt) {
    const moves = motion(data, space, shares, state);
    const { x, z, yaw } = integrate(moves.velocity, moves.turn, dt);
    const [s, c] = [Math.sin(state.yaw), Math.cos(state.yaw)];
    state.x += c * x + s * z;
    state.z += c * z - s * x;
    state.yaw += yaw;
    state.clock += dt;
    const phase = state.phase + moves.rate * dt, whole = Math.floor(phase);
    state.cycle += whole;
    state.phase = phase - whole;
    return moves;
  }

  /// Where a clip stands on the character's phase; clips without steps run on its clock, there and back if they do not loop.
  function clipTime(clip, state) {
    if (clip.cycles > 0) return phaseTime(clip, phaseIn(clip, state)).time;
    const period = clip.cyclic ? clip.seconds : 2 * clip.seconds;
    const time = state.clock - Math.floor(state.clock / period) * period;
    return time <= clip.seconds ? time : period - time;
  }

  // --- what: the pose

  function keys(clip, time) {
    const frame = clamp((time / clip.seconds) * (clip.frames - 1), 0, clip.frames - 1);
    const from = Math.min(Math.floor(frame), clip.frames - 2);
    return { from, share: frame - from };
  }

  /// Weighted sum of the clips' rotations and translations, joint by joint: local transforms.
  function blended(data, leaves) {
    const joints = data.body.parents.length, placed = leaves.map((leaf) => ({ ...leaf, ...keys(leaf.clip, leaf.time) }));
    const locals = data.body.rest.map((rest) => ({ rotation: [0, 0, 0, 0], translation: [...rest] }));
    for (const { clip, weight, from, share } of placed) {
      const count = clip.moving.length;
      clip.moving.forEach((joint, i) => {
        for (let k = 0; k < 3; ++k) {
          const a = clip.translations[3 * (from * count + i) + k], b = clip.translations[3 * ((from + 1) * count + i) + k];
          locals[joint].translation[k] += weight * ((a + (b - a) * share) * k_translation_unit - data.body.rest[joint][k]);
        }
      });
    }
    for (let j = 0; j < joints; ++j) {
      // Where a joint turns far from rest, each clip joins on the side of the sum so far.
      const sum = locals[j].rotation, turns = placed.some(({ clip }) => clip.turning.has(j));
      for (const { clip, weight, from, share } of placed) {
        const q = [0, 1, 2, 3].map((k) => {
          const a = clip.rotations[4 * (from * joints + j) + k], b = clip.rotations[4 * ((from + 1) * joints + j) + k];
          return (weight * (a + (b - a) * share)) / k_full_scale;
        });
        const sign = turns && dot(q, sum) < 0 ? -1 : 1;
        for (let k = 0; k < 4; ++k) sum[k] += sign * q[k];
      }
      locals[j].rotation = normalized(sum, k_identity);
    }
    return locals;
  }

  /// Local transforms to places and rotations seen from the root.
  function forward({ parents }, locals) {
    const at = [], turned = [];
    locals.forEach(({ rotation, translation }, j) => {
      const parent = parents[j];
      at[j] = parent < 0 ? translation : plus(at[parent], rotate(turned[parent], translation));
      turned[j] = parent < 0 ? rotation : product(turned[parent], rotation);
    });
    return { at, turned };
  }

  /// Points of the body (its joints, then heels, balls, toe tips and crown) of a blend, seen from the root: an array of
  /// [x, y, z]. `leaves` as leavesOf gives them, `moves` as motion does.
  function points(data, leaves, state, moves) {
    const locals = blended(data, leaves);
    let models = forward(data.body, locals);
    if (surefootFeet.solve(data, leaves, state, moves, locals, models, { footSpeed, phaseIn, phaseTime, integrate }))
      models = forward(data.body, locals);
    const ends = data.body.ends.map(({ joint, offset }) => plus(models.at[joint], rotate(models.turned[joint], offset)));
    return [...models.at, ...ends];
  }

  /// The leaves of a blend at a state: one a clip.
  function leavesOf(data, space, shares, state) {
    const leaves = new Map();
    for (const { sample, weight } of shares) {
      const index = space.clips[sample], clip = data.clips[index];
      const leaf = leaves.get(index) ?? { index, clip, time: clipTime(clip, state), weight: 0 };
      leaf.weight += weight;
      leaves.set(index, leaf);
    }
    return [...leaves.values()];
  }

  return { read, weightsAt, slice, motion, start, advance, leavesOf, points };
})();
if (typeof module !== 'undefined') module.exports = surefootBlend;
