"""Extremes of stress measures over many instants, compiled: no array in between.

A tile holds the linear stresses of some elements at some instants, (e k, t): k rows an
element, the instants contiguous. The equivalent stress is kept as its square until the
end. The arithmetic has the precision of the tile.
"""

from functools import partial

import numpy as np

from systems.tools.compiled import compiled

_threaded = partial(compiled, nogil=True)


@_threaded
def sheet_extremes(sigma, points, isotropic, first, square, when, high, low):
    """Von Mises and principal stresses of xx yy xy at the points of sheets.

    Args:
        sigma: (3 points e, t).
        points: of each element.
        isotropic: (e,) False: the largest principal magnitude stands for von Mises.
        first: number of the first instant.
        square, when, high, low: (e,) running extremes: square of the equivalent stress,
            number of its instant, largest and smallest principal stress.
    """
    t = sigma.shape[1]
    line = np.empty(t, sigma.dtype)
    top = np.empty(t, sigma.dtype)
    bottom = np.empty(t, sigma.dtype)
    for e in range(len(isotropic)):
        for p in range(points):
            row = 3 * (points * e + p)
            x, y, z = sigma[row], sigma[row + 1], sigma[row + 2]
            for i in range(t):
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
        if not isotropic[e]:
            for i in range(t):
                line[i] = max(top[i] * top[i], bottom[i] * bottom[i])
        _keep(line, top, bottom, first, e, square, when, high, low)


@_threaded
def line_extremes(sigma, points, isotropic, first, square, when, high, low):
    """Direct stresses at the points of bars and rods; see `sheet_extremes`."""
    t = sigma.shape[1]
    line = np.empty(t, sigma.dtype)
    top = np.empty(t, sigma.dtype)
    bottom = np.empty(t, sigma.dtype)
    for e in range(len(isotropic)):
        row = points * e
        for i in range(t):
            top[i] = sigma[row, i]
            bottom[i] = sigma[row, i]
        for p in range(1, points):
            x = sigma[row + p]
            for i in range(t):
                top[i] = max(top[i], x[i])
                bottom[i] = min(bottom[i], x[i])
        for i in range(t):
            line[i] = max(top[i] * top[i], bottom[i] * bottom[i])
        _keep(line, top, bottom, first, e, square, when, high, low)


@_threaded
def _keep(line, top, bottom, first, e, square, when, high, low):
    """The extremes of an element's instants into the running ones."""
    t = len(line)
    best, upper, lower = line[0], top[0], bottom[0]
    for i in range(1, t):
        best = max(best, line[i])
        upper = max(upper, top[i])
        lower = min(lower, bottom[i])
    if best > square[e]:
        square[e] = best
        for i in range(t):
            if line[i] == best:
                when[e] = first + i
                break
    high[e] = max(high[e], upper)
    low[e] = min(low[e], lower)
