'use strict';
// The page of a sweep: a map of its runs, and the numbers of the run that is chosen.

const byId = (id) => document.getElementById(id);

// From low to high; distinguishable without colours, on light and dark ground.
const shadeStops = [[68, 1, 84], [62, 74, 137], [38, 130, 142], [53, 183, 121], [180, 222, 44], [253, 231, 37]];
const wordColours = ['line1', 'line2', 'line3', 'line4', 'line5', 'line6'];

// A value of a column per run: a number in the unit of its label, or a word.
class SweepColumn {
  constructor({name, label, unit, factor, is_key: isKey, is_flag: isFlag, values}) {
    Object.assign(this, {name, label, unit, isKey, isFlag, words: values.words ?? null});
    this.values = this.words ? values.indices : unpacked(values).map((value) => factor * value);
    const known = Array.from(this.values).filter((value) => !Number.isNaN(value));
    this.different = [...new Set(known)].sort((a, b) => a - b);
  }
  get title() { return this.unit ? `${this.label}, ${this.unit}` : this.label; }
  text(run) {
    const value = this.values[run];
    if (this.words) return this.words[value];
    if (Number.isNaN(value)) return '–';
    return printed(value, 7) + (this.unit ? ' ' + this.unit : '');
  }
  // Values on a logarithmic axis: all positive, their ratios more alike than their differences.
  get isLogarithmic() {
    const at = this.different;
    if (this.words || at.length < 3 || !(at[0] > 0) || !Number.isFinite(at[at.length - 1])) return false;
    const spread = (steps) => Math.max(...steps) / Math.min(...steps);
    const pairs = at.slice(1).map((value, i) => [at[i], value]);
    return at[at.length - 1] / at[0] >= 3 && spread(pairs.map(([a, b]) => Math.log(b / a))) < spread(pairs.map(([a, b]) => b - a));
  }
}

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

// Colours over a column.
class Shade {
  constructor(column) {
    this.column = column;
    const at = column.different.filter(Number.isFinite);
    [this.low, this.high] = [at[0] ?? 0, at[at.length - 1] ?? 1];
    this.log = !column.words && this.low > 0 && this.high / this.low > 1e3;
  }
  share(value) {
    if (!(this.high > this.low)) return 0.5;
    return this.log ? Math.log(value / this.low) / Math.log(this.high / this.low) : (value - this.low) / (this.high - this.low);
  }
  // The colour of a value as red, green and blue; null where there is none.
  rgb(value) {
    if (!Number.isFinite(value)) return null;
    const place = Math.min(Math.max(this.share(value), 0), 1) * (shadeStops.length - 1);
    const k = Math.min(Math.floor(place), shadeStops.length - 2);
    return shadeStops[k].map((from, i) => Math.round(from + (place - k) * (shadeStops[k + 1][i] - from)));
  }
  of(value) {
    if (this.column.words) return colour(wordColours[value % wordColours.length]);
    const rgb = this.rgb(value);
    return rgb ? `rgb(${rgb.join(' ')})` : null;
  }
  // Of a mark on that colour.
  contrast(value) {
    if (this.column.words) return colour('paper');
    const [r, g, b] = this.rgb(value) ?? [0, 0, 0];
    return 0.299 * r + 0.587 * g + 0.114 * b > 140 ? '#000000' : '#ffffff';
  }

  // Of counts, whole numbers only.
  ticks(axes) {
    const ticks = axes.ticks(axes.x, axes.right - axes.left, 90);
    if (!this.column.different.every(Number.isInteger)) return ticks;
    return ticks.filter(({at}) => Math.abs(at - Math.round(at)) < 1e-9).map(({at}) => ({at, label: printed(Math.round(at), 7)}));
  }

