'use strict';
// The page of a sweep: what its map shows, and the run that is chosen.

class SweepPage {
  constructor(data) {
    this.runs = new SweptRuns(data);
    this.panel = new RunPanel(this.runs);
    this.map = new SweepMap(this.runs, byId('map'), {choose: (run) => this.choose(run), open: () => this.goToRun()});
    this.filters = [];
    this.addChoices();
    byId('before').addEventListener('click', () => this.map.chooseBeside(-1));
    byId('after').addEventListener('click', () => this.map.chooseBeside(1));
    addThemeButton(() => this.draw());
    new ResizeObserver(() => this.later()).observe(document.body);
    addEventListener('beforeprint', () => this.printing(true));
    addEventListener('afterprint', () => this.printing(false));
    byId('run').hidden = true;
    this.change();
  }

  addChoices() {
    const {keys} = this.runs;
    const [first, second] = keys;
    const results = this.runs.columns.filter((column) => !column.isKey && column.name !== 'message');
    const fill = (id, columns, selected) => {
      for (const column of columns) byId(id).append(new Option(column.title, column.name));
      byId(id).value = selected?.name ?? columns[0]?.name;
      byId(id).addEventListener('change', () => this.change());
    };
    const count = this.runs.column('n_sub_impacts') ?? results.find(({words}) => !words) ?? results[0];
    const numeric = results.filter(({words}) => !words);
    fill('x', [...keys, ...numeric], second ?? first);
    fill('y', [...keys, ...numeric], second ? first : count);
    fill('shade', [...results, ...keys], count);
  }

  // Keys on neither axis, of few values: one of them, or all.
  addFilters(across, upwards) {
    const place = byId('filters');
    const before = new Map(this.filters.map(({column, select}) => [column, select.value]));
    place.replaceChildren();
    this.filters = this.runs.keys.filter((column) => column !== across && column !== upwards
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
    const [across, upwards, shown] = ['x', 'y', 'shade'].map((id) => this.runs.column(byId(id).value));
    this.addFilters(across, upwards);
    const wanted = this.filters.filter(({select}) => select.value !== '')
      .map(({column, select}) => [column, Number(select.value)]);
    this.map.show(across, upwards, shown, wanted);
    byId('map-note').textContent = this.map.note(wanted.length > 0);
  }

  draw() {
    this.map.draw();
    this.panel.draw();
  }

  later() {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => {
      this.isWaiting = false;
      this.draw();
    });
  }

  choose(run) {
    if (run < 0) return;
    const words = this.runs.words(run, this.map.shade.column);
    byId('hovered').textContent = words;
    this.panel.show(run, words);
    this.map.choose(run);
  }

  goToRun() {
    if (this.map.chosen < 0) return;
    byId('run').scrollIntoView({block: 'start'});
    byId('run').focus({preventScroll: true});
  }

  printing(begins) {
    const {dataset} = document.documentElement;
    if (begins) this.themeBefore = dataset.theme;
    const theme = begins ? 'light' : this.themeBefore;
    if (theme) dataset.theme = theme;
    else delete dataset.theme;
    forgetColours();
    this.draw();
  }
}

startPage((data) => new SweepPage(data));
