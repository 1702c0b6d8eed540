"""Drake systems of a landing: tires, shock absorbers, gears, the flexible airframe.

    from systems import FlexibleAirframe, ShockAbsorber, Tire

Each is a LeafSystem whose ports stand in its docstring; its law is a pure function
beside it. Wrenches are [torque; force], spatial velocities [angular; linear], as in
Drake; SI units; world frame W with z up, airframe frame B.

Names are imported when they are first used.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
