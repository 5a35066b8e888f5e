#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Computes the values of golden_values.hpp, with methods that differ from the library's.

    python3 tests/golden/make_golden.py > tests/golden/golden_values.hpp

Needs numpy. The tests need neither numpy nor this script. Poses are matrices; their exponential is the power series with
scaling and squaring in long double. Derivatives are complex steps, exact to rounding. Chi-square quantiles come from
closed forms in decimals of 60 digits.
"""
from decimal import Decimal, getcontext

import numpy as np

STEP = 1e-30


def hat(a):
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def expm(A):
    squarings = max(0, int(np.ceil(np.log2(max(1e-300, float(np.abs(A).max()))))) + 6)
    A = A / 2.0**squarings
    total = term = np.eye(len(A), dtype=A.dtype)
    for k in range(1, 25):
        term = term @ A / k
        total = total + term
    for _ in range(squarings):
        total = total @ total
    return total


def algebra(turn, points):
    """The element of the Lie algebra of SE_K(3): a rotation and K points."""
    A = np.zeros((3 + len(points), 3 + len(points)), dtype=np.result_type(turn, *points, float))
    A[:3, :3] = hat(turn)
    for i, x in enumerate(points):
        A[:3, 3 + i] = x
    return A


# --- SE(3) ---


def poses():
    rows = []
    for tau in (
        [0, 0, 0, 0, 0, 0],
        [1, -2, 3, 0, 0, 0],
        [1, -2, 3, 1e-9, 2e-9, -1e-9],
        [0.4, 0.1, -0.2, 0.05, -0.02, 0.1],
        [10, 20, -5, 0.6, -0.8, 0.9],
        [-3, 0.5, 2, 2.0, 1.0, -2.1],
        [5, 1, 2, 0, 0, 3.1],
    ):
        long = np.array(tau, dtype=np.longdouble)
        T = expm(algebra(long[3:], [long[:3]])).astype(float)
        rows.append(list(map(float, tau)) + list(T[:3, :3].ravel()) + list(T[:3, 3]))
    return rows


# --- chi-square ---

getcontext().prec = 60
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459")


def erf(x):
    term, total, n = x, x, 0
    while abs(term) > Decimal(10) ** -58:
        n += 1
        term *= -x * x / n
        total += term / (2 * n + 1)
    return 2 * total / PI.sqrt()


def tail(dof, x):
    """P(X > x) by the finite sums of Abramowitz and Stegun 26.4.4 and 26.4.5."""
    y = x / 2
    if dof % 2 == 0:
        total, term, a = Decimal(0), (-y).exp(), Decimal(1)
    else:
        total, term, a = 1 - erf(y.sqrt()), 2 * (y / PI).sqrt() * (-y).exp(), Decimal("1.5")
    while 2 * a <= dof:
        total += term
        term *= y / a
        a += 1
    return total


def quantile(dof, p):
    low, high = Decimal(0), Decimal(4 * dof + 100)
    for _ in range(150):
        middle = (low + high) / 2
        if 1 - tail(dof, middle) < p:
            low = middle
        else:
            high = middle
    return float(low)


def quantiles():
    return [
        [dof, float(p), quantile(dof, Decimal(p))]
        for dof in (1, 2, 3, 6, 7, 30, 63, 120)
        for p in ("0.025", "0.5", "0.95", "0.975", "0.99", "0.9999")
    ]


# --- three steps of the filter ---

PLATFORM = np.array([0.3, -0.1, 1.2])
STICK = np.array([0.15, 0.05, 0.2])
PAN, TILT = 0.3, -0.2
SIGMA = np.array([0.5, 0.03, 0.02])  # range, azimuth, elevation
ENCODER = np.array([0.02, 0.015])  # pan, stick: one error for each frame
TWIST_SIGMA = np.array([0.05, 0.04, 0.03, 0.01, 0.012, 0.014])
ITERATIONS = 3


def atan2(y, x):
    real = np.arctan2(y.real, x.real)
    return real + 1j * (x.real * y.imag - y.real * x.imag) / (x.real**2 + y.real**2)


def rotation_z(a):
    return np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])


def rotation_y(a):
    return np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])


def see(R, p, landmark, mount):
    """Range, azimuth and elevation of m_c, where m_b = d + Rz Ry (s + m_c) (Mars paper, eq. 4)."""
    turned = rotation_z(PAN + mount[0]) @ rotation_y(TILT + mount[1])
    c = turned.T @ (R.T @ (landmark - p) - PLATFORM) - STICK
    flat = np.sqrt(c[0] ** 2 + c[1] ** 2)
    return np.array([np.sqrt(flat**2 + c[2] ** 2), atan2(c[1], c[0]), atan2(c[2], flat)])


def place(R, p, z, mount):
    turned = rotation_z(PAN + mount[0]) @ rotation_y(TILT + mount[1])
    c = z[0] * np.array([np.cos(z[2]) * np.cos(z[1]), np.cos(z[2]) * np.sin(z[1]), np.sin(z[2])])
    return p + R @ (PLATFORM + turned @ (STICK + c))


def derivative(f, inputs):
    return np.array([f(1j * STEP * e).imag / STEP for e in np.eye(inputs)]).T


class Filter:
    """Rotation, points (position, then landmarks) and mount angles, with the covariance of [p; R; landmarks; mount]."""

    def __init__(self, invariant, R, p, ordinary):
        self.invariant, self.R, self.points, self.mount = invariant, R, [p], np.zeros(0)
        self.P = np.linalg.inv(self.ordinary_by_own()) @ ordinary @ np.linalg.inv(self.ordinary_by_own()).T

    def size(self):
        return 3 + 3 * len(self.points) + len(self.mount)

    def parts(self, error):
        points = [error[0:3]] + [error[3 + 3 * i : 6 + 3 * i] for i in range(1, len(self.points))]
        return error[3:6], points, error[3 + 3 * len(self.points) :]

    def moved(self, error):
        turn, shifts, angles = self.parts(error)
        if self.invariant:
            E = expm(algebra(turn, shifts))
            return E[:3, :3] @ self.R, [E[:3, :3] @ x + E[:3, 3 + i] for i, x in enumerate(self.points)], self.mount + angles
        R = expm(hat(turn) + 0j) @ self.R
        return R, [x + e for x, e in zip(self.points, shifts)], self.mount + angles

    def small(self, R, points, mount, R0, points0, mount0):
        """First-order error of a state against another state that is a complex step away."""
        W = R @ R0.T
        turn = np.array([W[2, 1] - W[1, 2], W[0, 2] - W[2, 0], W[1, 0] - W[0, 1]]) / 2
        shifts = [x - (W @ x0 if self.invariant else x0) for x, x0 in zip(points, points0)]
        return np.concatenate([shifts[0], turn] + shifts[1:] + [mount - mount0])

    def ordinary_by_own(self):
        def f(error):
            R, points, mount = self.moved(error)
            W = R @ self.R.T
            turn = np.array([W[2, 1] - W[1, 2], W[0, 2] - W[2, 0], W[1, 0] - W[0, 1]]) / 2
            shifts = [x - x0 for x, x0 in zip(points, self.points)]
            return np.concatenate([shifts[0], turn] + shifts[1:] + [mount - self.mount])

        return derivative(f, self.size())

    def ordinary(self):
        A = self.ordinary_by_own()
        return A @ self.P @ A.T

    def predict(self, twist, dt):
        def after(R, p, noise):
            T = expm(algebra((twist + noise)[3:] * dt, [(twist + noise)[:3] * dt]))
            return R @ T[:3, :3], p + R @ T[:3, 3]

        R1, p1 = after(self.R, self.points[0], np.zeros(6))
        reached = (R1, [p1] + self.points[1:], self.mount)

        def step(error, noise):
            R, points, mount = self.moved(error)
            R, p = after(R, points[0], noise)
            return self.small(R, [p] + points[1:], mount, *reached)

        F = derivative(lambda e: step(e, np.zeros(6)), self.size())
        G = derivative(lambda n: step(np.zeros(self.size()), n), 6)
        self.P = F @ self.P @ F.T + G @ np.diag(TWIST_SIGMA**2) @ G.T
        self.R, self.points = R1, reached[1]

    def update(self, seen):
        """`seen`: (number of the landmark, z). The common error of the mount angles is a state during the frame."""
        n = self.size()
        P = np.zeros((n + 2, n + 2))
        P[:n, :n], P[n:, n:] = self.P, np.diag(ENCODER**2)
        self.P, self.mount = P, np.zeros(2)
        known = [(i, z) for i, z in seen if i + 1 < len(self.points)]
        nis = self.iterate(known) if known else 0.0
        for i, z in seen:
            if i + 1 >= len(self.points):
                self.augment(z)
        n = self.size() - 2
        self.P, self.mount = self.P[:n, :n], np.zeros(0)
        return nis

    def iterate(self, known):
        z = np.concatenate([z for _, z in known])
        noise = np.diag(np.tile(SIGMA**2, len(known)))
        xi, first = np.zeros(self.size()), (self.R, self.points, self.mount)
        for i in range(ITERATIONS):
            self.R, self.points, self.mount = [np.real(x) for x in self.moved(xi + 0j)]
            self.points = list(self.points)

            def h(error):
                R, points, mount = self.moved(error)
                return np.concatenate([see(R, points[0], points[k + 1], mount) for k, _ in known])

            H = derivative(h, self.size())
            r = z - h(np.zeros(self.size()) + 0j).real
            S = H @ self.P @ H.T + noise
            if i == 0:
                nis = r @ np.linalg.solve(S, r)
            K = self.P @ H.T @ np.linalg.inv(S)
            xi = K @ (r + H @ xi)
            self.R, self.points, self.mount = first
        L = np.eye(self.size()) - K @ H
        self.P = L @ self.P @ L.T + K @ noise @ K.T
        self.R, self.points, self.mount = [np.real(x) for x in self.moved(xi + 0j)]
        self.points = list(self.points)
        return nis

    def augment(self, z):
        landmark = place(self.R, self.points[0], z, self.mount)
        target = (self.R, self.points + [landmark], self.mount)

        def error_of(error, noise):
            R, points, mount = self.moved(error)
            return self.small(R, points + [place(R, points[0], z + noise, mount)], mount, *target)

        F = derivative(lambda e: error_of(e, np.zeros(3)), self.size())
        G = derivative(lambda e: error_of(np.zeros(self.size()) + 0j, e), 3)
        self.P = F @ self.P @ F.T + G @ np.diag(SIGMA**2) @ G.T
        self.points = target[1]


def tiny_run():
    start = expm(algebra(np.array([0.2, -0.1, 0.7]), [np.array([3.0, -2.0, 1.0])]))
    A = np.array([[1 if i == j else 0.1 * ((3 * i + j) % 5 - 2) for j in range(6)] for i in range(6)])
    P0 = np.diag([0.3, 0.2, 0.4, 0.05, 0.04, 0.06]) @ A
    P0 = P0 @ P0.T
    twists = [[1.0, 0.1, -0.05, 0.02, -0.03, 0.2], [1.2, 0.0, 0.1, -0.05, 0.04, 0.25], [0.9, -0.1, 0.0, 0.03, 0.02, 0.3]]
    dts = [0.5, 0.4, 0.6]
    body = np.array([[8.0, 2.0, 1.0], [12.0, -3.0, 0.5], [6.0, 1.5, 2.5]])
    landmarks = [start[:3, :3] @ b + start[:3, 3] for b in body]
    offsets = [[0.31, -0.02, 0.015], [-0.42, 0.035, -0.01], [0.15, 0.01, 0.025]]

    # The true motion differs slightly from the motion that the filter gets.
    R, p, frames = start[:3, :3], start[:3, 3], []
    for k in range(3):
        T = expm(algebra(np.array(twists[k])[3:] * dts[k] * 1.05, [np.array(twists[k])[:3] * dts[k] * 0.97]))
        R, p = R @ T[:3, :3], p + R @ T[:3, 3]
        count = 2 if k == 0 else 3
        frames.append(
            [see(R, p, landmarks[i] + 0j, np.array([0.01, -0.02])).real + np.roll(offsets, k, 0)[i] for i in range(count)]
        )
    values = {"start": np.concatenate([start[:3, 3], start[:3, :3].ravel()]), "covariance": P0.ravel()}
    values["twists"] = np.array([t + [dt] for t, dt in zip(twists, dts)]).ravel()
    values["frames"] = np.array([np.concatenate(f + [np.zeros(3)] * (3 - len(f))) for f in frames]).ravel()
    for invariant in (True, False):
        f = Filter(invariant, start[:3, :3], start[:3, 3], P0)
        results, nis = [], []
        for twist, dt, frame in zip(twists, dts, frames):
            f.predict(np.array(twist), dt)
            nis.append(f.update(list(enumerate(frame))))
            results.append(np.concatenate([f.R.ravel()] + f.points + [np.zeros(3)] * (4 - len(f.points))))
        name = "invariant" if invariant else "standard"
        values[name + "_states"] = np.array(results).ravel()
        values[name + "_covariance"] = f.ordinary().ravel()
        values[name + "_nis"] = np.array(nis)
    return values


def array(name, values, comment):
    lines, line = [], "   "
    for v in values:
        text = " " + repr(float(v)) + ","
        if len(line) + len(text) > 118:
            lines.append(line)
            line = "   "
        line += text
    print(f"\n// {comment}\ninline constexpr double k{name}[] = {{\n" + "\n".join(lines + [line]) + "\n};")


def main():
    print("// SPDX-License-Identifier: BSD-3-Clause")
    print(f"// Written by make_golden.py with numpy {np.__version__}: change the script, not this file.\n#pragma once\n")
    print("namespace golden {")
    array("Poses", np.array(poses()).ravel(), "Tangent [rho; theta], then rotation by rows and translation of its Exp: 18 numbers for each pose.")
    array("Quantiles", np.array(quantiles()).ravel(), "Degrees of freedom, probability, chi-square quantile: 3 numbers in each row.")
    run = tiny_run()
    comments = {
        "start": "The initial pose: position, then rotation by rows.",
        "covariance": "Ordinary covariance of the initial pose, 6 x 6.",
        "twists": "Velocity, rate and time of each of three steps.",
        "frames": "Observations of each step: three landmarks, range, azimuth and elevation; the first step has only two.",
    }
    for name, values in run.items():
        kind, _, what = name.partition("_")
        comment = comments.get(name) or {
            "states": "After each step, by the %s filter: rotation by rows, position, three landmarks." % kind,
            "covariance": "Ordinary joint covariance at the end, 15 x 15.",
            "nis": "Normalised innovation squared of each frame.",
        }[what]
        array("".join(part.capitalize() for part in name.split("_")), values, comment)
    print("\n}  // namespace golden")


if __name__ == "__main__":
    main()
