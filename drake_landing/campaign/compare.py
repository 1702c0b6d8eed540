"""Two campaigns side by side: what a change of the design made larger or smaller."""

from pathlib import Path

import pandas as pd

from fem.errors import InputError


def read_table(folder: Path, name: str) -> pd.DataFrame:
    """A table of a campaign.

    Raises:
        InputError: the folder holds no such table.
    """
    path = folder / "tables" / f"{name}.parquet"
    if not path.is_file():
        raise InputError(
            f"{folder}: found no {path.relative_to(folder)}, expected the folder of a "
            "campaign that was run to its end"
        )
    return pd.read_parquet(path)


def compare_campaigns(before: Path, after: Path) -> dict[str, pd.DataFrame]:
    """Extremes of both, and their ratio.

    Args:
        before, after: folders of campaigns.

    Returns:
        `components`: index component, columns `before`, `after` (largest equivalent
        stress, Pa), `ratio`, `case_before`, `case_after`. `sections`: index beam,
        station, quantity, columns `before`, `after` (largest magnitude), `ratio`.
        What only one of them has is NaN in the other.
    """
    stress = [
        read_table(f, "components").set_index("component") for f in (before, after)
    ]
    components = pd.DataFrame(
        {
            "before": stress[0].equivalent,
            "after": stress[1].equivalent,
            "case_before": stress[0].case,
            "case_after": stress[1].case,
        }
    )
    keys = ["beam", "station", "quantity"]
    cuts = [read_table(f, "sections").set_index(keys) for f in (before, after)]
    sections = pd.DataFrame(
        {
            name: table[["min", "max"]].abs().max(axis=1)
            for name, table in zip(("before", "after"), cuts)
        }
    )
    for table in (components, sections):
        table["ratio"] = table["after"] / table["before"]
    order = components.ratio.sub(1.0).abs().sort_values(ascending=False).index
    return {"components": components.loc[order], "sections": sections}
