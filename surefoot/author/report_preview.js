// The live half of the report: a puck in each space's drawing, and a figure that moves as the runtime would move there
// (report_blend.js). Findings and the marks of the drawing point at each other. Without this script the page is complete.
(() => {
  const k_svg = 'http://www.w3.org/2000/svg';
  const k_degrees = 180 / Math.PI;

  function make(tag, attributes = {}, ...children) {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.append(...children);
    return element;
  }
  function makeSvg(tag, attributes = {}, ...children) {
    const element = document.createElementNS(k_svg, tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.append(...children);
    return element;
  }

  // --- findings and their marks light up together

  function linkFindings() {
    const all = document.querySelectorAll('[data-finding]');
    const light = (event, on) => {
      const from = event.target.closest?.('[data-finding]');
      if (!from) return;
      for (const other of all)
        if (other.dataset.finding === from.dataset.finding) other.classList.toggle('lit', on);
    };
    for (const type of ['mouseover', 'focusin']) document.addEventListener(type, (event) => light(event, true));
    for (const type of ['mouseout', 'focusout']) document.addEventListener(type, (event) => light(event, false));
    const open = () => document.getElementById(location.hash.slice(1))?.closest('details')?.setAttribute('open', '');
    addEventListener('hashchange', open);
    open();
  }

  /// Paper cannot unfold: what is folded is printed open.
  function unfoldForPrint() {
    let folded = [];
    addEventListener('beforeprint', () => {
      folded = [...document.querySelectorAll('details:not([open])')];
      for (const details of folded) details.open = true;
    });
    addEventListener('afterprint', () => {
      for (const details of folded) details.open = false;
    });
  }

  // --- the figure

  /// Screen axes seen from the character: [right, up, towards the eye].
  function camera(azimuth, elevation) {
    const [sa, ca, se, ce] = [Math.sin(azimuth), Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation)];
    return [[ca, 0, -sa], [-sa * se, ce, -ca * se], [sa * ce, se, ca * ce]];
  }
  const k_views = { 'three-quarter': camera(-0.72, 0.26), side: camera(-Math.PI / 2, 0.1), front: camera(0, 0.1) };
  const k_grid = 0.5, k_grid_reach = 8; // [m], lines on either side
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

  class Stage {
    constructor(canvas, body) {
      this.canvas = canvas;
      this.body = body;
      this.view = 'three-quarter';
      this.readColours();
      matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.readColours());
    }

    readColours() {
      const style = getComputedStyle(document.documentElement);
      const colour = (name) => style.getPropertyValue(name).trim();
      this.colours = { left: colour('--left'), right: colour('--right'), body: colour('--limb'), halo: colour('--card'),
                       grid: colour('--hatch'), ink: colour('--ink') };
    }

    /// Fits the drawing to the element's size; false while it has none.
    begin() {
      const { clientWidth: w, clientHeight: h } = this.canvas, sharp = devicePixelRatio || 1;
      if (w === 0 || h === 0) return false;
      if (this.canvas.width !== Math.round(w * sharp) || this.canvas.height !== Math.round(h * sharp)) {
        this.canvas.width = Math.round(w * sharp);
        this.canvas.height = Math.round(h * sharp);
      }
      this.context = this.canvas.getContext('2d');
      this.context.setTransform(sharp, 0, 0, sharp, 0, 0);
      this.context.clearRect(0, 0, w, h);
      this.context.lineCap = this.context.lineJoin = 'round';
      this.scale = Math.min(h / (1.3 * this.body.height_m), w / (1.5 * this.body.height_m));
      this.middle = [w / 2, h / 2 + 0.5 * this.body.height_m * this.scale];
      return true;
    }

    project(p) {
      const [right, up] = k_views[this.view];
      return [this.middle[0] + this.scale * dot(p, right), this.middle[1] - this.scale * dot(p, up)];
    }

    line(a, b, width, colour, alpha = 1) {
      const c = this.context;
      c.globalAlpha = alpha;
      c.strokeStyle = colour;
      c.lineWidth = width;
      c.beginPath();
      c.moveTo(...this.project(a));
      c.lineTo(...this.project(b));
      c.stroke();
      c.globalAlpha = 1;
    }

    /// The ground's lines stand still in the world and pass below the character.
    ground(state, prints) {
      const [s, c] = [Math.sin(state.yaw), Math.cos(state.yaw)];
      const seen = (x, z) => [c * (x - state.x) - s * (z - state.z), 0, s * (x - state.x) + c * (z - state.z)];
      const reach = k_grid * k_grid_reach;
      const [mx, mz] = [Math.round(state.x / k_grid) * k_grid, Math.round(state.z / k_grid) * k_grid];
      for (let n = -k_grid_reach; n <= k_grid_reach; ++n) {
        const d = n * k_grid;
        this.line(seen(mx + d, mz - reach), seen(mx + d, mz + reach), 1, this.colours.grid, 0.8);
        this.line(seen(mx - reach, mz + d), seen(mx + reach, mz + d), 1, this.colours.grid, 0.8);
      }
      for (const print of prints)
        this.line(seen(...print.heel), seen(...print.toe), 0.09 * this.scale, this.colours[print.side], 0.3);
    }

    figure(points) {
      const toEye = k_views[this.view][2];
      const bones = this.body.bones.map((bone) => ({ ...bone, depth: dot(points[bone.a], toEye) + dot(points[bone.b], toEye) }));
      bones.sort((a, b) => a.depth - b.depth);
      for (const { a, b, width_m, side } of bones) {
        this.line(points[a], points[b], width_m * this.scale + 3, this.colours.halo);
        this.line(points[a], points[b], width_m * this.scale, this.colours[side]);
      }
      const c = this.context;
      c.fillStyle = this.colours.ink;
      c.font = '600 12px system-ui, sans-serif';
      c.textAlign = 'center';
      for (const side of ['left', 'right']) {
        const [x, y] = this.project(points[this.body.feet[side].toe]);
        c.fillText(side[0].toUpperCase(), x, y + 18);
      }
    }

    ghost(points) {
      for (const { a, b, side } of this.body.bones) this.line(points[a], points[b], 1.6, this.colours[side], 0.55);
    }
  }

  // --- a space with its puck

  class Preview {
    constructor(data, space, drawing, panel) {
      Object.assign(this, { data, space, drawing, panel, state: surefootBlend.start(), prints: [] });
      this.playing = !matchMedia('(prefers-reduced-motion: reduce)').matches;
      [this.acrossSlot, this.acrossAt0, this.acrossScale, this.upSlot, this.upAt0, this.upScale] =
        drawing.dataset.map.split(' ').map(Number);
      this.point = space.start;
      this.buildPanel();
      this.buildPuck();
      this.move(space.start);
    }

    buildPanel() {
      const button = make('button', { type: 'button', 'aria-pressed': String(this.playing) });
      const label = () => (button.textContent = this.playing ? 'Pause' : 'Play');
      button.addEventListener('click', () => {
        this.playing = !this.playing;
        button.setAttribute('aria-pressed', String(this.playing));
        label();
      });
      label();
      const canvas = make('canvas', { role: 'img', 'aria-label': 'A figure moving as the blend at the puck' });
      this.stage = new Stage(canvas, this.data.body);
      const views = make('select', { 'aria-label': 'View' });
      for (const view of Object.keys(k_views)) views.append(make('option', { value: view }, view));
      views.addEventListener('change', () => { this.stage.view = views.value; });
      const slow = make('input', { type: 'checkbox' }), ghosts = make('input', { type: 'checkbox' });
      Object.assign(this, { slow, ghosts });
      this.weights = make('ul', { class: 'weights' });
      this.obtained = make('p', { class: 'obtained', 'aria-live': 'polite' });
      const controls = make('div', { class: 'controls' }, button, views, make('label', {}, slow, ' quarter speed'),
                            make('label', {}, ghosts, ' show the clips'));
      const side = make('div', {}, controls, this.obtained, this.weights, ...this.sliders());
      this.panel.append(make('h3', {}, 'Try a blend'),
                        make('p', { class: 'hint' }, 'Drag the round puck in the drawing, or focus it and use the arrow keys. The ' +
                             'figure blends the clips around it as the runtime does; footprints stay where a foot stood.'),
                        make('div', { class: 'stage' }, canvas, side));
      this.panel.hidden = false;
      new IntersectionObserver((entries) => { this.visible = entries.at(-1).isIntersecting; }).observe(canvas);
    }

    /// Axes that the drawing does not show.
    sliders() {
      return this.space.axes.flatMap((axis, k) => {
        if (k === this.acrossSlot || k === this.upSlot) return [];
        const slider = make('input', { type: 'range', min: axis.low, max: axis.high, step: 'any', value: this.point[k] });
        slider.addEventListener('input', () => this.move(this.point.map((v, i) => (i === k ? Number(slider.value) : v))));
        return [make('label', { class: 'axis' }, axis.unit ? `${axis.name}, ${axis.unit} ` : `${axis.name} `, slider)];
      });
    }

    buildPuck() {
      this.live = makeSvg('polygon', { class: 'live' });
      this.lead = makeSvg('line', { class: 'lead-line' });
      this.puck = makeSvg('g', { class: 'puck', tabindex: 0, role: 'slider', 'aria-label': `Blend position in ${this.space.name}`,
                                 'aria-valuemin': 0, 'aria-valuemax': 1, 'aria-valuenow': 0 },
                          makeSvg('circle', { class: 'reach', r: 20 }), makeSvg('circle', { class: 'ring', r: 10 }),
                          makeSvg('circle', { class: 'core', r: 2.5 }));
      this.drawing.setAttribute('role', 'group');
      this.slices = makeSvg('g');
      this.drawing.querySelector('.below-samples').append(this.slices, this.live);
      this.drawing.append(this.lead, this.puck);
      const drag = (event) => {
        const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.drawing.getScreenCTM().inverse());
        this.moveTo(x, y);
      };
      this.drawing.addEventListener('pointerdown', (event) => {
        if (event.button !== 0 || event.target.closest('a')) return;
        if (event.pointerType === 'mouse' || event.target.closest('.puck')) {
          this.drawing.setPointerCapture(event.pointerId);
          this.dragging = true;
          event.preventDefault();
          this.puck.focus({ preventScroll: true });
        }
        drag(event);
      });
      this.drawing.addEventListener('pointermove', (event) => this.dragging && drag(event));
      for (const type of ['pointerup', 'pointercancel'])
        this.drawing.addEventListener(type, () => { this.dragging = false; });
      this.puck.addEventListener('keydown', (event) => {
        const step = event.shiftKey ? 60 : 12, way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
        if (!way) return;
        event.preventDefault();
        const [x, y] = this.pixels(this.point);
        this.moveTo(x + way[0] * step, y + way[1] * step);
      });
    }

    pixels(point) {
      const value = (slot) => (slot < 0 ? 0 : point[slot]);
      return [this.acrossAt0 + this.acrossScale * value(this.acrossSlot), this.upAt0 + this.upScale * value(this.upSlot)];
    }

    moveTo(x, y) {
      const point = [...this.point], put = (slot, value) => {
        const axis = this.space.axes[slot];
        if (axis) point[slot] = Math.min(Math.max(value, axis.low), axis.high);
      };
      put(this.acrossSlot, (x - this.acrossAt0) / this.acrossScale);
      put(this.upSlot, (y - this.upAt0) / this.upScale);
      this.move(point);
    }

    move(point) {
      this.point = point;
      this.found = surefootBlend.weightsAt(this.space, point);
      const { shares } = this.found;
      const [x, y] = this.pixels(point), [ax, ay] = this.pixels(this.found.at);
      this.puck.setAttribute('transform', `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      for (const [name, value] of Object.entries({ x1: x, y1: y, x2: ax, y2: ay })) this.lead.setAttribute(name, value.toFixed(1));
      this.lead.classList.toggle('hidden', !this.found.outside);
      if (this.space.axes.length > 2) this.cut();
      else this.live.setAttribute('points', this.polygon(shares.map(({ sample }) => this.space.samples[sample])));
      this.tell();
    }

    polygon(corners) {
      return corners.map((corner) => this.pixels(corner).map((v) => v.toFixed(1)).join()).join(' ');
    }

    /// Of a space of more than two axes the plane through the puck is drawn, and samples fade with their distance from it.
    cut() {
      this.drawing.classList.add('cut');
      const slice = (simplices) =>
        surefootBlend.slice({ ...this.space, simplices }, this.found.at, this.acrossSlot, this.upSlot).map((corners) => this.polygon(corners));
      this.slices.replaceChildren(...slice(this.space.simplices).map((points) => makeSvg('polygon', { class: 'slice', points })));
      this.live.setAttribute('points', slice([this.found.simplex])[0] ?? '');
      this.drawing.querySelectorAll('.sample').forEach((mark, i) => {
        const off = this.space.axes.map(({ low, high }, k) =>
          k === this.acrossSlot || k === this.upSlot ? 0 : Math.abs(this.space.samples[i][k] - this.found.at[k]) / (high - low));
        mark.setAttribute('opacity', Math.max(1 - 2 * Math.max(...off), 0.2).toFixed(2));
      });
    }

    describe(point) {
      return this.space.axes.map((axis, k) => `${axis.name} ${point[k].toFixed(axis.unit === 'm/s' || !axis.unit ? 2 : 0)} ${axis.unit}`.trim()).join(', ');
    }

    tell() {
      const asked = this.describe(this.point), { outside, shares, at } = this.found;
      this.puck.setAttribute('aria-valuetext', asked);
      const { velocity, turn, rate } = surefootBlend.motion(this.data, this.space, shares, this.state);
      const speed = Math.hypot(velocity[0], velocity[2]);
      this.obtained.textContent = `${asked}. ` + (outside ? `Outside what the clips cover: plays ${this.describe(at)}. ` : '') +
        `Moves at ${speed.toFixed(2)} m/s, turns ${(turn * k_degrees).toFixed(0)} deg/s` +
        (rate > 0 ? `, ${(120 * rate).toFixed(0)} steps a minute.` : '.');
      this.weights.replaceChildren(...[...shares].sort((a, b) => b.weight - a.weight).map(({ sample, weight }) => {
        const clip = this.data.clips[this.space.clips[sample]];
        return make('li', {}, make('span', { class: 'who' }, clip.name), make('progress', { max: 1, value: weight, 'aria-hidden': 'true' }),
                    make('b', {}, `${(100 * weight).toFixed(0)} %`));
      }));
    }

    /// A foot leaves its print in the middle of its stance, shortly after its strike.
    print(before, points) {
      const { phase } = this.state, { feet } = this.data.body;
      for (const [side, at] of [['left', 0.15], ['right', 0.65]]) {
        if (!(before < at && phase >= at)) continue;
        const [s, c] = [Math.sin(this.state.yaw), Math.cos(this.state.yaw)];
        const world = ([x, , z]) => [this.state.x + c * x + s * z, this.state.z + c * z - s * x];
        this.prints.push({ side, heel: world(points[feet[side].heel]), toe: world(points[feet[side].toe]) });
        if (this.prints.length > 8) this.prints.shift();
      }
    }

    frame(seconds) {
      if (!this.visible || !this.stage.begin()) return;
      const { shares } = this.found, before = this.state.phase;
      const moves = this.playing
        ? surefootBlend.advance(this.data, this.space, shares, this.state, seconds * (this.slow.checked ? 0.25 : 1))
        : surefootBlend.motion(this.data, this.space, shares, this.state);
      const leaves = surefootBlend.leavesOf(this.data, this.space, shares, this.state);
      const points = surefootBlend.points(this.data, leaves, this.state, moves);
      if (leaves.some(({ clip }) => clip.cycles > 0)) this.print(before, points);
      this.stage.ground(this.state, this.prints);
      if (this.ghosts.checked)
        for (const leaf of leaves) this.stage.ghost(surefootBlend.points(this.data, [{ ...leaf, weight: 1 }], this.state, moves));
      this.stage.figure(points);
    }
  }

  function startPreviews() {
    const source = document.getElementById('preview-data');
    if (!source) return;
    const data = surefootBlend.read(JSON.parse(source.textContent));
    const previews = data.spaces.map((space) => {
      const section = document.getElementById(`space-${space.index}`);
      return new Preview(data, space, section.querySelector('svg.space'), section.querySelector('.preview'));
    });
    let last = performance.now();
    const frame = (now) => {
      const seconds = Math.min((now - last) / 1000, 0.1);
      last = now;
      for (const preview of previews) preview.frame(seconds);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  linkFindings();
  unfoldForPrint();
  startPreviews();
})();
