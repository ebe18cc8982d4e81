'use strict';
// Colours over a column of a sweep, and their key.

// From low to high; distinguishable without colours, on light and dark ground.
const shadeStops = [[68, 1, 84], [62, 74, 137], [38, 130, 142], [53, 183, 121], [180, 222, 44], [253, 231, 37]];
// Of small counts, from 0 on: neighbours differ in hue and lightness.
const countStops = ['#ffffff', '#56b4e9', '#e69f00', '#009e73', '#f0e442', '#cc79a7', '#d55e00', '#0072b2', '#a6761d', '#b3b3b3']
  .map((text) => [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16)));
const wordColours = ['line1', 'line2', 'line3', 'line4', 'line5', 'line6'];

class Shade {
  constructor(column) {
    this.column = column;
    const at = column.different.filter(Number.isFinite);
    [this.low, this.high] = [at[0] ?? 0, at[at.length - 1] ?? 1];
    this.isCount = column.name.startsWith('n_') && this.low >= 0 && this.high < countStops.length;
    this.log = !column.words && this.low > 0 && this.high / this.low > 1e3;
  }
  share(value) {
    return this.high > this.low ? Axes.share({range: [this.low, this.high], log: this.log}, value) : 0.5;
  }
  // The colour of a value as red, green and blue; null where there is none.
  rgb(value) {
    if (!Number.isFinite(value)) return null;
    if (this.isCount) return countStops[value];
    const place = Math.min(Math.max(this.share(value), 0), 1) * (shadeStops.length - 1);
    const k = Math.min(Math.floor(place), shadeStops.length - 2);
    return shadeStops[k].map((from, i) => Math.round(from + (place - k) * (shadeStops[k + 1][i] - from)));
  }
  of(value) {
    if (this.column.words) return colour(wordColours[value % wordColours.length]);
    const rgb = this.rgb(value);
    return rgb ? `rgb(${rgb.join(' ')})` : null;
  }
  // The colour of a mark on that colour.
  contrast(value) {
    if (this.column.words) return colour('paper');
    const [r, g, b] = this.rgb(value) ?? [0, 0, 0];
    return 0.299 * r + 0.587 * g + 0.114 * b > 140 ? '#000000' : '#ffffff';
  }

  // Counts have ticks at whole numbers only.
  ticks(axes) {
    const ticks = axes.ticks(axes.x, axes.right - axes.left, 90);
    if (!this.column.different.every(Number.isInteger)) return ticks;
    return ticks.filter(({at}) => Math.abs(at - Math.round(at)) < 1e-9).map(({at}) => ({at, label: printed(Math.round(at), 7)}));
  }

  // The key: a strip of colours with ticks, or words with samples.
  draw(canvas) {
    const {column} = this;
    const [from, to] = this.high > this.low ? [this.low, this.high] : [this.low - 1, this.low + 1];
    const axes = new Axes(canvas, {x: {range: [from, to], label: column.title, log: this.log}, y: {range: [0, 1]}, top: 2});
    const {draw} = axes;
    if (column.words || this.isCount) {
      const samples = column.words ? column.words.map((word, k) => [word, k]) : column.different.map((n) => [String(n), n]);
      axes.key(samples.map(([word, value]) => [word, 18, (x, y) => {
        draw.fillStyle = this.of(value);
        draw.fillRect(x, y - 6, 18, 12);
      }]), 12);
      if (this.isCount) axes.text(column.title, 0.5 * (axes.left + axes.right), axes.bottom + 30, 'center');
      return;
    }
    for (let x = axes.left; x < axes.right; ++x) {
      const share = (x - axes.left) / (axes.right - axes.left);
      draw.fillStyle = this.of(this.log ? from * (to / from) ** share : from + share * (to - from));
      draw.fillRect(x, 2, 1.5, axes.bottom - 2);
    }
    for (const {at, label} of this.ticks(axes)) axes.text(label, axes.toX(at), axes.bottom + 11, 'center');
    axes.text(column.title, 0.5 * (axes.left + axes.right), axes.bottom + 30, 'center');
  }
}
