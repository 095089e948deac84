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

const addressOf = (file: string) => `api/files/${file.split('/').map(encodeURIComponent).join('/')}`;

export const list = async () => (await (await ask('api/project')).json()) as Listing;
export const read = async (file: string) => new Uint8Array(await (await ask(addressOf(file))).arrayBuffer());
export const write = (file: string, bytes: Uint8Array<ArrayBuffer>) => ask(addressOf(file), { method: 'PUT', body: bytes });
export const remove = (file: string) => ask(addressOf(file), { method: 'DELETE' });