  // The key: a strip of colours with ticks, or words with samples.
  draw(canvas) {
    const {column} = this;
    const from = this.high > this.low ? this.low : this.low - 1, to = this.high > this.low ? this.high : this.low + 1;
    const axes = new Axes(canvas, {x: {range: [from, to], label: column.title, log: this.log}, y: {range: [0, 1]}, top: 2});
    const {draw} = axes;
    if (column.words) {
      let x = axes.left;
      column.words.forEach((word, k) => {
        draw.fillStyle = this.of(k);
        draw.fillRect(x, 6, 18, 12);
        axes.text(word, x + 24, 12);
        x += 44 + draw.measureText(word).width;
      });
      return;
    }
    for (let x = axes.left; x < axes.right; ++x) {
      const share = (x - axes.left) / (axes.right - axes.left);
      draw.fillStyle = this.of(this.log ? from * (to / from) ** share : from + share * (to - from));
      draw.fillRect(x, 2, 1.5, axes.bottom - 2);
    }
    draw.font = '12px system-ui, sans-serif';
    draw.fillStyle = colour('text');
    draw.textAlign = 'center';
    draw.textBaseline = 'top';
    for (const {at, label} of this.ticks(axes)) draw.fillText(label, axes.toX(at), axes.bottom + 5);
    draw.fillText(column.title, 0.5 * (axes.left + axes.right), axes.bottom + 24);
  }
}

class SweepPage {
  constructor(data) {
    this.numbers = data.numbers;
    this.columns = data.columns.map((column) => new SweepColumn(column));
    this.keys = this.columns.filter((column) => column.isKey);
    this.readSubImpacts(data.sub_impacts);
    this.chosen = this.hovered = -1;
    this.filters = [];
    this.addChoices();
    this.addMap();
    byId('before').addEventListener('click', () => this.chooseBeside(-1));
    byId('after').addEventListener('click', () => this.chooseBeside(1));
    addThemeButton(() => this.draw());
    new ResizeObserver(() => this.later()).observe(document.body);
    addEventListener('beforeprint', () => this.printing(true));
    addEventListener('afterprint', () => this.printing(false));
    byId('run').hidden = true;
    this.change();
  }

  column(name) { return this.columns.find((column) => column.name === name); }

  readSubImpacts({counts, ...packed}) {
    this.subImpactColumns = Object.fromEntries(Object.entries(packed).map(([name, values]) => [name, unpacked(values)]));
    let first = 0;
    this.places = counts.map((count) => {
      const place = {first, count};
      first += Math.max(count, 0);
      return place;
    });
  }

  // --- choices -------------------------------------------------------------------------------------

  addChoices() {
    const [first, second] = this.keys;
    const results = this.columns.filter((column) => !column.isKey && column.name !== 'message');
    const fill = (id, columns, selected) => {
      for (const column of columns) byId(id).append(new Option(column.title, column.name));
      byId(id).value = selected?.name ?? columns[0]?.name;
      byId(id).addEventListener('change', () => this.change());
    };
    const count = this.column('n_sub_impacts') ?? results.find(({words}) => !words) ?? results[0];
    const numeric = results.filter(({words}) => !words);
    fill('x', this.keys.length > 0 ? [...this.keys, ...numeric] : numeric, second ?? first);
    fill('y', [...this.keys, ...numeric], second ? first : count);
    fill('shade', [...results, ...this.keys], count);
  }

  // Keys on neither axis, of few values: one of them, or all.
  addFilters() {
    const place = byId('filters');
    const before = new Map(this.filters.map(({column, select}) => [column, select.value]));
    place.replaceChildren();
    this.filters = this.keys.filter((column) => column !== this.x.column && column !== this.y.column
      && column.different.length > 1 && column.different.length <= 60).map((column) => {
      const label = document.createElement('label');
      const select = document.createElement('select');
      select.append(new Option('all', ''));
      for (const value of column.different) {
        select.append(new Option(column.words ? column.words[value] : printed(value, 6), String(value)));
      }
      select.value = before.get(column) ?? '';
      select.addEventListener('change', () => this.change());
      label.append(`${column.title} `, select);
      place.append(label, ' ');
      return {column, select};
    });
  }

