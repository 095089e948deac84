#!/usr/bin/env node
// A part of an HTML page as a picture (.png or .jpg). For developers; needs node, chromium ($CHROMIUM says where) and
// playwright-core in ./node_modules ($VIEW_MODULES says where).
//
//   node scripts/shoot_page.mjs PAGE.html SELECTOR OUT.png [WIDTH]
import path from 'node:path';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [page, selector, out, width = '1280'] = process.argv.slice(2);
if (!out) throw new Error('usage: shoot_page.mjs PAGE.html SELECTOR OUT.png [WIDTH]');
const modules = process.env.VIEW_MODULES || path.resolve('node_modules');
const { chromium } = createRequire(path.join(modules, 'x.js'))('playwright-core');
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM || '/usr/bin/chromium', args: ['--no-sandbox'] });
const view = await browser.newPage({ viewport: { width: Number(width), height: 720 }, colorScheme: 'light' });
await view.goto(pathToFileURL(path.resolve(page)).href);
await view.locator(selector).first().screenshot({ path: out });
await browser.close();
