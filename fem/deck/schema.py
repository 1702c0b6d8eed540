"""Column names of the card tables: the language between a deck and the elements.

A deck is read into one pandas table per card. Columns carry the lower-case field names
of the Nastran Quick Reference Guide. Rules for every table:

- the columns `file` and `line` say where the card begins (for messages);
- blank integer fields hold the default of the guide, or 0 where there is none
  (CONM2's CID may be -1);
- blank real fields hold the default of the guide, or NaN where it depends on others;
- columns ending in `s` that are marked `*` below hold one tuple or array per card;
- cards that differ in spelling only share a table (see `ALIASES`).
"""

ALIASES: dict[str, str] = {
    "SPC1": "SPC",  # one row per constrained grid
    "CMASS3": "CMASS1",  # scalar points: component 0
    "CELAS3": "CELAS1",
    "CDAMP3": "CDAMP1",
    "CONROD": "CROD",  # area, J, ... in the row itself, pid 0
    "QSET1": "QSET",
    "ASET1": "ASET",
    "BSET": "ASET",  # a-set with fixed boundary, as reductions here take all of it
    "BSET1": "ASET",
    "BNDFIX": "ASET",
    "BNDFIX1": "ASET",
    "PBARL": "PBAR",  # section properties are computed while reading
    "PBEAML": "PBEAM",
    "PCOMPG": "PCOMP",
}

