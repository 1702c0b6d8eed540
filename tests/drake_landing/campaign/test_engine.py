"""Tasks are done in the order of completion, and a cluster without workers is said."""

import pytest

from drake_landing.campaign import engine as module
from drake_landing.campaign.engine import Engine, NoWorkers, Pool, engine
from drake_landing.progress import Silent


def double(x: int) -> int:
    return 2 * x


class _Empty:
    """A cluster whose workers have gone, and the futures that it will never finish."""

    def scheduler_info(self) -> dict:
        return {"workers": {}}

    def count(self) -> int:
        return 1

    def next_batch(self, *, block: bool) -> list:
        assert not block
        return []


def test_a_cluster_without_workers_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_WITHOUT_WORKERS", 0.2)
    with pytest.raises(NoWorkers, match="the same command goes on"):
        list(Engine(_Empty())._completed(_Empty()))


@pytest.mark.parametrize("scheduler", ["here", "local"])
def test_every_task_is_done_once(scheduler: str) -> None:
    def never(task: int, why: str) -> None:
        pytest.fail(f"{task}: {why}")

    with engine(Pool(scheduler=scheduler, workers=1)) as found:
        results = list(found.run(double, list(range(40)), never, Silent()))
    assert sorted(results) == list(range(0, 80, 2))
