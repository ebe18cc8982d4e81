'use strict';
// The beam moving: deflected shape with the striker, and the diagram of moments below it.

// The largest distance of numbers from one.
function largest(numbers, from = 0) { return numbers.reduce((most, x) => Math.max(most, Math.abs(x - from)), 0); }

class Motion {
  // Displacements are drawn `exaggeration` times as large as lengths along the beam.
  constructor(strike, shapeCanvas, momentCanvas) {
    Object.assign(this, {strike, shapeCanvas, momentCanvas});
    this.follows = !strike.held;
    this.largestPlastic = largest(strike.shapes.plastic);
    this.largestMoment = largest(strike.shapes.moment);
    this.exaggeration = this.suitable();
  }

  // What displacements are measured from: the beam's mean, if the picture moves with it.
  origin(displacement) { return this.follows ? this.strike.mean(displacement) : 0; }

  // The exaggeration, 1, 2 or 5 times a power of ten, at which the largest deflection fits.
  suitable() {
    const {times, positions, displacement} = this.strike.shapes;
    const fields = Array.from(times, (_, k) => displacement.subarray(k * positions.length, (k + 1) * positions.length));
    let most = fields.reduce((most, field) => Math.max(most, largest(field, this.origin(field))), 0);
    if (this.strike.stop && this.strike.hasHistory) {  // which is to be seen with its gap
      most = Math.max(most, largest(this.strike.history.w_m_m, this.origin(fields[0])));
    }
    if (!(most > 0)) return 1;
    const {clientWidth: width, clientHeight: height} = this.shapeCanvas;
    const raw = Math.min(0.12, 0.35 * height / width || 0.12) * this.strike.length / most;
    const decade = 10 ** Math.floor(Math.log10(raw));
    return Math.max(1, decade * [5, 2, 1].find((factor) => factor * decade <= raw));
  }

  drawAt(time) {
    const shape = this.strike.shapeAt(time);
    this.drawShape(shape, time);
    this.drawMoment(shape);
  }

  drawShape(shape, time) {
    const {strike} = this;
    const length = strike.length;
    const width = this.shapeCanvas.clientWidth - 80, height = this.shapeCanvas.clientHeight - 26;
    // In mm, of the vertical axis, which counts downwards, in the direction of the strike.
    const extent = 1e3 * length * height / width / this.exaggeration;
    const axes = new Axes(this.shapeCanvas, {
      x: {range: [0, length]},
      y: {range: [0.5 * extent, -0.5 * extent],
          label: this.follows ? 'w − its mean, mm' : 'displacement w, mm'}});
    axes.frame();
    const origin = this.origin(shape.displacement);
    const points = Array.from(strike.shapes.positions, (x, i) =>
      [axes.toX(x), axes.toY(1e3 * (shape.displacement[i] - origin))]);
    const thick = Math.max(5, strike.thickness / length * (axes.right - axes.left));
    axes.inside((draw) => {
      draw.lineJoin = 'round';
      axes.line(points, {colour: colour('beam'), width: thick, smooth: true});
      this.drawPlastic(axes, points, shape, thick);
      if (strike.hasHistory) this.drawStriker(axes, time, origin, thick);
      drawGround(axes, strike, points, thick);
      drawLoads(axes, strike, points, thick, time);
    });
    this.drawSupports(axes, points, thick);  // beyond the axes, to be seen whole
    drawRollers(axes, strike, thick, time, origin);
  }

  // Sections that have yielded, the stronger the larger their plastic curvature.
  drawPlastic(axes, points, shape, thick) {
    if (!(this.largestPlastic > 0)) return;
    const {draw} = axes;
    const tone = colour('plastic');
    for (let i = 0; i < points.length; ++i) {
      const plastic = Math.abs(shape.plasticCurvature[i]);
      if (plastic < 1e-6 * this.largestPlastic) continue;
      const [before, after] = [points[Math.max(i - 1, 0)], points[Math.min(i + 1, points.length - 1)]];
      const from = [0, 1].map((c) => 0.5 * (before[c] + points[i][c]));
      const to = [0, 1].map((c) => 0.5 * (after[c] + points[i][c]));
      draw.globalAlpha = 0.35 + 0.65 * Math.sqrt(plastic / this.largestPlastic);
      axes.line([from, points[i], to], {colour: tone, width: thick});
    }
    draw.globalAlpha = 1;
  }

