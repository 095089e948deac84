// The folder that `surefoot studio` serves, if it does.
const k_token_header = 'X-Surefoot-Token';
const k_token_key = 'surefoot.studio.token';

/** What `surefoot studio` put behind the # of the page's address; kept for reloads of this tab. */
function takeToken(): string | null {
  const match = /^#token=([0-9a-f]+)$/.exec(location.hash);
  try {
    if (!match) return sessionStorage.getItem(k_token_key);
    sessionStorage.setItem(k_token_key, match[1]!);
  } catch {
    // Storage is closed to us: reloading asks for the address again.
  }
  if (match) history.replaceState(null, '', location.pathname + location.search);
  return match?.[1] ?? null;
}

const token = takeToken();
export const isServed = token !== null;

export interface Listing {
  /** null: the studio was started without a folder. */
  folder: string | null;
  files: { path: string; bytes: number; changed: string }[];
}

async function ask(path: string, options: RequestInit = {}): Promise<Response> {
  const response = await fetch(path, { ...options, headers: { [k_token_header]: token! } });
  if (!response.ok) throw new Error((await response.text()) || `${path}: ${response.status} ${response.statusText}`);
  return response;
}

const k_look_every_ms = 3000;
let writes = 0;
const watchers: ((listing: Listing) => void)[] = [];

async function look(): Promise<void> {
  if (document.hidden) return;
  const before = writes, listing = await list();
  if (writes !== before) return; // some of it may be from before we wrote
  for (const each of watchers) each(listing);
}

/** What is to hear of what is in the folder, now and then. */
export function watch(watcher: (listing: Listing) => void): void {
  if (!isServed) return;
  // A server that has gone is told of when it is needed.
  if (watchers.push(watcher) === 1) setInterval(() => void look().catch(() => undefined), k_look_every_ms);
}

const addressOf = (file: string) => `api/files/${file.split('/').map(encodeURIComponent).join('/')}`;

export const list = async () => (await (await ask('api/project')).json()) as Listing;
export const read = async (file: string) => new Uint8Array(await (await ask(addressOf(file))).arrayBuffer());

async function change(file: string, options: RequestInit): Promise<void> {
  ++writes;
  try {
    await ask(addressOf(file), options);
  } finally {
    ++writes;
  }
}
export const write = (file: string, bytes: Uint8Array<ArrayBuffer>) => change(file, { method: 'PUT', body: bytes });
export const remove = (file: string) => change(file, { method: 'DELETE' });
