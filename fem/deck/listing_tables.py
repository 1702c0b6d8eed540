"""The second place that talks to pyNastran: tables of an OP2 file as text of an F06."""

import logging
from pathlib import Path
from tempfile import TemporaryDirectory


def tables_of(op2: Path) -> str:
    """All tables of points and elements of an OP2 file, in the form of an F06.

    What pyNastran cannot print is left out.
    """
    from pyNastran.op2.op2 import OP2

    quiet = logging.getLogger("fem.listing")
    quiet.addHandler(logging.NullHandler())
    quiet.propagate = False
    model = OP2(log=quiet, debug=None)
    model.read_op2(str(op2), build_dataframe=False)
    with TemporaryDirectory() as folder:
        path = Path(folder, "tables.f06")
        model.write_f06(str(path), quiet=True, is_mag_phase=False)
        return path.read_text()