  change() {
    this.x = new MapAxis(this.column(byId('x').value));
    this.y = new MapAxis(this.column(byId('y').value));
    this.shade = new Shade(this.column(byId('shade').value));
    this.addFilters();
    const wanted = this.filters.filter(({select}) => select.value !== '')
      .map(({column, select}) => [column, Number(select.value)]);
    this.visible = this.numbers.map((_, run) => run).filter((run) =>
      Number.isFinite(this.x.column.values[run]) && Number.isFinite(this.y.column.values[run])
      && wanted.every(([column, value]) => column.values[run] === value));
    this.arrange();
    this.hovered = -1;
    this.draw();
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
    this.isGrid = this.x.column.isKey && this.y.column.isKey && this.x !== this.y && 2 * this.groups.size >= n;
    const unplaced = this.numbers.length - this.visible.length;
    const shared = Math.max(0, ...Array.from(this.groups.values(), (runs) => runs.length));
    byId('map-note').textContent = `${this.visible.length} of ${this.numbers.length} runs`
      + (unplaced > 0 && this.filters.every(({select}) => select.value === '') ? '; the others have no value on an axis' : '')
      + (this.isGrid && shared > 1 ? `; up to ${shared} runs share a field, each has a part of it` : '')
      + '.';
  }

  // 'decided', 'undecided' (count and order), or 'unknown' (no error bars).
  certainty(run) {
    const value = this.column('all_decided')?.values[run];
    return value === 1 ? 'decided' : value === 0 ? 'undecided' : 'unknown';
  }

  // --- map -----------------------------------------------------------------------------------------

  addMap() {
    const canvas = byId('map');
    canvas.addEventListener('mousemove', (event) => this.hover(this.runAt(event.offsetX, event.offsetY), event));
    canvas.addEventListener('mouseleave', () => this.hover(-1));
    canvas.addEventListener('click', (event) => {
      const run = this.runAt(event.offsetX, event.offsetY);
      if (run < 0) return;
      this.choose(run);
      this.goToRun();
    });
    canvas.addEventListener('keydown', (event) => this.key(event));
    canvas.addEventListener('focus', () => { if (this.chosen < 0 && this.visible.length > 0) this.choose(this.visible[0]); });
  }

