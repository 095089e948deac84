// Projects: from the folder that `surefoot studio` serves, or one that the user chooses or drags in.
import { fail, openDefault, openProject, say } from './session';

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

async function ask(path: string): Promise<Response> {
  const response = await fetch(path, { headers: { [k_token_header]: token! } });
  if (!response.ok) throw new Error((await response.text()) || `${path}: ${response.status} ${response.statusText}`);
  return response;
}

const isOfProject = (file: string) => file === 'project.json' || /^clips\/[^/]+\.(glb|gltf|bvh)$/i.test(file);

/** What the studio begins with. */
export async function openFirst(): Promise<void> {
  if (token) {
    try {
      const listing = (await (await ask('api/project')).json()) as { folder: string; files: { path: string }[] };
      const wanted = listing.files.map((file) => file.path).filter(isOfProject);
      if (wanted.includes('project.json')) {
        const fetched = wanted.map(async (file): Promise<[string, Uint8Array]> => [
          file,
          new Uint8Array(await (await ask(`api/files/${file.split('/').map(encodeURIComponent).join('/')}`)).arrayBuffer()),
        ]);
        await openProject(await Promise.all(fetched));
        return;
      }
    } catch (error) {
      fail('The project could not be opened; here is the default character', error);
    }
  }
  await openDefault();
}

/** A project folder chosen by hand: nothing leaves the machine. */
export async function openFolder(chosen: Iterable<{ path: string; file: File }>): Promise<void> {
  const all = [...chosen];
  const project = all.filter(({ path }) => /(^|\/)project\.json$/.test(path)).sort((a, b) => a.path.length - b.path.length)[0];
  try {
    if (!project)
      throw new Error('There is no project.json in it. Choose the folder that `surefoot author … -o FOLDER` wrote.');
    const folder = project.path.slice(0, -'project.json'.length);
    const files = all
      .filter(({ path }) => path.startsWith(folder) && isOfProject(path.slice(folder.length)))
      .map(async ({ path, file }): Promise<[string, Uint8Array]> => [path.slice(folder.length), new Uint8Array(await file.arrayBuffer())]);
    await openProject(await Promise.all(files));
    say('Opened. Nothing left this machine.');
  } catch (error) {
    fail('This is no project that can be opened', error);
  }
}

async function* filesIn(entry: FileSystemEntry, path = ''): AsyncGenerator<{ path: string; file: File }> {
  const here = path + entry.name;
  if (entry.isFile) {
    yield { path: here, file: await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject)) };
    return;
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) return;
    for (const each of some) yield* filesIn(each, `${here}/`);
  }
}

export async function openDropped(items: DataTransferItemList): Promise<void> {
  const entries = [...items].map((item) => item.webkitGetAsEntry()).filter((entry) => entry !== null);
  const files: { path: string; file: File }[] = [];
  for (const entry of entries) for await (const each of filesIn(entry)) files.push(each);
  await openFolder(files);
}
