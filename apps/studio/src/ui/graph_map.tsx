// A state machine, drawn: states where they can all be seen, transitions as arrows, weights as fillings; and the tree
// of nodes that a state plays.
import type { GraphFacts, GraphLive, GraphMachine, GraphTransition } from '../engine/messages';

const k_width = 600, k_height = 300;
const k_box = { width: 124, height: 46 };
const k_any = { x: 44, y: 26 };
const percent = (share: number) => `${Math.round(100 * share)} %`;

interface Point {
  x: number;
  y: number;
}

/** On an ellipse, the first one to the left: two are side by side. */
function placesOf(count: number): Point[] {
  if (count === 1) return [{ x: k_width / 2, y: k_height / 2 }];
  return Array.from({ length: count }, (_, i) => {
    const angle = Math.PI + (2 * Math.PI * i) / count;
    return { x: k_width / 2 + 0.36 * k_width * Math.cos(angle), y: k_height / 2 + 0.35 * k_height * Math.sin(angle) };
  });
}

/** Where the straight way from the middle of a box towards a point leaves it. */
function rim(from: Point, to: Point, half: Point): Point {
  const x = to.x - from.x, y = to.y - from.y;
  const share = Math.min(half.x / Math.max(Math.abs(x), 1e-6), half.y / Math.max(Math.abs(y), 1e-6));
  return { x: from.x + share * x, y: from.y + share * y };
}

interface Arrow {
  from: Point;
  bend: Point;
  to: Point;
}

function arrowOf(transition: GraphTransition, places: Point[]): Arrow {
  const start = transition.from < 0 ? k_any : places[transition.from]!, end = places[transition.to]!;
  const x = end.x - start.x, y = end.y - start.y, length = Math.max(Math.hypot(x, y), 1);
  // To the left of its way: there and back do not lie upon each other.
  const aside = transition.from < 0 ? 4 : 34;
  const bend = { x: (start.x + end.x) / 2 + (aside * y) / length, y: (start.y + end.y) / 2 - (aside * x) / length };
  const half = { x: k_box.width / 2 + 4, y: k_box.height / 2 + 4 };
  return { from: rim(start, bend, transition.from < 0 ? { x: 26, y: 14 } : half), bend, to: rim(end, bend, half) };
}

const along = ({ from, bend, to }: Arrow, t: number): Point => ({
  x: (1 - t) ** 2 * from.x + 2 * t * (1 - t) * bend.x + t * t * to.x,
  y: (1 - t) ** 2 * from.y + 2 * t * (1 - t) * bend.y + t * t * to.y,
});

/** Beside the arrow's middle, on the outside of its bend. */
function labelOf(arrow: Arrow): Point & { anchor: 'start' | 'middle' | 'end' } {
  const { x, y } = along(arrow, 0.5);
  const out = { x: arrow.to.y - arrow.from.y, y: arrow.from.x - arrow.to.x };
  if (Math.abs(out.x) > Math.abs(out.y)) return { x: x + 8 * Math.sign(out.x), y: y - 3, anchor: out.x > 0 ? 'start' : 'end' };
  return { x, y: out.y > 0 ? y + 16 : y - 20, anchor: 'middle' };
}

function Transition(props: { transition: GraphTransition; arrow: Arrow; chosen: boolean; share: number | null; onChoose: () => void }) {
  const { transition, arrow, share } = props;
  const path = `M${arrow.from.x} ${arrow.from.y} Q${arrow.bend.x} ${arrow.bend.y} ${arrow.to.x} ${arrow.to.y}`;
  const middle = labelOf(arrow), mark = share === null ? null : along(arrow, share);
  return (
    <g
      class={`transition${props.chosen ? ' on' : ''}${share === null ? '' : ' runs'}`}
      role="button"
      tabindex={0} // of SVG, whose names are as they are written
      aria-pressed={props.chosen}
      aria-label={`Transition ${transition.name}, ${transition.seconds} s, when ${transition.when}${share === null ? '' : ', running'}`}
      onClick={props.onChoose}
      onKeyDown={(event) => {
        if (event.key !== 'Enter' && event.key !== ' ') return;
        event.preventDefault();
        props.onChoose();
      }}
    >
      <path class="reach" d={path} />
      <path class="line" d={path} marker-end={`url(#arrow${share === null ? (props.chosen ? '-on' : '') : '-runs'})`} />
      <text x={middle.x} y={middle.y} text-anchor={middle.anchor}>
        {transition.name.replaceAll('_', ' ')}
      </text>
      <text class="seconds" x={middle.x} y={middle.y + 13} text-anchor={middle.anchor}>
        {transition.seconds} s{transition.kind === 'inertialize' ? ', inertial' : ''}
      </text>
      {mark && <circle cx={mark.x} cy={mark.y} r="6" />}
    </g>
  );
}

