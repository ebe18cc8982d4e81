'use strict';
// Panels over time and over indentation.

const lineStyles = [
  {colour: 'line1', dash: null}, {colour: 'line2', dash: [7, 3]}, {colour: 'line3', dash: [2, 2]},
  {colour: 'line4', dash: [9, 3, 2, 3]}, {colour: 'line5', dash: [4, 4]}, {colour: 'line6', dash: [12, 4]},
  {colour: 'soft', dash: [1, 3]}];

// What marks the time shown, above a panel that stays as it is.
function markOver(panel, name) {
  const mark = document.createElement('div');
  mark.className = name;
  panel.append(mark);
  return mark;
}

// A zoomable chart over time. rows: [time, value, ...] in the units of the labels.
class TimeChart {
  constructor(place, {rows, labels, valueLabel, unit, hits, view}) {
    Object.assign(this, {place, unit, view, hits, quiet: true});
    const body = place.querySelector('.plot');
    this.chart = new Dygraph(body, rows, {
      ...this.colours(labels.length),
      labels: [unit.name, ...labels],
      labelsDiv: place.querySelector('.legend'),
      legend: 'always',
      legendFormatter: (data) => this.legend(data),
      strokeWidth: 1.6,
      strokePattern: null,
      series: Object.fromEntries(labels.map((label, i) => [
        label, {strokePattern: lineStyles[i % lineStyles.length].dash, connectSeparatedPoints: true}])),
      xlabel: 'time, ' + unit.name,
      ylabel: valueLabel,
      axes: {x: {axisLabelFormatter: (x) => printed(x, 7), axisLabelWidth: 70},
             y: {axisLabelFormatter: (y) => printed(y, 5), axisLabelWidth: 56}},
      dateWindow: [0, view.end * unit.per_second],
      highlightCircleSize: 3,
      animatedZooms: false,
      underlayCallback: (draw, area, chart) => this.drawBands(draw, area, chart),
      drawCallback: (chart, initial) => this.drawn(chart, initial),
      clickCallback: (event, x) => view.setTime(x / unit.per_second),
    });
    this.cursor = markOver(body, 'cursor');
    this.quiet = false;
    this.showTime();
  }

  remove() {
    this.chart.destroy();
    this.cursor.remove();
  }

  colours(n) {
    return {
      colors: Array.from({length: n}, (_, i) => colour(lineStyles[i % lineStyles.length].colour)),
      axisLineColor: colour('soft'),
      gridLineColor: colour('grid'),
    };
  }

  // Names of the lines with a sample of each, and values at the cursor.
  legend(data) {
    const legend = document.createDocumentFragment();
    if (data.x !== undefined) legend.append(`${printed(data.x, 8)} ${this.unit.name}: `);
    data.series.forEach((series, i) => {
      const sample = document.createElement('span');
      sample.className = 'sample';
      const dash = (lineStyles[i % lineStyles.length].dash ?? []).join(' ');
      sample.innerHTML = `<svg viewBox="0 0 26 8"><path d="M0 4H26" stroke="${series.color}" stroke-width="2" stroke-dasharray="${dash}"/></svg>`;
      const value = data.x === undefined || series.y === undefined ? '' : ` ${printed(series.y, 6)}`;
      const item = document.createElement('span');
      item.className = 'item';
      item.append(sample, ` ${series.label}${value}`);
      legend.append(item);
    });
    return legend;
  }

  // Sub-impacts, hatched where they are not certain.
  drawBands(draw, area, chart) {
    const hatch = hatching();
    for (const {start, end, certain} of this.hits) {
      const [from, to] = [start, end].map((time) => chart.toDomXCoord(time * this.unit.per_second));
      const left = Math.max(from, area.x), right = Math.min(to, area.x + area.w);
      if (right < left) continue;
      draw.fillStyle = certain ? colour('band') : hatch;
      draw.fillRect(left, area.y, Math.max(right - left, 0.5), area.h);
    }
  }

  drawn(chart, initial) {
    if (initial || this.quiet) return;
    const [from, to] = chart.xAxisRange();
    this.view.setPart(from / this.unit.per_second, to / this.unit.per_second);
  }

  showPart() {
    this.quiet = true;
    const {from, to} = this.view;
    this.chart.updateOptions({dateWindow: [from, to].map((t) => t * this.unit.per_second), valueRange: null});
    this.quiet = false;
    this.showTime();
  }

  showTime() {
    const {x, y, w, h} = this.chart.getArea();
    const at = this.chart.toDomXCoord(this.view.time * this.unit.per_second);
    this.cursor.hidden = at < x - 1 || at > x + w + 1;
    Object.assign(this.cursor.style, {transform: `translateX(${at}px)`, top: `${y}px`, height: `${h}px`});
  }

  restyle() {
    this.quiet = true;
    this.chart.updateOptions(this.colours(this.chart.getLabels().length - 1));
    this.quiet = false;
  }
}

