"""A small free-free aircraft of beams and lumped masses, symmetric port to starboard.

Size, mass and lowest frequencies are those of a 150-seat transport without its landing
gear; the axes are those of the airframe frame B (x aft, y starboard, z up).
"""

from functools import cache

import numpy as np

from systems.airframe.modal_body import ModalBody

NOSE_GEAR, LEFT_GEAR, RIGHT_GEAR = 101, 102, 103
NOSE_TIP, TAIL_TIP, LEFT_TIP, RIGHT_TIP = 1, 13, 27, 37
MASS = 69448.0


def _beam(p: np.ndarray, q: np.ndarray, EA, GJ, EI_up, EI_side) -> np.ndarray:
    """(12, 12) stiffness of an Euler-Bernoulli beam between p and q, global axes."""
    L = np.linalg.norm(q - p)
    x = (q - p) / L
    z = np.array([0.0, 0.0, 1.0]) if abs(x[2]) < 0.9 else np.array([1.0, 0.0, 0.0])
    y = np.cross(z, x)
    y /= np.linalg.norm(y)
    K = np.zeros((12, 12))
    K[np.ix_([0, 6], [0, 6])] = EA / L * np.array([[1, -1], [-1, 1]])
    K[np.ix_([3, 9], [3, 9])] = GJ / L * np.array([[1, -1], [-1, 1]])
    b = (
        np.array(
            [
                [12, 6 * L, -12, 6 * L],
                [6 * L, 4 * L**2, -6 * L, 2 * L**2],
                [-12, -6 * L, 12, -6 * L],
                [6 * L, 2 * L**2, -6 * L, 4 * L**2],
            ]
        )
        / L**3
    )
    s = np.array([1, -1, 1, -1])
    K[np.ix_([1, 5, 7, 11], [1, 5, 7, 11])] = EI_side * b
    K[np.ix_([2, 4, 8, 10], [2, 4, 8, 10])] = EI_up * b * np.outer(s, s)
    T = np.kron(np.eye(4), np.array([x, y, np.cross(x, y)]))
    return T.T @ K @ T


def _model() -> tuple[dict[int, np.ndarray], dict[int, float], list[tuple]]:
    p, m, beams = {}, {}, []
    for i in range(13):
        p[1 + i] = np.array([0.5 + 3.0 * i, 0.0, 0.0])
        m[1 + i] = 3000.0 if 1 <= i <= 9 else 900.0
        if i:
            beams.append((i, i + 1, 8e9, 2e9, 4.5e9, 4.5e9))
    m[6] += 4000.0
    for first, side in ((21, -1.0), (31, 1.0)):
        previous = 6
        for i in range(7):
            y = 1.9 + 2.5 * i
            p[first + i] = np.array(
                [15.5 + 0.35 * (y - 1.9), side * y, -1.0 + 0.08 * y]
            )
            m[first + i] = (2700.0, 2400.0, 1500.0, 900.0, 500.0, 250.0, 100.0)[i]
            EI = 5.5e8 * (1.0 - 0.14 * i) ** 2
            beams.append((previous, first + i, 2e9, 0.8 * EI, EI, 6 * EI))
            previous = first + i
        p[first + 8] = np.array([13.7, side * 5.757, -2.2])
        m[first + 8] = 4990.0
        beams.append((first + 1, first + 8, 1e9, 5e7, 8e7, 8e7))
        gear = LEFT_GEAR if side < 0 else RIGHT_GEAR
        p[gear] = np.array([17.6, side * 3.795, -1.05])
        m[gear] = 40.0
        beams.append((first + 1, gear, 2e9, 4e8, 4e8, 4e8))
        p[first + 9] = np.array([34.0, side * 4.0, 1.0])
        m[first + 9] = 350.0
        beams.append((12, first + 9, 5e8, 1e7, 2e7, 6e7))
    p[50] = np.array([34.0, 0.0, 5.0])
    m[50] = 600.0
    beams.append((12, 50, 1e9, 5e7, 1e8, 1e8))
    p[NOSE_GEAR] = np.array([5.07, 0.0, -1.6])
    m[NOSE_GEAR] = 30.0
    beams += [(2, NOSE_GEAR, 2e9, 3e8, 3e8, 3e8), (3, NOSE_GEAR, 2e9, 3e8, 3e8, 3e8)]
    return p, m, beams


@cache
def aircraft_body(modes: int = 73, loss_factor: float = 0.03) -> ModalBody:
    """The aircraft with its lowest elastic modes and damping proportional to stiffness.

    Args:
        modes: number of elastic modes; 0 gives the rigid aircraft.
        loss_factor: twice the damping ratio at 5 Hz.
    """
    p, m, beams = _model()
    ids = sorted(p)
    row = {g: i for i, g in enumerate(ids)}
    k = len(ids)
    positions = np.array([p[g] for g in ids])
    lumps = np.array([m[g] for g in ids])
    lumps *= MASS / lumps.sum()
    K = np.zeros((6 * k, 6 * k))
    for a, b, *stiffness in beams:
        dofs = np.r_[6 * row[a] : 6 * row[a] + 6, 6 * row[b] : 6 * row[b] + 6]
        K[np.ix_(dofs, dofs)] += _beam(p[a], p[b], *stiffness)
    # Radius of gyration of each lump 0.5 m, so that no freedom is without inertia.
    diagonal = np.repeat(lumps, 6)
    diagonal[np.arange(6 * k) % 6 >= 3] *= 0.25
    root = np.sqrt(diagonal)
    values, vectors = np.linalg.eigh(K / np.outer(root, root))
    assert values[5] < 1e-6 * values[6]
    values = values[6 : 6 + modes]
    shapes = (vectors[:, 6 : 6 + modes] / root[:, None]).reshape(k, 6, modes)
    arms = positions - lumps @ positions / MASS
    inertia = sum(
        w * ((r @ r + 0.25) * np.eye(3) - np.outer(r, r)) for w, r in zip(lumps, arms)
    )
    return ModalBody(
        mass=MASS,
        p_BG=lumps @ positions / MASS,
        inertia_G=inertia,
        frequency=np.sqrt(values) / (2 * np.pi),
        modal_mass=np.ones(modes),
        modal_damping=np.diag(values) * loss_factor / (2 * np.pi * 5.0),
        node_id=np.array(ids),
        p_BN=positions,
        translation=shapes[:, :3],
        rotation=shapes[:, 3:],
    )
