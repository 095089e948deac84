#!/usr/bin/env node
// Renders moments of a .glb's first animation to one PNG: rows are views, columns are times. For developers who want to
// look at what they made; the program itself needs none of this.
//
//   node scripts/view_glb.mjs IN.glb OUT.png [--columns 8] [--views side,front] [--from 0] [--to 1] [--size 220]
//                             [--follow on|off] [--span METRES] [--clip NAME] [--bones]
//
// --from and --to are shares of the animation. Needs node, chromium, and in the working directory (or $VIEW_MODULES)
// node_modules with three and playwright-core.
import http from 'node:http';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { createRequire } from 'node:module';

function parse(argv) {
    const given = { columns: 8, views: 'side,front', from: 0, to: 1, size: 220, follow: 'on', span: 2.3, clip: '', bones: '' };
    const files = [];
    for (let i = 0; i < argv.length; ++i) {
        const key = argv[i].replace(/^--/, '');
        if (argv[i] === key) files.push(argv[i]);
        else if (key === 'bones') given.bones = 'on';
        else if (key in given && i + 1 < argv.length) given[key] = typeof given[key] === 'number' ? Number(argv[++i]) : argv[++i];
        else throw new Error(`unknown option ${argv[i]}`);
    }
    if (files.length !== 2) throw new Error('usage: view_glb.mjs IN.glb OUT.png [options]; see the top of this file');
    return { ...given, input: files[0], output: files[1] };
}

const page = (o) => `<!doctype html><style>body{margin:0;background:#fff}canvas{display:block}</style>
<script type="importmap">{"imports":{"three":"/modules/three/build/three.module.js","three/addons/":"/modules/three/examples/jsm/"}}</script>
<script type="module">
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
const o = ${JSON.stringify(o)};
const views = o.views.split(',');
const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
renderer.setSize(o.columns * o.size, views.length * o.size);
renderer.setScissorTest(true);
renderer.shadowMap.enabled = true;
document.body.append(renderer.domElement);
const gltf = await new GLTFLoader().loadAsync('/file.glb');
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xf4f5f7);
scene.add(gltf.scene, new THREE.HemisphereLight(0xffffff, 0x8d8d99, 2.0));
const sun = new THREE.DirectionalLight(0xffffff, 2.2);
sun.castShadow = true;
sun.shadow.mapSize.set(1024, 1024);
for (const side of ['left', 'right', 'top', 'bottom']) sun.shadow.camera[side] = /right|top/.test(side) ? 2 : -2;
scene.add(sun, sun.target);
gltf.scene.traverse((n) => { if (n.isMesh) { n.castShadow = n.receiveShadow = true; n.frustumCulled = false; } });
const terrain = gltf.scene.getObjectByName('terrain');
if (!terrain) {
    const floor = new THREE.Mesh(new THREE.PlaneGeometry(200, 200), new THREE.MeshLambertMaterial({ color: 0xe3e5e8 }));
    floor.rotation.x = -Math.PI / 2;
    floor.receiveShadow = true;
    const grid = new THREE.GridHelper(200, 200, 0xc6cad2, 0xd6dae0);
    grid.position.y = 0.001;
    scene.add(floor, grid);
}
if (o.bones) scene.add(new THREE.SkeletonHelper(gltf.scene));
const hips = [];
gltf.scene.traverse((n) => { if (n.isBone && hips.length === 0) hips.push(n); });
const mixer = new THREE.AnimationMixer(gltf.scene);
const clip = gltf.animations.find((c) => c.name === o.clip) ?? gltf.animations[0];
const action = mixer.clipAction(clip).setLoop(THREE.LoopOnce);
action.clampWhenFinished = true;
action.play();
const half = o.span / 2;
for (let c = 0; c < o.columns; ++c) {
    const share = o.columns > 1 ? c / o.columns : 0;
    mixer.setTime((o.from + (o.to - o.from) * share) * clip.duration);
    scene.updateMatrixWorld(true);
    const at = new THREE.Vector3();
    if (o.follow === 'on' && hips[0]) hips[0].getWorldPosition(at);
    // The way the root faces, so that a turning clip still shows its side and front.
    const q = new THREE.Quaternion();
    if (hips[0] && o.follow === 'on') (gltf.scene.getObjectByName('root') ?? hips[0]).getWorldQuaternion(q);
    const front = new THREE.Vector3(0, 0, 1).applyQuaternion(q).setY(0).normalize();
    const left = new THREE.Vector3(1, 0, 0).applyQuaternion(q).setY(0).normalize();
    const target = new THREE.Vector3(at.x, o.follow === 'on' ? at.y - 0.93 + 0.44 * o.span : 0.44 * o.span, at.z);
    sun.position.copy(target).addScaledVector(front, 2).addScaledVector(left, 1.5).add(new THREE.Vector3(0, 5, 0));
    sun.target.position.copy(target);
    views.forEach((view, r) => {
        const camera = new THREE.OrthographicCamera(-half, half, half, -half, 0.1, 50);
        const from = { side: left.clone().multiplyScalar(-1), left, front, back: front.clone().negate(), top: new THREE.Vector3(0, 1, 0),
                       three: front.clone().addScaledVector(left, -0.8).add(new THREE.Vector3(0, 0.35, 0)).normalize() }[view];
        camera.position.copy(target).addScaledVector(from, 10);
        if (view !== 'top' && view !== 'three') camera.position.y += 0.8;
        camera.up.set(0, 1, 0);
        if (view === 'top') camera.up.copy(front);
        camera.lookAt(target);
        const y = (views.length - 1 - r) * o.size;
        renderer.setViewport(c * o.size, y, o.size, o.size);
        renderer.setScissor(c * o.size, y, o.size, o.size);
        renderer.render(scene, camera);
    });
}
window.finished = renderer.domElement.toDataURL('image/png');
</script>`;

