'use strict';
// The map of a sweep: a mark per run over two columns, coloured by a third.

// An axis over a column: its range, and the cell of each value between half ways to its neighbours.
class MapAxis {
  constructor(column) {
    this.column = column;
    this.log = column.isLogarithmic;
    const at = column.different.filter(Number.isFinite);
    const forth = this.log ? Math.log : (x) => x, back = this.log ? Math.exp : (x) => x;
    const u = at.map(forth);
    const first = u.length > 1 ? 0.5 * (u[1] - u[0]) : 0.5, last = u.length > 1 ? 0.5 * (u[u.length - 1] - u[u.length - 2]) : 0.5;
    this.edges = new Map(at.map((value, i) => [value, [
      back(i > 0 ? 0.5 * (u[i - 1] + u[i]) : u[i] - first),
      back(i + 1 < u.length ? 0.5 * (u[i] + u[i + 1]) : u[i] + last)]]));
    this.range = u.length > 0 ? [back(u[0] - first), back(u[u.length - 1] + last)] : [0, 1];
  }
  // For points, a margin of the whole range on either side.
  get wideRange() {
    if (this.column.words || this.column.different.length < 2) return this.range;
    const at = this.column.different.filter(Number.isFinite);
    const [low, high] = [at[0], at[at.length - 1]];
    if (this.log) return [low * (low / high) ** 0.03, high * (high / low) ** 0.03];
    return [low - 0.04 * (high - low), high + 0.04 * (high - low)];
  }
  get options() {
    const {column} = this;
    const ticks = column.words ? column.words.map((label, at) => ({at, label})) : undefined;
    return {label: column.title, log: this.log, ticks};
  }
}

// `listener`: choose(run) and open(), called when the reader chooses a run and asks for its numbers.
class SweepMap {
  constructor(runs, canvas, listener) {
    Object.assign(this, {runs, canvas, listener});
    this.chosen = this.hovered = -1;
    this.rings = {chosen: overlay(canvas, 'ring chosen'), hovered: overlay(canvas, 'ring hovered')};
    canvas.addEventListener('mousemove', (event) => this.hover(this.runAt(event.offsetX, event.offsetY), event));
    canvas.addEventListener('mouseleave', () => this.hover(-1));
    canvas.addEventListener('click', (event) => {
      const run = this.runAt(event.offsetX, event.offsetY);
      if (run < 0) return;
      listener.choose(run);
      listener.open();
    });
    canvas.addEventListener('keydown', (event) => this.key(event));
    canvas.addEventListener('focus', () => { if (this.chosen < 0) listener.choose(this.visible[0] ?? -1); });
  }

  // Columns across, upwards and as colours; `wanted`: columns with the values that runs must have.
  show(across, upwards, shown, wanted) {
    this.x = new MapAxis(across);
    this.y = new MapAxis(upwards);
    this.shade = new Shade(shown);
    this.visible = this.runs.numbers.map((_, run) => run).filter((run) =>
      Number.isFinite(across.values[run]) && Number.isFinite(upwards.values[run])
      && wanted.every(([column, value]) => column.values[run] === value));
    this.arrange();
    this.hovered = -1;
    this.draw();
  }

  choose(run) {
    this.chosen = run;
    this.drawHighlights();
  }

  // Runs that share a place; a grid if most places of the grid are taken.
  arrange() {
    this.groups = new Map();
    for (const run of this.visible) {
      const place = `${this.x.column.values[run]} ${this.y.column.values[run]}`;
      if (!this.groups.has(place)) this.groups.set(place, []);
      this.groups.get(place).push(run);
    }
    const n = this.x.column.different.length * this.y.column.different.length;
    this.isGrid = this.x.column.isKey && this.y.column.isKey && this.x.column !== this.y.column && 2 * this.groups.size >= n;
  }

