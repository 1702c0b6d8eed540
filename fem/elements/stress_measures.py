"""Principal stresses and von Mises stress, over any leading axes."""

import numpy as np

from fem.arrays import Float64


def plane_columns(xx: Float64, yy: Float64, xy: Float64) -> tuple[Float64, ...]:
    """Angle (deg, from x to the major axis), major, minor of plane stress."""
    center, half = 0.5 * (xx + yy), 0.5 * (xx - yy)
    radius = np.hypot(half, xy)
    angle = 0.5 * np.degrees(np.arctan2(xy, half))
    return angle, center + radius, center - radius


def plane_von_mises(xx: Float64, yy: Float64, xy: Float64) -> Float64:
    """Von Mises stress of plane stress."""
    return np.sqrt(np.maximum(xx * xx - xx * yy + yy * yy + 3.0 * xy * xy, 0.0))


def plane_von_mises_strain(xx: Float64, yy: Float64, xy: Float64) -> Float64:
    """Nastran's equivalent strain of plane strains, xy the engineering shear strain.

    2/3 sqrt(xx^2 - xx yy + yy^2 + 3/4 xy^2), as its printed strains have it.
    """
    inner = xx * xx - xx * yy + yy * yy + 0.75 * xy * xy
    return 2.0 / 3.0 * np.sqrt(np.maximum(inner, 0.0))


def solid_principal(stress: Float64) -> Float64:
    """(..., 3) principal values, largest first, of (..., 6) xx yy zz xy yz zx.

    Closed form (trigonometric), so that histories need no eigenvalue calls.
    """
    xx, yy, zz, xy, yz, zx = np.moveaxis(stress, -1, 0)
    mean = (xx + yy + zz) / 3.0
    a, b, c = xx - mean, yy - mean, zz - mean
    j2 = 0.5 * (a * a + b * b + c * c) + xy * xy + yz * yz + zx * zx
    j3 = a * b * c + 2.0 * xy * yz * zx - a * yz**2 - b * zx**2 - c * xy**2
    radius = 2.0 * np.sqrt(j2 / 3.0)
    cubed = radius**3
    ratio = np.divide(4.0 * j3, cubed, out=np.zeros_like(j3), where=cubed > 0.0)
    lode = np.arccos(np.clip(ratio, -1.0, 1.0)) / 3.0
    turns = lode[..., None] - 2.0 * np.pi / 3.0 * np.array([0.0, 1.0, -1.0])
    return mean[..., None] + radius[..., None] * np.cos(turns)


def solid_von_mises(stress: Float64) -> Float64:
    """(...) von Mises stress of (..., 6) xx yy zz xy yz zx."""
    xx, yy, zz, xy, yz, zx = np.moveaxis(stress, -1, 0)
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.sqrt(0.5 * normal + 3.0 * (xy * xy + yz * yz + zx * zx))
