"""What a subcase selects and asks for."""

from dataclasses import dataclass, field

from fem.deck.control.case_sets import Selection


@dataclass(frozen=True, kw_only=True)
class Subcase:
    """One subcase; set ids are 0 and names '' where the deck selects nothing.

    Attributes:
        temperature: set of temperatures that load (TEMPERATURE(LOAD)).
        initial_temperature: set of TEMPERATURE(INITIAL), the reference of materials
            whose TREF is blank.
        material_temperature: set of TEMPERATURE(MATERIAL).
        meffmass: grid about which effective masses of modes are taken, 0: the origin of
            the basic frame; -1: they are not asked for.
        statsub: static subcase whose load buckles (STATSUB, STATSUB(BUCKLING)).
        preload: static subcase whose load stays (STATSUB(PRELOAD)).
        superelements: those that the subcase is for, 0: the residual structure; None:
            all.
        extseout: it makes an external superelement.
        combination: subcases and factors that SUBCOM or SYMCOM adds up.
        not_carried_out: commands that would change what a solution of the deck's own
            finds and that nothing here carries out, each with its place.
        outputs: quantity (DISPLACEMENT, VELOCITY, ACCELERATION, SPCFORCES, MPCFORCES,
            OLOAD, FORCE, STRESS, STRAIN, GPFORCE, ESE, EKE, EDE, GPKE) to the ids that
            are asked for.
        options: quantity to the words in its parentheses, capitals.
    """

    id: int = 1
    title: str = ""
    subtitle: str = ""
    label: str = ""
    analysis: str = ""
    spc: int = 0
    mpc: int = 0
    load: int = 0
    dload: int = 0
    loadset: int = 0
    ic: int = 0
    tstep: int = 0
    method: int = 0
    suport1: int = 0
    sdamping: int = 0
    frequency: int = 0
    meffmass: int = -1
    nsm: int = 0
    massset: int = 0
    statsub: int = 0
    preload: int = 0
    deform: int = 0
    temperature: int = 0
    initial_temperature: int = 0
    material_temperature: int = 0
    superelements: frozenset[int] | None = None
    extseout: bool = False
    resvec: str = ""
    k2gg: str = ""
    m2gg: str = ""
    b2gg: str = ""
    k2pp: str = ""
    m2pp: str = ""
    b2pp: str = ""
    tfl: int = 0
    nonlinear: int = 0
    p2g: str = ""
    combination: tuple[tuple[int, float], ...] = ()
    not_carried_out: tuple[str, ...] = ()
    outputs: dict[str, Selection] = field(default_factory=dict)
    options: dict[str, tuple[str, ...]] = field(default_factory=dict)
