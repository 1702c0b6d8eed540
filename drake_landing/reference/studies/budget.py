"""Where the difference between multibody run and direct transient comes from.

For one run with its attachment loads L on the grid of the transient, at one output:

    multibody - direct transient =
        truncation + reduction + formulation + time integration + rest

    truncation        modal response with the run's modes less that with all modes of
                      its basis (below the limit of the candidates)
    reduction         all modes of a reduced model less all candidates of the full one
    formulation       multibody less modal response with the same modes: finite
                      rotation, arms of the deformed structure, inertial coupling,
                      tolerance of the integrator, hand-over
    time integration  modal response integrated exactly less that by the scheme of the
                      direct transient, all candidates
    rest              modal response of all candidates by that scheme less the direct
                      transient: modes above the candidates

All modal responses are linear, exact for loads that are linear between samples, with
the same projected damping. Feedback is how much the loads themselves change with the
modes: full-model response under L less that under the loads of the reference run.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from drake_landing.airframe.oscillators import modal_accelerations
from drake_landing.airframe.relevance import ModalModel
from drake_landing.landing.handover import AttachmentLoads

Float64 = npt.NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Budget:
    """Parts of the difference, histories (t, p, 3), m/s²."""

    truncation: Float64
    reduction: Float64
    formulation: Float64
    integration: Float64
    rest: Float64

    @property
    def total(self) -> Float64:
        """Multibody less direct transient."""
        return self.omitted + self.formulation

    @property
    def omitted(self) -> Float64:
        """The linear model with the run's modes less the direct transient."""
        return self.truncation + self.reduction + self.integration + self.rest


def error_budget(
    model: ModalModel,
    whole: ModalModel,
    chosen: ModalModel,
    loads: AttachmentLoads,
    multibody: Float64,
    transient: Float64,
    scheme: str,
) -> Budget:
    """Splits the difference of one run.

    Args:
        model: rigid-body modes and all candidates of the full model.
        whole: the same, or those of the reduced model that the run's modes are of.
        chosen: rigid-body modes and those of the run.
        loads: attachment loads on an even grid.
        multibody, transient: (t, p, 3) accelerations of the points of the model.
        scheme: of the transient, `nastran` or `generalised-alpha`.
    """
    force = modal_forces(model, loads)
    exact = modal_accelerations(model.frequency_hz, model.damping, force, loads.step)
    every = at_points(model, exact)
    of_basis = every if whole is model else exact_response(whole, loads)
    few = exact_response(chosen, loads)
    if scheme == "nastran":
        stepped = nastran_accelerations(model, force, loads.step)
        scheme_all = at_points(model, stepped)
    else:
        scheme_all = every  # its error stays in the rest
    return Budget(
        truncation=few - of_basis,
        reduction=of_basis - every,
        formulation=multibody - few,
        integration=every - scheme_all,
        rest=scheme_all - transient,
    )


def modal_forces(model: ModalModel, loads: AttachmentLoads) -> Float64:
    """(t, n) modal forces per modal mass."""
    return np.sum(
        [
            loads.load[:, k] @ model.attachment[int(node)]
            for k, node in enumerate(loads.node_id)
        ],
        axis=0,
    )


def exact_response(model: ModalModel, loads: AttachmentLoads) -> Float64:
    """(t, p, 3) of the monitoring points, for loads linear between samples."""
    force = modal_forces(model, loads)
    return at_points(
        model,
        modal_accelerations(model.frequency_hz, model.damping, force, loads.step),
    )


def at_points(
    model: ModalModel, acceleration: Float64, keep: npt.NDArray[np.bool_] | None = None
) -> Float64:
    """(t, p, 3) of the monitoring points from modal accelerations (t, n)."""
    shape, q = model.monitor, acceleration
    if keep is not None:
        shape, q = shape[:, :, keep], q[:, keep]
    return np.einsum("tn,pan->tpa", q, shape, optimize=True)


def nastran_accelerations(model: ModalModel, force: Float64, step: float) -> Float64:
    """(t, n) modal accelerations by the scheme of the direct transient.

    The scheme is linear: mode by mode it does what it does to the whole model.
    """
    h, k = step, (2.0 * np.pi * model.frequency_hz) ** 2
    c = model.damping
    ahead = 1.0 / h**2 + c / (2.0 * h) + k / 3.0
    now, before = 2.0 / h**2 - k / 3.0, -1.0 / h**2 + c / (2.0 * h) - k / 3.0
    # One step beyond the end with the last value held; a start at rest: P_-1 = P_0 = 0.
    padded = np.vstack([np.zeros((1, len(k))), force, force[-1:]])
    padded[1] = 0.0
    mean = (padded[:-2] + padded[1:-1] + padded[2:]) / 3.0
    u = np.zeros((len(force) + 2, len(k)))
    for i in range(len(force)):
        u[i + 2] = (mean[i] + now * u[i + 1] + before * u[i]) / ahead
    return np.diff(u, 2, axis=0) / h**2


def rms_share(part: Float64, reference: Float64) -> Float64:
    """(p, 3) rms over time of a part over that of a reference, both (t, p, 3)."""
    size = np.sqrt((reference**2).mean(axis=0))
    return np.sqrt((part**2).mean(axis=0)) / np.where(size > 0.0, size, np.nan)
