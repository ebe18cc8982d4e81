'use strict';
// What acts on the beam besides the striker: springs and bedding from the ground, loads as arrows.

// Of points [x, y], such as the beam's axis on the canvas or a force over time.
function heightAt(points, x) { return interpolated(points.map((point) => point[0]), points.map((point) => point[1]), x); }

function drawGround(axes, strike, points, thick) {
  const springs = strike.springs.filter((spring) => !spring.one_sided);
  if (springs.length === 0 && !strike.bedding) return;
  const ground = axes.bottom - 6;
  axes.line([[axes.left, ground], [axes.right, ground]], {colour: colour('soft'), width: 3});
  const spring = (x, wide) => {
    const top = heightAt(points, x) + thick / 2;
    const zigzag = Array.from({length: 9}, (_, i) => [x + (i % 2 ? wide : -wide), top + (ground - top) * (i + 0.5) / 9]);
    axes.line([[x, top], ...zigzag, [x, ground]], {colour: colour('soft'), width: 1.5});
  };
  for (const {position} of springs) spring(axes.toX(position), 6);
  if (!strike.bedding) return;
  for (let i = 0; i < 24; ++i) spring(axes.left + (i + 0.5) / 24 * (axes.right - axes.left), 2);
}

// Supports that the beam can lift off, as rollers: filled where it lies on them.
function drawRollers(axes, strike, thick, time, origin) {
  const {draw} = axes;
  const radius = 7;
  for (const {position, one_sided: isLoose, gap, side} of strike.springs) {
    if (!isLoose) continue;
    const touched = strike.supports.some((one) => one.position === position && one.start <= time && time <= one.end);
    const x = axes.toX(position), y = axes.toY(1e3 * (side * gap - origin)) + side * (0.5 * thick + radius);
    draw.fillStyle = draw.strokeStyle = colour('soft');
    draw.lineWidth = 2;
    draw.beginPath();
    draw.arc(x, y, radius - 1, 0, 2 * Math.PI);
    if (touched) draw.fill();
    draw.stroke();
    draw.fillRect(x - 12, side > 0 ? y + radius : y - radius - 3, 24, 3);
  }
}

// Arrows that end at the beam, on the side from which a force pushes, as long as it is strong.
function drawLoads(axes, strike, points, thick, time) {
  const arrow = (x, share) => {
    if (Math.abs(share) < 0.02) return;
    const way = Math.sign(share), tip = heightAt(points, x) - way * thick / 2;
    const tail = tip - way * (10 + 40 * Math.abs(share));
    const style = {colour: colour('line3'), width: 2};
    axes.line([[x, tail], [x, tip]], style);
    axes.line([[x - 4, tip - 8 * way], [x, tip], [x + 4, tip - 8 * way]], style);
  };
  for (const {position, table} of strike.forces) {
    const largest = table.reduce((most, [, force]) => Math.max(most, Math.abs(force)), 0);
    arrow(axes.toX(position), heightAt(table, time) / (largest || 1));
  }
  if (strike.load === 0) return;
  for (let i = 0; i < 16; ++i) {
    arrow(axes.left + (i + 0.5) / 16 * (axes.right - axes.left), 0.25 * Math.sign(strike.load));
  }
}
