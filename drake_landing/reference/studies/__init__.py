"""The paper's studies: how many modes, which topology, and where the difference lies.

from drake_landing.reference.studies import PLANS, run_study
study = run_study(PLANS["modes"], Path("out/modes"))
"""

from drake_landing.reference.studies.plan import PLANS as PLANS
from drake_landing.reference.studies.plan import Plan as Plan
from drake_landing.reference.studies.runs import Study as Study
from drake_landing.reference.studies.study import run_study as run_study
