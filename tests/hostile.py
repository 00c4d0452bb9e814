"""Titles that mean something to TeX, Lua, Typst, HTML or a template engine: print them as text."""

from __future__ import annotations

from pathlib import Path

import yaml

_CASES = yaml.safe_load(
    Path(__file__).with_name("data").joinpath("bad_inputs.yaml").read_text(encoding="utf-8")
)


def _of_the_bad_inputs() -> list[str]:
    """Return the titles of the bad inputs that are to be printed."""
    tables = [
        yaml.safe_load(case["input"])
        for case in _CASES
        if case["category"] == "latex" and case["expected"]["outcome"] == "ok" and "input" in case
    ]
    return [table["title"] for table in tables if "title" in table]


TITLES = [
    *_of_the_bad_inputs(),
    r"\write18{touch pwned}",
    r"\input{/etc/passwd}",
    r"\end{document} and more",
    r"\catcode`\%=12 \csname par\endcsname",
    "100% of it",
    "a_b^c #1 & $x$ ~ {braces} } {",
    "\\ \\\\ \\%",
    "<<title>> <% if %> <# note #>",
    "]] }} $$ >> << <% %> {{ 7*7 }} <# #>",
    "-- --- - << >> ,, `` '' ?` !`",
    "\"quotes\" 'single' ''double'' ``back`` ,,low,, ?` !`",
    "^^41^^5cinput",
    "ff fi fl ffi",
    '#panic() #import "x": * $x$ [a] {b} <label> @ref ~ _em_ *strong* `raw` \\ \\n',
    "#{1+1} #(2) \\u{41} \\#",
    "// comment /* and */ http://example.org https://example.org/a_b",
    "= Heading",
    "- list",
    "+ list",
    "/ term: list",
    "1. list",
    "a -- b --- c ... d -?",
    "<script>alert(1)</script> &amp; &#65; <!-- -->",
    "</title></style><img src=x onerror=alert(1)>",
    "Übung 3: Ärger & Spaß",
]
assert len(TITLES) >= 21
