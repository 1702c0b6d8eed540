"""Descriptions of the cards with fields at fixed places (see `regular`)."""

_ORIENTED = "eid:i pid:i=eid ga:i gb:i x1:u=nan x2:f=nan x3:f=nan"
_OFFSETS = "pa:c= pb:c= w1a:f=0. w2a:f=0. w3a:f=0. w1b:f=0. w2b:f=0. w3b:f=0."
_FORCE = "sid:i g:i cid:i=0 {0}:f n1:f=0. n2:f=0. n3:f=0."

LAYOUTS: dict[str, str] = {
    # geometry
    "GRID": "id:i cp:i=0 x1:f=0. x2:f=0. x3:f=0. cd:i=0 ps:c= -",
    "CBAR": f"{_ORIENTED} offt:s=GGG {_OFFSETS}",
    "CBEAM": f"{_ORIENTED} offt:s=GGG {_OFFSETS} sa:i=0 sb:i=0",
    "CROD": "eid:i pid:i=eid g1:i g2:i",
    "CONROD": "eid:i g1:i g2:i mid:i a:f j:f=0. c:f=0. nsm:f=0.",
    "CTUBE": "eid:i pid:i=eid g1:i g2:i",
    "PBAR": (
        "pid:i mid:i a:f=0. i1:f=0. i2:f=0. j:f=0. nsm:f=0. - c1:f=0. c2:f=0. d1:f=0. "
        "d2:f=0. e1:f=0. e2:f=0. f1:f=0. f2:f=0. k1:f=nan k2:f=nan i12:f=0."
    ),
    "PROD": "pid:i mid:i a:f j:f=0. c:f=0. nsm:f=0.",
    "PTUBE": "pid:i mid:i od1:f t:f=nan nsm:f=0. od2:f=od1",
    # scalar and bushing elements
    "CELAS1": "eid:i pid:i=eid g1:i=0 c1:i=0 g2:i=0 c2:i=0",
    "CELAS2": "eid:i k:f g1:i=0 c1:i=0 g2:i=0 c2:i=0 ge:f=0. s:f=0.",
    "CDAMP1": "eid:i pid:i=eid g1:i=0 c1:i=0 g2:i=0 c2:i=0",
    "CDAMP2": "eid:i b:f g1:i=0 c1:i=0 g2:i=0 c2:i=0",
    "CMASS1": "eid:i pid:i=eid g1:i=0 c1:i=0 g2:i=0 c2:i=0",
    "CMASS2": "eid:i m:f g1:i=0 c1:i=0 g2:i=0 c2:i=0",
    "CELAS3": "eid:i pid:i=eid g1:i=0 g2:i=0",
    "CELAS4": "eid:i k:f g1:i=0 g2:i=0",
    "CDAMP3": "eid:i pid:i=eid g1:i=0 g2:i=0",
    "CDAMP4": "eid:i b:f g1:i=0 g2:i=0",
    "CMASS3": "eid:i pid:i=eid g1:i=0 g2:i=0",
    "CMASS4": "eid:i m:f g1:i=0 g2:i=0",
    "PELAS": "(pid:i k:f=0. ge:f=0. s:f=0.)",
    "PDAMP": "(pid:i b:f=0.)",
    "PMASS": "(pid:i m:f=0.)",
    "CVISC": "eid:i pid:i=eid g1:i g2:i",
    "PVISC": "(pid:i ce:f=0. cr:f=0. -)",
    "CBUSH": (
        "eid:i pid:i=eid ga:i gb:i=0 x1:u=nan x2:f=nan x3:f=nan cid:i=-1 s:f=.5 "
        "ocid:i=-1 s1:f=0. s2:f=0. s3:f=0."
    ),
    # masses
    "CONM2": (
        "eid:i g:i cid:i=0 m:f=0. x1:f=0. x2:f=0. x3:f=0. - i11:f=0. i21:f=0. i22:f=0. "
        "i31:f=0. i32:f=0. i33:f=0."
    ),
    # shells
    "CQUAD4": (
        "eid:i pid:i=eid g1:i g2:i g3:i g4:i theta:u=0. zoffs:f=0. - tflag:i=0 "
        "t1:f=nan t2:f=nan t3:f=nan t4:f=nan"
    ),
    "CTRIA3": (
        "eid:i pid:i=eid g1:i g2:i g3:i theta:u=0. zoffs:f=0. - - tflag:i=0 t1:f=nan "
        "t2:f=nan t3:f=nan"
    ),
    "CSHEAR": "eid:i pid:i=eid g1:i g2:i g3:i g4:i",
    "PSHELL": (
        "pid:i mid1:i=0 t:f=nan mid2:i=0 bk:f=1. mid3:i=0 tst:f=.833333 nsm:f=0. "
        "z1:f=nan z2:f=nan mid4:i=0"
    ),
    "PSHEAR": "pid:i mid:i t:f nsm:f=0. f1:f=0. f2:f=0.",
    "PSOLID": "pid:i mid:i cordm:i=0 integ:s= stress:s= isop:s= fctn:s=SMECH",
    # materials
    "MAT1": (
        "mid:i e:f=nan g:f=nan nu:f=nan rho:f=0. a:f=0. tref:f=0. ge:f=0. st:f=nan "
        "sc:f=nan ss:f=nan mcsid:i=0"
    ),
    "MAT2": (
        "mid:i g11:f=0. g12:f=0. g13:f=0. g22:f=0. g23:f=0. g33:f=0. rho:f=0. - - - - "
        "ge:f=0. st:f=nan sc:f=nan ss:f=nan -"
    ),
    "MAT8": (
        "mid:i e1:f e2:f nu12:f=0. g12:f=0. g1z:f=0. g2z:f=0. rho:f=0. - - - xt:f=nan "
        "xc:f=nan yt:f=nan yc:f=nan s:f=nan ge:f=0. f12:f=0. strn:f=0."
    ),
    # constraints
    "RBAR": "eid:i ga:i gb:i cna:c= cnb:c= cma:c= cmb:c= -",
    "SPC": "sid:i (g:i c:c=0 d:f=0.)",
    "SUPORT": "(id:i c:c=0)",
    "ASET": "(id:i c:c=0)",
    "BSET": "(id:i c:c=0)",
    "BNDFIX": "(id:i c:c=0)",
    "QSET": "(id:i c:c=0)",
    # static loads
    "FORCE": _FORCE.format("f"),
    "MOMENT": _FORCE.format("m"),
    "FORCE1": "sid:i g:i f:f g1:i g2:i",
    "MOMENT1": "sid:i g:i m:f g1:i g2:i",
    "FORCE2": "sid:i g:i f:f g1:i g2:i g3:i g4:i",
    "MOMENT2": "sid:i g:i m:f g1:i g2:i g3:i g4:i",
    "SLOAD": "sid:i (id:i f:f)",
    "PLOAD": "sid:i p:f g1:i g2:i g3:i g4:i=0",
    "PLOAD1": "sid:i eid:i type:s scale:s x1:f=0. p1:f=0. x2:f=nan p2:f=0.",
    "GRAV": "sid:i cid:i=0 a:f n1:f=0. n2:f=0. n3:f=0. -",
    "RFORCE": (
        "sid:i g:i=0 cid:i=0 a:f=0. r1:f=0. r2:f=0. r3:f=0. method:i=1 racc:f=0. -"
    ),
    "SPCD": "sid:i (g:i c:c=0 d:f=0.)",
    # dynamic loads
    "DAREA": "sid:i (id:i c:i=0 a:f)",
    "LSEQ": "sid:i exciteid:i lid:i=0 -",
    "TLOAD1": "sid:i exciteid:i delay:u=0 type:s=0 tid:u us0:f=0. vs0:f=0.",
    "TLOAD2": (
        "sid:i exciteid:i delay:u=0 type:s=0 t1:f=0. t2:f f:f=0. p:f=0. c:f=0. b:f=0. "
        "us0:f=0. vs0:f=0."
    ),
    "DELAY": "sid:i (id:i c:i=0 t:f=0.)",
    "TIC": "sid:i id:i c:i=0 u0:f=0. v0:f=0.",
    "EIGRL": (
        "sid:i v1:f=nan v2:f=nan nd:i=0 msglvl:i=0 maxset:i=0 shfscl:f=0. norm:s=MASS"
    ),
    "EIGR": (
        "sid:i method:s f1:f=nan f2:f=nan ne:i=0 nd:i=0 - - norm:s=MASS g:i=0 c:i=0"
    ),
    # partitioned superelements
    "SEBULK": "seid:i type:s rseid:i=0 method:s=AUTO tol:f=1.E-5 loc:s=YES unitno:i=0",
    "PLOTEL": "eid:i g1:i g2:i -",
    # defaults for other cards
    "GRDSET": "- cp:i=0 - - - cd:i=0 ps:c= -",
    "BAROR": "- pid:i=0 - - x1:u=nan x2:f=nan x3:f=nan offt:s=GGG",
    "BEAMOR": "- pid:i=0 - - x1:u=nan x2:f=nan x3:f=nan offt:s=GGG",
    "CORD1R": "(cid:i g1:i g2:i g3:i)",
    "CORD2R": (
        "cid:i rid:i=0 a1:f=0. a2:f=0. a3:f=0. b1:f=0. b2:f=0. b3:f=0. c1:f=0. "
        "c2:f=0. c3:f=0."
    ),
}
for _name, _like in [("CORD1C", "CORD1R"), ("CORD1S", "CORD1R")]:
    LAYOUTS[_name] = LAYOUTS[_like]
for _name in ("CORD2C", "CORD2S"):
    LAYOUTS[_name] = LAYOUTS["CORD2R"]
