"""Shear factors and torsion constants of PBARL and PBEAML against Nastran's own."""

from benchmarks.verification.row import LINES, Row, figure
from benchmarks.verification.runner import run
from fem.cross_sections.library import section
from fem.cross_sections.shapes import DIMENSIONS
from fem.cross_sections.shear_factors import SOURCES

# Dimensions, J, K1, K2 as printed for an entry PBAR or PBEAM.
_PRINTED: dict[str, tuple[tuple[float, ...], float, float, float]] = {
    "ROD": ((1.0,), 1.5708, 0.9, 0.9),
    "TUBE": ((0.6, 0.598), 2.7008e-3, 0.5, 0.5),
    "BOX": ((6.0, 1.0, 0.1, 0.1), 0.8292971, 0.1176471, 0.8529412),
}
_THEORY: dict[str, tuple[tuple[float, ...], float, float]] = {
    "TUBE2": ((0.6, 0.002), 0.5, 0.5),
    "BAR": ((10.0, 30.0), 5 / 6, 5 / 6),
    "BOX1": (
        (6.0, 1.0, 0.1, 0.2, 0.05, 0.15),
        0.2 * 0.7 / 1.94,
        0.3 * 5.8 / 1.94,
    ),
    "L": ((100.0, 80.0, 10.0, 5.0), 350 / 1350, 950 / 1350),
    "CHAN": ((10.0, 30.0, 1.0, 2.0), 26 / 66, 36 / 66),
    "CHAN1": ((9.0, 1.0, 26.0, 30.0), 26 / 66, 36 / 66),
    "CHAN2": ((2.0, 1.0, 10.0, 30.0), 36 / 66, 26 / 66),
}
# The others by finite elements: K1, K2 of another finite element program.
_ELEMENTS: dict[str, tuple[tuple[float, ...], float, float]] = {
    "I": ((30.0, 20.0, 10.0, 2.0, 1.0, 0.5), 0.63242, 0.25151),
    "I1": ((10.0, 1.0, 18.0, 20.0), 0.45561, 0.47685),
    "T": ((10.0, 24.0, 0.24, 1.0), 0.78604, 0.10078),
    "T1": ((10.0, 12.0, 1.0, 0.8), 0.43850, 0.43204),
    "T2": ((10.0, 12.0, 1.0, 0.8), 0.41260, 0.45679),
    "CROSS": ((10.0, 1.0, 12.0, 0.8), 0.51816, 0.39666),
    "H": ((10.0, 2.0, 12.0, 1.0), 0.60618, 0.29882),
    "Z": ((10.0, 1.0, 22.0, 28.0), 0.29337, 0.58237),
    "HEXA": ((3.0, 15.0, 20.0), 0.86900, 0.82957),
    "HAT": ((20.0, 2.0, 15.0, 5.0), 0.55518, 0.14114),
    "HAT1": ((16.0, 11.0, 10.0, 1.0, 1.2), 0.36232, 0.45396),
    "DBOX": (
        (30.0, 20.0, 10.0, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6),
        0.37509,
        0.53221,
    ),
}
_FEF = "finite elements (MSC 2022's default; NX's equation unknown): sectionproperties"


def shear_factors() -> list[Row]:
    """One shape after the other; all types that are read occur."""
    rows = []
    for kind, (dims, j, k1, k2) in _PRINTED.items():
        c = section(kind, dims).constants
        name = f"section {kind}"
        rows.append(figure(name, "shear factor K1", c.k1, k1, SOURCES[kind]))
        rows.append(figure(name, "shear factor K2", c.k2, k2, SOURCES[kind]))
        rows.append(figure(name, "torsion constant J", c.j, j, SOURCES[kind]))
    for kind, (dims, k1, k2) in _THEORY.items():
        c = section(kind, dims).constants
        name = f"section {kind}"
        rows.append(figure(name, "shear factor K1", c.k1, k1, SOURCES[kind]))
        rows.append(figure(name, "shear factor K2", c.k2, k2, SOURCES[kind]))
    for kind, (dims, k1, k2) in _ELEMENTS.items():
        c = section(kind, dims).constants
        name = f"section {kind}"
        for label, ours, theirs in (("K1", c.k1, k1), ("K2", c.k2, k2)):
            text = f"shear factor {label}"
            rows.append(figure(name, text, ours, theirs, _FEF, target=3e-3))
    missing = set(DIMENSIONS) - {*_PRINTED, *_THEORY, *_ELEMENTS}
    if missing:
        raise ValueError(f"sections without a row: {', '.join(sorted(missing))}")
    return rows


# A bar and a beam of a round section with an inertia at the tip, by own figures: the
# model whose modes NX 2019.2 printed (pyNastran, models/beam_modes).
_NX_HZ = [456.66034, 2674.58749, 3554.92300, 4507.48720, 6626.10398, 11111.58536]


def round_cantilever_modes() -> list[Row]:
    """Nine CBAR and a CBEAM, PBARL and PBEAML of type ROD."""
    lines = ["SOL 103\nCEND\nSPC = 1\nMETHOD = 1\nDISP = ALL\nBEGIN BULK"]
    lines += ["EIGRL,1,,,10\nSPC,1,1,123456,0.\nMAT1,2,3.+7,1.1628+7,.29,7.4851-4"]
    lines += ["PBARL,1,2,,ROD\n,1.\nPBEAML,3,2,,ROD\n,1."]
    lines += [f"GRID,{k + 1},,{k}.,0.,0." for k in range(11)]
    lines += [f"CBAR,{k},1,{k},{k + 1},0.,1.,0." for k in range(1, 10)]
    lines += ["CBEAM,10,3,10,11,0.,1.,0.", "CONM2,21,11,,2.59-3"]
    lines += [",2.59-3,,2.59-3,,,2.59-3", "ENDDATA"]
    ours = run("\n".join(lines))["modes/frequency_hz"]
    # Bending modes come in pairs.
    single = [ours[0], ours[2], ours[4], ours[5], ours[6], ours[8]]
    source = "NX 2019.2 (pyNastran models, beam_modes)"
    return [
        figure("round cantilever", f"mode {k + 1}, Hz", a, b, source, target=LINES)
        for k, (a, b) in enumerate(zip(single, _NX_HZ))
    ]
