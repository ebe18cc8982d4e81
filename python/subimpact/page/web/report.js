'use strict';
// Joins the panels of a page: one time and one part of the strike for all of them.

function addCopyButton() {
  byId('copy').addEventListener('click', ({target: button}) => {
    getSelection().selectAllChildren(byId('toml'));
    button.textContent = document.execCommand('copy') ? 'Copied' : 'Selected: copy it with Ctrl+C';
  });
}

// Rows of a chart: time, then columns of the history times their factors. Where two rows have one
// time, before and after an event, both are kept.
function chartRows(strike, columns) {
  const {times, history, time_unit: unit} = strike;
  return Array.from(times, (time, i) =>
    [time * unit.per_second, ...columns.map(({name, factor = 1}) => factor * history[name][i])]);
}

// All strikes of a beam that was struck several times; the one that is clicked is named with how to open it.
function addStrikes(strikes) {
  const rows = Array.from(document.querySelectorAll('[data-strike]'));
  const choose = (index) => {
    rows.forEach((row, i) => row.classList.toggle('chosen', i === index));
    byId('strike-command').textContent = rows[index].dataset.strike;
  };
  rows.forEach((row, i) => row.addEventListener('click', () => choose(i)));
  choose(rows.length - 1);
  if (typeof Dygraph === 'undefined') return;
  const labels = ['strike', 'peak force, N', 'permanent set, mm'];
  new Dygraph(byId('strikes-chart'), strikes, {
    labels, xlabel: labels[0], ylabel: labels[1], y2label: labels[2], series: {[labels[2]]: {axis: 'y2', strokePattern: [7, 3]}},
    colors: [colour('line1'), colour('line2')], drawPoints: true, pointSize: 3, axes: {y2: {drawAxis: true}, y: {axisLabelWidth: 56}},
    clickCallback: (event, x) => choose(Math.min(Math.max(Math.round(x), 1), rows.length) - 1)});
}

const timeCharts = [
  {id: 'chart-force', columns: [{name: 'force_N', label: 'contact force'}]},
  {id: 'chart-displacement', label: 'displacement, mm', columns: [
    {name: 'w_c_m', label: 'struck point w_c', factor: 1e3},
    {name: 'w_m_m', label: 'striker w_m', factor: 1e3},
    {name: 'f_c_m', label: 'deflection f_c = w_c − w(0)', factor: 1e3}]},
  {id: 'chart-energy', label: 'energy, J', columns: [
    {name: 'U_m_J', label: 'striker U_m'}, {name: 'U_k_J', label: 'beam, kinetic U_k'},
    {name: 'U_e_J', label: 'bending, elastic U_e'}, {name: 'U_p_J', label: 'bending, plastic U_p'},
    {name: 'D_c_J', label: 'contact, plastic D_c'}, {name: 'U_c_J', label: 'contact, elastic U_c'},
    {name: 'D_b_J', label: 'damping of the beam D_b', ifAny: true}]},
];

class Page {
  constructor(data) {
    const strike = this.strike = new Strike(data);
    const view = this.view = new View(strike.end);
    this.player = new Player(view);
    this.charts = [];
    this.chosen = -1;
    this.motion = strike.hasShapes ? new Motion(strike, byId('shape'), byId('moment')) : null;
    for (const part of [byId('motion'), byId('moment').closest('.panel')]) part.hidden = !strike.hasShapes;
    this.loop = strike.hasHistory ? new Loop(strike, byId('loop'), view) : null;
    this.timeline = strike.sub_impacts.length > 0
      ? new Timeline(strike, byId('timeline'), view, (index) => this.show(index)) : null;
    byId('loop').closest('.panel').hidden = !this.loop;
    byId('timeline').closest('.panel').hidden = !this.timeline;
    byId('along').hidden = !strike.envelope;
    if (data.strikes.length > 0) addStrikes(data.strikes);
    this.addCharts();
    this.addControls();
    this.addTable();
    document.addEventListener('keydown', (event) => this.key(event));
    view.changed = (what) => this.later(what);
    new ResizeObserver(() => this.later('size')).observe(document.body);
    this.watchPanels();
    addThemeButton(() => this.restyle());
    // The page opens on the largest force.
    const [hardest] = [...strike.sub_impacts].sort((a, b) => b.peak_force - a.peak_force);
    if (hardest) view.setTime(hardest.peak_time);
    this.drawAll();
  }