function hatching() {
  const tile = document.createElement('canvas');
  tile.width = tile.height = 8;
  const draw = tile.getContext('2d');
  draw.strokeStyle = colour('band-edge');
  for (const shift of [-8, 0, 8]) {
    draw.beginPath();
    draw.moveTo(shift, 8);
    draw.lineTo(shift + 8, 0);
    draw.stroke();
  }
  return draw.createPattern(tile, 'repeat');
}

// Contact force against indentation, with the branches of the contact law in colours.
class Loop {
  constructor(strike, canvas, view) {
    Object.assign(this, {strike, canvas, view, dot: markOver(canvas.parentElement, 'dot')});
    const {times, events} = strike;
    this.pieces = events.map(({time, kind}, k) => {
      const from = Math.max(countUpTo(times, time) - 1, 0);
      let to = k + 1 < events.length ? countUpTo(times, events[k + 1].time) : times.length;
      // An event has two rows: the first ends a branch, the second begins the next one.
      if (k + 1 < events.length && times[to - 2] === times[to - 1]) --to;
      const rows = Array.from({length: Math.max(to - from, 0)}, (_, i) => from + i);
      return {branch: eventKinds[kind].branch, rows};
    }).filter(({branch}) => branch !== 'apart');
  }

  static branchStyle = {
    elastic: {name: 'line1', words: 'elastic (loading, unloading)', width: 1.3},
    yielding: {name: 'line2', words: 'yielding', width: 3},
  };

  drawPart() {
    const {strike, view: {from, to}} = this, unit = strike.unitOfForce();
    const mm = (i) => 1e3 * strike.history.indentation_m[i], newton = (i) => unit.per_newton * strike.history.force_N[i];
    const isShown = (i) => strike.times[i] >= from && strike.times[i] <= to;
    const visible = this.pieces.map(({branch, rows}) => ({branch, rows: rows.filter(isShown)})).filter((p) => p.rows.length > 1);
    let low = Infinity, high = 0, most = 0;
    for (const i of visible.flatMap(({rows}) => rows)) {
      [low, high, most] = [Math.min(low, mm(i)), Math.max(high, mm(i)), Math.max(most, newton(i))];
    }
    if (!(high > low)) [low, high, most] = [0, 1e3 * strike.max_indentation || 1, unit.per_newton * strike.max_force || 1];
    const margin = 0.06 * (high - low);
    const axes = new Axes(this.canvas, {
      x: {range: [low > margin ? low - margin : 0, high + margin], label: 'indentation, mm'},
      y: {range: [0, 1.06 * most], label: `contact force, ${unit.name}`}});
    this.axes = axes;
    Object.assign(this.dot.style, {left: `${this.canvas.offsetLeft - 5}px`, top: `${this.canvas.offsetTop - 5}px`});
    axes.frame();
    axes.inside(() => {
      for (const {branch, rows} of visible) {
        const {name, width} = Loop.branchStyle[branch];
        axes.line(rows.map((i) => [axes.toX(mm(i)), axes.toY(newton(i))]), {colour: colour(name), width});
      }
    });
    Object.values(Loop.branchStyle).forEach(({name, words, width}, i) =>
      axes.lineKey([[words, {colour: colour(name), width}]], axes.top + 8 + 18 * i));
    this.drawTime();
  }

  drawTime() {
    const {axes, strike, view, dot} = this;
    const x = axes.toX(1e3 * strike.at('indentation_m', view.time)), y = axes.toY(strike.unitOfForce().per_newton * strike.at('force_N', view.time));
    dot.hidden = !(x >= axes.left && x <= axes.right && y >= axes.top - 1 && y <= axes.bottom + 1);
    dot.style.transform = `translate(${x}px, ${y}px)`;
  }
}

// Durations of sub-impacts and of the separations after them, above the uncertainty of the time at
// which each begins: bars from the axis, numerical error.
class Timeline {
  constructor(strike, canvas, view, choose) {
    Object.assign(this, {strike, canvas, view, cursor: markOver(canvas.parentElement, 'cursor')});
    const hits = strike.sub_impacts;
    this.marks = [];
    hits.forEach((s, i) => {
      this.marks.push({kind: 'contact', index: i, time: s.start, value: s.end - s.start,
                       error: s.start_error, certain: s.certain});
      const after = hits[i + 1];
      if (!after || s.ongoing) return;
      this.marks.push({kind: 'separation', index: i, time: s.end, value: after.start - s.end,
                       error: s.end_error, certain: after.certain});
    });
    this.hasErrors = this.marks.some(({error}) => error > 0);
    canvas.addEventListener('click', (event) => {
      const nearest = this.nearest(event.offsetX, event.offsetY);
      if (nearest) choose(nearest.index);
    });
  }

