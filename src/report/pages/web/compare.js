'use strict';
// A page that compares runs: one line per run in every chart.

const comparedCharts = [
  {id: 'chart-force', label: 'force, N', name: 'force_N', factor: 1},
  {id: 'chart-deflection', label: 'deflection f_c, mm', name: 'f_c_m', factor: 1e3},
  {id: 'chart-velocity', label: 'velocity, m/s', name: 'v_m_m_per_s', factor: 1},
  {id: 'chart-elastic', label: 'energy U_e, J', name: 'U_e_J', factor: 1},
];

// Rows of all runs in order of time, with null where a run has none.
function mergedRows(runs, unit, name, factor) {
  const rows = [];
  runs.forEach(({history}, run) => history.time_s.forEach((time, i) => {
    const row = new Array(1 + runs.length).fill(null);
    row[0] = time * unit.per_second;
    row[1 + run] = factor * history[name][i];
    rows.push(row);
  }));
  return rows.sort((a, b) => a[0] - b[0]);
}

class ComparisonPage {
  constructor({end, time_unit: unit, runs}) {
    this.view = new View(end);
    this.unit = unit;
    this.charts = [];
    this.runs = runs.map((run) => ({...run, history: unpackedColumns(run.history)})).filter((run) => run.history.time_s);
    byId('strike').hidden = typeof Dygraph === 'undefined' || this.runs.length === 0;
    if (!byId('strike').hidden) this.addCharts();
    this.addTables();
    byId('all').addEventListener('click', () => this.view.showAll());
    this.view.onChange(() => this.show());
    addThemeButton(() => this.charts.forEach((chart) => chart.restyle()));
    document.addEventListener('keydown', (event) => {
      if (event.key === '0' || event.key === 'Escape') this.view.showAll();
    });
  }

  addCharts() {
    const {unit, view, runs} = this;
    const bands = bandsOf(runs[0].sub_impacts, unit);
    for (const {id, label, name, factor} of comparedCharts) {
      this.charts.push(new TimeChart(byId(id), {rows: mergedRows(runs, unit, name, factor), valueLabel: label,
        labels: runs.map((run) => run.name), unit, bands, view}));
    }
  }

  addTables() {
    for (const row of document.querySelectorAll('[data-from]')) {
      const [from, to] = [Number(row.dataset.from), Number(row.dataset.to)];
      const go = () => {
        const margin = 0.25 * (to - from);
        this.view.setPart(from - margin, to + margin);
        document.querySelectorAll('tr.chosen').forEach((other) => other.classList.remove('chosen'));
        row.classList.add('chosen');
        byId('strike').scrollIntoView({block: 'start'});
      };
      row.tabIndex = 0;
      row.addEventListener('click', go);
      row.addEventListener('keydown', (event) => { if (event.key === 'Enter') go(); });
    }
  }

  show() {
    this.charts.forEach((chart) => chart.showPart());
    byId('part').textContent = this.view.words(this.unit);
  }
}

startPage((data) => new ComparisonPage(data));
