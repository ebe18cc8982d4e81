// Explicit dynamics of a beam in plane stress or plane strain, struck by a rigid cylinder.
//
// Rectangles with four nodes, in finite rotations: F = R U at the centre, the strain is U - I, the
// stress T is its conjugate (Biot's), J2 with perfect plasticity. Normal strains are taken at 2 x 2
// points and shear at the centre, since bending locks otherwise. Forces follow from the power of T,
// the part of the rotation included.
#include <array>
#include <cmath>
#include <vector>

#include "run.h"

namespace continuum {
namespace {

const double gauss = 1.0 / std::sqrt(3.0);
constexpr std::array<double, 4> point_x{-1, 1, 1, -1}, point_y{-1, -1, 1, 1};

// Returns plane stress to the yield surface (Simo and Taylor 1986): Newton's method in the
// multiplier from 0, where the function is convex and falls.
void return_to_yield(const Scene& s, double& sx, double& sy, double& shear) {
  const double sum = sx + sy, difference = sx - sy;
  const double a = sum * sum / 12.0, b = 0.25 * difference * difference + shear * shear;
  const double slope_a = s.modulus / (3.0 * (1.0 - s.poisson)), slope_b = 2.0 * s.shear_modulus();
  double multiplier = 0.0, p = 1.0, q = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double f = a * p * p + b * q * q - s.yield * s.yield / 3.0;
    const double change = 0.5 * f / (slope_a * a * p * p * p + slope_b * b * q * q * q);
    multiplier += change;
    p = 1.0 / (1.0 + slope_a * multiplier);
    q = 1.0 / (1.0 + slope_b * multiplier);
    if (change <= 1e-13 * multiplier) break;
  }
  sx = 0.5 * (sum * p + difference * q);
  sy = 0.5 * (sum * p - difference * q);
  shear *= q;
}

class Plane {
 public:
  explicit Plane(const Scene& s);

  void add_internal_forces() {
    for (int j = 0; j < ny_; ++j) {
      strain_row(j);
      for (int p = 0; p < 4; ++p) stress_row(j, p);
      force_row(j);
    }
  }

  double internal_energy() const {
    double sum = 0.0;
    for (double w : work_) sum += w;
    return sum;
  }

  double middle() const {
    return 0.5 * (nodes.u[1][at(struck_, ny_ / 2)] + nodes.u[1][at(struck_, (ny_ + 1) / 2)]);
  }

  double dent() const { return nodes.u[1][at(struck_, 0)] - nodes.u[1][at(struck_, ny_)]; }

  double shape(std::size_t n) const { return free_mode(s_.mode, s_.length, x_[n % (nx_ + 1)]); }

  Vector curvatures() const;
  const Vector& lengths() const { return dx_; }

  double parts() const { return s_.is_symmetric() ? 2.0 : 1.0; }
  int n_elements() const { return nx_ * ny_; }

  Nodes nodes;
  Surface surface;
  double dt = 0.0;

 private:
  int at(int i, int j) const { return j * (nx_ + 1) + i; }
  bool is_strain() const { return s_.state == "strain"; }

  void strain_row(int j);
  void stress_row(int j, int p);
  void force_row(int j);

