#!/usr/bin/env node
// Renders moments of .glb animations to one picture (.png or .jpg): a row for each file and view, a column for each
// time. For developers who want to look at what they made; the program itself needs none of this.
//
//   node scripts/view_glb.mjs IN.glb... OUT.png [--columns 8] [--views side,front,back,left,top,three] [--from 0] [--to 1]
//                             [--size 220] [--span METRES] [--follow on|off] [--floor on|off] [--clip NAME] [--bones]
//                             [--across] [--turn "Joint:X,Y,Z;..."]
//
// --from and --to are shares of the animation; --across puts files side by side; --turn turns joints by degrees (what does
// not move is shown as it rests). Needs node, chromium ($CHROMIUM says where), and three and
// playwright-core in ./node_modules ($VIEW_MODULES says where): npm install --no-save three playwright-core
import http from 'node:http';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';

function parse(argv) {
    const given = { columns: 8, views: 'side,front', from: 0, to: 1, size: 220, span: 2.1, follow: 'on', floor: 'on', clip: '', bones: '', across: '', turn: '' };
    const files = [];
    for (let i = 0; i < argv.length; ++i) {
        const key = argv[i].replace(/^--/, '');
        if (argv[i] === key) files.push(argv[i]);
        else if (key === 'bones' || key === 'across') given[key] = 'on';
        else if (key in given && i + 1 < argv.length) given[key] = typeof given[key] === 'number' ? Number(argv[++i]) : argv[++i];
        else throw new Error(`unknown option ${argv[i]}`);
    }
    if (files.length < 2) throw new Error('usage: view_glb.mjs IN.glb... OUT.png [options]; see the top of this file');
    for (const file of files.slice(0, -1)) if (!fs.existsSync(file)) throw new Error(`${file}: no such file`);
    const type = /\.jpe?g$/.test(files.at(-1)) ? 'image/jpeg' : 'image/png';
    return { inputs: files.slice(0, -1), output: files.at(-1), page: { ...given, files: files.length - 1, type } };
}

const types = { '.js': 'text/javascript', '.html': 'text/html', '.glb': 'model/gltf-binary' };
const here = path.dirname(fileURLToPath(import.meta.url));

function serve({ inputs, page }, modules) {
    const fileOf = (url) => {
        if (url === '/') return path.join(here, 'view_glb.html');
        const glb = /^\/file\/(\d+)\.glb$/.exec(url);
        if (glb) return inputs[Number(glb[1])];
        return url.startsWith('/modules/') ? path.join(modules, path.normalize(url.slice('/modules'.length))) : '';
    };
    const server = http.createServer((request, response) => {
        const url = new URL(request.url, 'http://localhost').pathname;
        if (url === '/options.json') return response.end(JSON.stringify(page));
        const file = fileOf(url);
        if (!file || !fs.existsSync(file)) return response.writeHead(404).end();
        response.setHeader('content-type', types[path.extname(file)] ?? 'application/octet-stream');
        fs.createReadStream(file).pipe(response);
    });
    return new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(server)));
}

async function picture(tab, address) {
    const complaints = [];
    const failed = new Promise((_, reject) => tab.on('pageerror', (error) => reject(error)));
    tab.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
    await tab.goto(address);
    try {
        const done = tab.waitForFunction(() => window.finished, null, { timeout: 120000 }).then((handle) => handle.jsonValue());
        return await Promise.race([done, failed]);
    } catch (error) {
        throw new Error([error.message, ...complaints].join('\n'));
    }
}

async function main() {
    const job = parse(process.argv.slice(2));
    const modules = path.resolve(process.env.VIEW_MODULES ?? 'node_modules');
    const { chromium } = createRequire(path.join(modules, 'any.js'))('playwright-core');
    const server = await serve(job, modules);
    const profile = fs.mkdtempSync(path.join(os.tmpdir(), 'view-glb-'));
    const context = await chromium.launchPersistentContext(profile, {
        executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', headless: true,
        args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking',
               '--disable-component-update', '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader'] });
    try {
        const data = await picture(await context.newPage(), `http://127.0.0.1:${server.address().port}/`);
        fs.writeFileSync(job.output, Buffer.from(data.split(',')[1], 'base64'));
    } finally {
        await context.close().catch(() => {});
        server.close();
        fs.rmSync(profile, { recursive: true, force: true });
    }
}

main().catch((error) => {
    console.error(`view_glb: ${error.message}`);
    process.exit(2);
});
