// Asks Khronos' validator and three.js about .glb files, and the SARIF schema about lint's.
//
//   node judge.mjs valid  FILE.glb|FOLDER...      no errors by the Khronos glTF validator
//   node judge.mjs places FILE.json|FOLDER...     three.js puts every joint of every frame where the JSON says
//   node judge.mjs sarif  FILE.sarif|FOLDER...    valid by the JSON schema of SARIF 2.1.0, and with results in it
//   node judge.mjs graph  FILE.json|FOLDER...     a graph by docs/graph.schema.json
//   node judge.mjs whole  FILE.json               the same, and every key of the schema is in it
//   node judge.mjs slips  FILE.json               each of its patches (RFC 7396) spoils a sound graph, where it says
//
// NAME.INDEX.json belongs to animation INDEX of NAME.glb beside it, in metres, in the world:
//   { "animation": 0, "fps": 60, "joints": ["hips", …], "frames": [[x, y, z, x, y, z, …], …] }
//
// Exit codes: 0 fine, 1 something is wrong, 2 usage, 77 the npm packages are not installed (skip).
import { existsSync, readFileSync, readdirSync, statSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';

const k_tolerance = 1e-4; // [m] a tenth of a millimetre

const require = createRequire(import.meta.url);
const [command, ...paths] = process.argv.slice(2);
const judges = { valid, places, sarif, graph, whole, slips };
if (!judges[command] || paths.length === 0) {
  console.error('usage: judge.mjs valid|places|sarif|graph|whole|slips FILE|FOLDER...');
  process.exit(2);
}
if (!existsSync(new URL('node_modules/three', import.meta.url))) {
  console.log('the judges are not installed: scripts/setup.sh test does that');
  process.exit(process.env.SUREFOOT_NEED_JUDGES ? 1 : 77);
}

const ending = { valid: '.glb', sarif: '.sarif' }[command] ?? '.json';
const files = paths.flatMap((path) =>
  statSync(path).isDirectory()
    ? readdirSync(path, { recursive: true })
        .filter((name) => name.endsWith(ending))
        .sort()
        .map((name) => join(path, name))
    : [path],
);
if (files.length === 0) throw new Error(`no ${ending} in ${paths.join(', ')}`);

let failures = 0;
for (const file of files) {
  try {
    console.log(`ok      ${file}: ${await judges[command](file)}`);
  } catch (error) {
    console.log(`FAILED  ${file}: ${error?.message ?? error}`);
    ++failures;
  }
}
process.exit(failures ? 1 : 0);

async function valid(file) {
  const validator = require('gltf-validator');
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), { maxIssues: 1000 });
  const { numErrors, numWarnings, messages } = report.issues;
  if (numErrors > 0) {
    const first = messages.filter((m) => m.severity === 0).slice(0, 5);
    throw new Error(`${numErrors} errors: ` + first.map((m) => `${m.code} at ${m.pointer}: ${m.message}`).join('; '));
  }
  const warned = [...new Set(messages.filter((m) => m.severity === 1).map((m) => m.code))];
  return `valid, ${numWarnings} warnings ${warned.join(' ')}`.trim();
}

async function sarif(file) {
  const Ajv = require('ajv-draft-04'); // what the schema is written in
  const schema = require('@microsoft/jest-sarif/lib/schemas/sarif-2.1.0-rtm.5.json');
  const ajv = new Ajv({ allErrors: true, strict: false, unicodeRegExp: false });
  require('ajv-formats')(ajv);
  const log = JSON.parse(readFileSync(file, 'utf8'));
  if (!ajv.validate(schema, log)) {
    const first = ajv.errors.slice(0, 5);
    throw new Error(`${ajv.errors.length} errors: ` + first.map((e) => `${e.instancePath} ${e.message}`).join('; '));
  }
  const [run] = log.runs;
  const ids = run.tool.driver.rules.map((rule) => rule.id);
  for (const { ruleId, ruleIndex } of run.results)
    if (ids[ruleIndex] !== ruleId) throw new Error(`rule ${ruleIndex} is ${ids[ruleIndex]}, not ${ruleId}`);
  if (run.results.length === 0) throw new Error('no results');
  return `valid, ${ids.length} rules, ${run.results.length} results`;
}