  addCharts() {
    const {strike} = this;
    if (typeof Dygraph === 'undefined' || !strike.hasHistory) {
      byId('charts').hidden = byId('chart-force').hidden = true;
      document.getElementById('chart-measured')?.remove();
      return;
    }
    const ofForce = strike.unitOfForce();
    for (const {id, label = `force, ${ofForce.name}`, columns: all} of timeCharts) {
      if (id === 'chart-force') all[0].factor = ofForce.per_newton;
      const columns = all.filter(({name, ifAny}) => !ifAny || strike.history[name].some((value) => value !== 0));
      this.addChart(id, label, columns.map((column) =>
        ({...column, label: column.label.replace('striker', strike.stop ? 'stop' : 'striker')})));
    }
    byId('chart-strain').hidden = strike.gauges.length === 0;
    if (strike.gauges.length > 0) {
      this.addChart('chart-strain', 'strain, 1e-6', strike.gauges.map((where, i) =>
        ({name: `gauge_${i + 1}_strain`, label: `gauge ${i + 1}: ${where}`, factor: 1e6})));
    }
    if (strike.overlay) this.addOverlay();
    const columns = Object.keys(strike.meanings).filter((name) => strike.history[name].some(Number.isFinite));
    const select = byId('column');
    for (const name of columns) select.append(new Option(`${name}: ${strike.meanings[name]}`, name));
    const draw = () => this.addChart('chart-any', select.value, [{name: select.value, label: select.value}]);
    select.addEventListener('change', () => {
      this.charts.pop().remove();
      draw();
      this.charts.at(-1).showPart();
    });
    select.value = 'v_m_m_per_s';
    draw();
  }

  addChart(id, valueLabel, columns) {
    const {strike, view} = this;
    this.charts.push(new TimeChart(byId(id), {
      rows: chartRows(strike, columns), labels: columns.map((column) => column.label), valueLabel,
      unit: strike.time_unit, hits: strike.sub_impacts, view}));
  }

  // Measured and computed force, or strain, each at its own times.
  addOverlay() {
    const chart = byId('chart-measured');
    const [factor, valueLabel] = 'strain' in chart.dataset ? [1e6, 'strain, 1e-6'] : [1, 'force, N'];
    const {overlay, time_unit: unit, sub_impacts: hits} = this.strike;
    const rows = overlay.map(unpackedColumns).flatMap(({time_s: times, force_N: forces}, k) => Array.from(
      times, (time, i) => [time * unit.per_second, k === 0 ? factor * forces[i] : null, k === 1 ? factor * forces[i] : null]));
    this.charts.push(new TimeChart(chart, {
      rows: rows.sort((a, b) => a[0] - b[0]), labels: ['measured', 'computed, as the transducer shows it'],
      valueLabel, unit, hits, view: this.view}));
  }

  // Canvases out of sight are not painted while the picture moves.
  watchPanels() {
    const watcher = new IntersectionObserver((entries) => {
      for (const {target, isIntersecting} of entries) target.classList.toggle('away', !isIntersecting);
    }, {rootMargin: '200px'});
    document.querySelectorAll('#strike .panel, #more .panel').forEach((panel) => watcher.observe(panel));
  }

  // Drawing waits for the next frame, so that many changes within one are drawn once.
  later(what) {
    this.waiting ??= new Set();
    if (this.waiting.size === 0) requestAnimationFrame(() => this.drawWaiting());
    this.waiting.add(what);
  }

  drawWaiting() {
    const waiting = this.waiting;
    this.waiting = new Set();
    if (waiting.has('size')) this.drawAll();
    else if (waiting.has('part')) this.drawPart();
    this.drawTime();
  }

  drawAll() {
    this.drawPart();
    this.drawEnvelope();
    this.drawTime();
  }

  drawPart() {
    this.charts.forEach((chart) => chart.showPart());
    this.loop?.drawPart();
    this.timeline?.drawPart();
    byId('part').textContent = this.chosen < 0 ? this.view.words(this.strike.time_unit) : this.rowWords();
  }

  // The row of the sub-impact that is chosen, which may be out of sight.
  rowWords() {
    const row = document.querySelector(`[data-hit="${this.chosen}"]`), {cells} = row;
    const [, ...heads] = row.closest('table').querySelectorAll('thead th');
    return heads.map((head, i) => [head.firstChild.textContent, cells[i + 1].textContent.trim().replace(/\s+/g, ' '),
                                   head.querySelector('small').textContent])
      .filter(([, value]) => value !== '').map(([name, value, unit]) => `${name} ${value} ${unit.replace('max, ', '')}`).join(' · ');
  }
  drawTime() {
    const {time, end} = this.view;
    this.motion?.drawAt(time);
    this.charts.forEach((chart) => chart.showTime());
    this.loop?.drawTime();
    this.timeline?.drawTime();
    if (document.activeElement !== byId('time') || this.player.playing) byId('time').value = 1e4 * time / end;
    byId('readout').textContent = this.words();
  }

