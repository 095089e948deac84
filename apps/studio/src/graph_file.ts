// A graph's file: places in it, what one writes there, and where it is kept.
import * as folder from './folder';
import { graphStamps } from './settings';

/** Any JSON value. */
export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
type JsonObject = { [key: string]: Json };
const isObject = (value: Json | undefined): value is JsonObject => typeof value === 'object' && value !== null && !Array.isArray(value);

/** A step of a JSON pointer (RFC 6901). */
export const escaped = (name: string) => name.replaceAll('~', '~0').replaceAll('/', '~1');

/** What a text has at a pointer; undefined: nothing. */
export function valueAt(text: string, pointer: string): Json | undefined {
  let at: Json | undefined = JSON.parse(text) as Json;
  for (const step of pointer.split('/').slice(1).map((each) => each.replaceAll('~1', '/').replaceAll('~0', '~'))) {
    if (Array.isArray(at)) at = at[Number(step)];
    else if (isObject(at)) at = at[step];
    else return undefined;
  }
  return at;
}

/** On one line, as people write it. */
export function inLine(value: Json): string {
  if (Array.isArray(value)) return `[${value.map(inLine).join(', ')}]`;
  if (isObject(value)) return `{${Object.entries(value).map(([key, each]) => `${JSON.stringify(key)}: ${inLine(each)}`).join(', ')}}`;
  return JSON.stringify(value);
}

/** A name that is not among those that there are. */
export function freeName(wanted: string, taken: readonly string[]): string {
  let name = wanted;
  for (let number = 2; taken.includes(name); ++number) name = `${wanted}_${number}`;
  return name;
}

/** A patch of a graph upon what it extends (RFC 7396). */
function merged(base: Json | undefined, patch: Json): Json {
  if (!isObject(patch)) return patch;
  const out: JsonObject = isObject(base) ? { ...base } : {};
  for (const [key, value] of Object.entries(patch)) {
    if (value === null) delete out[key];
    else out[key] = merged(out[key], value);
  }
  return out;
}

const k_most_bases = 8; // as the program takes them

/** A text with what it extends; `others` are files by name. The name of what it extends, or null where it does so of nothing. */
export async function whole(text: string, others: ReadonlyMap<string, string>): Promise<{ text: string; extended: string | null }> {
  let graph: Json;
  try {
    graph = JSON.parse(text) as Json;
  } catch {
    return { text, extended: null }; // the engine says what is wrong
  }
  if (!isObject(graph) || typeof graph['extends'] !== 'string') return { text, extended: null };
  const extended = graph['extends'];
  for (let depth = 0; isObject(graph) && typeof graph['extends'] === 'string'; ++depth) {
    const name: string = graph['extends'];
    if (depth === k_most_bases) throw new Error(`graphs extend each other more than ${k_most_bases} deep, at ${name}`);
    const base = JSON.parse(await textOf(name, others)) as JsonObject;
    const { extends: _, ...patch } = graph;
    graph = merged(base, patch);
  }
  return { text: `${JSON.stringify(graph, null, 2)}\n`, extended };
}

async function textOf(name: string, others: ReadonlyMap<string, string>): Promise<string> {
  const given = others.get(name.split('/').at(-1)!);
  if (given !== undefined) return given;
  if (folder.isServed) {
    try {
      return new TextDecoder().decode(await folder.read(name.replace(/^\.\//, '')));
    } catch {
      // It is not there either.
    }
  }
  throw new Error(`This graph extends ${name}: choose both files together.`);
}

const stampIn = ({ files }: folder.Listing, name: string) => files.find(({ path }) => path === name)?.changed ?? '';
const stampOf = async (name: string) => stampIn(await folder.list(), name);
const know = (name: string, stamp: string) => (graphStamps.value = { ...graphStamps.value, [name]: stamp });

export const isServed = folder.isServed;

/** Graphs of the served folder. */
export async function graphsInFolder(): Promise<string[]> {
  const { files } = await folder.list();
  return files.map(({ path }) => path).filter((path) => path.endsWith('.json') && path !== 'project.json' && !path.includes('/'));
}

export async function readFromFolder(name: string): Promise<string> {
  const stamp = await stampOf(name);
  const text = new TextDecoder().decode(await folder.read(name));
  know(name, stamp);
  return text;
}

/** True where another program has written the file since we last saw it: saving puts ours in its place. */
export async function hasChanged(name: string): Promise<boolean> {
  const now = await stampOf(name);
  if (now === (graphStamps.value[name] ?? '')) return false;
  told = changeOf(name, now);
  return true;
}

export async function writeToFolder(name: string, text: string): Promise<void> {
  await folder.write(name, new TextEncoder().encode(text));
  know(name, await stampOf(name));
}

/** Of which change the user has heard. */
let told = '';
const changeOf = (name: string, stamp: string) => `${name} ${stamp}`;

/** Tells of each change that another program makes to the file that `open` names, once, where `tell` takes notice. */
export function watchFile(open: () => string | null, tell: (name: string) => boolean): void {
  folder.watch((listing) => {
    const name = open(), known = name === null ? undefined : graphStamps.value[name];
    if (name === null || known === undefined) return;
    const now = stampIn(listing, name), change = changeOf(name, now);
    if (now !== '' && now !== known && change !== told && tell(name)) told = change;
  });
}
