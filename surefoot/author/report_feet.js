// Blended legs whose feet are where the blend's feet should be, in the page as in the runtime (graph/foot_blend.cpp,
// ik/two_bone.cpp): footprints are averaged, seen from the blended root, and hip and knee are solved for them.
'use strict';
const surefootFeet = (() => {
  const { dot, plus, minus, times, mix, length, clamp, normalized, k_identity, conjugate, product, aligned, yawed, rotate,
          rotationBetween } = surefootMath;
  const k_sides = ['left', 'right'];

  // --- one leg

  const k_short = 1e-6, k_fold_share = 0.05, k_soft_extension = 0.9975;
  const perpendicular = (v, u) => minus(v, times(u, dot(v, u)));
  const anyPerpendicular = (u) => normalized(perpendicular(Math.abs(u[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0], u), [1, 0, 0]);

  function softLimit(distance, full, free) {
    const start = Math.max(full * k_soft_extension, Math.min(free, full));
    if (distance <= start) return distance;
    const room = full - start;
    if (room <= 1e-7 * full) return start;
    const x = (distance - start) / room;
    return start + (room * x) / (1 + x);
  }

  function kneeDirection({ hip, knee, ankle, kneeForward }, swing, along, offset) {
    const animated = perpendicular(minus(knee, hip), normalized(minus(ankle, hip), [0, -1, 0]));
    const own = perpendicular(rotate(swing, animated), along), animatedOffset = length(animated);
    if (offset <= animatedOffset && animatedOffset > k_short) return normalized(own, anyPerpendicular(along));
    const forward = normalized(perpendicular(rotate(swing, kneeForward), along), [0, 0, 0]);
    return normalized(plus(own, times(forward, offset - animatedOffset)), anyPerpendicular(along));
  }

  /// Rotations to premultiply those of thigh and calf with, so that the ankle comes to `target`.
  function solveTwoBone(leg) {
    const { hip, knee, ankle, target } = leg;
    const still = { upper: k_identity, lower: k_identity };
    const upper = length(minus(hip, knee)), lower = length(minus(knee, ankle)), full = upper + lower;
    if (!(full > k_short) || length(minus(ankle, target)) <= 1e-7 * full) return still;
    const animated = length(minus(hip, ankle)), wanted = length(minus(hip, target));
    const shortest = Math.max(Math.abs(upper - lower), k_fold_share * full);
    const reach = clamp(softLimit(wanted, full, animated), Math.min(shortest, Math.max(animated, k_short)), full);
    const line = normalized(minus(ankle, hip), [0, -1, 0]);
    const along = wanted > k_short ? times(minus(target, hip), 1 / wanted) : line;
    const swing = animated > k_short ? rotationBetween(line, along) : k_identity;
    const below = 2 * upper * reach;
    const cosine = below > 1e-12 ? clamp((upper * upper + reach * reach - lower * lower) / below, -1, 1) : 1;
    const offset = upper * Math.sqrt(Math.max(0, 1 - cosine * cosine));
    const aside = kneeDirection(leg, swing, along, offset);
    const newKnee = plus(hip, plus(times(along, upper * cosine), times(aside, offset)));
    const newAnkle = plus(hip, times(along, reach));
    return {
      upper: product(rotationBetween(rotate(swing, minus(knee, hip)), minus(newKnee, hip)), swing),
      lower: product(rotationBetween(rotate(swing, minus(ankle, knee)), minus(newAnkle, newKnee)), swing),
    };
  }

  // --- footprints

  const k_key = 12; // numbers a key: rotation, translation, toes, age

  function keyAt(clip, side, time) {
    const { keys } = clip.feet[side], last = keys.length / k_key - 1;
    const frame = clamp((time / clip.seconds) * last, 0, last), from = Math.min(Math.floor(frame), last - 1), t = frame - from;
    const a = keys.subarray(k_key * from, k_key * (from + 1)), b = keys.subarray(k_key * (from + 1), k_key * (from + 2));
    const turned = (at) => {
      const p = [...a.subarray(at, at + 4)], q = [...b.subarray(at, at + 4)];
      return normalized(mix(p, aligned(q, p), t), k_identity);
    };
    return { rotation: turned(0), translation: mix([...a.subarray(4, 7)], [...b.subarray(4, 7)], t), toes: turned(7),
             age: a[11] + (b[11] - a[11]) * t };
  }

  /// Where a clip's own step is when the blended one is `share` of its way, of which it stands for `duty`.
  const ownShare = (lift, share, duty) =>
    share < duty ? (share / duty) * lift : lift + ((share - duty) / (1 - duty)) * (1 - lift);

  function standOn(leg, rotation, heel, ball) {
    const t = clamp(0.5 + (0.5 * (heel[1] - ball[1])) / 0.02, 0, 1);
    return mix(minus(heel, rotate(rotation, leg.heel)), minus(ball, rotate(rotation, leg.ball)), t * t * (3 - 2 * t));
  }

  /// A place of the sole as the clips have it. Clips that stand keep a stepping foot where it is, but not on the ground.
  class SoleMean {
    constructor() {
      this.sum = [0, 0, 0];
      this.stepping = this.lift = 0;
    }
    add(place, weight, steps) {
      this.sum = plus(this.sum, times(place, weight));
      if (steps) this.stepping += weight, this.lift += place[1] * weight;
    }
    mean() {
      const { stepping, lift, sum: [x, y, z] } = this, half = 0.15;
      if (!(stepping > 0 && stepping < 1)) return this.sum;
      const share = (stepping * (1 + half)) / (stepping + half);
      return [x, share * (lift / stepping) + (1 - share) * ((y - lift) / (1 - stepping)), z];
    }
  }

  function meanKey(leg, leaves, side, strike, share, phaseTime) {
    let stance = 0, duration = 0;
    for (const { step, say } of leaves)
      if (step) stance += say * step.duration_s * step.lift, duration += say * step.duration_s;
    const duty = duration > 0 ? clamp(stance / duration, 0.05, 0.95) : 0.5;
    const sum = { rotation: [0, 0, 0, 0], toes: [0, 0, 0, 0], age: 0 }, heel = new SoleMean(), ball = new SoleMean();
    for (const { clip, weight, say, time, step, at } of leaves) {
      const own = step ? phaseTime(clip, strike + at + ownShare(step.lift, share, duty)).time : time;
      const key = keyAt(clip, side, own);
      const print = (offset) => plus(key.translation, rotate(key.rotation, offset));
      heel.add(print(leg.heel), weight, step);
      ball.add(print(leg.ball), weight, step);
      sum.rotation = plus(sum.rotation, times(aligned(key.rotation, sum.rotation), weight));
      sum.toes = plus(sum.toes, times(aligned(key.toes, sum.toes), weight));
      sum.age += key.age * say;
    }
    const rotation = normalized(sum.rotation, k_identity);
    return { rotation, translation: standOn(leg, rotation, heel.mean(), ball.mean()), toes: normalized(sum.toes, k_identity), age: sum.age };
  }

  /// Changes the legs' local rotations. `blend` lends what it knows of phases: { footSpeed, phaseIn, phaseTime, integrate }.
  function solve(data, leaves, state, moves, locals, models, blend) {
    const { legs } = data.body;
    if (!legs || leaves.length < 2 || leaves.some(({ clip }) => !clip.feet)) return false;
    k_sides.forEach((side, s) => {
      const strike = s === 0 ? 0 : 0.5, after = state.phase - strike, before = after < 0 ? 1 : 0, leg = legs[side];
      const told = leaves.map((leaf) => {
        const { clip, weight } = leaf, speed = clip.cycles > 0 ? Math.max(blend.footSpeed(clip), 1e-3) : 0;
        const at = clip.cycles > 0 ? (((state.cycle - before) % clip.cycles) + clip.cycles) % clip.cycles : 0;
        return { ...leaf, say: weight * speed, at, step: clip.cycles > 0 ? clip.feet[side].steps[at] : null };
      });
      const says = told.reduce((sum, { say }) => sum + say, 0);
      for (const leaf of told) leaf.say = says > 0 ? leaf.say / says : 0;
      const key = meanKey(leg, told, side, strike, after + before, blend.phaseTime);
      const seconds = told.reduce((sum, { clip, say, step }) =>
        step ? sum + say * blend.phaseTime(clip, blend.phaseIn(clip, moves.from)).slope : sum, 0);
      const pace = seconds * moves.rate > 0 ? clamp(seconds * moves.rate, 0.25, 4) : 1;
      const moved = blend.integrate(moves.velocity, moves.turn, key.age / pace), back = yawed(-moved.yaw);
      const foot = product(back, key.rotation), target = rotate(back, minus(key.translation, [moved.x, moved.y, moved.z]));
      const { at, turned } = models, parent = (joint) => turned[data.body.parents[joint]] ?? k_identity;
      const solved = solveTwoBone({ hip: at[leg.upper], knee: at[leg.lower], ankle: at[leg.foot], target,
                                    kneeForward: rotate(turned[leg.upper], leg.knee_forward) });
      locals[leg.upper].rotation = product(conjugate(parent(leg.upper)), product(solved.upper, turned[leg.upper]));
      locals[leg.lower].rotation =
        product(conjugate(product(solved.upper, parent(leg.lower))), product(solved.lower, turned[leg.lower]));
      locals[leg.foot].rotation = product(conjugate(product(solved.lower, parent(leg.foot))), foot);
      if (leg.toes >= 0) locals[leg.toes].rotation = key.toes;
    });
    return true;
  }

  return { solve };
})();