  const Scene& s_;
  Vector x_;  // of the nodes
  int nx_, ny_, struck_ = 0;
  Vector dx_;
  double dy_;
  // By element: strains ex, ey, shear of the centre; ex over eta, ey over xi. By point of an
  // element: stresses.
  std::array<Vector, 5> strain_;
  struct Stress {
    Vector x, y, z, shear;
  };
  std::array<Stress, 4> stress_;
  Vector work_;
  // Of the row at work: cosine and sine of the rotation, hourglass (local), strain increments,
  // trial yield function.
  Vector cos_, sin_, hour_x_, hour_y_, trial_;
  std::array<Vector, 5> change_;
  std::array<Vector, 8> force_;
};

Plane::Plane(const Scene& s)
    : nodes(stations(s).size() * (s.layers + 1)),
      s_(s),
      x_(stations(s)),
      nx_(static_cast<int>(x_.size()) - 1),
      ny_(s.layers),
      dy_(s.thickness / ny_) {
  while (x_[struck_] < 0.0) ++struck_;
  const std::size_t n = nx_ * ny_;
  for (Vector& v : strain_) v.assign(n, 0.0);
  for (Stress& t : stress_)
    for (Vector* v : {&t.x, &t.y, &t.z, &t.shear}) v->assign(n, 0.0);
  work_.assign(n, 0.0);
  for (Vector* v : {&cos_, &sin_, &hour_x_, &hour_y_, &trial_}) v->assign(nx_, 0.0);
  for (Vector& v : change_) v.assign(nx_, 0.0);
  for (Vector& v : force_) v.assign(nx_, 0.0);

  double shortest = 1e300;
  for (int i = 0; i < nx_; ++i) {
    dx_.push_back(x_[i + 1] - x_[i]);
    shortest = std::min(shortest, dx_[i]);
    for (int j = 0; j < ny_; ++j)
      for (int k : {at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)})
        nodes.mass[k] += 0.25 * s.density * s.width * dx_[i] * dy_;
  }
  const double stiffness =
      is_strain() ? s.lame() + 2.0 * s.shear_modulus() : s.modulus / (1.0 - s.poisson * s.poisson);
  dt = s.courant /
       std::sqrt(stiffness / s.density * (1.0 / (shortest * shortest) + 1.0 / (dy_ * dy_)));
  nodes.release();
  std::fill(nodes.free[2].begin(), nodes.free[2].end(), 0.0);
  for (int j = 0; j <= ny_; ++j) {
    if (s.is_symmetric() && s.mode % 2 == 1) nodes.free[0][at(0, j)] = 0.0;
    if (s.is_symmetric() && s.mode == 0) nodes.free[0][at(0, j)] = 0.0;
    if (s.clamped) nodes.free[0][at(0, j)] = nodes.free[1][at(0, j)] = 0.0;
  }
  for (int i = 0; i <= nx_; ++i)
    if (std::abs(x_[i]) < 0.8 * s.radius)
      surface.add(at(i, 0), x_[i], 0.0, s.contact_stiffness(nodes.mass[i], dt));
}

// Rotation and strains of a row of elements, and how the strains have changed.
void Plane::strain_row(int j) {
  const double* __restrict ux0 = &nodes.u[0][at(0, j)], * __restrict ux1 =
                                                            &nodes.u[0][at(0, j + 1)];
  const double* __restrict uy0 = &nodes.u[1][at(0, j)], * __restrict uy1 =
                                                            &nodes.u[1][at(0, j + 1)];
  double *__restrict c = cos_.data(), *__restrict s = sin_.data(), *__restrict hx = hour_x_.data(),
                     *__restrict hy = hour_y_.data();
  std::array<double*, 5> e, de;
  for (int k = 0; k < 5; ++k) {
    e[k] = &strain_[k][j * nx_];
    de[k] = change_[k].data();
  }
  const double* dx = dx_.data();
  const double b = dy_;
#pragma GCC ivdep
  for (int i = 0; i < nx_; ++i) {
    const double a = dx[i];
    const double xx = 1.0 + 0.5 * (ux0[i + 1] + ux1[i + 1] - ux0[i] - ux1[i]) / a;
    const double xy = 0.5 * (ux1[i] + ux1[i + 1] - ux0[i] - ux0[i + 1]) / b;
    const double yx = 0.5 * (uy0[i + 1] + uy1[i + 1] - uy0[i] - uy1[i]) / a;
    const double yy = 1.0 + 0.5 * (uy1[i] + uy1[i + 1] - uy0[i] - uy0[i + 1]) / b;
    const double gx = 0.25 * (ux0[i] - ux0[i + 1] + ux1[i + 1] - ux1[i]);
    const double gy = 0.25 * (uy0[i] - uy0[i + 1] + uy1[i + 1] - uy1[i]);
    const double length = 1.0 / std::sqrt((xx + yy) * (xx + yy) + (yx - xy) * (yx - xy));
    c[i] = (xx + yy) * length;
    s[i] = (yx - xy) * length;
    hx[i] = c[i] * gx + s[i] * gy;
    hy[i] = c[i] * gy - s[i] * gx;
    const double now[5] = {c[i] * xx + s[i] * yx - 1.0, c[i] * yy - s[i] * xy - 1.0,
                           c[i] * xy + s[i] * yy + c[i] * yx - s[i] * xx, 2.0 * gauss / a * hx[i],
                           2.0 * gauss / b * hy[i]};
    for (int k = 0; k < 5; ++k) {
      de[k][i] = now[k] - e[k][i];
      e[k][i] = now[k];
    }
  }
}