export function MachineMap(props: { machine: GraphMachine; live: GraphLive | null; index: number; chosen: number; onChoose: (transition: number) => void }) {
  const { machine, live } = props;
  const places = placesOf(machine.states.length), now = live?.machines[props.index];
  const whole = live?.weights[machine.node] ?? 0;
  return (
    <svg class="machine" viewBox={`0 0 ${k_width} ${k_height}`} role="group" aria-label={`State machine ${machine.path}`}>
      <defs>
        {['', '-on', '-runs'].map((kind) => (
          <marker key={kind} id={`arrow${kind}`} class={`arrow${kind}`} viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8" markerHeight="8" markerUnits="userSpaceOnUse" orient="auto">
            <path d="M0 0L8 4L0 8z" />
          </marker>
        ))}
      </defs>
      {machine.transitions.some((each) => each.from < 0) && (
        <g class="any">
          <rect x={k_any.x - 24} y={k_any.y - 12} width="48" height="24" rx="12" />
          <text x={k_any.x} y={k_any.y + 4} text-anchor="middle">any</text>
        </g>
      )}
      {machine.transitions.map((transition, i) => (
        <Transition
          key={transition.name}
          transition={transition}
          arrow={arrowOf(transition, places)}
          chosen={props.chosen === i}
          share={now?.transition === i ? Math.min(now.elapsed / Math.max(transition.seconds, 1e-3), 1) : null}
          onChoose={() => props.onChoose(i)}
        />
      ))}
      {machine.states.map((state, i) => {
        const { x, y } = places[i]!, weight = whole > 0 ? Math.min((live?.weights[state.node] ?? 0) / whole, 1) : 0;
        return (
          <g key={state.name} class={`state${now?.state === i ? ' on' : ''}`} transform={`translate(${x - k_box.width / 2} ${y - k_box.height / 2})`}>
            <rect class="box" {...k_box} rx="9" />
            <rect class="weight" width={k_box.width} height={k_box.height} rx="9" style={{ fillOpacity: 0.55 * weight }} />
            <text x={k_box.width / 2} y="20" text-anchor="middle">{state.name}</text>
            <text class="share" x={k_box.width / 2} y="37" text-anchor="middle">{percent(weight)}</text>
          </g>
        );
      })}
    </svg>
  );
}

const k_row = 40, k_column = 168, k_node = { width: 148, height: 32 };

interface Placed {
  node: number;
  depth: number;
  row: number;
  children: Placed[];
}

/** Leaves in rows of their own, parents in the middle of their children. */
function layOut(graph: GraphFacts, node: number, depth: number, next: { row: number }): Placed {
  const children = graph.nodes[node]!.children.map((child) => layOut(graph, child, depth + 1, next));
  const row = children.length === 0 ? next.row++ : (children[0]!.row + children.at(-1)!.row) / 2;
  return { node, depth, row, children };
}

const nameOf = (path: string) => path.split('/').at(-1)!.replaceAll('_', ' ');

export function BlendTree({ graph, live }: { graph: GraphFacts; live: GraphLive | null }) {
  const next = { row: 0 };
  const root = layOut(graph, graph.nodes.length - 1, 0, next);
  const all: Placed[] = [];
  const collect = (placed: Placed): void => {
    all.push(placed);
    placed.children.forEach(collect);
  };
  collect(root);
  const depth = Math.max(...all.map((each) => each.depth));
  const width = depth * k_column + k_node.width + 4, height = next.row * k_row + 2;
  const x = ({ depth }: Placed) => 2 + depth * k_column, y = ({ row }: Placed) => 3 + row * k_row;
  const weight = ({ node }: Placed) => live?.weights[node] ?? 0;
  return (
    <svg class="tree" viewBox={`0 0 ${width} ${height}`} style={{ width: `${width}px` }} role="img" aria-label="The tree of nodes, with the weight of each">
      {all.flatMap((parent) =>
        parent.children.map((child) => {
          const from = { x: x(parent) + k_node.width, y: y(parent) + k_node.height / 2 }, to = { x: x(child), y: y(child) + k_node.height / 2 };
          const middle = (from.x + to.x) / 2;
          return (
            <path key={child.node} class="branch" style={{ strokeWidth: 1 + 4 * weight(child), strokeOpacity: 0.25 + 0.75 * weight(child) }} d={`M${from.x} ${from.y}C${middle} ${from.y} ${middle} ${to.y} ${to.x} ${to.y}`} />
          );
        }),
      )}
      {all.map((placed) => {
        const { path, type, detail } = graph.nodes[placed.node]!;
        return (
          <g key={placed.node} class={`node${weight(placed) > 0 ? ' plays' : ''}`} transform={`translate(${x(placed)} ${y(placed)})`}>
            <title>{`${path}: ${type}${detail ? `, ${detail}` : ''}, weight ${percent(weight(placed))}`}</title>
            <rect class="box" {...k_node} rx="6" />
            <rect class="weight" width={k_node.width} height={k_node.height} rx="6" style={{ fillOpacity: 0.5 * weight(placed) }} />
            <text x="8" y="14">{nameOf(path)}</text>
            <text class="share" x={k_node.width - 7} y="14" text-anchor="end">{percent(weight(placed))}</text>
            <text class="detail" x="8" y="26">{detail && detail !== nameOf(path) ? `${type}: ${detail}`.slice(0, 24) : type}</text>
          </g>
        );
      })}
    </svg>
  );
}
