"""Extremes of stress measures over many instants, compiled: no array in between.

The instants of an element are lanes, contiguous: its linear stresses (k, lanes) come
from a product that was taken before (`of_rows`), or from the displacements on the spot
(`of_displacements`), where they never leave the processor's first cache. Lanes may be
instants of several load cases, all cases of an instant side by side; extremes are kept
for each case. The equivalent stress is kept as its square until the end. The arithmetic
has the precision of the given arrays.
"""

from functools import partial

import numpy as np

from systems.tools.compiled import compiled

_threaded = partial(compiled, nogil=True)
AT_ONCE = 4  # columns of a product: one load and store of the sums for four products


@_threaded
def of_rows(sheet, sigma, points, isotropic, first, square, when, high, low):
    """Extremes of stresses of one load case.

    Args:
        sheet: rows are xx yy xy at some points of a sheet, else the direct stresses at
            some points of a bar.
        sigma: (e k, t), k rows an element.
        points: of each element.
        isotropic: (e,) False: the largest principal magnitude stands for von Mises.
        first: number of the first instant.
        square, when, high, low: (e, 1) running extremes: square of the equivalent
            stress, number of its instant, largest and smallest principal stress.
    """
    k = 3 * points if sheet else points
    lanes = sigma.shape[1]
    line = np.empty(lanes, sigma.dtype)
    top = np.empty(lanes, sigma.dtype)
    bottom = np.empty(lanes, sigma.dtype)
    for e in range(len(isotropic)):
        own = sigma[k * e : k * e + k]
        if sheet:
            _sheet(own, points, isotropic[e], line, top, bottom)
        else:
            _bar(own, points, line, top, bottom)
        _keep(line, top, bottom, first, square[e], when[e], high[e], low[e])


@_threaded
def of_displacements(
    sheet,
    pointer,
    column,
    coefficient,
    offset,
    share,
    u,
    points,
    isotropic,
    first,
    square,
    when,
    high,
    low,
):
    """Extremes of stresses that follow from displacements; see `of_rows`.

    Args:
        sheet, points, isotropic, first: as there.
        pointer: (e + 1,) where an element's columns begin; their number is a multiple
            of `AT_ONCE`.
        column: (d,) freedoms.
        coefficient: (d, k) stresses per unit of each.
        offset: (e k,) stresses that are added to a lane with its `share` (lanes,).
        u: (n, lanes) displacements, lanes = instants times cases.
        square, when, high, low: (e, cases).
    """
    k, lanes = coefficient.shape[1], u.shape[1]
    sigma = np.empty((k, lanes), u.dtype)
    line = np.empty(lanes, u.dtype)
    top = np.empty(lanes, u.dtype)
    bottom = np.empty(lanes, u.dtype)
    for e in range(len(isotropic)):
        for r in range(k):
            value = offset[k * e + r]
            for i in range(lanes):
                sigma[r, i] = share[i] * value
        for j in range(pointer[e], pointer[e + 1], AT_ONCE):
            x0, x1 = u[column[j]], u[column[j + 1]]
            x2, x3 = u[column[j + 2]], u[column[j + 3]]
            for r in range(k):
                a0, a1 = coefficient[j, r], coefficient[j + 1, r]
                a2, a3 = coefficient[j + 2, r], coefficient[j + 3, r]
                own = sigma[r]
                for i in range(lanes):
                    own[i] += a0 * x0[i] + a1 * x1[i] + a2 * x2[i] + a3 * x3[i]
        if sheet:
            _sheet(sigma, points, isotropic[e], line, top, bottom)
        else:
            _bar(sigma, points, line, top, bottom)
        _keep(line, top, bottom, first, square[e], when[e], high[e], low[e])


@_threaded
def norms_of(sheet, modes, points, isotropic, out):
    """Equivalent stress of each mode, the largest of all points.

    Args:
        sheet, points, isotropic: as in `of_rows`.
        modes: (e k, r) stresses of modes.
        out: (e, r).
    """
    k, count = 3 * points if sheet else points, modes.shape[1]
    top = np.empty(count, modes.dtype)
    bottom = np.empty(count, modes.dtype)
    for e in range(len(isotropic)):
        own = modes[k * e : k * e + k]
        if sheet:
            _sheet(own, points, isotropic[e], out[e], top, bottom)
        else:
            _bar(own, points, out[e], top, bottom)
        for i in range(count):
            out[e, i] = np.sqrt(out[e, i])