  // How many runs there are, and what is not to be seen.
  note(isFiltered) {
    const n = this.runs.numbers.length;
    const shared = Math.max(0, ...Array.from(this.groups.values(), (runs) => runs.length));
    return `${this.visible.length} of ${n} runs`
      + (this.visible.length < n && !isFiltered ? '; the others have no value on an axis' : '')
      + (this.isGrid && shared > 1 ? `; up to ${shared} runs share a field, each has a part of it` : '')
      + '.';
  }

  draw() {
    const {x, y} = this;
    const range = (axis) => (this.isGrid ? axis.range : axis.wideRange);
    const options = {x: {range: range(x), ...x.options}, y: {range: range(y), ...y.options}, top: 26};
    const axes = this.axes = new Axes(this.canvas, {...options, left: new Axes(this.canvas, options).roomForLabels()});
    axes.frame();
    this.marks = [];
    for (const runs of this.groups.values()) this.isGrid ? this.addCells(runs) : this.addPoints(runs);
    axes.inside((draw) => this.marks.forEach((mark) => this.drawMark(draw, mark)));
    this.drawKey();
    this.drawHighlights();
    this.shade.draw(byId('scale'));
  }

  // The field of a place, divided among its runs.
  addCells(runs) {
    const {axes, x, y} = this;
    const [left, right] = x.edges.get(x.column.values[runs[0]]).map((value) => axes.toX(value));
    const [bottom, top] = y.edges.get(y.column.values[runs[0]]).map((value) => axes.toY(value));
    const n = Math.ceil(Math.sqrt(runs.length)), rows = Math.ceil(runs.length / n);
    const width = (right - left) / n, height = (bottom - top) / rows;
    runs.forEach((run, i) => this.marks.push(
      {run, left: left + (i % n) * width, top: top + Math.floor(i / n) * height, width, height}));
  }

  addPoints(runs) {
    const {axes, x, y} = this;
    for (const run of runs) {
      const [px, py] = [axes.toX(x.column.values[run]), axes.toY(y.column.values[run])];
      this.marks.push({run, left: px - 4.5, top: py - 4.5, width: 9, height: 9, isPoint: true});
    }
  }

  static outline(draw, {left, top, width, height, isPoint}) {
    draw.beginPath();
    if (isPoint) draw.arc(left + width / 2, top + height / 2, width / 2, 0, 2 * Math.PI);
    else draw.rect(left, top, width, height);
  }

  drawMark(draw, mark) {
    const value = this.shade.column.values[mark.run];
    const tone = this.shade.of(value);
    SweepMap.outline(draw, mark);
    draw.fillStyle = tone ?? colour('grid');
    draw.fill();
    if (mark.isPoint) {
      draw.strokeStyle = colour('text');
      draw.lineWidth = 0.7;
      draw.stroke();
    }
    if (tone === null) this.drawLack(mark);
    else if (this.runs.certainty(mark.run) === 'uncertain') this.drawCross(mark, this.shade.contrast(value));
    if (tone === null || mark.width < 42 || mark.height < 40) return;
    draw.fillStyle = this.shade.contrast(value);
    draw.textAlign = 'center';
    draw.fillText(this.shade.column.words?.[value] ?? printed(value, 3), mark.left + mark.width / 2, mark.top + mark.height / 2 + 14);
  }

  // Count and order of the run's sub-impacts are not certain.
  drawCross({left, top, width, height}, tone) {
    const size = Math.min(5, 0.32 * Math.min(width, height));
    const x = left + width / 2, y = top + height / 2;
    for (const rise of [-size, size]) {
      this.axes.line([[x - size, y + rise], [x + size, y - rise]], {colour: tone, width: size > 2.5 ? 1.5 : 1});
    }
  }

  // No value: the run was refused, or left no result.
  drawLack({left, top, width, height}) {
    const y = top + 0.5 * height;
    this.axes.line([[left + 0.2 * width, y], [left + 0.8 * width, y]], {colour: colour('soft'), width: 1});
  }

