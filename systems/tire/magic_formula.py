"""Magic Formula of a tire, with the coefficients of a property file (.tir).

Steady forces at combined slip after H. B. Pacejka, Tire and Vehicle Dynamics (4.E1 to
4.E78), as PAC2002, MF-Tyre 5.2 and 6.x have them; without turn slip, overturning
moment and changes of pressure. Axes of the file, ISO: x in the direction of travel
along the wheel, y to the left, z up; κ = -v_slide,x/|v_x|, tan α = v_slide,y/|v_x|.
The formula's rolling resistance and vertical spring are not used: the tire has its own.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from systems.tools.scalar import Scalar, atan, cos, exp, sin, sqrt

_NEEDED = (
    "FNOMIN UNLOADED_RADIUS PCX1 PDX1 PKX1 PCY1 PDY1 PKY1 PKY2 QBZ1 QCZ1 QDZ1".split()
)
_KNOWN_TYPES = (5, 6, 21, 51, 52, 60, 61, 62)
_LINE = re.compile(r"^\s*(\w+)\s*=\s*(.*?)\s*$")
_UNITS = {
    "LENGTH": ("meter", "metre", "m"),
    "FORCE": ("newton", "n"),
    "ANGLE": ("radians", "radian", "rad"),
    "MASS": ("kg", "kilogram"),
    "TIME": ("second", "seconds", "sec", "s"),
}
# Slip beyond which the formulas of lateral slip are held: nearly sideways.
_STEEP = 1.5


@dataclass(frozen=True)
class MagicFormula:
    """A `SlipLaw` by coefficients, named as in the file, e.g. `PKY1`; missing ones: 0.

    Raises:
        ValueError: one without which there is no formula is missing.
    """

    coefficients: Mapping[str, float] = field(repr=False, hash=False)

    def __post_init__(self) -> None:
        missing = [name for name in _NEEDED if name not in self.coefficients]
        if missing:
            raise ValueError(
                f"magic formula: found no {', '.join(missing)}, expected the "
                "coefficients of a PAC2002, MF-Tyre 5.2 or 6.x file"
            )
        for name in ("FNOMIN", "UNLOADED_RADIUS"):
            if not self.coefficients[name] > 0.0:
                found = self.coefficients[name]
                raise ValueError(f"magic formula: {name} is {found}, expected > 0")

    @classmethod
    def from_file(cls, path: str | Path) -> "MagicFormula":
        """Reads a property file in SI units.

        Raises:
            ValueError: a line cannot be read, units are others, or the model is not
                the Magic Formula; the message names file and line.
        """
        found: dict[str, float] = {}
        with open(path, encoding="utf-8", errors="replace") as file:
            for number, line in enumerate(file, start=1):
                match = _LINE.match(re.split(r"[$!]", line)[0])
                if match:
                    _read(found, match[1].upper(), match[2], f"{path}, line {number}")
        try:
            return cls(found)
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from None

    def _c(self, name: str, default: float = 0.0) -> float:
        return self.coefficients.get(name, default)

    def _scaled(self, name: str) -> float:
        return self.coefficients.get(name, 1.0)

    @property
    def compiled_form(self) -> None:
        """See `SlipLaw`: it is not compiled."""
        return None

    def slopes(self, load: float, deflection: float) -> tuple[float, float]:
        """See `SlipLaw`; both > 0, whatever the deflection."""
        dfz = self._dfz(load)
        return abs(self._k_x(load, dfz)), abs(self._k_y(load, 0.0))

    def _dfz(self, load: Scalar) -> Scalar:
        nominal = self.coefficients["FNOMIN"] * self._scaled("LFZO")
        return (load - nominal) / nominal

    def _k_x(self, load: Scalar, dfz: Scalar) -> Scalar:
        grown = exp(self._c("PKX3") * dfz)
        stiffness = load * (self._c("PKX1") + self._c("PKX2") * dfz) * grown
        return stiffness * self._scaled("LKX")

    def _k_y(self, load: Scalar, camber: Scalar) -> Scalar:
        nominal = self.coefficients["FNOMIN"] * self._scaled("LFZO")
        late = self._c("FITTYP") >= 60
        base = self._c("PKY2") + (self._c("PKY5") * camber * camber if late else 0.0)
        times = self._c("PKY4", 2.0) if late else 2.0
        shape = sin(times * atan(load / (nominal * base)))
        camber_loss = 1.0 - self._c("PKY3") * abs(camber)
        scale = self._scaled("LKY")
        return self.coefficients["PKY1"] * nominal * shape * camber_loss * scale

    def relaxation_share(self, k_t: Scalar, k_l: Scalar, deflection: Scalar) -> Scalar:
        """See `SlipLaw`: the length does not depend on the slip."""
        return 1.0 + 0.0 * deflection

    def wheel_forces(
        self,
        k_t: Scalar,
        k_l: Scalar,
        travel: Scalar,
        deflection: Scalar,
        load: Scalar,
        factor: Scalar,
        tilt: Scalar,
    ) -> tuple[Scalar, Scalar, Scalar]:
        """See `SlipLaw`; the load alone stands for the deflection."""
        if not load > 0.0:
            return 0.0 * load, 0.0 * load, 0.0 * load
        sense = -1.0 if travel <= 0.0 else 1.0
        camber = sense * atan(tilt / sqrt(1.0 - tilt * tilt))
        across = sense * k_l
        across = min(max(across, -_STEEP), _STEEP)
        fx, fy, mz = self.forces(load, -sense * k_t, across, camber)
        return factor * (sense * fx), factor * (sense * fy), factor * mz

    def forces(
        self, load: Scalar, kappa: Scalar, tangent: Scalar, camber: Scalar
    ) -> tuple[Scalar, Scalar, Scalar]:
        """F_x, F_y (N), M_z (N m) in the axes of the file.

        Args:
            load: N, > 0.
            kappa: longitudinal slip, positive where the wheel drives.
            tangent: tan α.
            camber: rad.
        """
        c, dfz = self._c, self._dfz(load)
        angle = atan(tangent)
        fx0 = self._pure_x(load, dfz, kappa, camber)
        fy0, slope, b_y, c_y, s_hy, s_vy = self._pure_y(load, dfz, angle, camber)
        g_x = _weight(
            (c("RBX1") + c("RBX3") * camber * camber)
            * cos(atan(c("RBX2") * kappa))
            * self._scaled("LXAL"),
            c("RCX1"),
            c("REX1") + c("REX2") * dfz,
            angle,
            c("RHX1"),
        )
        g_y = _weight(
            (c("RBY1") + c("RBY4") * camber * camber)
            * cos(atan(c("RBY2") * (angle - c("RBY3"))))
            * self._scaled("LYKA"),
            c("RCY1"),
            c("REY1") + c("REY2") * dfz,
            kappa,
            c("RHY1") + c("RHY2") * dfz,
        )
        mu_y = self._mu_y(dfz, camber)
        d_v = mu_y * load * (c("RVY1") + c("RVY2") * dfz + c("RVY3") * camber)
        d_v = d_v * cos(atan(c("RVY4") * angle))
        s_v = d_v * sin(c("RVY5") * atan(c("RVY6") * kappa)) * self._scaled("LVYKA")
        fx, fy = g_x * fx0, g_y * fy0 + s_v
        k_x = self._k_x(load, dfz)
        equal = (k_x / slope) * (k_x / slope) * kappa * kappa
        # The side force without that of camber acts with the trail (4.E72).
        plain = self._pure_y(load, dfz, angle, 0.0)[0] * g_y
        trail, rest = self._trail(load, dfz, angle, camber, equal, b_y, c_y, s_hy, s_vy)
        nominal = self.coefficients["FNOMIN"]
        scrub = self.coefficients["UNLOADED_RADIUS"] * (
            c("SSZ1")
            + c("SSZ2") * fy / nominal
            + (c("SSZ3") + c("SSZ4") * dfz) * camber
        )
        scrub = scrub * self._scaled("LS")
        return fx, fy, -trail * plain + rest + scrub * fx

    def _pure_x(
        self, load: Scalar, dfz: Scalar, kappa: Scalar, camber: Scalar
    ) -> Scalar:
        c = self._c
        mu = (c("PDX1") + c("PDX2") * dfz) * (1.0 - c("PDX3") * camber * camber)
        mu = mu * self._scaled("LMUX")
        x = kappa + (c("PHX1") + c("PHX2") * dfz) * self._scaled("LHX")
        bend = c("PEX1") + dfz * (c("PEX2") + dfz * c("PEX3"))
        bend = bend * (1.0 - c("PEX4") * _sign(x)) * self._scaled("LEX")
        shape = c("PCX1") * self._scaled("LCX")
        b = self._k_x(load, dfz) / (shape * mu * load)
        shift = load * (c("PVX1") + c("PVX2") * dfz) * self._scaled("LVX")
        shift = shift * self._scaled("LMUX")
        return mu * load * sin(_argument(b * x, shape, bend)) + shift

    def _mu_y(self, dfz: Scalar, camber: Scalar) -> Scalar:
        c = self._c
        mu = (c("PDY1") + c("PDY2") * dfz) * (1.0 - c("PDY3") * camber * camber)
        return mu * self._scaled("LMUY")

    def _pure_y(
        self, load: Scalar, dfz: Scalar, angle: Scalar, camber: Scalar
    ) -> tuple[Scalar, ...]:
        """F_y0, K_y, B, C, S_Hy, S_Vy."""
        c = self._c
        mu, slope = self._mu_y(dfz, camber), self._k_y(load, camber)
        leaning = load * (c("PVY3") + c("PVY4") * dfz) * camber * self._scaled("LMUY")
        s_v = load * (c("PVY1") + c("PVY2") * dfz) * self._scaled("LVY")
        s_v = s_v * self._scaled("LMUY") + leaning
        s_h = (c("PHY1") + c("PHY2") * dfz) * self._scaled("LHY")
        if c("FITTYP") >= 60:
            thrust = load * (c("PKY6") + c("PKY7") * dfz) * camber
            s_h = s_h + (thrust - leaning) / slope
        else:
            s_h = s_h + c("PHY3") * camber
        x = angle + s_h
        bend = (c("PEY1") + c("PEY2") * dfz) * self._scaled("LEY")
        odd = (c("PEY3") + c("PEY4") * camber) * _sign(x)
        bend = bend * (1.0 + c("PEY5") * camber * camber - odd)
        shape = c("PCY1") * self._scaled("LCY")
        b = slope / (shape * mu * load)
        force = mu * load * sin(_argument(b * x, shape, bend)) + s_v
        return force, slope, b, shape, s_h, s_v

    def _trail(
        self,
        load: Scalar,
        dfz: Scalar,
        angle: Scalar,
        camber: Scalar,
        equal: Scalar,
        b_y: Scalar,
        c_y: Scalar,
        s_hy: Scalar,
        s_vy: Scalar,
    ) -> tuple[Scalar, Scalar]:
        """Pneumatic trail (m), and the moment that is left (N m)."""
        c, radius = self._c, self.coefficients["UNLOADED_RADIUS"]
        slope = self._k_y(load, camber)
        s_ht = c("QHZ1") + c("QHZ2") * dfz + (c("QHZ3") + c("QHZ4") * dfz) * camber
        at = angle + s_ht
        ar = angle + s_hy + s_vy / slope
        at = _sign(at) * atan(sqrt(_square_tan(at) + equal))
        ar = _sign(ar) * atan(sqrt(_square_tan(ar) + equal))
        lean = abs(camber)
        late = c("FITTYP") >= 60
        b = c("QBZ1") + dfz * (c("QBZ2") + dfz * c("QBZ3"))
        b = b * (1.0 + c("QBZ4") * camber + c("QBZ5") * lean)
        b = b * self._scaled("LKY") / self._scaled("LMUY")
        d = load * radius / self.coefficients["FNOMIN"]
        d = d * (c("QDZ1") + c("QDZ2") * dfz) * self._scaled("LTR")
        side = lean if late else camber
        d = d * (1.0 + c("QDZ3") * side + c("QDZ4") * camber * camber)
        bend = c("QEZ1") + dfz * (c("QEZ2") + dfz * c("QEZ3"))
        turned = (2.0 / 3.141592653589793) * atan(b * c("QCZ1") * at)
        bend = bend * (1.0 + (c("QEZ4") + c("QEZ5") * camber) * turned)
        steered = cos(angle)
        trail = d * cos(_argument(b * at, c("QCZ1"), bend)) * steered
        b_r = c("QBZ9") * self._scaled("LKY") / self._scaled("LMUY")
        b_r = b_r + c("QBZ10") * b_y * c_y
        left = (c("QDZ6") + c("QDZ7") * dfz) * self._scaled("LRES")
        left = left + (c("QDZ8") + c("QDZ9") * dfz) * camber
        left = left + (c("QDZ10") + c("QDZ11") * dfz) * camber * lean
        left = left * load * radius * self._scaled("LMUY")
        return trail, left * cos(atan(b_r * ar)) * steered


def _read(found: dict[str, float], name: str, text: str, place: str) -> None:
    """One entry of a file; texts other than units are passed over."""
    word = text.strip("'\" ").lower()
    if name in _UNITS and word not in _UNITS[name] and not _is_number(text):
        raise ValueError(
            f"{place}: found {name} in {word!r}, expected SI units, {_UNITS[name][0]}"
        )
    if _is_number(text):
        found[name] = float(text)
        if name == "FITTYP" and int(found[name]) not in _KNOWN_TYPES:
            raise ValueError(
                f"{place}: found FITTYP {text}, expected one of "
                f"{', '.join(map(str, _KNOWN_TYPES))}: the Magic Formula"
            )
    elif name == "PROPERTY_FILE_FORMAT" and word not in (
        "pac2002",
        "mf-tyre",
        "mf_05",
        "mf_tyre",
        "user",
        "pac-2002",
    ):
        raise ValueError(f"{place}: found {word!r}, expected PAC2002 or MF-Tyre")
    elif re.match(r"^[PQR][A-Z]{1,2}\d+$", name):
        raise ValueError(f"{place}: found {name} = {text!r}, expected a number")


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _sign(x: Scalar) -> float:
    return -1.0 if x < 0.0 else 1.0


def _square_tan(x: Scalar) -> Scalar:
    s, c = sin(x), cos(x)
    return s * s / (c * c)


def _argument(bx: Scalar, shape: float, bend: Scalar) -> Scalar:
    """C atan(B x - E (B x - atan(B x))), E at most 1."""
    bend = bend if bend < 1.0 else 1.0 + 0.0 * bend
    return shape * atan(bx - bend * (bx - atan(bx)))


def _weight(
    b: Scalar, shape: float, bend: Scalar, slip: Scalar, shift: Scalar
) -> Scalar:
    """Factor on the force of pure slip by slip in the other direction, 1 at none."""
    with_slip = cos(_argument(b * (slip + shift), shape, bend))
    return with_slip / cos(_argument(b * shift, shape, bend))
