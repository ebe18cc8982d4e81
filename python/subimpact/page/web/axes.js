'use strict';
// Axes with ticks and labels on a canvas.

// A colour of the style sheet, by its name there.
const colours = new Map();
function colour(name) {
  if (!colours.has(name)) {
    colours.set(name, getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim());
  }
  return colours.get(name);
}

// 1, 2 or 5 times a power of ten, nearest above.
function roundSpacing(raw) {
  const decade = 10 ** Math.floor(Math.log10(raw));
  return decade * ([1, 2, 5].find((factor) => factor * decade >= raw * (1 - 1e-9)) ?? 10);
}

// Round values, some `most` and two at least.
function linearTicks(from, to, most) {
  for (let parts = most; ; parts *= 2) {
    const spacing = roundSpacing((to - from) / parts);
    const decimals = Math.max(0, Math.ceil(-Math.log10(spacing) - 1e-9));
    const ticks = [];
    for (let k = Math.ceil(from / spacing - 1e-9); k * spacing <= to + 1e-9 * spacing; ++k) {
      ticks.push({at: k * spacing, label: (k * spacing).toFixed(decimals).replace(/^-(?=.*[1-9])/, '−').replace(/^-/, '')});
    }
    if (ticks.length >= 2 || !(to > from) || parts > 64 * most) return ticks;
  }
}

// Powers of ten; between them 2 and 5 where fewer than three of those would be there.
function logTicks(from, to) {
  const factors = Math.log10(to / from) >= 3 ? [1] : [1, 2, 5];
  const ticks = [];
  for (let decade = Math.floor(Math.log10(from)); 10 ** decade <= to; ++decade) {
    for (const factor of factors) {
      const at = Number((factor * 10 ** decade).toPrecision(3));
      if (at >= from && at <= to) ticks.push({at, label: printed(at)});
    }
  }
  return ticks;
}

// A range of a logarithmic axis that ends at ticks, two at least.
function logRange(values) {
  const positive = values.filter((value) => value > 0).sort((a, b) => a - b);
  return positive.length === 0 ? [0.1, 10] : [roundSpacing(positive[0] / 3), roundSpacing(1.6 * positive.at(-1))];
}

class Axes {
  // options: x and y: {range, label, log}; a range may descend. top: the margin in pixels.
  constructor(canvas, options) {
    this.canvas = canvas;
    const ratio = window.devicePixelRatio || 1;
    this.width = canvas.clientWidth;
    this.height = canvas.clientHeight;
    const width = Math.round(this.width * ratio), height = Math.round(this.height * ratio);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
    this.draw = canvas.getContext('2d');
    this.draw.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.draw.clearRect(0, 0, this.width, this.height);
    this.x = options.x;
    this.y = options.y;
    this.left = 66;
    this.right = this.width - 14;
    this.top = options.top ?? 14;
    this.bottom = this.height - (options.x.label ? 44 : 12);
  }

  static share(axis, value) {
    const [from, to] = axis.range;
    return axis.log ? Math.log(value / from) / Math.log(to / from) : (value - from) / (to - from);
  }
  toX(value) { return this.left + Axes.share(this.x, value) * (this.right - this.left); }
  toY(value) { return this.bottom - Axes.share(this.y, value) * (this.bottom - this.top); }

  ticks(axis, pixels, perTick) {
    const [from, to] = [Math.min(...axis.range), Math.max(...axis.range)];
    return axis.log ? logTicks(from, to) : linearTicks(from, to, Math.max(2, Math.floor(pixels / perTick)));
  }

  // Grid, ticks and labels; what is drawn afterwards lies above the grid.
  frame() {
    const {draw, left, right, top, bottom} = this;
    const grid = {colour: colour('grid'), width: 1};
    for (const {at, label} of this.ticks(this.y, bottom - top, 36)) {
      this.line([[left, this.toY(at)], [right, this.toY(at)]], grid);
      this.text(label, left - 7, this.toY(at), 'right', 'soft');
    }
    for (const {at, label} of this.ticks(this.x, right - left, 90)) {
      this.line([[this.toX(at), top], [this.toX(at), bottom]], grid);
      if (this.x.label) this.text(label, this.toX(at), bottom + 12, 'center', 'soft');
    }
    this.line([[left, top], [left, bottom], [right, bottom]], {colour: colour('soft')});
    if (this.x.label) this.text(this.x.label, (left + right) / 2, bottom + 31, 'center');
    draw.save();
    draw.translate(12, (top + bottom) / 2);
    draw.rotate(-Math.PI / 2);
    this.text(this.y.label, 0, 0, 'center');
    draw.restore();
  }

  // What `paint` draws is cut off at the axes.
  inside(paint) {
    const {draw} = this;
    draw.save();
    draw.beginPath();
    draw.rect(this.left, this.top, this.right - this.left, this.bottom - this.top);
    draw.clip();
    paint(draw);
    draw.restore();
  }

  // A line through points in pixels; `smooth`: round between them.
  line(points, style = {}) {
    const {draw} = this;
    if (style.colour) draw.strokeStyle = style.colour;
    if (style.width) draw.lineWidth = style.width;
    draw.setLineDash(style.dash ?? []);
    draw.beginPath();
    points.forEach(([x, y], i) => {
      if (i === 0) draw.moveTo(x, y);
      else if (!style.smooth) draw.lineTo(x, y);
      else {  // cubics whose slopes at points are those of their neighbours
        const [before, from, after] = [points[Math.max(i - 2, 0)], points[i - 1], points[Math.min(i + 1, points.length - 1)]];
        draw.bezierCurveTo(from[0] + (x - before[0]) / 6, from[1] + (y - before[1]) / 6,
                           x - (after[0] - from[0]) / 6, y - (after[1] - from[1]) / 6, x, y);
      }
    });
    draw.stroke();
    draw.setLineDash([]);
  }

  text(words, x, y, align = 'left', name = 'text') {
    this.draw.font = '12px system-ui, sans-serif';
    this.draw.fillStyle = colour(name);
    this.draw.textAlign = align;
    this.draw.textBaseline = 'middle';
    this.draw.fillText(words, x, y);
  }

  // Samples with words, side by side: [words, width of the sample, paint(x, y)].
  key(entries, y) {
    let x = this.left + 12;
    for (const [words, width, paint] of entries) {
      paint(x, y);
      this.text(words, x + width + 6, y);
      x += width + 21 + this.draw.measureText(words).width;
    }
  }

  // The same of lines: [words, style].
  lineKey(entries, y) {
    this.key(entries.map(([words, style]) => [words, 26, (x) => this.line([[x, y], [x + 26, y]], style)]), y);
  }
}
