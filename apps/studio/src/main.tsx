import { render } from 'preact';
import { useRef } from 'preact/hooks';
import { effect, signal, untracked } from '@preact/signals';
import './style.css';
import * as session from './session';
import * as crowd from './crowd';
import * as graph from './graph';
import { listen } from './input';
import * as bench from './bench';
import { isKept, openDropped, openFirst, openGiven } from './project';
import { course, gradeDeg, graphText, theme, workspace, type Theme, type Workspace } from './settings';
import { isDark } from './view/theme';
import { ProblemCard } from './ui/problem';
import { Timeline } from './ui/timeline';
import { Viewport } from './ui/viewport';
import { WorkCard } from './ui/work';
import { CrowdPanel, CrowdViewport } from './workspaces/crowd';
import * as gait from './gait';
import { GaitDesk, GaitPanel } from './workspaces/gait';
import { GraphDesk, GraphPanel } from './workspaces/graph';
import { spaceKeys, SpacePanel } from './workspaces/space';
import { SpaceMap } from './workspaces/space_map';
import { TerrainPanel } from './workspaces/terrain';

const panelOpen = signal(matchMedia('(min-width: 1000px)').matches);
const k_next_theme: Record<Theme, Theme> = { system: 'light', light: 'dark', dark: 'system' };
const k_theme_names: Record<Theme, string> = { system: 'as the system', light: 'light', dark: 'dark' };

/** A button that chooses files, or a whole folder. */
function Chooser(props: { label: string; title: string; folder?: boolean; accept?: string }) {
  const input = useRef<HTMLInputElement>(null);
  return (
    <>
      <button type="button" onClick={() => input.current!.click()} title={props.title}>{props.label}</button>
      <input
        ref={(element) => {
          input.current = element;
          if (props.folder) element?.setAttribute('webkitdirectory', '');
        }}
        class={`hidden ${props.folder ? 'folder' : 'files'}`}
        type="file"
        multiple
        accept={props.accept}
        tabIndex={-1}
        aria-hidden="true"
        onChange={(event) => {
          const files = [...(event.currentTarget.files ?? [])];
          event.currentTarget.value = '';
          if (files.length > 0) void openGiven(files.map((file) => ({ path: file.webkitRelativePath || file.name, file })));
        }}
      />
    </>
  );
}

const dragged = signal(false);

const k_workspaces: { value: Workspace; label: string }[] = [
  { value: 'gait', label: 'Gait' },
  { value: 'space', label: 'Blend space' },
  { value: 'terrain', label: 'Terrain' },
  { value: 'graph', label: 'Graph' },
  { value: 'crowd', label: 'Crowd' },
];
const k_panels: Record<Workspace, () => preact.JSX.Element> = { gait: GaitPanel, space: SpacePanel, terrain: TerrainPanel, graph: GraphPanel, crowd: CrowdPanel };

/** Arrow keys go from tab to tab, as everywhere. */
function moveTab(event: KeyboardEvent): void {
  const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
  if (step === 0) return;
  event.preventDefault();
  const now = k_workspaces.findIndex((each) => each.value === workspace.value);
  const next = k_workspaces[(now + step + k_workspaces.length) % k_workspaces.length]!;
  workspace.value = next.value;
  document.getElementById(`tab-${next.value}`)?.focus();
}

