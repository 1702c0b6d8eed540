"""The page in a real browser: nothing is wider than its page, and it prints whole."""

import re
import shutil
import subprocess
import tempfile
from pathlib import Path

import pandas as pd
import pytest

from drake_landing.report.page import (
    Block,
    Page,
    Section,
    pairs_block,
    table_block,
    write_page,
)
from drake_landing.report.pdf import browser, write_pdf
from drake_landing.report.svg_plots import panels, svg
from fem.errors import InputError

_MEASURE = """<script>addEventListener("load", () => {
  const width = document.documentElement.clientWidth;
  const wide = [...document.body.querySelectorAll("*")].filter(e => {
    const box = e.getBoundingClientRect();
    return !(e instanceof SVGElement) && getComputedStyle(e).position != "absolute"
      && !e.parentElement.closest(".picture")
      && box.width > 0 && (box.right > width + 1 || box.left < -1);
  });
  // Pictures are drawn 691 px wide: narrower, their words could not be read.
  wide.push(...[...document.querySelectorAll("figure svg")]
    .filter(e => e.getBoundingClientRect().width < 650));
  document.title = document.documentElement.scrollWidth <= width
    ? wide.map(e => e.tagName + e.textContent.slice(0, 30)).join("|") : "scrolls";
});</script>"""


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """As the report is at its widest: long names, many columns, long sentences."""
    columns = {f"quantity {i} kN m": f"q{i}" for i in range(13)}
    row = {name: -12345.678 for name in columns.values()}
    table = pd.DataFrame(
        [{**row, "q0": "fuselage_frame_between_stations_12_and_13"}] * 9
    )
    heads = {name: head for head, name in columns.items()}
    path = tmp_path_factory.mktemp("page") / "report.html"
    with panels(1, 3) as (figure, _):
        picture = svg(figure, "three panels")
    write_page(
        path,
        Page(
            name='tiny "}</style><b>',
            title="A landing",
            story="Touched down. " * 20,
            key_figures=[("largest", "1.0 kN (main, 0.1 s)")] * 5,
            sections=[
                Section(
                    id="a",
                    title="Tables",
                    blocks=[
                        pairs_block([("modes", "word " * 80), ("sha", "f" * 200)]),
                        table_block(table, heads, {n: ".3f" for n in row}, "Wide"),
                        table_block(table, heads, {}, "Folded", fold=True),
                        Block(caption="Text", pre="x" * 300 + "\nlast of the folded"),
                        Block(items=["notice " * 40]),
                        Block(svg=picture, caption="Picture"),
                    ],
                )
            ],
        ),
    )
    return path


@pytest.fixture(scope="module")
def chromium() -> str:
    try:
        return browser()
    except InputError as error:
        pytest.skip(str(error))


@pytest.mark.parametrize("width", [1400, 800, 400])
def test_no_element_is_wider_than_its_page(
    page: Path, chromium: str, width: int
) -> None:
    # Windows of a headless browser are 500 px wide at least; frames are not.
    text = page.read_text().replace("</body>", _MEASURE + "</body>")
    # The page runs no scripts; the one that measures must.
    text = re.sub('<meta http-equiv="Content-Security-Policy".*?>', "", text)
    with tempfile.TemporaryDirectory() as folder:
        inner, outer = Path(folder, "inner.html"), Path(folder, "outer.html")
        inner.write_text(text)
        outer.write_text(
            f'<iframe src="inner.html" style="border:0;width:{width}px;height:900px">'
            "</iframe><script>addEventListener('load', () => setTimeout(() => {"
            "document.title = 'found:' + frames[0].document.title}, 50))</script>"
        )
        done = subprocess.run(
            [chromium, "--headless", "--no-sandbox", "--disable-gpu", "--dump-dom",
             "--disable-background-networking", "--allow-file-access-from-files",
             "--virtual-time-budget=5000", "--window-size=1500,1000",
             f"--user-data-dir={folder}/profile", outer.as_uri()],
            capture_output=True, text=True, timeout=120, check=True,
        )  # fmt: skip
    found = re.search("<title>(.*?)</title>", done.stdout, re.DOTALL)
    assert found is not None
    assert found[1] == "found:"


def test_it_prints_with_what_is_folded(
    page: Path, chromium: str, tmp_path: Path
) -> None:
    write_pdf(page, tmp_path / "report.pdf")
    assert [p.name for p in tmp_path.iterdir()] == ["report.pdf"]
    reader = shutil.which("pdftotext")
    if reader is None:
        pytest.skip("pdftotext is not there")
    command = [reader, "-bbox", tmp_path / "report.pdf", "-"]
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    # All values of both tables, within the page; what was folded; page numbers.
    width = float(re.findall(r'<page width="([\d.]+)"', text)[0])
    right = [float(x) for x in re.findall(r'xMax="([\d.]+)"', text)]
    assert max(right) < width - 10.0
    assert text.count(">-12345.678<") == 2 * 9 * 12
    assert ">folded<" in text
    assert re.search(r">page</word>\s*<word [^>]*>1</word>", text)


def test_a_name_cannot_leave_the_style(page: Path) -> None:
    head = page.read_text().split("</head>")[0]
    assert head.count("<style>") == head.count("</style>") == 1
    assert "<b>" not in head


def test_no_browser_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DRAKE_LANDING_BROWSER", "no-such-browser")
    with pytest.raises(InputError, match="no-such-browser"):
        browser()
