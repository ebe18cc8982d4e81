// Explicit dynamics of a beam of bricks, struck by a rigid cylinder across its width or by a ball.
//
// Bricks with one point in finite rotations: F = R U, the strain is U - I, the stress T is its
// conjugate (Biot's), J2 with perfect plasticity. Hourglass displacements q meet an elastic
// stiffness k = 0.05 mu V (1/a^2 + 1/b^2 + 1/c^2)/2 (Flanagan and Belytschko 1981). Half of the
// width is computed, and half of the length if the strike is at the middle.
#include <array>
#include <cmath>
#include <vector>

#include "run.h"

namespace continuum {
namespace {

constexpr int block = 64;  // elements whose forces are kept in the first cache

struct Tensor {
  double xx, xy, xz, yx, yy, yz, zx, zy, zz;
};

struct Symmetric {
  double xx, yy, zz, xy, yz, zx;
};

// One step of R <- (R + R^-T)/2, which tends to the rotation of the polar decomposition (Higham
// 1986).
[[gnu::always_inline]] inline Tensor nearer_rotation(const Tensor& r) {
  const double xx = r.yy * r.zz - r.yz * r.zy, xy = r.yz * r.zx - r.yx * r.zz,
               xz = r.yx * r.zy - r.yy * r.zx;
  const double yx = r.zy * r.xz - r.zz * r.xy, yy = r.zz * r.xx - r.zx * r.xz,
               yz = r.zx * r.xy - r.zy * r.xx;
  const double zx = r.xy * r.yz - r.xz * r.yy, zy = r.xz * r.yx - r.xx * r.yz,
               zz = r.xx * r.yy - r.xy * r.yx;
  const double w = 0.5 / (r.xx * xx + r.xy * xy + r.xz * xz);
  return {0.5 * r.xx + w * xx, 0.5 * r.xy + w * xy, 0.5 * r.xz + w * xz,
          0.5 * r.yx + w * yx, 0.5 * r.yy + w * yy, 0.5 * r.yz + w * yz,
          0.5 * r.zx + w * zx, 0.5 * r.zy + w * zy, 0.5 * r.zz + w * zz};
}

// U - I = sym(R^T F) - I.
[[gnu::always_inline]] inline Symmetric stretch(const Tensor& r, const Tensor& f) {
  const auto column = [](double a, double b, double c, double x, double y, double z) {
    return a * x + b * y + c * z;
  };
  const double xy =
      column(r.xx, r.yx, r.zx, f.xy, f.yy, f.zy) + column(r.xy, r.yy, r.zy, f.xx, f.yx, f.zx);
  const double yz =
      column(r.xy, r.yy, r.zy, f.xz, f.yz, f.zz) + column(r.xz, r.yz, r.zz, f.xy, f.yy, f.zy);
  const double zx =
      column(r.xz, r.yz, r.zz, f.xx, f.yx, f.zx) + column(r.xx, r.yx, r.zx, f.xz, f.yz, f.zz);
  return {column(r.xx, r.yx, r.zx, f.xx, f.yx, f.zx) - 1.0,
          column(r.xy, r.yy, r.zy, f.xy, f.yy, f.zy) - 1.0,
          column(r.xz, r.yz, r.zz, f.xz, f.yz, f.zz) - 1.0,
          0.5 * xy,
          0.5 * yz,
          0.5 * zx};
}

[[gnu::always_inline]] inline double contraction(const Symmetric& a, const Symmetric& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.xy * b.xy + a.yz * b.yz + a.zx * b.zx);
}

struct Material {
  double lambda, mu, yield_squared;
};

// The stress after a change of strain: elastic, then scaled radially to the yield surface.
[[gnu::always_inline]] inline Symmetric stress(const Material& m, const Symmetric& old,
                                               const Symmetric& du) {
  const double mean = (old.xx + old.yy + old.zz) / 3.0, volume = (du.xx + du.yy + du.zz) / 3.0,
               two_mu = 2.0 * m.mu;
  const double pressure = mean + (3.0 * m.lambda + two_mu) * volume;
  const Symmetric d{old.xx - mean + two_mu * (du.xx - volume),
                    old.yy - mean + two_mu * (du.yy - volume),
                    old.zz - mean + two_mu * (du.zz - volume),
                    old.xy + two_mu * du.xy,
                    old.yz + two_mu * du.yz,
                    old.zx + two_mu * du.zx};
  const double room = m.yield_squared / (1.5 * contraction(d, d));
  const double scale = std::sqrt(room < 1.0 ? room : 1.0);
  return {pressure + scale * d.xx,
          pressure + scale * d.yy,
          pressure + scale * d.zz,
          scale * d.xy,
          scale * d.yz,
          scale * d.zx};
}

// P with T : dU = P : dF, that is R (T + S) with S skew: it balances the moment of T on U, solved
// for with the diagonal of U, which leaves an error of the third order in the strain.
[[gnu::always_inline]] inline Tensor piola(const Tensor& r, const Symmetric& t,
                                           const Symmetric& u) {
  const double xy = ((t.yy - t.xx) * u.xy + t.xy * (u.xx - u.yy) + t.yz * u.zx - t.zx * u.yz) /
                    (2.0 + u.xx + u.yy);
  const double yz = ((t.zz - t.yy) * u.yz + t.yz * (u.yy - u.zz) + t.zx * u.xy - t.xy * u.zx) /
                    (2.0 + u.yy + u.zz);
  const double zx = ((t.xx - t.zz) * u.zx + t.zx * (u.zz - u.xx) + t.xy * u.yz - t.yz * u.xy) /
                    (2.0 + u.zz + u.xx);
  const Tensor p{t.xx,      t.xy + xy, t.zx - zx, t.xy - xy, t.yy,
                 t.yz + yz, t.zx + zx, t.yz - yz, t.zz};
  return {r.xx * p.xx + r.xy * p.yx + r.xz * p.zx, r.xx * p.xy + r.xy * p.yy + r.xz * p.zy,
          r.xx * p.xz + r.xy * p.yz + r.xz * p.zz, r.yx * p.xx + r.yy * p.yx + r.yz * p.zx,
          r.yx * p.xy + r.yy * p.yy + r.yz * p.zy, r.yx * p.xz + r.yy * p.yz + r.yz * p.zz,
          r.zx * p.xx + r.zy * p.yx + r.zz * p.zx, r.zx * p.xy + r.zy * p.yy + r.zz * p.zy,
          r.zx * p.xz + r.zy * p.yz + r.zz * p.zz};
}

// Of one component of displacement on the eight nodes: its sums with the signs of X, Y, Z (8
// elements' lengths times the gradient) and with those of the four hourglass patterns.
struct Pattern {
  double x, y, z, xy, xz, yz, xyz;
};

struct Corners {  // first nodes of the four rows of nodes around a row of elements: (y, z) = --,
                  // +-, -+, ++
  int a, b, c, d;
};

[[gnu::always_inline]] inline Pattern pattern(const double* u, const Corners& n, int i) {
  const double a0 = u[n.a + i], a1 = u[n.a + i + 1], b0 = u[n.b + i], b1 = u[n.b + i + 1];
  const double c0 = u[n.c + i], c1 = u[n.c + i + 1], d0 = u[n.d + i], d1 = u[n.d + i + 1];
  const double sa = a0 + a1, sb = b0 + b1, sc = c0 + c1, sd = d0 + d1;
  const double da = a1 - a0, db = b1 - b0, dc = c1 - c0, dd = d1 - d0;
  return {da + db + dc + dd, sb + sd - sa - sc, sc + sd - sa - sb, db + dd - da - dc,
          dc + dd - da - db, sa + sd - sb - sc, da + dd - db - dc};
}

using Forces = std::array<std::array<double, block>, 8>;  // by node of the elements of a block

// One component of an element's forces, from x, y, z (of the stress, over the four signs) and the
// hourglass stiffness g; returns the energy of the hourglass patterns.
[[gnu::always_inline]] inline double put(Forces& out, int m, double x, double y, double z, double g,
                                         const Pattern& q) {
  const double xy = g * q.xy, xz = g * q.xz, yz = g * q.yz, xyz = g * q.xyz;
  out[0][m] = x + y + z - xy - xz - yz + xyz;
  out[1][m] = -x + y + z + xy + xz - yz - xyz;
  out[2][m] = x - y + z + xy - xz + yz - xyz;
  out[3][m] = -x - y + z - xy + xz + yz + xyz;
  out[4][m] = x + y - z - xy + xz + yz - xyz;
  out[5][m] = -x + y - z + xy - xz + yz + xyz;
  out[6][m] = x - y - z + xy + xz - yz + xyz;
  out[7][m] = -x - y - z - xy - xz - yz - xyz;
  return 0.5 * (xy * q.xy + xz * q.xz + yz * q.yz + xyz * q.xyz);
}

class Solid {
 public:
  explicit Solid(const Scene& s);