function Studio() {
  const known = session.facts.value;
  const Panel = k_panels[workspace.value];
  return (
    <div
      class={`studio ${workspace.value}${panelOpen.value ? '' : ' narrow'}`}
      onDragOver={(event) => {
        event.preventDefault();
        dragged.value = true;
      }}
      onDragLeave={(event) => event.relatedTarget === null && (dragged.value = false)}
      onDrop={(event) => {
        event.preventDefault();
        dragged.value = false;
        if (event.dataTransfer) void openDropped(event.dataTransfer.items);
      }}
    >
      <header class="bar">
        <h1>
          <img src="./icon.svg" alt="" width="24" height="24" />
          Surefoot
        </h1>
        <div role="tablist" aria-label="Workspaces">
          {k_workspaces.map(({ value, label }) => (
            <button
              key={value}
              type="button"
              role="tab"
              id={`tab-${value}`}
              aria-selected={workspace.value === value}
              aria-controls="panel"
              tabIndex={workspace.value === value ? 0 : -1}
              onClick={() => (workspace.value = value)}
              onKeyDown={moveTab}
            >
              {label}
            </button>
          ))}
        </div>
        <p class="character">{!known ? 'Starting the engine…' : known.clipNames.length > 0 ? `${known.name}, ${known.clipNames.length} clips` : known.name}</p>
        <Chooser label="Open folder…" title="A project that `surefoot author` wrote, or a folder of clips; you can also drag it in" folder />
        <Chooser label="Open clips…" title=".bvh and .glb files to make a blend space of; you can also drag them in" accept=".bvh,.glb,.gltf,.json,.zip" />
        <button type="button" title={`Colours: ${k_theme_names[theme.value]}`} aria-label={`Colours: ${k_theme_names[theme.value]}`} onClick={() => (theme.value = k_next_theme[theme.value])}>
          <svg viewBox="0 0 20 20" aria-hidden="true"><path d="M10 2a8 8 0 1 0 0 16zM10 3.5a6.5 6.5 0 0 1 0 13z" /></svg>
        </button>
        <button type="button" aria-expanded={panelOpen.value} aria-controls="panel" title="Panel" aria-label="Panel" onClick={() => (panelOpen.value = !panelOpen.value)}>
          <svg viewBox="0 0 20 20" aria-hidden="true"><path d="M3 4h14v12H3zM4.500 5.500v9h6.500v-9z" fill-rule="evenodd" /></svg>
        </button>
      </header>
      <main>
        {workspace.value === 'space' && <SpaceMap />}
        {workspace.value === 'gait' && <GaitDesk />}
        {workspace.value === 'graph' && <GraphDesk />}
        {workspace.value === 'crowd' ? <CrowdViewport /> : <Viewport />}
      </main>
      <div class="panel" id="panel" role="tabpanel" aria-labelledby={`tab-${workspace.value}`} hidden={!panelOpen.value}>
        <Panel />
      </div>
      <Timeline />
      <ProblemCard />
      <WorkCard />
      {dragged.value && <p class="drop">Drop a project’s folder, or clips (.bvh, .glb) to make a blend space of</p>}
    </div>
  );
}

effect(() => {
  document.documentElement.dataset['theme'] = isDark.value ? 'dark' : 'light';
});
/** What a workspace begins with. */
async function enter(where: Workspace): Promise<void> {
  session.present(where === 'crowd' ? crowd.crowdShow : where === 'graph' ? graph.graphShow : null);
  if (where !== 'space') session.hold(null);
  if (where === 'crowd') return crowd.makeCrowd();
  if (where === 'gait') return gait.loadGait();
  await session.stopGuests();
  if (where === 'graph') return graph.loadGraph();
  if (where === 'space') {
    // Shown on flat ground, where the puck alone says how it goes.
    if (session.shownCourse() !== 'flat') await session.showCourse('flat', gradeDeg.value);
    void bench.openDefaultBench(); // which takes its time
    return;
  }
  if (session.shownCourse() !== course.value) await session.showCourse(course.value, gradeDeg.value);
}

let entering = Promise.resolve();
effect(() => {
  const where = workspace.value;
  if (session.opened.value === 0) return;
  // One after the other: what one leaves, the next one takes over. Who has gone on meanwhile is not kept waiting.
  untracked(() => {
    entering = entering
      .then(() => (where === workspace.value ? enter(where) : undefined))
      .catch((error: unknown) => session.fail('This workspace cannot be shown', error));
  });
});
listen();
addEventListener('keydown', (event) => {
  if (session.showsGait()) gait.gaitKeys(event);
  if (session.showsGraph()) graph.graphKeys(event);
  if (workspace.value === 'space') spaceKeys(event);
});
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
Object.assign(globalThis, {
  studio: {
    session,
    engine: session.engine,
    entered: () => entering,
    isKept,
    bench,
    gait,
    crowd: () => ({ facts: crowd.crowd.value?.facts, posed: crowd.posed.value, costs: crowd.costs, texels: crowd.texels.length, heights: [...crowd.texels.subarray(0, 4 * (crowd.crowd.value?.facts.count ?? 0))].filter((_, i) => i % 4 === 1) }),
    graph: { ...graph, text: () => graphText.value ?? graph.k_first_graph },
  },
});
