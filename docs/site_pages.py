"""Pages of the site that are made when it is built: a hook of mkdocs.

README, CONTRIBUTING and CHANGELOG stand at the root of the repository; all fields of a
case come from its schema (`case_page`); the reference has a page for each room, with
the docstrings of its modules. Systems that Drake makes for several scalars exist at run
time only: their docstrings are taken from there.
"""

import inspect
import re
import sys
from collections.abc import Iterator
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

import systems

sys.path.insert(0, str(Path(__file__).parent))
from case_page import case_page

ROOT = Path(__file__).parents[1]
PACKAGES = ("drake_landing", "systems", "fem")
_AT_ROOT = {
    "README.md": "index.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changes.md",
}
# The search is a dialog without a name, its switch a box without one; code would
# scroll, by the mouse alone; links in text differ by color alone; comments in code are
# too pale; wide tables, which the theme wraps when the page is there, scroll by the
# mouse alone; drawings made of characters must not be wrapped as code is; words in
# pictures could not be read on narrow screens.
_PALE = ("comment", "operator", "punctuation", "generic", "variable")
_STYLE = (
    "<style>.md-typeset :is(p,li,td) a{text-decoration:underline}"
    ".md-typeset pre>code{white-space:pre-wrap;overflow-wrap:anywhere}"
    "[data-md-color-scheme=default]{"
    + "".join(f"--md-code-hl-{name}-color:#5c5c5c;" for name in _PALE)
    + "}@media(max-width:600px){.md-typeset p:has(>img:only-child){overflow-x:auto}"
    ".md-typeset p>img:only-child{width:700px;max-width:none}"
    ".md-typeset p>img[src$=svg]:only-child{width:1100px}}</style></head>"
)
_WHEN_LOADED = (
    '<script>addEventListener("load",()=>{const all=s=>document.querySelectorAll(s);'
    'for(const e of all(".md-typeset__scrollwrap,p:has(>img:only-child)"))e.tabIndex=0;'
    'for(const e of all("pre>code"))if(/[\u2500-\u257f]/.test(e.textContent)){'
    'e.style.whiteSpace="pre";e.tabIndex=0}})</script></body>'
)
_ACCESSIBLE = {
    "</body>": _WHEN_LOADED,
    'data-md-component="search" role="dialog"': 'data-md-component="search" '
    'role="dialog" aria-label="Search"',
    'id="__search"': 'id="__search" aria-label="Search"',
    'id="__drawer"': 'id="__drawer" aria-label="Navigation"',
    "</head>": _STYLE,
}
_CODE = re.compile(r"`[^`\n]+`")
_LINK = re.compile(r"(?<!!)\[([^\]]+)\]\(([^)\s]+)\)")


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """The reference goes to the end of the navigation."""
    reference = [
        {package: [{name: page} for name, page, _ in _rooms(package)]}
        for package in PACKAGES
    ]
    assert config.nav is not None
    config.nav.append({"Reference": reference})
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Adds what is not a file of the folder of pages."""
    for source, page in _AT_ROOT.items():
        text = (ROOT / source).read_text(encoding="utf-8")
        files.append(File.generated(config, page, content=_from_root(text)))
    files.append(File.generated(config, "case.md", content=case_page()))
    for package in PACKAGES:
        for _, page, modules in _rooms(package):
            content = "\n\n".join(_reference(modules))
            files.append(File.generated(config, page, content=content))
    return files


def on_post_page(output: str, **_: object) -> str:
    """What the theme leaves out for screen readers, keyboards and weak eyes."""
    for old, new in _ACCESSIBLE.items():
        output = output.replace(old, new)
    return output


def on_post_template(output: str, template_name: str, **_: object) -> str:
    """The same for the page that is shown where none is."""
    return on_post_page(output) if template_name == "404.html" else output


def on_page_markdown(markdown: str, **_: object) -> str:
    """Pages link files of the repository that the site does not have: their names.

    Bars within code, which GitHub wants escaped in tables, are none of the table here.
    """
    markdown = _CODE.sub(lambda code: code[0].replace("\\|", "|"), markdown)
    return _LINK.sub(_kept, markdown)


def _from_root(text: str) -> str:
    """Links and pictures seen from the folder of pages."""
    for source, page in _AT_ROOT.items():
        text = text.replace(f"]({source})", f"]({page})")
    return text.replace("](docs/", "](")


def _kept(match: re.Match[str]) -> str:
    text, target = match.groups()
    path = target.split("#")[0]
    inside = not path or "://" in target or path.endswith((".md", ".png", ".svg"))
    return match[0] if inside and not path.startswith("../") else f"`{text.strip('`')}`"


def _rooms(package: str) -> Iterator[tuple[str, str, list[str]]]:
    """Name, page and modules of each room; modules beside the rooms come first."""
    folder = ROOT / package
    alone = [p for p in sorted(folder.glob("*.py")) if not p.stem.startswith("_")]
    yield package, f"reference/{package}/index.md", [package, *map(_module, alone)]
    for room in sorted(p for p in folder.iterdir() if (p / "__init__.py").exists()):
        files = [p for p in sorted(room.rglob("*.py")) if not p.stem.startswith("_")]
        page = f"reference/{package}/{room.name}.md"
        yield room.name, page, [_module(room), *map(_module, files)]


def _module(path: Path) -> str:
    return ".".join(path.relative_to(ROOT).with_suffix("").parts)


def _reference(modules: list[str]) -> Iterator[str]:
    yield f"# {modules[0]}"
    yield f"::: {modules[0]}\n    options: {{members: false, show_root_heading: false}}"
    for module in modules[1:]:
        yield f"## {module.split('.', 1)[1]}"
        yield from _templated(module)
        yield f"::: {module}\n    options: {{show_root_heading: false}}"


def _templated(module: str) -> Iterator[str]:
    """Systems of a module that are made from a template."""
    for name in systems.__all__:
        system = getattr(systems, name.removesuffix("_"), None)
        if name.endswith("_") and system.__module__ == module:
            signature = f"{name.removesuffix('_')}{inspect.signature(system)}"
            yield f"### {module}.{name.removesuffix('_')}"
            yield f"```python\n{signature}\n```"
            yield inspect.getdoc(system) or ""
