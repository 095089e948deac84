// three.js at the work of bench_peers: an AnimationMixer and a tree of bones for each character.
//   bench_peers --write-hero hero.json && node --max-old-space-size=12000 bench/peers/three.mjs hero.json
// Writes what Google Benchmark would, so that one table can be made of both.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

// three.js is a package of the judges' folder, where the tests have it too.
const three_at = createRequire(new URL('../../tests/judges/package.json', import.meta.url)).resolve('three');
const THREE = await import(three_at.replace(/three\.cjs$/, 'three.module.js'));

const hero = JSON.parse(readFileSync(process.argv[2], 'utf8'));
const joints = hero.joints.length;

const clips = hero.clips.map((clip, i) => new THREE.AnimationClip(`clip${i}`, hero.times.at(-1), [
  new THREE.VectorKeyframeTrack(`${hero.joints[0].name}.position`, hero.times, clip.translations.flat()),
  ...clip.rotations.map((keys, j) =>
    new THREE.QuaternionKeyframeTrack(`${hero.joints[j].name}.quaternion`, hero.times, keys.flat())),
]));

class Character {
  constructor() {
    this.root = new THREE.Object3D();
    this.bones = [];
    for (const { name, parent, translation, rotation } of hero.joints) {
      const bone = new THREE.Bone();
      bone.name = name;
      bone.position.fromArray(translation);
      bone.quaternion.fromArray(rotation);
      (parent < 0 ? this.root : this.bones[parent]).add(bone);
      this.bones.push(bone);
    }
    this.mixer = new THREE.AnimationMixer(this.root);
    this.actions = clips.map((clip) => this.mixer.clipAction(clip).play());
  }
  pose({ seconds, weights }, out, from) {
    this.actions.forEach((action, i) => {
      action.time = seconds;
      action.setEffectiveWeight(weights[i]);
    });
    this.mixer.update(0);
    this.root.updateMatrixWorld(true);
    for (let j = 0; j < joints; ++j) {
      const m = this.bones[j].matrixWorld.elements;
      for (let k = 0; k < 12; ++k) out[from + 12 * j + k] = m[(k % 4) * 4 + (k >> 2)];
    }
  }
}

// As moment() of peer.cpp.
function moment(character, frame) {
  const t = frame / 60 + 0.137 * (character % 97);
  const parts = [1 + Math.sin(0.7 * t), 1 + Math.sin(1.1 * t + 2), 1 + Math.sin(0.9 * t + 4)];
  const sum = parts[0] + parts[1] + parts[2];
  return { seconds: t - Math.floor(t), weights: parts.map((part) => part / sum) };
}

function worst_mm(poses) {
  const character = new Character(), out = new Float32Array(12 * joints);
  let worst = 0;
  for (const pose of poses) {
    character.pose(pose, out, 0);
    pose.places.forEach((place, j) => {
      worst = Math.max(worst, 1000 * Math.hypot(...place.map((x, k) => out[12 * j + 4 * k + 3] - x)));
    });
  }
  return worst;
}

const single_clip_mm = worst_mm(hero.single_clips), mixed_mm = worst_mm(hero.mixes);
if (!(single_clip_mm < 1)) {
  console.error(`three.mjs: its pose of one clip differs from ours by ${single_clip_mm} mm`);
  process.exit(1);
}

const benchmarks = [];
for (const count of [100, 10000]) {
  const crowd = Array.from({ length: count }, () => new Character());
  const out = new Float32Array(12 * joints * count);
  let frame = 0;
  const play = () => {
    ++frame;
    crowd.forEach((character, c) => character.pose(moment(c, frame), out, 12 * joints * c));
  };
  for (let i = 0; i < Math.max(1, 2000 / count); ++i) play();  // until it is compiled
  const frames = Math.max(1, 5000 / count), began = process.cpuUsage();
  for (let i = 0; i < frames; ++i) play();
  const { user, system } = process.cpuUsage(began);
  benchmarks.push({ name: `three.js/characters:${count}`, run_type: 'iteration', single_clip_mm, mixed_mm,
                    us_per_character: (user + system) / (frames * count) });
}
console.log(JSON.stringify({ context: { executable: `three.js ${THREE.REVISION}` }, benchmarks }));