  nearest(x, y) {
    const {axes, strike} = this;
    const far = ({time, value}) => Math.hypot(axes.toX(time * strike.time_unit.per_second) - x, axes.toY(1e6 * value) - y);
    const found = this.marks.reduce((best, mark) => (!best || far(mark) < far(best) ? mark : best), null);
    return found && far(found) < 20 ? found : null;
  }

  drawPart() {
    const {view, strike, canvas} = this;
    const unit = strike.time_unit;
    const margin = 0.02 * (view.to - view.from);
    const range = [(view.from - margin) * unit.per_second, (view.to + margin) * unit.per_second];
    const axes = new Axes(canvas, {
      x: {range, label: `start, ${unit.name}`},
      y: {range: logRange(this.shownValues()), label: this.hasErrors ? 'duration; uncertainty, µs' : 'duration, µs', log: true},
      top: this.hasErrors ? 40 : 22});
    this.axes = axes;
    Object.assign(this.cursor.style, {left: `${canvas.offsetLeft}px`, top: `${canvas.offsetTop + axes.top}px`,
                                      height: `${axes.bottom - axes.top}px`});
    axes.frame();
    axes.inside(() => {
      for (const {time, error} of this.marks) {
        if (!(1e6 * error > axes.y.range[0])) continue;
        const x = axes.toX(time * unit.per_second);
        axes.line([[x, axes.bottom], [x, axes.toY(1e6 * error)]], {colour: colour('text'), width: 3});
      }
      for (const {kind, time, value, certain} of this.marks) {
        this.drawMark(axes, kind, axes.toX(time * unit.per_second), axes.toY(1e6 * value), certain);
      }
    });
    this.drawKey(axes);
    this.drawTime();
  }

  // In µs; of bars, those down to a thousandth of the shortest duration.
  shownValues() {
    const values = this.marks.map(({value}) => 1e6 * value).filter((value) => value > 0);
    const least = values.reduce((low, value) => Math.min(low, value), Infinity) / 1e3;
    return [...values, ...this.marks.map(({error}) => 1e6 * error).filter((error) => error > least)];
  }

  drawMark(axes, kind, x, y, isFilled) {
    const {draw} = axes;
    draw.beginPath();
    if (kind === 'separation') draw.rect(x - 3.5, y - 3.5, 7, 7);
    else draw.arc(x, y, 4, 0, 2 * Math.PI);
    draw.strokeStyle = colour({contact: 'line1', separation: 'line2', open: 'text'}[kind]);
    draw.fillStyle = isFilled ? draw.strokeStyle : colour('paper');
    draw.lineWidth = 1.4;
    draw.fill();
    draw.stroke();
  }
  drawKey(axes) {
    const kinds = [['contacts', 'contact'], ['separations', 'separation'], ['open: not certain', 'open']];
    axes.key(kinds.map(([words, kind]) =>
      [words, 4, (x, y) => this.drawMark(axes, kind, x, y, kind !== 'open')]), 8);
    if (!this.hasErrors) return;
    axes.key([['numerical error', 3, (x, y) => axes.line([[x, y - 7], [x, y + 7]], {colour: colour('text'), width: 3})]], 26);
  }
  drawTime() {
    const {axes, view, strike, cursor} = this;
    const x = axes.toX(view.time * strike.time_unit.per_second);
    cursor.hidden = !(x >= axes.left && x <= axes.right);
    cursor.style.transform = `translateX(${x}px)`;
  }
}

function drawAlongBeam(strike, canvas, {lines, label, zones = []}) {
  const all = lines.flatMap(({values}) => Array.from(values));
  const most = Math.max(...all, 0), least = Math.min(...all, 0);
  const margin = 0.08 * (most - least) || 1;
  const axes = new Axes(canvas, {
    x: {range: [0, strike.length], label: 'position along the beam, m'},
    y: {range: [least - margin, most + margin], label}, top: 22});
  const styles = lineStyles.map(({colour: name, dash}) => ({colour: colour(name), width: 1.8, dash}));
  axes.frame();
  axes.inside((draw) => {
    draw.fillStyle = colour('band');
    for (const {from, to} of zones) {
      draw.fillRect(axes.toX(from), axes.top, Math.max(1, axes.toX(to) - axes.toX(from)), axes.bottom - axes.top);
    }
    lines.forEach(({values}, k) =>
      axes.line(strike.envelope.positions.map((x, i) => [axes.toX(x), axes.toY(values[i])]), styles[k]));
  });
  axes.lineKey(lines.map(({name}, k) => [name, styles[k]]), 10);
}

// Light, dark or as the system is. `restyle` draws in the new colours.
function addThemeButton(restyle) {
  const media = {auto: byId('dark').media, light: 'not all', dark: 'screen'};
  const names = Object.keys(media);
  const repaint = () => {
    colours.clear();
    restyle();
  };
  const button = byId('theme');
  let at = 0;
  button.addEventListener('click', () => {
    at = (at + 1) % names.length;
    byId('dark').media = media[names[at]];
    button.textContent = 'Colours: ' + names[at];
    repaint();
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', repaint);
}
