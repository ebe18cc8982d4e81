'use strict';
// The runs of a sweep: the columns of their table, and their sub-impacts.

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
    return printed(value, this.isKey || Number.isInteger(value) ? 7 : 4) + (this.unit ? ' ' + this.unit : '');
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

class SweptRuns {
  constructor({numbers, case_file: caseFile, columns, sub_impacts: subImpacts}) {
    Object.assign(this, {numbers, caseFile});
    this.columns = columns.map((column) => new SweepColumn(column));
    this.keys = this.columns.filter((column) => column.isKey);
    this.readSubImpacts(subImpacts);
  }

  column(name) { return this.columns.find((column) => column.name === name); }

  readSubImpacts({counts, ...packed}) {
    this.subImpactColumns = unpackedColumns(packed);
    let first = 0;
    this.places = counts.map((count) => {
      const place = {first, count};
      first += Math.max(count, 0);
      return place;
    });
  }

  // 'certain', 'uncertain' (count and order), or 'unknown' (no error bars).
  certainty(run) {
    const value = this.column('all_certain')?.values[run];
    return value === 1 ? 'certain' : value === 0 ? 'uncertain' : 'unknown';
  }

  // What a run is, with its value of the column that is shown.
  words(run, shown) {
    const keys = this.keys.slice(0, 6).map((key) => `${key.label} ${key.text(run)}`);
    const parts = [`run ${this.numbers[run]}: ${keys.join(', ')}`];
    if (!shown.isKey) parts.push(`${shown.label} ${shown.text(run)}`);
    if (this.certainty(run) === 'uncertain') {
      const n = this.column('n_certain')?.values[run];
      parts.push(n > 0 ? `not certain: only the first ${n} of its sub-impacts are certain`
                       : 'not certain: none of its sub-impacts is certain');
    }
    const outcome = this.column('outcome').text(run);
    if (outcome !== 'completed') parts.push(outcome);
    return parts.join(' · ');
  }

  subImpacts(run) {
    const {first, count} = this.places[run];
    const columns = this.subImpactColumns;
    const certain = this.column('n_certain')?.values[run];
    const end = this.column('time_s')?.values[run] * 1e-3;
    const orNull = (value) => (Number.isNaN(value) ? null : value);
    return Array.from({length: Math.max(count, 0)}, (_, i) => {
      const row = Object.fromEntries(Object.entries(columns).map(([name, values]) => [name, orNull(values[first + i])]));
      const ongoing = row.end === null;
      return {...row, end: ongoing ? Math.max(end, row.start) : row.end, ongoing, certain: !(i >= certain)};
    });
  }
}
