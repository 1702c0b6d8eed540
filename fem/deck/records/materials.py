"""Materials, and matrices given directly."""

from fem.deck.cards import conversions, dmig, solids
from fem.deck.records.card import Card

_GROUP = "Materials"

RECORDS = (
    Card(
        name="MAT1",
        group=_GROUP,
        fields="mid:i e:f=nan[M/L] g:f=nan[M/L] nu:f=nan rho:f=0.[M/L3] a:f=0. "
        "tref:f=nan ge:f=0. st:f=nan[M/L] sc:f=nan[M/L] ss:f=nan[M/L] mcsid:i=0",
        ids="material",
    ),
    Card(
        name="MAT2",
        group=_GROUP,
        fields="mid:i g11:f=0.[M/L] g12:f=0.[M/L] g13:f=0.[M/L] g22:f=0.[M/L] "
        "g23:f=0.[M/L] g33:f=0.[M/L] rho:f=0.[M/L3] a1:f=0. a2:f=0. a3:f=0. "
        "tref:f=nan ge:f=0. st:f=nan[M/L] "
        "sc:f=nan[M/L] ss:f=nan[M/L] -",
        ids="material",
    ),
    Card(
        name="MAT8",
        group=_GROUP,
        fields="mid:i e1:f[M/L] e2:f[M/L] nu12:f=0. g12:f=0.[M/L] g1z:f=0.[M/L] "
        "g2z:f=0.[M/L] rho:f=0.[M/L3] a1:f=0. a2:f=0. tref:f=nan "
        "xt:f=nan xc:f=nan yt:f=nan yc:f=nan "
        "s:f=nan ge:f=0. f12:f=0.[L2/M2] strn:f=0.",
        ids="material",
        convert=conversions.strengths,
    ),
    # gs: (6, 6) symmetric; alphas: (6,)
    Card(
        name="MAT9",
        group=_GROUP,
        read=solids.mat9,
        more="mid:i gs:*[M/L] rho:f[M/L3] ge:f alphas:* tref:f",
        ids="material",
    ),
    # Of bodies of revolution: radial (X), azimuthal (TH), axial (Z).
    Card(
        name="MAT3",
        group=_GROUP,
        fields="mid:i ex:f[M/L] eth:f[M/L] ez:f[M/L] nuxth:f=0. nuthz:f=0. nuzx:f=0. "
        "rho:f=0.[M/L3] - - gzx:f[M/L] ax:f=0. ath:f=0. az:f=0. tref:f=nan ge:f=0.",
        ids="material",
    ),
    Card(name="MAT11", group=_GROUP, read=solids.mat11, table="MAT9", ids="material"),
    # Complete, both triangles; columns of text and numbers.
    Card(
        name="DMIG",
        group="Matrices",
        gather=dmig.read_dmig,
        more="name:s form:i rowids:*>FREEDOM rowcs:* colids:*>FREEDOM colcs:* values:*",
        convert=conversions.matrix,
    ),
)