  double parts() const { return 2.0 * (s_.is_symmetric() ? 2.0 : 1.0); }
  int n_elements() const { return nx_ * ny_ * nz_; }
  void add_internal_forces();

  double internal_energy() const {
    double sum = 0.0;
    for (std::size_t n = 0; n < work_.size(); ++n) sum += work_[n] + hourglass_[n];
    return sum;
  }

  double middle() const {
    return 0.5 * (nodes.u[1][at(struck_, ny_ / 2, 0)] + nodes.u[1][at(struck_, (ny_ + 1) / 2, 0)]);
  }

  double dent() const { return nodes.u[1][at(struck_, 0, 0)] - nodes.u[1][at(struck_, ny_, 0)]; }
  double shape(std::size_t n) const { return free_mode(s_.mode, s_.length, x_[n % (nx_ + 1)]); }
  Vector curvatures() const;
  const Vector& lengths() const { return dx_; }

  Nodes nodes;
  Surface surface;
  double dt = 0.0;

 private:
  int at(int i, int j, int k) const { return (j * (nz_ + 1) + k) * (nx_ + 1) + i; }
  void hold();
  void add_row(const Corners& n, int first, int begin, int end);

  const Scene& s_;
  Vector x_, dx_;
  int nx_, ny_, nz_, struck_ = 0;
  double dy_, dz_;
  std::array<Vector, 6> strain_, stress_;  // xx, yy, zz, xy, yz, zx of each element
  Vector work_, hourglass_;                // energies
  std::array<Forces, 3> force_{};
  Material material_;
};

Solid::Solid(const Scene& s)
    : nodes(stations(s).size() * (s.layers + 1) * (s.across + 1)),
      s_(s),
      x_(stations(s)),
      nx_(static_cast<int>(x_.size()) - 1),
      ny_(s.layers),
      nz_(s.across),
      dy_(s.thickness / ny_),
      dz_(0.5 * s.width / nz_),
      material_{s.lame(), s.shear_modulus(), s.yield_squared()} {
  while (x_[struck_] < 0.0) ++struck_;
  for (auto* set : {&strain_, &stress_})
    for (Vector& v : *set) v.assign(n_elements(), 0.0);
  work_.assign(n_elements(), 0.0);
  hourglass_.assign(n_elements(), 0.0);
  double shortest = 1e300;
  for (int i = 0; i < nx_; ++i) {
    dx_.push_back(x_[i + 1] - x_[i]);
    shortest = std::min(shortest, dx_[i]);
    for (int j = 0; j < ny_; ++j)
      for (int k = 0; k < nz_; ++k)
        for (int corner = 0; corner < 8; ++corner)
          nodes.mass[at(i + corner % 2, j + corner / 2 % 2, k + corner / 4)] +=
              0.125 * s.density * dx_[i] * dy_ * dz_;
  }
  const double waves = (s.lame() + 2.0 * s.shear_modulus()) / s.density;
  dt = s.courant /
       std::sqrt(waves * (1.0 / (shortest * shortest) + 1.0 / (dy_ * dy_) + 1.0 / (dz_ * dz_)));
  nodes.release();
  hold();
  for (int k = 0; k <= nz_; ++k)
    for (int i = 0; i <= nx_; ++i) {
      const double z = k * dz_, across = s.nose == "ball" ? z : 0.0;
      if (std::hypot(x_[i], across) < 0.8 * s.radius)
        surface.add(at(i, 0, k), x_[i], z, s.contact_stiffness(nodes.mass[at(i, 0, k)], dt));
    }
}

// Planes of symmetry, and the clamp.
void Solid::hold() {
  for (int j = 0; j <= ny_; ++j) {
    for (int i = 0; i <= nx_; ++i) nodes.free[2][at(i, j, 0)] = 0.0;
    for (int k = 0; k <= nz_; ++k) {
      if (s_.is_symmetric()) nodes.free[0][at(0, j, k)] = 0.0;
      for (int d = 0; d < 3 && s_.clamped; ++d) nodes.free[d][at(0, j, k)] = 0.0;
    }
  }
}

void Solid::add_internal_forces() {
  for (int j = 0; j < ny_; ++j)
    for (int k = 0; k < nz_; ++k) {
      const Corners n{at(0, j, k), at(0, j + 1, k), at(0, j, k + 1), at(0, j + 1, k + 1)};
      for (int begin = 0; begin < nx_; begin += block)
        add_row(n, (j * nz_ + k) * nx_, begin, std::min(nx_, begin + block));
    }
}

// Forces of some neighbouring elements of a row.
void Solid::add_row(const Corners& n, int first, int begin, int end) {
  const double *__restrict ux = nodes.u[0].data(), *__restrict uy = nodes.u[1].data(), *__restrict uz = nodes.u[2].data(),
                           *__restrict dx = dx_.data();
  std::array<double*, 6> e, t;
  for (int m = 0; m < 6; ++m) {
    e[m] = &strain_[m][first];
    t[m] = &stress_[m][first];
  }
  double* __restrict work = &work_[first], * __restrict hourglass = &hourglass_[first];
  const Material material = material_;
  const double b = dy_, c = dz_, stiffness = 0.0625 * s_.hourglass * material_.mu;
#pragma GCC ivdep
  for (int i = begin; i < end; ++i) {
    const double a = dx[i], volume = a * b * c;
    const Pattern px = pattern(ux, n, i), py = pattern(uy, n, i), pz = pattern(uz, n, i);
    const double wx = 0.25 / a, wy = 0.25 / b, wz = 0.25 / c;
    const Tensor f{1.0 + wx * px.x, wy * px.y, wz * px.z, wx * py.x,      1.0 + wy * py.y,
                   wz * py.z,       wx * pz.x, wy * pz.y, 1.0 + wz * pz.z};
    const Tensor r = nearer_rotation(nearer_rotation(nearer_rotation(f)));
    const Symmetric u = stretch(r, f);
    const Symmetric old{t[0][i], t[1][i], t[2][i], t[3][i], t[4][i], t[5][i]};
    const Symmetric du{u.xx - e[0][i], u.yy - e[1][i], u.zz - e[2][i],
                       u.xy - e[3][i], u.yz - e[4][i], u.zx - e[5][i]};
    const Symmetric s = stress(material, old, du);
    work[i] += 0.5 * volume * (contraction(old, du) + contraction(s, du));
    e[0][i] = u.xx, e[1][i] = u.yy, e[2][i] = u.zz, e[3][i] = u.xy, e[4][i] = u.yz, e[5][i] = u.zx;
    t[0][i] = s.xx, t[1][i] = s.yy, t[2][i] = s.zz, t[3][i] = s.xy, t[4][i] = s.yz, t[5][i] = s.zx;

    const Tensor p = piola(r, s, u);
    const double g = stiffness * volume * (1.0 / (a * a) + 1.0 / (b * b) + 1.0 / (c * c));
    const double vx = volume * wx, vy = volume * wy, vz = volume * wz;
    hourglass[i] = put(force_[0], i - begin, vx * p.xx, vy * p.xy, vz * p.xz, g, px) +
                   put(force_[1], i - begin, vx * p.yx, vy * p.yy, vz * p.yz, g, py) +
                   put(force_[2], i - begin, vx * p.zx, vy * p.zy, vz * p.zz, g, pz);
  }
  const std::array<int, 8> corner{n.a, n.a + 1, n.b, n.b + 1, n.c, n.c + 1, n.d, n.d + 1};
  for (int d = 0; d < 3; ++d)
    for (int m = 0; m < 8; ++m) {
      double* __restrict to = &nodes.f[d][corner[m] + begin];
      const double* __restrict from = force_[d][m].data();
      for (int i = 0; i < end - begin; ++i) to[i] += from[i];
    }
}

// u_y'' = -12/(b h^3) times the integral of the plastic strain times y, for each slice of elements.
Vector Solid::curvatures() const {
  Vector sums(nx_, 0.0);
  for (int n = 0; n < n_elements(); ++n) {
    const double y = (n / (nx_ * nz_) + 0.5) * dy_ - 0.5 * s_.thickness;
    const double elastic =
        (stress_[0][n] - s_.poisson * (stress_[1][n] + stress_[2][n])) / s_.modulus;
    sums[n % nx_] -= 12.0 / (nz_ * std::pow(s_.thickness, 3)) * (strain_[0][n] - elastic) * y * dy_;
  }
  return sums;
}

}  // namespace
}  // namespace continuum

int main(int argc, char** argv) {
  const continuum::Scene scene =
      continuum::scene_of(argc, argv, "A beam of bricks, struck by a cylinder or a ball.");
  continuum::Solid body(scene);
  return continuum::Run(scene, body).go();
}
