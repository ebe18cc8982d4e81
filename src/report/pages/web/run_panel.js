'use strict';
// The run of a sweep that is chosen: its row, the command that makes it, its sub-impacts.

function cellsOf(texts) {
  return texts.map((text) => {
    const cell = document.createElement('td');
    cell.textContent = text;
    return cell;
  });
}

class RunPanel {
  constructor(runs) {
    this.runs = runs;
  }

  show(run, words) {
    byId('run').hidden = false;
    byId('run-title').textContent = `Run ${this.runs.numbers[run]}`;
    byId('run-words').textContent = words;
    byId('row').tBodies[0].replaceChildren(...this.runs.columns.map((column) => {
      const row = document.createElement('tr');
      row.append(...cellsOf([column.label, column.text(run)]));
      return row;
    }));
    byId('command').textContent = [`subimpact run ${RunPanel.quoted(this.runs.caseFile)} --out run-${this.runs.numbers[run]}`,
      ...this.runs.keys.map((key) => `--set ${RunPanel.quoted(`${key.name}=${this.setting(key, run)}`)}`)].join(' \\\n  ');
    this.showSubImpacts(run);
  }

  setting(key, run) {
    if (key.isFlag) return String(key.values[run] === 1);
    if (key.words) return key.words[key.values[run]].replaceAll(';', ',');
    return String(key.values[run]).replace('Infinity', 'inf');
  }

  static quoted(text) {
    return /^[\w.,=+/-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
  }

  showSubImpacts(run) {
    const hits = this.runs.subImpacts(run);
    const isLeftOut = this.runs.places[run].count < 0;
    byId('hits').hidden = hits.length === 0;
    byId('hits-note').textContent = isLeftOut ? 'Left out to keep the page small; sub_impacts.csv has them.'
      : hits.length === 0 ? 'It has none.'
      : this.runs.certainty(run) === 'unknown' ? 'Without error bars: how many of the digits are right is not known.'
      : hits.every(({certain}) => certain) ? 'All are certain.' : 'Those in grey are not certain: their count, order and times may be wrong.';
    byId('sub-impacts').closest('.wide').hidden = hits.length === 0;
    byId('sub-impacts').tBodies[0].replaceChildren(...hits.map((hit, i) => RunPanel.rowOf(hit, i)));
    this.showTimeline(hits);
  }

  static rowOf(hit, i) {
    const row = document.createElement('tr');
    row.classList.toggle('uncertain', !hit.certain);
    row.dataset.row = i;
    const time = (value, error) => withError(1e6 * value, error === null ? null : 1e6 * error, hit.certain);
    const sum = hit.start_error === null || hit.end_error === null ? null : hit.start_error + hit.end_error;
    row.append(...cellsOf([`${i + 1}${hit.certain ? '' : '?'}`, time(hit.start, hit.start_error),
                           hit.ongoing ? '(open)' : time(hit.end, hit.end_error),
                           hit.ongoing ? '' : time(hit.end - hit.start, sum).split(' ')[0],
                           printed(hit.peak_force, 5), printed(hit.impulse, 4), printed(1e3 * hit.max_indentation, 5),
                           printed(hit.striker_velocity, 5)]));
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
    this.draw();
  }

  draw() {
    if (!this.timeline) return;
    this.timeline.drawPart();
    this.drawPulses(this.timeline.strike);
  }

  // Contacts as pulses F sin(pi s)^p, s from 0 to 1/2 at the largest force, and to 1 after it, with the
  // power p that gives each its impulse.
  drawPulses({sub_impacts: hits, time_unit: unit}) {
    const end = hits[hits.length - 1].end, n = 40;
    const axes = new Axes(byId('pulses'), {
      x: {range: [-0.02, 1.02].map((share) => share * end * unit.per_second), label: `time, ${unit.name}`},
      y: {range: [0, 1.06 * Math.max(...hits.map((hit) => hit.peak_force))], label: 'contact force, N'}});
    axes.frame();
    axes.inside(() => hits.forEach(({start, end: last, peak_time: top, peak_force: peak, impulse}) => {
      const power = RunPanel.powerOfPulse(impulse / (peak * (last - start)));
      const timeAt = (s) => (s < 0.5 ? start + 2 * s * (top - start) : top + (2 * s - 1) * (last - top));
      axes.line(Array.from({length: n + 1}, (_, i) => [axes.toX(timeAt(i / n) * unit.per_second),
        axes.toY(peak * Math.max(0, Math.sin(Math.PI * i / n)) ** power)]), {colour: colour('line1'), width: 1.5});
    }));
  }

  // The power with which the mean of sin(pi s)^p is `mean`, by bisection of its logarithm.
  static powerOfPulse(mean) {
    const meanOf = (power) => Array.from({length: 64}, (_, i) => Math.sin(Math.PI * (i + 0.5) / 64) ** power)
      .reduce((sum, value) => sum + value) / 64;
    let low = -5, high = 6;
    for (let i = 0; i < 40; ++i) {
      const middle = 0.5 * (low + high);
      if (meanOf(Math.exp(middle)) > mean) low = middle;
      else high = middle;
    }
    return Math.exp(0.5 * (low + high));
  }
}

// A number with the digits that its error leaves, and the error, rounded up.
function withError(value, error, isDecided) {
  if (!isDecided) return printed(value, 4) + ' ?';
  if (error === null || error === 0) return printed(value, 7);
  const decimals = Math.min(6, Math.max(0, Math.ceil(-Math.log10(error / 1.5))));
  const unit = 10 ** -decimals;
  return `${value.toFixed(decimals)} ± ${(Math.ceil(error / unit - 1e-9) * unit).toFixed(decimals)}`.replaceAll('-', '−');
}
