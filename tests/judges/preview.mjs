// Holds the preview of a report against the runtime: the page's own script and data, out of report.html, must weigh, step
// and pose as runtime.json (preview_export.cpp) says. Needs Node and nothing else.
//
//   node preview.mjs FOLDER...
//
// Exit codes: 0 fine, 1 something is wrong, 2 usage.
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { runInNewContext } from 'node:vm';

const k_weight = 2e-4;   // a thousandth of a pose is left out on both sides
const k_rate = 1e-3;     // [cycles/s]
const k_joint = 0.012;   // [m] the page keeps 40 poses a second, the runtime all
const k_mean = 0.0015;   // [m] over all joints and moments
const k_root = 1e-3;     // [m], [rad] after a second and a half
const k_slice = 1e-4;    // of an axis' range, for the middle of a slice's polygon; of its plane's area, for the area

const folders = process.argv.slice(2);
if (folders.length === 0) {
  console.error('usage: preview.mjs FOLDER...');
  process.exit(2);
}
let failures = 0;
const fail = (where, what) => {
  if (++failures <= 10) console.log(`FAILED ${where}: ${what}`);
};

function pageOf(html) {
  const inside = (open) => {
    const from = html.indexOf(open) + open.length;
    return html.slice(from, html.indexOf('</script>', from));
  };
  const script = inside('<script>'), style = html.slice(html.indexOf('<style>') + 7, html.indexOf('</style>'));
  return { script, style, data: JSON.parse(inside('<script type="application/json" id="preview-data">')) };
}

/// The policy admits the script and the style that the page holds, and nothing else.
function checkPolicy(html, { script, style }, where) {
  const policy = /http-equiv="Content-Security-Policy" content="([^"]*)"/.exec(html)?.[1] ?? '';
  const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
  const wanted = `default-src 'none'; style-src ${hash(style)}; script-src ${hash(script)}; base-uri 'none'; form-action 'none'`;
  if (policy !== wanted) fail(where, `content security policy is "${policy}", not "${wanted}"`);
}

/// Centroid and area of a convex polygon in shares of its axes' ranges; corners may stand twice.
function shapeOf(polygon, ranges) {
  const points = polygon.map((point) => point.map((v, k) => v / ranges[k]));
  let area = 0;
  const moment = [0, 0];
  for (let i = 2; i < points.length; ++i) {
    const [p, q, r] = [points[0], points[i - 1], points[i]];
    const part = Math.abs((q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1])) / 2;
    area += part;
    [0, 1].forEach((k) => { moment[k] += (part * (p[k] + q[k] + r[k])) / 3; });
  }
  return { area, middle: moment.map((v) => (area > 0 ? v / area : 0)) };
}

/// Every polygon that the library cuts is one of the page's, and together they are as large.
function checkSlice(blend, space, cut, where) {
  const ranges = [cut.right, cut.up].map((k) => space.axes[k].high - space.axes[k].low);
  const theirs = blend.slice(space, cut.at, cut.right, cut.up)
    .map((corners) => shapeOf(corners.map((corner) => [corner[cut.right], corner[cut.up]]), ranges));
  const ours = cut.polygons.map((polygon) => shapeOf(polygon, ranges));
  for (const { area, middle } of ours)
    if (area > k_slice && !theirs.some((t) => Math.abs(t.area - area) < k_slice && t.middle.every((v, k) => Math.abs(v - middle[k]) < 20 * k_slice)))
      fail(where, `no slice of area ${area.toFixed(5)} around ${middle.map((v) => v.toFixed(4))}`);
  const total = (shapes) => shapes.reduce((sum, { area }) => sum + area, 0);
  if (Math.abs(total(theirs) - total(ours)) > k_slice) fail(where, `slices of ${total(theirs)} in all, in the library ${total(ours)}`);
  return ours.length;
}

for (const folder of folders) {
  const html = readFileSync(join(folder, 'report.html'), 'utf8'), page = pageOf(html);
  checkPolicy(html, page, folder);
  const context = { module: {}, atob, document: undefined };
  // The half that knows of the page fails without one, after the half under test has been defined.
  try {
    runInNewContext(page.script, context);
  } catch (error) {
    if (!context.module.exports) throw error;
  }
  const blend = context.module.exports, data = blend.read(page.data);
  let worst = 0, sum = 0, count = 0, moments = 0;
  for (const run of JSON.parse(readFileSync(join(folder, 'runtime.json'), 'utf8'))) {
    const space = data.spaces.find(({ index }) => index === run.space);
    const where = `${folder}, ${space.name} at ${run.at}`;
    const { shares } = blend.weightsAt(space, run.at), state = blend.start();
    let steps = 0, moves;
    for (const moment of run.moments) {
      ++moments;
      for (; steps < moment.steps; ++steps) moves = blend.advance(data, space, shares, state, run.dt);
      const leaves = blend.leavesOf(data, space, shares, state);
      const weights = Object.fromEntries(leaves.map(({ clip, weight }) => [clip.name, weight]));
      for (const name of new Set([...Object.keys(weights), ...Object.keys(moment.weights)]))
        if (Math.abs((weights[name] ?? 0) - (moment.weights[name] ?? 0)) > k_weight)
          fail(where, `${name} weighs ${weights[name]}, in the runtime ${moment.weights[name]}`);
      if (Math.abs(moves.rate - moment.phase_rate) > k_rate)
        fail(where, `${moves.rate} cycles a second, in the runtime ${moment.phase_rate}`);
      [state.x, state.z, state.yaw].forEach((v, k) => {
        if (Math.abs(v - moment.root[k]) > k_root) fail(where, `the root is at ${v}, in the runtime at ${moment.root[k]}`);
      });
      const points = blend.points(data, leaves, state, moves);
      data.body.joints.forEach((name, j) => {
        const off = Math.hypot(...points[j].map((v, k) => v - moment.joints[name][k]));
        worst = Math.max(worst, off);
        sum += off;
        ++count;
        if (off > k_joint) fail(where, `after ${moment.steps} steps ${name} is ${(1000 * off).toFixed(1)} mm away`);
      });
    }
  }
  let cells = 0;
  for (const cut of JSON.parse(readFileSync(join(folder, 'slices.json'), 'utf8'))) {
    const space = data.spaces.find(({ index }) => index === cut.space);
    cells += checkSlice(blend, space, cut, `${folder}, ${space.name} cut through ${cut.at} along ${cut.right} and ${cut.up}`);
  }
  if (cells === 0) fail(folder, 'no slice to compare');
  if (moments === 0) fail(folder, 'nothing to compare');
  if (sum / count > k_mean) fail(folder, `joints are ${((1000 * sum) / count).toFixed(2)} mm away on average`);
  console.log(`${folder}: ${moments} moments, joints within ${(1000 * worst).toFixed(2)} mm of the runtime, ` +
    `${((1000 * sum) / count).toFixed(3)} mm on average; ${cells} slices; page of ${(html.length / 1e6).toFixed(2)} MB`);
}
if (failures > 10) console.log(`... and ${failures - 10} more`);
process.exit(failures > 0 ? 1 : 0);
