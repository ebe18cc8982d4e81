'use strict';
// The numbers of a page, packed by numbers.py, and a strike made of them.

const byId = (id) => document.getElementById(id);

// An array of numbers, 64-bit or 32-bit floating point.
function unpacked({f64, f32}) {
  const {buffer} = Uint8Array.from(atob(f64 ?? f32), (c) => c.charCodeAt(0));
  return f64 === undefined ? new Float32Array(buffer) : new Float64Array(buffer);
}

function unpackedColumns(columns) {
  return Object.fromEntries(Object.entries(columns).map(([name, column]) => [name, unpacked(column)]));
}

// The number of leading entries of an ascending array that are at most x.
function countUpTo(ascending, x) {
  let low = 0, high = ascending.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (ascending[middle] <= x) low = middle + 1; else high = middle;
  }
  return low;
}

// The y at an x of a line through points, x ascending: straight between them, constant outside, the later of two at one x.
function interpolated(xs, ys, x) {
  const k = countUpTo(xs, x);
  if (k === 0 || k === xs.length) return ys[Math.max(k - 1, 0)];
  return ys[k - 1] + (x - xs[k - 1]) / (xs[k] - xs[k - 1]) * (ys[k] - ys[k - 1]);
}

// A number as it is set in print: significant digits, a minus sign.
function printed(x, digits = 4) {
  if (!Number.isFinite(x)) return '–';
  const text = Math.abs(x) >= 1e6 || (x !== 0 && Math.abs(x) < 1e-4)
    ? x.toExponential(digits - 1) : String(Number(x.toPrecision(digits)));
  return text.replaceAll('-', '−');
}

// What each kind of event is called, and the branch of the contact law that follows it.
const eventKinds = {
  contact_begins: {name: 'contact begins', branch: 'elastic'},
  contact_yields: {name: 'contact yields', branch: 'yielding'},
  contact_unloads: {name: 'unloading begins', branch: 'elastic'},
  contact_ends: {name: 'contact ends', branch: 'apart'},
};

class Strike {
  constructor(data) {
    Object.assign(this, data);
    this.history = unpackedColumns(data.history);
    this.times = this.history.time_s ?? new Float64Array(0);
    if (data.shapes) {
      for (const name of ['times', 'positions', 'displacement', 'moment', 'plastic']) {
        this.shapes[name] = unpacked(data.shapes[name]);
      }
    }
  }

  // Numbers of more digits would run into the name of their axis.
  unitOfForce() { return this.max_force < 1e5 ? {name: 'N', per_newton: 1} : {name: 'kN', per_newton: 1e-3}; }

  get hasHistory() { return this.times.length > 0; }
  get hasShapes() { return Boolean(this.shapes); }

  // A column of the history at a time (s).
  at(name, time) { return interpolated(this.times, this.history[name], time); }

  // The fields along the beam at a time (s), straight between stored shapes.
  shapeAt(time) {
    const {times, positions, plastic_points: where, displacement, moment, plastic} = this.shapes;
    const n = positions.length;
    const k = Math.min(Math.max(countUpTo(times, time) - 1, 0), times.length - 1);
    const next = Math.min(k + 1, times.length - 1);
    const share = next > k ? Math.min(Math.max((time - times[k]) / (times[next] - times[k]), 0), 1) : 0;
    const between = (field, width) => {
      const values = new Float64Array(width);
      for (let i = 0; i < width; ++i) {
        const now = field[k * width + i];
        values[i] = share > 0 ? now + share * (field[next * width + i] - now) : now;
      }
      return values;
    };
    const plasticCurvature = new Float64Array(n);
    between(plastic, where.length).forEach((value, i) => { plasticCurvature[where[i]] = value; });
    return {displacement: between(displacement, n), moment: between(moment, n), plasticCurvature};
  }

  mean(field) {
    const x = this.shapes.positions;
    let sum = 0;
    for (let i = 1; i < x.length; ++i) sum += 0.5 * (x[i] - x[i - 1]) * (field[i] + field[i - 1]);
    return sum / (x[x.length - 1] - x[0]);
  }

  subImpactAt(time) {
    return this.sub_impacts.findIndex((s) => time >= s.start && (time < s.end || s.ongoing));
  }

  // How far apart the surfaces are, m: less than 0 in contact.
  gapAt(time) {
    const hits = this.sub_impacts;
    const before = hits.findLast((hit) => hit.end <= time && !hit.ongoing);
    const dent = before ? before.residual : hits.length > 0 ? this.at('indentation_m', hits[0].start) : 0;
    return dent - this.at('indentation_m', time);
  }

  eventAt(time) { return this.events.find((event) => event.time === time); }

  // The next event after a time (sense 1), or the one before it (sense -1), or undefined.
  eventBeside(time, sense) {
    return sense > 0 ? this.events.find((event) => event.time > time)
                     : this.events.findLast((event) => event.time < time);
  }
}

// What all panels show: a time, and a part of the strike. Both in seconds.
class View {
  constructor(end) {
    this.end = end;
    this.time = 0;
    this.from = 0;
    this.to = end;
    this.changed = (what) => {};  // 'time' or 'part'
  }
  setTime(time) {
    this.time = Math.min(Math.max(time, 0), this.end);
    this.changed('time');
  }
  setPart(from, to) {
    const least = 1e-9 * this.end;  // below which digits end
    this.from = Math.max(0, Math.min(from, this.end - least));
    this.to = Math.min(this.end, Math.max(to, this.from + least));
    this.changed('part');
  }
  showAll() { this.setPart(0, this.end); }
  // The part, in words, in a unit of time; none for the whole strike.
  words({name, per_second: perSecond}) {
    return this.from === 0 && this.to === this.end ? ''
      : `${printed(this.from * perSecond, 7)} to ${printed(this.to * perSecond, 7)} ${name}`;
  }
  zoom(factor) {
    const half = 0.5 * factor * (this.to - this.from);
    this.setPart(this.time - half, this.time + half);
  }
}