  restyle() {
    this.charts.forEach((chart) => chart.restyle());
    this.drawAll();
  }

  drawEnvelope() {
    const {strike} = this;
    if (!strike.envelope) return;
    const {moment, displacement, permanent_set: set} = strike.envelope;
    const mm = (values) => values.map((value) => 1e3 * value);
    drawAlongBeam(strike, byId('envelope'), {label: 'displacement, mm', lines: [
      {name: 'largest w', values: mm(displacement.largest)}, {name: 'smallest w', values: mm(displacement.smallest)}]});
    drawAlongBeam(strike, byId('envelope-moment'), {label: 'moment, N m', zones: strike.plastic_zones, lines: [
      {name: 'largest moment', values: moment.largest}, {name: 'smallest moment', values: moment.smallest}]});
    byId('set').closest('.panel').hidden = !strike.yields;
    if (strike.yields) {
      drawAlongBeam(strike, byId('set'), {label: 'permanent set, mm', zones: strike.plastic_zones,
                                          lines: [{name: 'at rest, from its supports or chord', values: mm(set)}]});
    }
  }

  words() {
    const {strike, view: {time}} = this;
    const {per_second, name} = strike.time_unit;
    const event = strike.eventAt(time);
    const index = strike.subImpactAt(time);
    const parts = [`t = ${(time * per_second).toFixed(name === 'µs' ? 3 : 6)} ${name}`];
    if (event) parts.push(`event: ${eventKinds[event.kind].name}`);
    parts.push(index < 0 ? 'apart' : `in sub-impact ${index + 1}${strike.sub_impacts[index].certain ? '' : ' (not certain)'}`);
    if (strike.hasHistory) {
      const [name, length] = index < 0 ? ['gap', strike.gapAt(time)] : ['indentation', strike.at('indentation_m', time)];
      parts.push(`force ${printed(strike.at('force_N', time))} N`,
                 Math.abs(length) < 1e-5 ? `${name} ${printed(1e6 * length)} µm` : `${name} ${printed(1e3 * length)} mm`,
                 `striker ${printed(strike.at('v_m_m_per_s', time))} m/s`);
    }
    return parts.join(' · ');
  }

  announce() { byId('announced').textContent = this.words(); }

  step(sense) {
    this.player.pause();
    const event = this.strike.eventBeside(this.view.time, sense);
    this.view.setTime(event ? event.time : sense > 0 ? this.view.end : 0);
    const {time, from, to} = this.view;
    if (time < from || time > to) this.view.setPart(time - 0.5 * (to - from), time + 0.5 * (to - from));
    this.drawWaiting();
    this.announce();
  }

  // All panels go to a sub-impact.
  choose(index) {
    const hit = this.strike.sub_impacts[index];
    if (!hit) return;
    this.player.pause();
    this.chosen = index;
    const margin = 0.25 * Math.max(hit.end - hit.start, 1e-5 * this.view.end);
    this.view.setPart(hit.start - margin, hit.end + margin);
    this.view.setTime(hit.start);
    this.playIn(this.view.to - this.view.from, 5);
    document.querySelectorAll('[data-hit]').forEach((row) =>
      row.classList.toggle('chosen', Number(row.dataset.hit) === index));
    this.drawWaiting();
    this.announce();
  }

  // The same, with beam, force and indentation brought into sight below the bar of controls.
  show(index) {
    this.choose(index);
    byId('strike').style.scrollMarginTop = `${byId('bar').offsetHeight}px`;
    byId('strike').scrollIntoView({block: 'start'});
  }

  chooseBeside(sense) {
    const hits = this.strike.sub_impacts;
    const now = this.chosen >= 0 ? this.chosen : -0.5 * (1 + sense);
    this.choose(Math.min(Math.max(now + sense, 0), hits.length - 1));
  }

  showAll() {
    this.chosen = -1;
    document.querySelectorAll('[data-hit].chosen').forEach((row) => row.classList.remove('chosen'));
    this.playIn(this.view.end, 20);
    this.view.showAll();
  }

  addTable() {
    for (const row of document.querySelectorAll('[data-hit]')) {
      const index = Number(row.dataset.hit);
      row.addEventListener('click', () => this.show(index));
      const cell = row.cells[0];
      const button = document.createElement('button');
      button.textContent = cell.textContent.trim();
      button.setAttribute('aria-label', `show sub-impact ${index + 1} in all panels`);
      cell.replaceChildren(button);
    }
  }

