// Unsaved work, kept in this browser's own storage so that it survives a reload.

/** A project's files, and whose they are: of the served folder by name, or of nobody. */
export interface KeptWork {
  files: [string, Uint8Array][];
  folder: string | null;
  /** What the folder's project.json was when it was opened. */
  known: string;
}

const k_store = 'work', k_key = 'last';

function request<T>(asked: IDBRequest<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    asked.onsuccess = () => resolve(asked.result);
    asked.onerror = () => reject(asked.error);
  });
}

async function store(mode: IDBTransactionMode): Promise<IDBObjectStore> {
  const opening = indexedDB.open('surefoot.studio', 1);
  opening.onupgradeneeded = () => opening.result.createObjectStore(k_store);
  return (await request(opening)).transaction(k_store, mode).objectStore(k_store);
}

/** True once it is written, not only asked for. */
function written({ transaction }: IDBRequest): Promise<boolean> {
  return new Promise((resolve) => {
    transaction!.oncomplete = () => resolve(true);
    transaction!.onabort = () => resolve(false);
  });
}

let last: Promise<unknown> = Promise.resolve();
/** One after the other, as they were asked for. Where storage is closed to us nothing is kept, and nothing is missed but that. */
function inTurn<T>(body: () => Promise<T>, otherwise: T): Promise<T> {
  const done = last.then(body).catch(() => otherwise);
  last = done;
  return done;
}

export const keepWork = (work: KeptWork) => inTurn(async () => written((await store('readwrite')).put(work, k_key)), false);
export const forgetWork = () => inTurn(async () => written((await store('readwrite')).delete(k_key)), false);
export const keptWork = () => inTurn(async () => request<KeptWork | undefined>((await store('readonly')).get(k_key)), undefined);
