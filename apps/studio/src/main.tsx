import { render } from 'preact';
import { useRef } from 'preact/hooks';
import { effect, signal } from '@preact/signals';
import './style.css';
import * as session from './session';
import { listen } from './input';
import { openDropped, openFirst, openFolder } from './project';
import { theme, type Theme } from './settings';
import { isDark } from './view/theme';
import { ProblemCard } from './ui/problem';
import { Timeline } from './ui/timeline';
import { Viewport } from './ui/viewport';
import { TerrainPanel } from './workspaces/terrain';

const panelOpen = signal(matchMedia('(min-width: 1000px)').matches);
const k_next_theme: Record<Theme, Theme> = { system: 'light', light: 'dark', dark: 'system' };
const k_theme_names: Record<Theme, string> = { system: 'as the system', light: 'light', dark: 'dark' };

function OpenButton() {
  const input = useRef<HTMLInputElement>(null);
  return (
    <>
      <button type="button" onClick={() => input.current!.click()} title="A folder that `surefoot author` wrote; you can also drag it in">
        Open project…
      </button>
      <input
        ref={(element) => {
          input.current = element;
          element?.setAttribute('webkitdirectory', '');
        }}
        class="hidden"
        type="file"
        tabIndex={-1}
        aria-hidden="true"
        onChange={(event) => {
          const files = [...(event.currentTarget.files ?? [])];
          event.currentTarget.value = '';
          if (files.length > 0) void openFolder(files.map((file) => ({ path: file.webkitRelativePath || file.name, file })));
        }}
      />
    </>
  );
}

function Studio() {
  const known = session.facts.value;
  return (
    <div
      class={panelOpen.value ? 'studio' : 'studio narrow'}
      onDragOver={(event) => event.preventDefault()}
      onDrop={(event) => {
        event.preventDefault();
        if (event.dataTransfer) void openDropped(event.dataTransfer.items);
      }}
    >
      <header class="bar">
        <h1>
          <img src="./icon.svg" alt="" width="24" height="24" />
          Surefoot
        </h1>
        <div role="tablist" aria-label="Workspaces">
          <button type="button" role="tab" id="tab-terrain" aria-selected="true" aria-controls="panel">
            Terrain
          </button>
        </div>
        <p class="character">{known ? `${known.name}, ${known.clips} clips` : 'Starting the engine…'}</p>
        <OpenButton />
        <button type="button" title={`Colours: ${k_theme_names[theme.value]}`} aria-label={`Colours: ${k_theme_names[theme.value]}`} onClick={() => (theme.value = k_next_theme[theme.value])}>
          <svg viewBox="0 0 20 20" aria-hidden="true"><path d="M10 2a8 8 0 1 0 0 16zM10 3.5a6.5 6.5 0 0 1 0 13z" /></svg>
        </button>
        <button type="button" aria-expanded={panelOpen.value} aria-controls="panel" title="Panel" aria-label="Panel" onClick={() => (panelOpen.value = !panelOpen.value)}>
          <svg viewBox="0 0 20 20" aria-hidden="true"><path d="M3 4h14v12H3zM4.500 5.500v9h6.500v-9z" fill-rule="evenodd" /></svg>
        </button>
      </header>
      <Viewport />
      <div class="panel" id="panel" role="tabpanel" aria-labelledby="tab-terrain" hidden={!panelOpen.value}>
        <TerrainPanel />
      </div>
      <Timeline />
      <ProblemCard />
    </div>
  );
}

effect(() => {
  document.documentElement.dataset['theme'] = isDark.value ? 'dark' : 'light';
});
listen();
const app = document.getElementById('app')!;
app.textContent = '';
render(<Studio />, app);
void session.boot(async () => {
  try {
    await openFirst();
  } catch (error) {
    session.failForGood('There is no character', error instanceof Error ? error.message : String(error));
  }
});

// For tests and for who likes to look inside.
Object.assign(globalThis, { studio: { session, engine: session.engine } });
