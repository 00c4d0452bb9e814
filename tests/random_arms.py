"""Tables of random arms that have a closed form, for the tests of inverse kinematics."""

from __future__ import annotations

import random
from dataclasses import dataclass, field

#: Twists of links as arms have them.
_TWISTS = ("0", "90 deg", "-90 deg", "180 deg")
_ACROSS = ("90 deg", "-90 deg")


@dataclass
class Row:
    """One row: what its joint does, whether it has a and d, its twist.

    Attributes
    ----------
    kind : str
        R, P, or F for a fixed row.
    a, d : bool
    alpha : str
    """

    kind: str
    a: bool = False
    d: bool = False
    alpha: str = "0"


@dataclass
class Table:
    """A table in the making."""

    name: str
    drawn: random.Random
    rows: list[Row]
    values: dict[str, str] = field(default_factory=dict)
    ends: bool = False

    def text(self) -> str:
        """Return the YAML; in a modified table a row has a and alpha of the one before."""
        drawn = self.drawn
        convention = drawn.choice(("standard", "modified"))
        links = [(row.a, row.alpha) for row in self.rows]
        if convention == "modified":
            links = [(False, "0"), *links[:-1]]
        lines = [
            f"name: {self.name}",
            f"convention: {convention}",
            "units: {angle: deg, length: m}",
            "joints:",
        ]
        for k, (row, (a, alpha)) in enumerate(zip(self.rows, links, strict=True), start=1):
            cells = {
                "theta": self._variable(k, turns=True) if row.kind == "R" else self._turn(),
                "d": self._variable(k, turns=False) if row.kind == "P" else self._d(row, k),
                "a": self._length(f"a{k}") if a else "0",
                "alpha": self._alpha(k, alpha),
            }
            lines.append("  - {" + ", ".join(f"{key}: {x}" for key, x in cells.items()) + "}")
        if self.ends:
            lines.append("base: [Tz(0.4), Rx(30 deg)]")
            lines.append("tool: [Rz(40 deg), Tx(0.2), Rx(90 deg)]")
        known = ", ".join(f"{name}: {value}" for name, value in self.values.items())
        lines.append(f"values: {{{known}}}")
        return "\n".join(lines) + "\n"

    def _variable(self, k: int, *, turns: bool) -> str:
        name = f"{'theta' if turns else 'q'}{k}"
        offsets = ("90 deg", "-90 deg", "180 deg", "30 deg") if turns else ("0.2", "-0.1")
        style = self.drawn.random()
        if style < 0.7:
            return name
        offset = self.drawn.choice(offsets)
        return f"{offset} - {name}" if style > 0.85 else f"{name} + {offset}"

    def _turn(self) -> str:
        return self.drawn.choice(("0", "0", "90 deg", "-90 deg"))

    def _d(self, row: Row, k: int) -> str:
        return self._length(f"d{k}") if row.d else "0"

    def _length(self, name: str) -> str:
        number = f"{self.drawn.choice((1, 1, 1, -1)) * self.drawn.uniform(0.1, 0.8):.3f}"
        if self.drawn.random() < 0.25:
            return number
        self.values[name] = number
        return name

    def _alpha(self, k: int, alpha: str) -> str:
        if alpha != "?":
            return alpha
        angle = self.drawn.choice(("37 deg", "-60 deg", "45 deg"))
        if self.drawn.random() < 0.5:
            return angle
        self.values[f"alpha{k}"] = angle
        return f"alpha{k}"


def wrist_arm(seed: int) -> str:
    """Return a table with three joints of any kind and a spherical wrist."""
    drawn = random.Random(seed)
    kinds = drawn.choice(("RRR", "RRR", "RRP", "RPR", "PRR", "RPP", "PRP", "PPR", "PPP"))
    twists = [drawn.choice(_ACROSS), drawn.choice(("0", *_ACROSS)), drawn.choice(_ACROSS)]
    if drawn.random() < 0.15:
        twists[drawn.randrange(3)] = "?"
    rows = [
        Row(kind, drawn.random() < 0.5, drawn.random() < 0.5, twist)
        for kind, twist in zip(kinds, twists, strict=True)
    ]
    rows += [
        Row("R", False, drawn.random() < 0.6, drawn.choice(_ACROSS)),
        Row("R", False, False, drawn.choice(_ACROSS)),
        Row("R", drawn.random() < 0.3, drawn.random() < 0.7, drawn.choice(_TWISTS)),
    ]
    return Table(f"wrist_{seed}", drawn, rows, ends=drawn.random() < 0.2).text()


def parallel_arm(seed: int) -> str:
    """Return a table with six revolute joints, the axes of 2, 3 and 4 parallel."""
    drawn = random.Random(seed)
    rows = [
        Row("R", drawn.random() < 0.4, drawn.random() < 0.6, drawn.choice(_ACROSS)),
        Row("R", True, drawn.random() < 0.3, drawn.choice(("0", "0", "180 deg"))),
        Row("R", True, drawn.random() < 0.3, drawn.choice(("0", "0", "180 deg"))),
        Row("R", False, drawn.random() < 0.7, drawn.choice(_ACROSS)),
        Row("R", False, drawn.random() < 0.7, drawn.choice(_ACROSS)),
        Row("R", drawn.random() < 0.3, drawn.random() < 0.7, drawn.choice(_TWISTS)),
    ]
    return Table(f"parallel_{seed}", drawn, rows, ends=drawn.random() < 0.2).text()


#: Arms with fewer joints, by kinds and twists; a question mark is a twist that is no right angle.
_FEW = (
    ("RR", "0 0"), ("RP", "90 0"), ("PR", "0 0"), ("PP", "90 0"),
    ("RRR", "0 0 0"), ("RRR", "90 0 0"), ("RRP", "90 90 0"), ("RPR", "90 90 0"),
    ("PRR", "0 0 0"), ("PRR", "90 0 0"), ("PPP", "90 90 0"), ("RPP", "0 90 0"), ("RRR", "90 90 0"),
    ("RRRR", "90 0 0 0"), ("RRPR", "0 0 0 0"), ("RPRR", "0 90 0 0"), ("RRFR", "90 0 90 0"),
    ("RRRRR", "90 0 0 90 0"), ("PRRRR", "0 0 90 90 0"), ("RRRFRR", "90 0 0 90 90 0"),
    ("RRRRR", "90 90 90 90 0"), ("RRPRR", "90 90 0 90 0"), ("RRRRR", "90 0 90 90 0"),
    ("RRR", "? 0 0"), ("RRP", "90 ? 0"),
)  # fmt: skip


def short_arm(seed: int) -> str:
    """Return a table with two to five joints that move."""
    drawn = random.Random(seed)
    kinds, twists = _FEW[seed % len(_FEW)]
    rows = []
    for kind, twist in zip(kinds, twists.split(), strict=True):
        turned = drawn.choice(_ACROSS) if twist == "90" else twist
        rows.append(Row(kind, drawn.random() < 0.6, drawn.random() < 0.4, turned))
    if all(not row.a and not row.d for row in rows):
        rows[-1].a = True
    return Table(f"short_{seed}", drawn, rows, ends=drawn.random() < 0.1).text()
