"""Tables as CSV files, written aside and then renamed."""

from pathlib import Path

import pandas as pd

from fem.files.atomic import write_aside
from fem.files.escaping import cell


def write_csv(path: Path, table: pd.DataFrame, *, index: bool = False) -> None:
    """Nine significant digits, zero without a sign; NaN is an empty cell.

    Text that a spreadsheet would compute gets a `'` before it.
    """
    plain = table.copy()
    floats = plain.select_dtypes("floating").columns
    plain[floats] = plain[floats] + 0.0  # -0.0 + 0.0 is 0.0
    for name in plain.columns[
        [not pd.api.types.is_numeric_dtype(t) for t in plain.dtypes]
    ]:
        plain[name] = [cell(v) if isinstance(v, str) else v for v in plain[name]]
    plain.columns = [cell(str(name)) for name in plain.columns]
    write_aside(path, lambda to: plain.to_csv(to, index=index, float_format="%.9g"))