  addControls() {
    const {view, player, strike} = this;
    player.changed = () => {
      byId('play').textContent = player.playing ? 'Pause' : 'Play';
      document.documentElement.classList.toggle('playing', player.playing);
    };
    byId('play').addEventListener('click', () => player.toggle());
    byId('back').addEventListener('click', () => this.step(-1));
    byId('next').addEventListener('click', () => this.step(1));
    byId('all').addEventListener('click', () => this.showAll());
    byId('time').addEventListener('input', () => view.setTime(byId('time').value / 1e4 * view.end));
    this.addSpeeds();
    if (!this.motion) return;
    const exaggeration = byId('exaggeration');
    exaggeration.value = 100 * Math.log10(this.motion.exaggeration);
    exaggeration.addEventListener('input', () => this.exaggerate(10 ** (exaggeration.value / 100)));
    this.exaggerate(this.motion.exaggeration);
    byId('follow').checked = this.motion.follows;
    byId('follow').addEventListener('change', () => {
      this.motion.follows = byId('follow').checked;
      exaggeration.value = 100 * Math.log10(this.motion.suitable());
      this.exaggerate(this.motion.suitable());
    });
    byId('plastic-key').hidden = !(this.motion.largestPlastic > 0);
  }

  exaggerate(factor) {
    this.motion.exaggeration = factor;
    byId('exaggeration-text').textContent = '×' + printed(factor, 2);
    this.later('time');
  }

  // The speed at which a time of the strike lasts some seconds, unless the reader has chosen one.
  playIn(time, seconds) {
    const speed = byId('speed');
    if (speed.dataset.own) return;
    const slow = Array.from(speed.options).findLast(({value}) => value <= time / seconds) ?? speed.options[0];
    speed.value = slow.value;
    this.player.speed = Number(slow.value);
  }

  // Microseconds of the strike per second; the whole of it in some half a minute at first.
  addSpeeds() {
    const {player, view} = this;
    const speeds = [];
    for (let decade = 1e-7; decade < 1e2; decade *= 10) speeds.push(decade, 2 * decade, 5 * decade);
    const suitable = speeds.findLast((speed) => speed <= view.end / 20) ?? speeds[0];
    const near = speeds.filter((speed) => speed > suitable / 1200 && speed < 30 * suitable);
    for (const speed of near) byId('speed').append(new Option(printed(1e6 * speed, 3) + ' µs per second', speed));
    this.playIn(view.end, 20);
    byId('speed').addEventListener('change', () => {
      byId('speed').dataset.own = 'true';
      player.speed = Number(byId('speed').value);
    });
  }

  changeSpeed(sense) {
    const speed = byId('speed');
    speed.selectedIndex = Math.min(Math.max(speed.selectedIndex + sense, 0), speed.length - 1);
    speed.dataset.own = 'true';
    this.player.speed = Number(speed.value);
  }

  key(event) {
    const tag = event.target.tagName;
    if (tag === 'SELECT' || (tag === 'INPUT' && event.key.startsWith('Arrow'))) return;
    if (['BUTTON', 'SUMMARY'].includes(tag) && (event.key === ' ' || event.key === 'Enter')) return;
    const {view, player} = this;
    const small = (view.to - view.from) / 200;
    const action = {
      ' ': () => player.toggle(),
      ArrowRight: () => (event.shiftKey ? view.setTime(view.time + small) : this.step(1)),
      ArrowLeft: () => (event.shiftKey ? view.setTime(view.time - small) : this.step(-1)),
      Home: () => view.setTime(0),
      End: () => view.setTime(view.end),
      n: () => this.chooseBeside(1),
      p: () => this.chooseBeside(-1),
      '+': () => view.zoom(0.5),
      '-': () => view.zoom(2),
      0: () => this.showAll(),
      Escape: () => this.showAll(),
      '[': () => this.changeSpeed(-1),
      ']': () => this.changeSpeed(1),
    }[event.key];
    if (event.ctrlKey || event.altKey || event.metaKey || !action) return;
    event.preventDefault();
    action();
  }
}

if (typeof Dygraph === 'undefined') byId('stills').classList.add('open');
byId('show-stills').addEventListener('click', () => {
  byId('show-stills').setAttribute('aria-expanded', String(byId('stills').classList.toggle('open')));
});
// Charts have the width of the window; on paper they are made smaller.
const widthOnPaper = 400;
addEventListener('beforeprint', () => {
  document.querySelector('details.verdict').open = true;
  for (const plot of document.querySelectorAll('#pulse .plot')) {
    Object.assign(plot.style, {height: `${plot.offsetHeight}px`, zoom: widthOnPaper / plot.offsetWidth});
  }
});
addEventListener('afterprint', () => {
  for (const plot of document.querySelectorAll('#pulse .plot')) Object.assign(plot.style, {height: '', zoom: ''});
});
addCopyButton();
// Before the page has loaded: who photographs it then sees it drawn.
document.documentElement.classList.add('live');
window.page = new Page(JSON.parse(byId('data').textContent));