# name -> columns (without file and line); `*` marks a column of sequences.
COLUMNS: dict[str, str] = {
    # geometry
    "GRID": "id cp x1 x2 x3 cd ps",  # ps: text of digits, '' if none; GRDSET applied
    "SPOINT": "id",
    # type R/C/S; form 1 by grids g1 g2 g3, form 2 by points a b c in frame rid
    "CORD": "cid type form rid g1 g2 g3 a1 a2 a3 b1 b2 b3 c1 c2 c3",
    # one-dimensional elements; orientation: g0 > 0, else the vector x1 x2 x3
    "CBAR": "eid pid ga gb g0 x1 x2 x3 offt pa pb w1a w2a w3a w1b w2b w3b",
    "CBEAM": "eid pid ga gb g0 x1 x2 x3 offt pa pb w1a w2a w3a w1b w2b w3b sa sb",
    "CROD": "eid pid g1 g2 mid a j c nsm",  # the last five for CONROD (pid 0)
    "CTUBE": "eid pid g1 g2",
    "PBAR": "pid mid a i1 i2 j nsm c1 c2 d1 d2 e1 e2 f1 f2 k1 k2 i12",
    # sequences over the stations xxb = 0 ... 1, all stations present
    "PBEAM": (
        "pid mid xxbs* sos* as* i1s* i2s* i12s* js* nsms* c1s* c2s* d1s* d2s* e1s* "
        "e2s* f1s* f2s* k1 k2 s1 s2 nsia nsib cwa cwb m1a m2a m1b m2b n1a n2a n1b n2b"
    ),
    "PROD": "pid mid a j c nsm",
    "PTUBE": "pid mid od1 t nsm od2",
    # scalar and bushing elements; c 0 for a scalar point, g 0 for ground; card: how
    # the element was spelled (CELAS3)
    "CELAS1": "eid pid g1 c1 g2 c2 card",
    "CELAS2": "eid k g1 c1 g2 c2 ge s card",
    "CDAMP1": "eid pid g1 c1 g2 c2 card",
    "CDAMP2": "eid b g1 c1 g2 c2 card",
    "CMASS1": "eid pid g1 c1 g2 c2 card",
    "CMASS2": "eid m g1 c1 g2 c2 card",
    "PELAS": "pid k ge s",
    "PDAMP": "pid b",
    "PMASS": "pid m",
    "CVISC": "eid pid g1 g2",
    "PVISC": "pid ce cr",
    "CBUSH": "eid pid ga gb g0 x1 x2 x3 cid s ocid s1 s2 s3",  # cid -1: blank
    # k, b, ge per component (6,), 0 where blank; k and b 'RIGID' is refused
    # sa st ea et: stress and strain coefficients (RCV)
    "PBUSH": "pid ks* bs* ges* mass sa st ea et",
    # masses
    "CONM1": "eid g cid ms*",  # ms: (6, 6) symmetric
    "CONM2": "eid g cid m x1 x2 x3 i11 i21 i22 i31 i32 i33",
    # shells; ts: thickness at the corners (NaN: from the property)
    "CQUAD4": "eid pid g1 g2 g3 g4 theta mcid zoffs t1 t2 t3 t4 tflag",  # mcid -1 none
    "CTRIA3": "eid pid g1 g2 g3 theta mcid zoffs t1 t2 t3 tflag",
    "CSHEAR": "eid pid g1 g2 g3 g4",
    "PSHELL": "pid mid1 t mid2 bk mid3 tst nsm z1 z2 mid4",
    "PCOMP": "pid z0 nsm sb ft tref ge lam mids* ts* thetas* souts* plies*",
    "PSHEAR": "pid mid t nsm f1 f2",
    # solids; nodes: (n,) with 0 for absent mid-side nodes
    "CHEXA": "eid pid nodes*",
    "CPENTA": "eid pid nodes*",
    "CTETRA": "eid pid nodes*",
    "CPYRAM": "eid pid nodes*",
    "PSOLID": "pid mid cordm integ stress isop fctn",  # cordm -1: element, 0: basic
    # materials
    "MAT1": "mid e g nu rho a tref ge st sc ss mcsid",
    "MAT2": "mid g11 g12 g13 g22 g23 g33 rho ge st sc ss",
    "MAT8": "mid e1 e2 nu12 g12 g1z g2z rho xt xc yt yc s ge f12 strn",
    "MAT9": "mid gs* rho ge",  # gs: (6, 6) symmetric
    # non-structural mass; type PSHELL, PBAR, ..., ELEMENT; ids of that type
    "NSM": "sid type ids* values*",  # NSM and NSM1: per length or area
    "NSML": "sid type ids* value",  # NSML and NSML1: lumped total
    "NSMADD": "sid sets*",
    # rigid elements and constraints; components as text of digits
    "RBE2": "eid gn cm gms*",
    # weights, components and grids: parallel sequences, one entry per (weight, grid)
    "RBE3": "eid refgrid refc weights* comps* grids* umgrids* umcomps*",
    "RBAR": "eid ga gb cna cnb cma cmb",
    "MPC": "sid grids* comps* coefficients*",  # comps: integers, 0 for a scalar point
    "MPCADD": "sid sets*",
    "SPC": "sid g c d",  # c text of digits ('0' scalar point), d enforced value
    "SPCADD": "sid sets*",
    "SUPORT": "id c",
    "ASET": "id c",
    "QSET": "id c",
    # direct input matrices: complete, both triangles; columns of text and numbers
    "DMIG": "name form rowids* rowcs* colids* colcs* values*",
    # static loads
    "FORCE": "sid g cid f n1 n2 n3",
    "MOMENT": "sid g cid m n1 n2 n3",
    "FORCE1": "sid g f g1 g2",
    "MOMENT1": "sid g m g1 g2",
    "FORCE2": "sid g f g1 g2 g3 g4",
    "MOMENT2": "sid g m g1 g2 g3 g4",
    "SLOAD": "sid id f",
    "PLOAD": "sid p g1 g2 g3 g4",
    "PLOAD1": "sid eid type scale x1 p1 x2 p2",
    "PLOAD2": "sid p eids*",
    "PLOAD4": "sid eids* p1 p2 p3 p4 g1 g34 cid n1 n2 n3 sorl ldir",
    "GRAV": "sid cid a n1 n2 n3",
    "ACCEL1": "sid cid a n1 n2 n3 grids*",
    "RFORCE": "sid g cid a r1 r2 r3 method racc",
    "SPCD": "sid g c d",
    "LOAD": "sid s scales* lids*",
    # dynamic loads
    "DAREA": "sid id c a",
    "LSEQ": "sid exciteid lid",
    "DLOAD": "sid s scales* lids*",
    "TLOAD1": "sid exciteid delayid delay type tid us0 vs0",  # type LOAD, DISP, ...
    "TLOAD2": "sid exciteid delayid delay type t1 t2 f p c b us0 vs0",
    "DELAY": "sid id c t",
    "TABLED1": "tid xaxis yaxis xs* ys* extrap",
    "TIC": "sid id c u0 v0",
    "TSTEP": "sid counts* steps* outputs*",
    "EIGRL": "sid v1 v2 nd msglvl maxset shfscl norm",
    "TABDMP1": "tid type fs* gs*",
    # partitioned superelements: SEBULK in the main section, grids joined by SECONCT
    "SEBULK": "seid type",
    "SECONCT": "sea seb gidas* gidbs*",
    # output only
    "PLOTEL": "eid g1 g2",
}
