"""KaTeX as it is put into a page: its script, and its style with the fonts inside.

The files under ``templates/html/katex`` are those of the npm package (MIT licence, version in
VERSION), renewed by ``make vendor``; only the fonts that symdh's formulas use are kept.
"""

from __future__ import annotations

import base64
import re
from pathlib import Path

from symdh.resources import templates_dir

_FONT_FACE = re.compile(r"@font-face\{[^}]*\}")


def katex_script() -> str:
    """Return the typesetting script."""
    return (_folder() / "katex.min.js").read_text(encoding="utf-8")


def katex_style() -> str:
    """Return the style sheet; each font that is there is inlined, the others are left out."""
    style = (_folder() / "katex.min.css").read_text(encoding="utf-8")
    return _FONT_FACE.sub(_inlined, style)


def _inlined(face: re.Match[str]) -> str:
    found = re.search(r"url\(fonts/([A-Za-z0-9_-]+\.woff2)\)", face[0])
    path = _folder() / "fonts" / found[1] if found else None
    if path is None or not path.is_file():
        return ""
    data = base64.b64encode(path.read_bytes()).decode("ascii")
    source = f'src:url(data:font/woff2;base64,{data}) format("woff2")'
    return re.sub(r"src:[^}]*", lambda _: source, face[0])


def _folder() -> Path:
    return templates_dir() / "html" / "katex"
