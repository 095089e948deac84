// Vectors, quaternions (x, y, z, w) and small systems of equations, for the scripts of the report.
'use strict';
const surefootMath = (() => {
  const dot = (a, b) => a.reduce((sum, v, k) => sum + v * b[k], 0);
  const plus = (a, b) => a.map((v, k) => v + b[k]);
  const minus = (a, b) => a.map((v, k) => v - b[k]);
  const times = (a, s) => a.map((v) => v * s);
  const mix = (a, b, t) => a.map((v, k) => v + (b[k] - v) * t);
  const length = (v) => Math.sqrt(dot(v, v));
  const clamp = (v, low, high) => Math.min(Math.max(v, low), high);
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

  function normalized(v, fallback) {
    const size = length(v);
    return size > 1e-9 ? times(v, 1 / size) : fallback;
  }

  // --- rotations

  const k_identity = [0, 0, 0, 1];
  const conjugate = ([x, y, z, w]) => [-x, -y, -z, w];
  const product = (a, b) => [
    a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
    a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
    a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
    a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
  ];
  const aligned = (q, side) => (dot(q, side) < 0 ? times(q, -1) : q);
  const yawed = (yaw) => [0, Math.sin(yaw / 2), 0, Math.cos(yaw / 2)];

  function rotate(q, v) {
    const [x, y, z, w] = q;
    const tx = 2 * (y * v[2] - z * v[1]), ty = 2 * (z * v[0] - x * v[2]), tz = 2 * (x * v[1] - y * v[0]);
    return [v[0] + w * tx + (y * tz - z * ty), v[1] + w * ty + (z * tx - x * tz), v[2] + w * tz + (x * ty - y * tx)];
  }

  /// The least rotation that takes one direction to another.
  function rotationBetween(from, to) {
    const a = normalized(from, [0, 0, 1]), b = normalized(to, [0, 0, 1]), c = dot(a, b);
    if (c < -0.999999) return [...normalized(cross(a, Math.abs(a[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0]), [0, 1, 0]), 0];
    return normalized([...cross(a, b), 1 + c], k_identity);
  }

  // --- equations

  /// Solves n equations, the right side in column n; null where they do not decide.
  function solve(m, n) {
    for (let c = 0; c < n; ++c) {
      let pivot = c;
      for (let r = c + 1; r < n; ++r) if (Math.abs(m[r][c]) > Math.abs(m[pivot][c])) pivot = r;
      if (!(Math.abs(m[pivot][c]) > 1e-30)) return null;
      [m[c], m[pivot]] = [m[pivot], m[c]];
      for (let r = c + 1; r < n; ++r) {
        const f = m[r][c] / m[c][c];
        for (let k = c; k <= n; ++k) m[r][k] -= f * m[c][k];
      }
    }
    const x = new Array(n).fill(0);
    for (let r = n - 1; r >= 0; --r) {
      let sum = m[r][n];
      for (let k = r + 1; k < n; ++k) sum -= m[r][k] * x[k];
      x[r] = sum / m[r][r];
    }
    return x;
  }

  return { dot, plus, minus, times, mix, length, clamp, cross, normalized, k_identity, conjugate, product, aligned, yawed,
           rotate, rotationBetween, solve };
})();