  later() {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => {
      this.isWaiting = false;
      this.draw();
    });
  }

  draw() {
    const {x, y} = this;
    const range = (axis) => (this.isGrid ? axis.range : axis.wideRange);
    const options = {x: {range: range(x), ...x.options}, y: {range: range(y), ...y.options}, top: 26};
    const axes = this.axes = new Axes(byId('map'), {...options, left: new Axes(byId('map'), options).roomForLabels()});
    axes.frame();
    this.marks = [];
    for (const runs of this.groups.values()) this.isGrid ? this.addCells(runs) : this.addPoints(runs);
    axes.inside((draw) => this.marks.forEach((mark) => this.drawMark(draw, mark)));
    this.drawKey();
    axes.keep();
    this.drawHighlights();
    this.shade.draw(byId('scale'));
    this.timeline?.drawPart();
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

  static outline(draw, {left, top, width, height, isPoint}, margin = 0) {
    draw.beginPath();
    if (isPoint) draw.arc(left + width / 2, top + height / 2, width / 2 + margin, 0, 2 * Math.PI);
    else draw.rect(left - margin, top - margin, width + 2 * margin, height + 2 * margin);
  }

  drawMark(draw, mark) {
    const value = this.shade.column.values[mark.run];
    const tone = this.shade.of(value);
    SweepPage.outline(draw, mark);
    draw.fillStyle = tone ?? colour('grid');
    draw.fill();
    if (mark.isPoint) {
      draw.strokeStyle = colour('text');
      draw.lineWidth = 0.7;
      draw.stroke();
    }
    if (tone === null) this.drawLack(draw, mark);
    else if (this.certainty(mark.run) === 'undecided') SweepPage.drawCross(draw, mark, this.shade.contrast(value));
  }

  // Count and order of the run's sub-impacts are not decided.
  static drawCross(draw, {left, top, width, height}, tone) {
    const size = Math.min(5, 0.32 * Math.min(width, height));
    const x = left + width / 2, y = top + height / 2;
    draw.strokeStyle = tone;
    draw.lineWidth = size > 2.5 ? 1.5 : 1;
    draw.beginPath();
    draw.moveTo(x - size, y - size);
    draw.lineTo(x + size, y + size);
    draw.moveTo(x - size, y + size);
    draw.lineTo(x + size, y - size);
    draw.stroke();
  }

  // No value: the run was refused, or left no result.
  drawLack(draw, {left, top, width, height}) {
    draw.strokeStyle = colour('soft');
    draw.lineWidth = 1;
    draw.beginPath();
    draw.moveTo(left + 0.2 * width, top + 0.5 * height);
    draw.lineTo(left + 0.8 * width, top + 0.5 * height);
    draw.stroke();
  }

  drawKey() {
    const {axes} = this;
    const {draw} = axes;
    const box = (left) => ({left, top: 5, width: 14, height: 14});
    let x = axes.left;
    const entry = (words, paint) => {
      paint(box(x));
      axes.text(words, x + 20, 12);
      x += 40 + draw.measureText(words).width;
    };
    if (this.visible.some((run) => this.certainty(run) === 'undecided')) {
      entry('count not decided', (mark) => {
        SweepPage.outline(draw, mark);
        draw.strokeStyle = colour('soft');
        draw.stroke();
        SweepPage.drawCross(draw, mark, colour('text'));
      });
    }
    if (this.visible.some((run) => this.shade.of(this.shade.column.values[run]) === null)) {
      entry('no value', (mark) => {
        SweepPage.outline(draw, mark);
        draw.fillStyle = colour('grid');
        draw.fill();
        this.drawLack(draw, mark);
      });
    }
  }

  drawHighlights() {
    const {axes} = this;
    axes.restore();
    const {draw} = axes;
    const ring = (run, width) => {
      const mark = this.marks.find((other) => other.run === run);
      if (!mark) return;
      for (const [margin, tone] of [[width, 'paper'], [0.5 * width, 'text']]) {
        SweepPage.outline(draw, mark, margin);
        draw.strokeStyle = colour(tone);
        draw.lineWidth = width;
        draw.stroke();
      }
    };
    if (this.hovered >= 0) ring(this.hovered, 1.5);
    if (this.chosen >= 0) ring(this.chosen, 2.5);
  }

  runAt(x, y) {
    const inside = this.marks.find(({left, top, width, height, isPoint}) =>
      !isPoint && x >= left && x < left + width && y >= top && y < top + height);
    if (inside) return inside.run;
    let best = -1, least = 15;
    for (const {run, left, top, width, height, isPoint} of this.marks) {
      if (!isPoint) continue;
      const far = Math.hypot(left + width / 2 - x, top + height / 2 - y);
      if (far < least) [best, least] = [run, far];
    }
    return best;
  }

  words(run) {
    const keys = this.keys.slice(0, 6).map((key) => `${key.label} ${key.text(run)}`);
    const parts = [`run ${this.numbers[run]}: ${keys.join(', ')}`];
    const {column} = this.shade;
    if (!column.isKey) parts.push(`${column.label} ${column.text(run)}`);
    if (this.certainty(run) === 'undecided') {
      const n = this.column('n_decided')?.values[run];
      parts.push(n > 0 ? `not decided: only the first ${n} of its sub-impacts are certain`
                       : 'not decided: none of its sub-impacts is certain');
    }
    const outcome = this.column('outcome').text(run);
    if (outcome !== 'completed') parts.push(outcome);
    return parts.join(' · ');
  }

  hover(run, event) {
    const tip = byId('tip');
    byId('map').style.cursor = run >= 0 ? 'pointer' : '';
    tip.hidden = run < 0;
    if (event && run >= 0) {
      tip.textContent = this.words(run);
      const {clientWidth: width} = byId('map');
      const right = event.offsetX > 0.55 * width;
      Object.assign(tip.style, {top: `${event.offsetY + 16}px`, left: right ? 'auto' : `${event.offsetX + 12}px`,
                                right: right ? `${width - event.offsetX + 12}px` : 'auto'});
    }
    if (run === this.hovered) return;
    this.hovered = run;
    this.drawHighlights();
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const actions = {
      ArrowLeft: () => this.chooseTowards(-1, 0), ArrowRight: () => this.chooseTowards(1, 0),
      ArrowUp: () => this.chooseTowards(0, -1), ArrowDown: () => this.chooseTowards(0, 1),
      n: () => this.chooseBeside(1), p: () => this.chooseBeside(-1), Enter: () => this.goToRun()};
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  // The nearest run in a direction, which counts more than the way across.
  chooseTowards(dx, dy) {
    const centre = ({left, top, width, height}) => [left + width / 2, top + height / 2];
    const here = this.marks.find(({run}) => run === this.chosen);
    if (!here) {
      this.choose(this.visible[0] ?? -1);
      return;
    }
    const [x, y] = centre(here);
    let best = -1, least = Infinity;
    for (const mark of this.marks) {
      const [ox, oy] = centre(mark);
      const along = (ox - x) * dx + (oy - y) * dy, across = Math.abs((ox - x) * dy) + Math.abs((oy - y) * dx);
      const far = along + 3 * across;
      if (along > 0.5 && along >= across && far < least) [best, least] = [mark.run, far];
    }
    this.choose(best);
  }

  chooseBeside(sense) { this.choose(Math.min(Math.max(this.chosen + sense, 0), this.numbers.length - 1)); }

  goToRun() {
    if (this.chosen < 0) return;
    byId('run').scrollIntoView({block: 'start'});
    byId('run').focus({preventScroll: true});
  }

  // --- the run that is chosen ------------------------------------------------------------------------

  subImpacts(run) {
    const {first, count} = this.places[run];
    const columns = this.subImpactColumns;
    const decided = this.column('n_decided')?.values[run];
    const end = this.column('time_s')?.values[run] * 1e-3;
    const orNull = (value) => (Number.isNaN(value) ? null : value);
    return Array.from({length: Math.max(count, 0)}, (_, i) => {
      const row = Object.fromEntries(Object.entries(columns).map(([name, values]) => [name, orNull(values[first + i])]));
      const ongoing = row.end === null;
      return {...row, end: ongoing ? Math.max(end, row.start) : row.end, ongoing, decided: !(i >= decided)};
    });
  }

  choose(run) {
    if (run < 0) return;
    this.chosen = run;
    byId('run').hidden = false;
    byId('run-title').textContent = `Run ${this.numbers[run]}`;
    byId('run-words').textContent = byId('hovered').textContent = this.words(run);
    byId('row').tBodies[0].replaceChildren(...this.columns.map((column) => {
      const row = document.createElement('tr');
      const cells = [column.label, column.text(run)].map((text) => {
        const cell = document.createElement('td');
        cell.textContent = text;
        return cell;
      });
      row.append(...cells);
      return row;
    }));
    byId('command').textContent = ['subimpact run CASE.toml --out DIR',
      ...this.keys.map((key) => `--set ${SweepPage.quoted(`${key.name}=${this.setting(key, run)}`)}`)].join(' \\\n  ');
    this.showSubImpacts(run);
    this.drawHighlights();
  }

  setting(key, run) {
    if (key.isFlag) return String(key.values[run] === 1);
    if (key.words) return key.words[key.values[run]].replaceAll(';', ',');
    return String(key.values[run]).replace('Infinity', 'inf');
  }

  // A word of a command line.
  static quoted(text) {
    return /^[\w.,=+-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
  }

  showSubImpacts(run) {
    const hits = this.subImpacts(run);
    const isLeftOut = this.places[run].count < 0;
    byId('hits').hidden = hits.length === 0;
    byId('hits-note').textContent = isLeftOut ? 'Left out to keep the page small; sub_impacts.csv has them.'
      : hits.length === 0 ? 'It has none.'
      : this.certainty(run) === 'unknown' ? 'Without error bars: how many of the digits are right is not known.'
      : hits.every(({decided}) => decided) ? 'All are decided.' : 'Those in grey are not decided: their count, order and times may be wrong.';
    byId('sub-impacts').closest('.wide').hidden = hits.length === 0;
    byId('sub-impacts').tBodies[0].replaceChildren(...hits.map((hit, i) => SweepPage.rowOf(hit, i)));
    this.showTimeline(hits);
  }

  static rowOf(hit, i) {
    const row = document.createElement('tr');
    row.classList.toggle('undecided', !hit.decided);
    row.dataset.row = i;
    const time = (value, error) => withError(1e6 * value, error === null ? null : 1e6 * error, hit.decided);
    const sum = hit.start_error === null || hit.end_error === null ? null : hit.start_error + hit.end_error;
    const cells = [`${i + 1}${hit.decided ? '' : '?'}`, time(hit.start, hit.start_error),
                   hit.ongoing ? '(open)' : time(hit.end, hit.end_error),
                   hit.ongoing ? '' : time(hit.end - hit.start, sum).split(' ')[0],
                   printed(hit.peak_force, 5), printed(hit.impulse, 4), printed(1e3 * hit.max_indentation, 5),
                   printed(hit.striker_velocity, 5)];
    row.append(...cells.map((text) => {
      const cell = document.createElement('td');
      cell.textContent = text;
      return cell;
    }));
    return row;
  }

  showTimeline(hits) {
    this.timeline = null;
    if (hits.length === 0) return;
    const old = byId('timeline');
    const canvas = old.cloneNode();
    old.parentElement.replaceChildren(canvas);  // without what listened to the old one, and its cursor
    const end = hits[hits.length - 1].end;
    const unit = end > 0.1 ? {name: 'ms', per_second: 1e3} : {name: 'µs', per_second: 1e6};
    const strike = {sub_impacts: hits, time_unit: unit, horizon: null};
    const view = new View(end);
    view.time = -1;  // no cursor
    this.timeline = new Timeline(strike, canvas, view, (index) => {
      for (const row of byId('sub-impacts').tBodies[0].rows) row.classList.toggle('chosen', Number(row.dataset.row) === index);
      byId('sub-impacts').tBodies[0].rows[index].scrollIntoView({block: 'nearest'});
    });
    this.timeline.drawPart();
  }

  // Prints in the colours for paper.
  printing(begins) {
    const root = document.documentElement;
    if (begins) {
      this.themeBefore = root.dataset.theme;
      root.dataset.theme = 'light';
    } else if (this.themeBefore) {
      root.dataset.theme = this.themeBefore;
    } else {
      delete root.dataset.theme;
    }
    forgetColours();
    this.draw();
  }
}

// A number with the digits that its error leaves, and the error, rounded up.
function withError(value, error, isDecided) {
  if (!isDecided) return printed(value, 4) + ' ?';
  if (error === null) return printed(value, 7);
  if (error === 0) return printed(value, 7);
  const decimals = Math.min(6, Math.max(0, Math.ceil(-Math.log10(error / 1.5))));
  const unit = 10 ** -decimals;
  return `${value.toFixed(decimals)} ± ${(Math.ceil(error / unit - 1e-9) * unit).toFixed(decimals)}`.replaceAll('-', '−');
}

document.documentElement.classList.add('live');
requestAnimationFrame(() => setTimeout(() => { window.page = new SweepPage(JSON.parse(byId('data').textContent)); }));
