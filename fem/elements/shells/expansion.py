"""How the grids of free shells move when temperatures strain them."""

import numpy as np

from fem.arrays import Float64
from fem.elements.shells.shell_geometry import Facet, corner_gradients, corner_spin


def stretched(shape: Facet, grids: Float64, strain: Float64) -> Float64:
    """(e, n, 6) motion of the grids by a uniform strain, about their middle.

    Args:
        shape: element axes.
        grids: (e, n, 3) basic frame.
        strain: (e, 3) xx yy xy, element axes; along the normal their mean.
    """
    xx, yy, xy = strain.T
    tensor = np.zeros((len(grids), 3, 3))
    tensor[:, 0, 0], tensor[:, 1, 1] = xx, yy
    tensor[:, 0, 1] = tensor[:, 1, 0] = 0.5 * xy
    tensor[:, 2, 2] = 0.5 * (xx + yy)
    arm = grids - grids.mean(axis=1, keepdims=True)
    moved = np.zeros((*arm.shape[:2], 6))
    moved[..., :3] = arm @ (shape.axes.transpose(0, 2, 1) @ tensor @ shape.axes)
    return moved


def curled(shape: Facet, grids: Float64, curvature: Float64) -> Float64:
    """(e, n, 6) motion of the grids by a curvature xx yy xy (e, 3) about z.

    Without shear: w = -(k_xx x^2 + k_yy y^2 + k_xy x y) / 2. NaN where there are grids
    beside the corners of the shape.
    """
    moved = np.zeros((*grids.shape[:2], 6))
    if not curvature.any():
        return moved
    if grids.shape[1] != shape.corners:
        moved[curvature.any(axis=1)] = np.nan
        return moved
    x, y = np.moveaxis(shape.xy, -1, 0)
    xx, yy, xy = curvature.T[..., None]
    along = xx * x + 0.5 * xy * y, yy * y + 0.5 * xy * x
    zero = np.zeros_like(x)
    turn = np.stack([-along[1], along[0], zero], axis=-1)
    shift = np.stack([zero, zero, -0.5 * (along[0] * x + along[1] * y)], axis=-1)
    # The grid is the root of the arm to the reference surface.
    arm = np.zeros_like(turn)
    arm[..., 2] = shape.offset[:, None]
    shift = shift - np.cross(turn, arm)
    moved[..., :3], moved[..., 3:] = shift @ shape.axes, turn @ shape.axes
    return moved


def warmed(shape: Facet, strain: Float64, temperature: Float64) -> Float64:
    """(e, 24) what temperatures of four corners add to the motion by their mean.

    The strain e T(x, y) of a linear T about the middle of the corners moves a free
    sheet by u = e_xx (T_x x^2 / 2 + T_y x y) + (e_xy T_y - e_yy T_x) y^2 / 2, v alike;
    turned as its corners turn, so that the drilling penalty is silent. On rectangles
    the load is a commercial solver's to six digits; on other shapes it follows from the
    same field.

    Args:
        shape: element axes and flat shape.
        strain: (e, 3) xx yy xy per degree, element axes.
        temperature: (e, 4) of the grids; NaN: not given.
    """
    moved = np.zeros((len(strain), 4, 6))
    beyond = temperature - temperature.mean(axis=1, keepdims=True)
    beyond = np.nan_to_num(beyond)
    if not beyond.any():
        return moved.reshape(len(moved), -1)
    xy = shape.xy - shape.xy.mean(axis=1, keepdims=True)
    slope = np.einsum("ein,en->ei", np.linalg.pinv(xy), beyond)
    xx, yy, both = strain.T[..., None]
    tx, ty = slope.T[..., None]
    x, y = np.moveaxis(xy, -1, 0)
    u = xx * (0.5 * tx * x + ty * y) * x + 0.5 * (both * ty - yy * tx) * y**2
    v = yy * (0.5 * ty * y + tx * x) * y + 0.5 * (both * tx - xx * ty) * x**2
    shift = np.stack([u, v], axis=-1)
    spin = np.einsum("eijc,ejc->ei", corner_spin(corner_gradients(shape)), shift)
    moved[..., :3] = shift @ shape.axes[:, :2]
    moved[..., 3:] = spin[..., None] * shape.axes[:, 2:]
    return moved.reshape(len(moved), -1)