// Stresses of a row at one point of its elements, and the work done there. Trapezium rule: the old
// stress here, the new one in force_row().
void Plane::stress_row(int j, int p) {
  double *__restrict tx = &stress_[p].x[j * nx_], *__restrict ty = &stress_[p].y[j * nx_],
                     *__restrict tz = &stress_[p].z[j * nx_], *__restrict ts = &stress_[p].shear[j * nx_];
  const double *__restrict ex = change_[0].data(), *__restrict ey = change_[1].data(), *__restrict es = change_[2].data(),
                           *__restrict ex_y = change_[3].data(), *__restrict ey_x = change_[4].data();
  double* __restrict work = &work_[j * nx_], * __restrict trial = trial_.data();
  const double* dx = dx_.data();
  const bool strain = is_strain();
  const double g = s_.shear_modulus(), y2 = s_.yield_squared();
  const double lambda =
      strain ? s_.lame() : s_.modulus * s_.poisson / (1.0 - s_.poisson * s_.poisson);
  const double lambda_z = strain ? lambda : 0.0, weight = 0.125 * dy_ * s_.width;
#pragma GCC ivdep
  for (int i = 0; i < nx_; ++i) {
    const double dex = ex[i] + point_y[p] * ex_y[i], dey = ey[i] + point_x[p] * ey_x[i];
    work[i] += weight * dx[i] * (tx[i] * dex + ty[i] * dey + ts[i] * es[i]);
    tx[i] += lambda * (dex + dey) + 2.0 * g * dex;
    ty[i] += lambda * (dex + dey) + 2.0 * g * dey;
    tz[i] += lambda_z * (dex + dey);
    ts[i] += g * es[i];
    const double xy = tx[i] - ty[i], yz = ty[i] - tz[i], zx = tz[i] - tx[i];
    trial[i] = 0.5 * (xy * xy + yz * yz + zx * zx) + 3.0 * ts[i] * ts[i];
  }
  for (int i = 0; i < nx_; ++i) {
    if (trial[i] <= y2) continue;
    if (strain) {  // radial return
      const double scale = s_.yield / std::sqrt(trial[i]),
                   mean = (1.0 - scale) * (tx[i] + ty[i] + tz[i]) / 3.0;
      tx[i] = mean + scale * tx[i];
      ty[i] = mean + scale * ty[i];
      tz[i] = mean + scale * tz[i];
      ts[i] *= scale;
    } else {
      return_to_yield(s_, tx[i], ty[i], ts[i]);
    }
  }
#pragma GCC ivdep
  for (int i = 0; i < nx_; ++i) {
    const double dex = ex[i] + point_y[p] * ex_y[i], dey = ey[i] + point_x[p] * ey_x[i];
    work[i] += weight * dx[i] * (tx[i] * dex + ty[i] * dey + ts[i] * es[i]);
  }
}

