"""Hypothesis strategies for valid tables, as text in the long spelling that the oracle reads."""

from __future__ import annotations

from hypothesis import strategies as st

_ANGLES = st.one_of(
    st.sampled_from(["0", "90 deg", "-90 deg", "180 deg", "pi/2", "-pi/3", "270 deg", "45 deg"]),
    st.decimals(-400, 400, places=2, allow_nan=False).map(lambda d: f"{d} deg"),
    st.decimals(-7, 7, places=3, allow_nan=False).map(lambda d: f"{d} rad"),
)
_LENGTHS = st.one_of(
    st.just("0"),
    st.decimals(-2, 2, places=3, allow_nan=False).map(lambda d: f"{d} m"),
    st.integers(-900, 900).map(lambda i: f"{i} mm"),
    st.decimals(-2, 2, places=2, allow_nan=False).map(str),
)
_MOTIONS = st.one_of(
    st.builds("R{}({})".format, st.sampled_from("xyz"), _ANGLES),
    st.builds("T{}({})".format, st.sampled_from("xyz"), _LENGTHS),
)
_SIGNS = st.sampled_from(["{}", "{}", "-{}"])


@st.composite
def tables(draw: st.DrawFn, most: int = 6) -> str:
    """A table of 1 to `most` rows: any mixture of joints, conventions, offsets and signs."""
    values: dict[str, str] = {}
    rows = []
    for number in range(1, draw(st.integers(1, most)) + 1):
        kind = draw(st.sampled_from(["revolute", "revolute", "prismatic", "fixed"]))
        row = {"a": _maybe_named(draw, f"a{number}", values), "alpha": draw(_ANGLES)}
        if kind == "revolute":
            row["theta"] = _offset(draw(_SIGNS).format(f"theta{number}"), draw(_ANGLES))
        else:
            row["theta"] = draw(_ANGLES)
        if kind == "prismatic":
            row["d"] = _offset(draw(_SIGNS).format(f"q{number}"), draw(_LENGTHS))
        else:
            row["d"] = _maybe_named(draw, f"d{number}", values)
        if kind == "fixed":
            row["type"] = "fixed"
        rows.append(row)
    lines = ["name: arm", f"convention: {draw(st.sampled_from(['standard', 'modified']))}"]
    lines.append(f"units: {{length: {draw(st.sampled_from(['m', 'mm', 'cm']))}}}")
    lines.append("joints:")
    lines += [f"  - {{{', '.join(f'{key}: {cell}' for key, cell in row.items())}}}" for row in rows]
    for place in ("base", "tool"):
        word = draw(st.lists(_MOTIONS, max_size=3))
        if word:
            lines.append(f"{place}: [{', '.join(word)}]")
    if values:
        lines.append(f"values: {{{', '.join(f'{name}: {text}' for name, text in values.items())}}}")
    return "\n".join(lines) + "\n"


def _maybe_named(draw: st.DrawFn, name: str, values: dict[str, str]) -> str:
    """Draw a length: a number, a symbol that has a value, or a symbol without one."""
    kind = draw(st.sampled_from(["number", "number", "value", "open"]))
    if kind == "number":
        return draw(_LENGTHS)
    if kind == "value":
        values[name] = draw(_LENGTHS)
    return name


def _offset(variable: str, amount: str) -> str:
    """Add an amount to a variable, if it is not nothing."""
    if amount == "0":
        return variable
    sign = "-" if amount.startswith("-") else "+"
    return f"{variable} {sign} {amount.removeprefix('-')}"