  drawKey() {
    const {axes, shade, visible} = this;
    const {draw} = axes;
    const entries = [];
    const add = (words, paint) => entries.push([words, 14, (x, y) => {
      const mark = {left: x, top: y - 7, width: 14, height: 14};
      SweepMap.outline(draw, mark);
      paint(mark);
    }]);
    if (visible.some((run) => this.runs.certainty(run) === 'uncertain')) {
      add('count not certain', (mark) => {
        draw.strokeStyle = colour('soft');
        draw.stroke();
        this.drawCross(mark, colour('text'));
      });
    }
    if (visible.some((run) => shade.of(shade.column.values[run]) === null)) {
      add('no value', (mark) => {
        draw.fillStyle = colour('grid');
        draw.fill();
        this.drawLack(mark);
      });
    }
    axes.key(entries, 12);
  }

  // Rings around the run that is chosen and the one that is pointed at.
  drawHighlights() {
    for (const [name, ring] of Object.entries(this.rings)) {
      const mark = this.marks.find(({run}) => run === this[name]);
      ring.hidden = !mark;
      if (!mark) continue;
      ring.classList.toggle('round', Boolean(mark.isPoint));
      for (const side of ['left', 'top', 'width', 'height']) ring.style[side] = `${mark[side]}px`;
    }
  }

  runAt(x, y) {
    return this.nearest(15, ({isPoint, left, top, width, height}, dx, dy) => {
      if (isPoint) return Math.hypot(dx, dy);
      return x >= left && x < left + width && y >= top && y < top + height ? -1 : Infinity;
    }, [x, y]);
  }

  static centre({left, top, width, height}) { return [left + width / 2, top + height / 2]; }

  // The run whose mark has the least distance(mark, x, y), below `most`, or -1. x, y: from a place.
  nearest(most, distance, [x, y]) {
    let best = -1, least = most;
    for (const mark of this.marks) {
      const [markX, markY] = SweepMap.centre(mark);
      const far = distance(mark, markX - x, markY - y);
      if (far < least) [best, least] = [mark.run, far];
    }
    return best;
  }

  hover(run, event) {
    const tip = byId('tip');
    this.canvas.style.cursor = run >= 0 ? 'pointer' : '';
    tip.hidden = run < 0;
    if (event && run >= 0) {
      tip.textContent = this.runs.words(run, this.shade.column);
      const {clientWidth: width} = this.canvas;
      const right = event.offsetX > 0.55 * width;
      Object.assign(tip.style, {top: `${event.offsetY + 16}px`, left: right ? 'auto' : `${event.offsetX + 12}px`,
                                right: right ? `${width - event.offsetX + 12}px` : 'auto'});
    }
    if (run === this.hovered) return;
    this.hovered = run;
    this.drawHighlights();
  }

  key(event) {
    actOn(event, {
      ArrowLeft: () => this.chooseTowards(-1, 0), ArrowRight: () => this.chooseTowards(1, 0),
      ArrowUp: () => this.chooseTowards(0, -1), ArrowDown: () => this.chooseTowards(0, 1),
      n: () => this.chooseBeside(1), p: () => this.chooseBeside(-1), Enter: () => this.listener.open()});
  }

  // The nearest run in a direction, which counts more than the way across.
  chooseTowards(dx, dy) {
    const here = this.marks.find(({run}) => run === this.chosen);
    if (!here) return this.listener.choose(this.visible[0] ?? -1);
    this.listener.choose(this.nearest(Infinity, (mark, x, y) => {
      const along = x * dx + y * dy, across = Math.abs(x * dy) + Math.abs(y * dx);
      return along > 0.5 && along >= across ? along + 3 * across : Infinity;
    }, SweepMap.centre(here)));
  }

  chooseBeside(sense) { this.listener.choose(Math.min(Math.max(this.chosen + sense, 0), this.runs.numbers.length - 1)); }
}