// Adds the forces of a row. T : dU = P : dF with P = R (T + S), where S is skew and balances the
// moment of T on U (and that of the hourglass forces), so that forces do exactly the work that is
// counted.
void Plane::force_row(int j) {
  const double *__restrict c = cos_.data(), *__restrict s = sin_.data(), *__restrict hx = hour_x_.data(),
                           *__restrict hy = hour_y_.data(), *dx = dx_.data();
  std::array<const double*, 3> e;
  for (int k = 0; k < 3; ++k) e[k] = &strain_[k][j * nx_];
  std::array<const double*, 4> tx, ty, ts;
  for (int p = 0; p < 4; ++p) {
    tx[p] = &stress_[p].x[j * nx_];
    ty[p] = &stress_[p].y[j * nx_];
    ts[p] = &stress_[p].shear[j * nx_];
  }
  std::array<double*, 8> out;
  for (int k = 0; k < 8; ++k) out[k] = force_[k].data();
  const double b = dy_, w = 0.25 * s_.width;
#pragma GCC ivdep
  for (int i = 0; i < nx_; ++i) {
    const double a = dx[i];
    const double x = w * (tx[0][i] + tx[1][i] + tx[2][i] + tx[3][i]),
                 y = w * (ty[0][i] + ty[1][i] + ty[2][i] + ty[3][i]);
    const double shear = w * (ts[0][i] + ts[1][i] + ts[2][i] + ts[3][i]);
    const double qx = 2.0 * gauss * b * w * (tx[2][i] + tx[3][i] - tx[0][i] - tx[1][i]);
    const double qy = 2.0 * gauss * a * w * (ty[1][i] + ty[2][i] - ty[0][i] - ty[3][i]);
    const double moment =
        (y - x) * 0.5 * e[2][i] + shear * (e[0][i] - e[1][i]) + (qy * hx[i] - qx * hy[i]) / (a * b);
    const double skew = moment / (2.0 + e[0][i] + e[1][i]), xy = shear + skew, yx = shear - skew;
    const double xx_ = 0.5 * b * (c[i] * x - s[i] * yx), xy_ = 0.5 * a * (c[i] * xy - s[i] * y);
    const double yx_ = 0.5 * b * (s[i] * x + c[i] * yx), yy_ = 0.5 * a * (s[i] * xy + c[i] * y);
    const double hour_x = 0.25 * (c[i] * qx - s[i] * qy), hour_y = 0.25 * (s[i] * qx + c[i] * qy);
    out[0][i] = xx_ + xy_ - hour_x;
    out[1][i] = xy_ - xx_ + hour_x;
    out[2][i] = -xx_ - xy_ - hour_x;
    out[3][i] = xx_ - xy_ + hour_x;
    out[4][i] = yx_ + yy_ - hour_y;
    out[5][i] = yy_ - yx_ + hour_y;
    out[6][i] = -yx_ - yy_ - hour_y;
    out[7][i] = yx_ - yy_ + hour_y;
  }
  const std::array<int, 4> corner{at(0, j), at(1, j), at(1, j + 1), at(0, j + 1)};
  for (int k = 0; k < 8; ++k) {
    double* __restrict f = &nodes.f[k / 4][corner[k % 4]];
    const double* __restrict from = out[k];
    for (int i = 0; i < nx_; ++i) f[i] += from[i];
  }
}

// u_y'' = -12/h^3 times the integral of the plastic strain times y, for each column of elements.
Vector Plane::curvatures() const {
  Vector sums(nx_, 0.0);
  for (int n = 0; n < n_elements(); ++n) {
    const double y = (n / nx_ + 0.5) * dy_ - 0.5 * s_.thickness;
    double elastic = 0.0;
    for (const Stress& t : stress_)
      elastic += 0.25 * (t.x[n] - s_.poisson * (t.y[n] + t.z[n])) / s_.modulus;
    sums[n % nx_] -= 12.0 / std::pow(s_.thickness, 3) * (strain_[0][n] - elastic) * y * dy_;
  }
  return sums;
}

}  // namespace
}  // namespace continuum

int main(int argc, char** argv) {
  const continuum::Scene scene =
      continuum::scene_of(argc, argv, "A beam in plane stress or strain, struck by a cylinder.");
  continuum::Plane body(scene);
  return continuum::Run(scene, body).go();
}
