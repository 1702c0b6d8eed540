"""The site of pages and reference: it builds, and needs no network to be read."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
LOADED = re.compile(
    r"<(?:script|link|img|iframe)[^>]*?(?:src|href)=[\"']?(\S+?)[\"'\s>]"
)


def test_navigation_has_every_page() -> None:
    text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8").partition("nav:")[2]
    named = set(re.findall(r"\w+\.md", text))
    made = {"index.md", "contributing.md", "changes.md", "case.md"}
    assert named == made | {path.name for path in (ROOT / "docs").glob("*.md")}


@pytest.mark.slow
def test_site_builds_and_is_complete_in_itself(tmp_path: Path) -> None:
    pytest.importorskip("mkdocs")
    pytest.importorskip("mkdocstrings")
    # Strict: links and anchors that lead nowhere are errors.
    build = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "-d"]
    run = subprocess.run(
        [*build, str(tmp_path)], cwd=ROOT, capture_output=True, text=True
    )
    assert run.returncode == 0, run.stderr
    tires = (tmp_path / "reference" / "systems" / "tire.html").read_text()
    assert "systems.tire.tire.Tire" in tires
    assert "cornering_power" in tires
    pages = list(tmp_path.rglob("*.html"))
    assert len(pages) > 40
    for page in pages:
        for link in LOADED.findall(page.read_text(encoding="utf-8")):
            canonical = link.startswith("https://github.com")
            assert canonical or not link.startswith(("http:", "https:", "//")), page