@_threaded
def of_intervals(
    sheet, sigma, bend, modes, steady, fine, points, isotropic, square, when, high, low
):
    """Extremes of one load case; instants that cannot be extreme are left out.

    Between two coarse instants an element is looked at where its measures, bounded by
    those of both ends and by `bend`, could exceed what has been found.

    Args:
        sheet, points, isotropic: as in `of_rows`.
        sigma: (e k, c) stresses at the coarse instants.
        bend: (e, c - 1) bound on the equivalent stress of what bends away from the
            chord of each interval.
        modes: (e k, r) stresses of modes.
        steady: (e k,) what is added to them.
        fine: (c - 1, r, s) amplitudes within each interval; its last is the coarse one.
        square, when, high, low: (e, 1) running extremes, as in `of_rows`.

    Returns:
        Intervals that were looked at.
    """
    k, coarse = 3 * points if sheet else points, sigma.shape[1]
    count, inside = fine.shape[1], fine.shape[2]
    even = count - count % AT_ONCE
    line = np.empty(coarse, sigma.dtype)
    top = np.empty(coarse, sigma.dtype)
    bottom = np.empty(coarse, sigma.dtype)
    part = np.empty((k, inside), sigma.dtype)
    line_in = np.empty(inside, sigma.dtype)
    top_in = np.empty(inside, sigma.dtype)
    bottom_in = np.empty(inside, sigma.dtype)
    done = 0
    for e in range(len(isotropic)):
        own = sigma[k * e : k * e + k]
        # The larger principal magnitude of a plane stress is at most 2 / sqrt(3) of
        # von Mises'; elsewhere it is the equivalent stress itself.
        share = 1.1547006 if sheet and isotropic[e] else 1.0
        if sheet:
            _sheet(own, points, isotropic[e], line, top, bottom)
        else:
            _bar(own, points, line, top, bottom)
        best, at = square[e, 0], when[e, 0]
        upper, lower = high[e, 0], low[e, 0]
        for i in range(coarse):
            if line[i] > best:
                best, at = line[i], inside * i
            upper = max(upper, top[i])
            lower = min(lower, bottom[i])
        root = np.sqrt(best)
        for i in range(coarse - 1):
            over = bend[e, i]
            gap = max(root - over, 0.0)
            if (
                max(line[i], line[i + 1]) <= gap * gap
                and max(top[i], top[i + 1]) + share * over <= upper
                and min(bottom[i], bottom[i + 1]) - share * over >= lower
            ):
                continue
            done += 1
            for r in range(k):
                row = part[r]
                for t in range(inside):
                    row[t] = steady[k * e + r]
                of = modes[k * e + r]
                for m in range(0, even, AT_ONCE):
                    a0, a1, a2, a3 = of[m], of[m + 1], of[m + 2], of[m + 3]
                    q0, q1 = fine[i, m], fine[i, m + 1]
                    q2, q3 = fine[i, m + 2], fine[i, m + 3]
                    for t in range(inside):
                        row[t] += a0 * q0[t] + a1 * q1[t] + a2 * q2[t] + a3 * q3[t]
                for m in range(even, count):
                    a0, q0 = of[m], fine[i, m]
                    for t in range(inside):
                        row[t] += a0 * q0[t]
            if sheet:
                _sheet(part, points, isotropic[e], line_in, top_in, bottom_in)
            else:
                _bar(part, points, line_in, top_in, bottom_in)
            for t in range(inside - 1):  # its last is a coarse one
                if line_in[t] > best:
                    best, at = line_in[t], inside * i + t + 1
                    root = np.sqrt(best)
                upper = max(upper, top_in[t])
                lower = min(lower, bottom_in[t])
        square[e, 0], when[e, 0] = best, at
        high[e, 0], low[e, 0] = upper, lower
    return done


@_threaded
def lanes_of(window, total, out):
    """Instants and cases as lanes, by tiles that stay in the cache.

    Args:
        window: (m, c, n) displacements.
        total: cases side by side; those beyond c repeat the first.
        out: (n or more, m total).
    """
    m, cases, n = window.shape
    for start in range(0, n, 64):
        stop = min(start + 64, n)
        for s in range(m):
            for c in range(total):
                given = window[s, c if c < cases else 0]
                lane = s * total + c
                for j in range(start, stop):
                    out[j, lane] = given[j]


@_threaded
def _sheet(sigma, points, isotropic, line, top, bottom):
    """Squared equivalent stress, largest and smallest principal stress, every lane."""
    lanes = len(line)
    for p in range(points):
        x, y, z = sigma[3 * p], sigma[3 * p + 1], sigma[3 * p + 2]
        for i in range(lanes):
            middle = (x[i] + y[i]) / 2
            half = (x[i] - y[i]) / 2
            shear = z[i] * z[i]
            radius = np.sqrt(half * half + shear)
            # xx² - xx yy + yy² + 3 xy² in terms of middle and half.
            mises = middle * middle + 3 * (half * half + shear)
            if p == 0:
                line[i] = mises
                top[i] = middle + radius
                bottom[i] = middle - radius
            else:
                line[i] = max(line[i], mises)
                top[i] = max(top[i], middle + radius)
                bottom[i] = min(bottom[i], middle - radius)
    if not isotropic:
        for i in range(lanes):
            line[i] = max(top[i] * top[i], bottom[i] * bottom[i])


@_threaded
def _bar(sigma, points, line, top, bottom):
    """As `_sheet`, of direct stresses."""
    lanes = len(line)
    for i in range(lanes):
        top[i] = sigma[0, i]
        bottom[i] = sigma[0, i]
    for p in range(1, points):
        x = sigma[p]
        for i in range(lanes):
            top[i] = max(top[i], x[i])
            bottom[i] = min(bottom[i], x[i])
    for i in range(lanes):
        line[i] = max(top[i] * top[i], bottom[i] * bottom[i])


@_threaded
def _keep(line, top, bottom, first, square, when, high, low):
    """The lanes of an element into its running extremes (cases,)."""
    lanes, cases = len(line), len(square)
    if cases > 1:
        for s in range(lanes // cases):
            for c in range(cases):
                i = s * cases + c
                better = line[i] > square[c]
                square[c] = line[i] if better else square[c]
                when[c] = first + s if better else when[c]
                high[c] = max(high[c], top[i])
                low[c] = min(low[c], bottom[i])
        return
    best, upper, lower = line[0], top[0], bottom[0]
    for i in range(1, lanes):
        best = max(best, line[i])
        upper = max(upper, top[i])
        lower = min(lower, bottom[i])
    if best > square[0]:
        square[0] = best
        for i in range(lanes):
            if line[i] == best:
                when[0] = first + i
                break
    high[0] = max(high[0], upper)
    low[0] = min(low[0], lower)