  drawStriker(axes, time, origin, thick) {
    const {strike} = this;
    const {draw} = axes;
    const touches = strike.at('force_N', time) > 0;
    const x = axes.toX(strike.struck_at);
    const nose = axes.toY(1e3 * (strike.at('w_m_m', time) - origin)) - 0.5 * thick;
    // The nose is to the scale of the beam's length, unless it would be too small to see.
    const radius = Math.max(4, strike.nose_radius / strike.length * (axes.right - axes.left));
    if (nose < axes.top + 4 || nose > axes.bottom + 70) {
      this.drawStrikerFar(axes, x, nose < axes.top + 4, time);
      return;
    }
    draw.fillStyle = colour(touches ? 'striker' : 'striker-apart');
    draw.strokeStyle = colour('text');
    draw.lineWidth = 1;
    draw.beginPath();
    if (strike.ball && !strike.stop) {
      draw.arc(x, nose - radius, radius, 0, 2 * Math.PI);
    } else {
      const back = strike.stop ? axes.top : nose - Math.max(46, 2 * radius);  // a stop reaches out of the picture
      draw.moveTo(x - radius, back);
      draw.lineTo(x + radius, back);
      draw.lineTo(x + radius, nose - radius);
      draw.arc(x, nose - radius, radius, 0, Math.PI);
      draw.closePath();
    }
    draw.fill();
    draw.stroke();
  }

  // An arrow towards a striker outside of the picture, with its distance from the beam.
  drawStrikerFar(axes, x, above, time) {
    const distance = Math.abs(1e3 * (this.strike.at('w_c_m', time) - this.strike.at('w_m_m', time)));
    const y = above ? axes.top + 12 : axes.bottom - 12;
    axes.text(`${above ? '↑' : '↓'} ${this.strike.stop ? 'stop' : 'striker'}, ${printed(distance, 3)} mm from the beam`, x + 8, y);
  }

  drawSupports(axes, points, thick) {
    const {draw} = axes;
    draw.fillStyle = colour('soft');
    this.strike.ends.forEach((end, i) => {
      const [x, y] = points[i === 0 ? 0 : points.length - 1];
      if (end === 'clamped') draw.fillRect(x + (i === 0 ? -6 : 0), y - 26, 6, 52);
      if (end !== 'pinned') return;
      const foot = y + thick / 2 + 15;
      draw.beginPath();
      draw.moveTo(x, y + thick / 2);
      draw.lineTo(x - 9, foot);
      draw.lineTo(x + 9, foot);
      draw.fill();
      draw.fillRect(x - 12, foot, 24, 3);
    });
  }

  drawMoment(shape) {
    const {strike} = this;
    const yieldMoment = strike.yield_moment;
    const most = 1.1 * Math.max(this.largestMoment, this.largestMoment > 0.3 * yieldMoment ? yieldMoment : 0);
    const axes = new Axes(this.momentCanvas, {
      x: {range: [0, strike.length], label: 'position along the beam, m'},
      y: {range: most > 0 ? [-most, most] : [-1, 1], label: 'moment, N m'}});
    axes.frame();
    const {positions} = strike.shapes;
    axes.inside((draw) => {
      if (strike.envelope) this.drawMomentEnvelope(axes, draw);
      const points = Array.from(positions, (x, i) => [axes.toX(x), axes.toY(shape.moment[i])]);
      axes.line(points, {colour: colour('line1'), width: 2, smooth: true});
      if (yieldMoment === null || yieldMoment > most) return;
      for (const level of [yieldMoment, -yieldMoment]) {
        axes.line([[axes.left, axes.toY(level)], [axes.right, axes.toY(level)]],
                  {colour: colour('soft'), width: 1, dash: [5, 4]});
      }
      axes.text('first yield', axes.right - 4, axes.toY(yieldMoment) - 8, 'right', 'soft');
    });
  }

  drawMomentEnvelope(axes, draw) {
    const {positions, moment} = this.strike.envelope;
    draw.fillStyle = colour('band');
    draw.beginPath();
    positions.forEach((x, i) => draw.lineTo(axes.toX(x), axes.toY(moment.largest[i])));
    for (let i = positions.length - 1; i >= 0; --i) {
      draw.lineTo(axes.toX(positions[i]), axes.toY(moment.smallest[i]));
    }
    draw.fill();
  }
}

// Plays time, to the end of the part shown: so many seconds of the strike per second.
class Player {
  constructor(view) {
    this.view = view;
    this.speed = 1e-4;
    this.playing = false;
    this.changed = () => {};
  }
  toggle() { this.playing ? this.pause() : this.play(); }
  play() {
    const {time, from, to} = this.view;
    if (time >= to || time < from) this.view.setTime(from);
    this.playing = true;
    this.last = performance.now();
    requestAnimationFrame((now) => this.frame(now));
    this.changed();
  }
  pause() {
    this.playing = false;
    this.changed();
  }
  frame(now) {
    if (!this.playing) return;
    const passed = Math.max(0, now - this.last) / 1e3;
    this.last = Math.max(now, this.last);
    this.view.setTime(Math.min(this.view.time + passed * this.speed, this.view.to));
    if (this.view.time >= this.view.to) this.pause();
    else requestAnimationFrame((next) => this.frame(next));
  }
}