async function graph(file) {
  const errors = graphErrors(readJson(file));
  if (errors.length > 0) throw new Error(`${errors.length} errors: ` + errors.slice(0, 5).join('; '));
  return 'a graph by its schema';
}

function readJson(file) {
  return JSON.parse(readFileSync(file, 'utf8'));
}

function graphSchema() {
  return readJson(new URL('../../docs/graph.schema.json', import.meta.url));
}

/// Where and what.
function graphErrors(graph) {
  const Ajv = require('ajv');
  const ajv = new Ajv({ allErrors: true, strict: true, strictTypes: false, strictRequired: false });
  return ajv.validate(graphSchema(), graph) ? [] : ajv.errors.map((e) => `${e.instancePath} ${e.message}`);
}

async function slips(file) {
  const { of, patches } = readJson(file);
  const sound = readJson(join(dirname(file), of));
  if (graphErrors(sound).length > 0) throw new Error(`${of} is not sound to begin with`);
  const patched = (value, patch) => {
    if (patch === null || typeof patch !== 'object' || Array.isArray(patch)) return patch;
    const result = { ...value };
    for (const [key, change] of Object.entries(patch))
      if (change === null) delete result[key];
      else result[key] = patched(result[key], change);
    return result;
  };
  for (const [name, { at, patch }] of Object.entries(patches))
    if (!graphErrors(patched(sound, patch)).some((error) => error.startsWith(`${at} `)))
      throw new Error(`the slip '${name}' is not seen at ${at}`);
  return `${Object.keys(patches).length} slips are seen`;
}

async function whole(file) {
  await graph(file);
  const known = new Set();
  const look = (schema) => {
    if (schema === null || typeof schema !== 'object') return;
    for (const key of Object.keys(schema.properties ?? {})) known.add(key);
    Object.values(schema).forEach(look);
  };
  look(graphSchema());
  const used = new Set();
  JSON.parse(readFileSync(file, 'utf8'), (key, value) => (used.add(key), value));
  // A patch's, and what only a project of its own kind has.
  const missing = [...known].filter((key) => !used.has(key) && !['extends', 'custom', 'style'].includes(key));
  if (missing.length > 0) throw new Error(`not there: ${missing.join(', ')}`);
  return `all ${known.size} keys of the schema`;
}

async function places(wantedFile) {
  const wanted = JSON.parse(readFileSync(wantedFile, 'utf8'));
  const file = wantedFile.replace(/\.\d+\.json$/, '.glb');
  globalThis.self = globalThis; // what three.js' loader takes for granted
  const three = await import('three');
  const { GLTFLoader } = await import('three/examples/jsm/loaders/GLTFLoader.js');
  const bytes = readFileSync(file);
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
  const gltf = await new GLTFLoader().parseAsync(buffer, '');

  // Joints by the names in the file (three.js changes names to suit its own paths).
  const nodes = gltf.parser.json.nodes;
  const joints = await Promise.all(
    wanted.joints.map((name) => {
      const index = nodes.findIndex((node) => node.name === name);
      if (index < 0) throw new Error(`no node '${name}'`);
      return gltf.parser.getDependency('node', index);
    }),
  );

  const mixer = new three.AnimationMixer(gltf.scene);
  const animation = gltf.animations[wanted.animation];
  if (!animation) throw new Error(`no animation ${wanted.animation}`);
  const action = mixer.clipAction(animation);
  action.setLoop(three.LoopOnce);
  action.clampWhenFinished = true;
  action.play();

  const place = new three.Vector3();
  let worst = 0;
  let where = '';
  wanted.frames.forEach((frame, f) => {
    mixer.setTime(f / wanted.fps);
    gltf.scene.updateMatrixWorld(true);
    joints.forEach((joint, j) => {
      place.setFromMatrixPosition(joint.matrixWorld);
      const off = Math.hypot(place.x - frame[3 * j], place.y - frame[3 * j + 1], place.z - frame[3 * j + 2]);
      if (!(off <= worst)) [worst, where] = [off, `'${wanted.joints[j]}' in frame ${f}`];
    });
  });
  if (wanted.frames.length < 2 || joints.length < 2) throw new Error('nothing to compare');
  if (!(worst < k_tolerance)) throw new Error(`${where} is ${(worst * 1000).toFixed(3)} mm away`);
  return `${joints.length} joints, ${wanted.frames.length} frames, at most ${(worst * 1000).toFixed(5)} mm apart`;
}
