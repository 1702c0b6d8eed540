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