function serve(options, modules) {
    const types = { '.js': 'text/javascript', '.html': 'text/html', '.glb': 'model/gltf-binary' };
    const server = http.createServer((request, response) => {
        const url = new URL(request.url, 'http://localhost').pathname;
        const file = url === '/file.glb' ? path.resolve(options.input)
            : url.startsWith('/modules/') ? path.join(modules, path.normalize(url.slice('/modules/'.length))) : null;
        if (url === '/') return response.setHeader('content-type', 'text/html').end(page(options));
        if (!file || !fs.existsSync(file)) return response.writeHead(404).end();
        response.setHeader('content-type', types[path.extname(file)] ?? 'application/octet-stream');
        fs.createReadStream(file).pipe(response);
    });
    return new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(server)));
}

async function main() {
    const options = parse(process.argv.slice(2));
    const modules = path.resolve(process.env.VIEW_MODULES ?? 'node_modules');
    const { chromium } = createRequire(path.join(modules, 'x.js'))('playwright-core');
    const server = await serve(options, modules);
    const profile = fs.mkdtempSync(path.join(os.tmpdir(), 'view-glb-'));
    const context = await chromium.launchPersistentContext(profile, {
        executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', headless: true,
        args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
               '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
    try {
        const tab = await context.newPage();
        const complaints = [];
        tab.on('pageerror', (e) => complaints.push(e.message));
        tab.on('console', (m) => m.type() === 'error' && complaints.push(m.text()));
        await tab.goto(`http://127.0.0.1:${server.address().port}/`);
        const data = await tab.waitForFunction(() => window.finished, null, { timeout: 60000 })
            .then((h) => h.jsonValue()).catch((e) => { throw new Error([e.message, ...complaints].join('\n')); });
        fs.writeFileSync(options.output, Buffer.from(data.split(',')[1], 'base64'));
    } finally {
        await context.close();
        server.close();
        fs.rmSync(profile, { recursive: true, force: true });
    }
}

main().catch((error) => { console.error(error.message); process.exit(2); });
