"""A student's answers against the table that they are about."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property

from sympy import Expr, Symbol

from symdh.errors import UnsupportedError
from symdh.kinematics.answers.equality import Sameness, compare
from symdh.kinematics.answers.expected import Expected
from symdh.kinematics.answers.figures import Written
from symdh.kinematics.answers.measured import judged_number
from symdh.kinematics.answers.near_miss import agrees, near_miss
from symdh.kinematics.answers.numbers import Matrix, Point, close, random_points, value
from symdh.kinematics.answers.rows import judge_rows
from symdh.kinematics.answers.verdicts import (
    Finding,
    JudgedClaim,
    JudgedEntry,
    JudgedSheet,
    Verdict,
)
from symdh.robot import JointType, Robot
from symdh.table.answers import AnswerSheet, Claim, Entry, Jacobian

_POINTS = 4
#: What a rounded number in a formula may change of its value.
_ROUNDED = 2e-3

_MISTAKES = (Verdict.WRONG, Verdict.SIGN, Verdict.SWAPPED)

_BY_NUMBER = "decided by number, to 50 digits"
_POSITIVE = "right where all symbols are positive; decided by number, to 50 digits"
_WITH_VALUES = "with the table's values put in"


def judge(robot: Robot, sheet: AnswerSheet) -> JudgedSheet:
    """Judge a student's answers.

    A formula is right when it equals the right one whatever its form: proven in a polynomial ring
    and confirmed by number. A number is right when the truth rounds, or is cut, to it.

    Raises
    ------
    UnsupportedError
        When a number is claimed and a symbol has no value, or no closed form is small enough.
    """
    judge_claim = _Judge(robot, sheet)
    claims = [judge_claim(claim) for claim in sheet.claims]
    if sheet.rows:
        claims.append(judge_rows(robot, sheet.rows, judge_claim.points))
    return JudgedSheet(sheet.filename, sheet.student, tuple(claims))


class _Judge:
    """Judges claims about one robot."""

    def __init__(self, robot: Robot, sheet: AnswerSheet) -> None:
        self._robot = robot
        self._filename = sheet.filename
        self._values = {s: value(e, {}) for s, e in {**robot.values, **sheet.values}.items()}
        self._expected: dict[object, Expected] = {}

    @cached_property
    def points(self) -> list[dict[Symbol, float]]:
        """Numbers for all symbols."""
        return random_points(self._symbols, {}, _POINTS, self._angles)

    @cached_property
    def _points_with_values(self) -> list[dict[Symbol, float]]:
        """Numbers for all symbols, parameters at the table's values."""
        known = {s: self._values[s] for s in self._robot.parameters if s in self._robot.values}
        return random_points(self._symbols, known, _POINTS, self._angles) if known else []

    @property
    def _angles(self) -> set[Symbol]:
        """The joint angles: what is right for half of their turns alone is wrong."""
        joints = self._robot.joints
        return {j.variable for j in joints if j.variable and j.type is JointType.REVOLUTE}

    @property
    def _symbols(self) -> tuple[Symbol, ...]:
        return (*self._robot.variables, *self._robot.parameters)

    def __call__(self, claim: Claim) -> JudgedClaim:
        """Judge one claim."""
        expected = self._expected.setdefault(claim.subject, Expected(self._robot, claim.subject))
        if isinstance(claim.subject, Jacobian) and expected.formula is None:
            raise self._refused(claim, f"the Jacobian of {self._robot.name} has no closed form")
        if claim.numeric:
            entries, point = self._numeric(claim, expected)
            hint = _numeric_hint(claim, entries, expected, point)
        else:
            entries = [self._formula(entry, expected) for entry in claim.entries]
            hint = self._hint(claim, entries, expected)
        columns = len({entry.column for entry in claim.entries})
        return JudgedClaim(claim.name, tuple(entries), columns, hint)

    def _refused(self, claim: Claim, why: str) -> UnsupportedError:
        place = claim.entries[0].place
        return UnsupportedError(f"{self._filename}:{place.line}:{place.column}: {why}")

    # -- formulas --

    def _formula(self, entry: Entry, expected: Expected) -> JudgedEntry:
        label = f"[{entry.row + 1},{entry.column + 1}]"
        right = expected.entry(entry.row, entry.column)
        if entry.value is None:
            return JudgedEntry(label, entry, Finding(Verdict.BLANK), right)
        if right is None:
            finding = self._by_number_alone(entry.value, entry, expected)
        else:
            finding = self._compared(entry.value, right)
            if finding.verdict is Verdict.WRONG and self._is_rounded(entry, right):
                finding = Finding(Verdict.COARSE, "a number in it is rounded; write it exactly")
        return JudgedEntry(label, entry, finding, right)

    def _is_rounded(self, entry: Entry, right: Expr) -> bool:
        """Say whether a formula with decimals in it is the right one but for rounding."""
        if "." not in entry.text or entry.value is None:
            return False
        for points in filter(None, (self.points, self._points_with_values)):
            pairs = [(value(entry.value, p), value(right, p)) for p in points]
            if all(abs(x - y) <= _ROUNDED * max(1, abs(y)) for x, y in pairs):
                return True
        return False

    def _compared(self, given: Expr, right: Expr) -> Finding:
        found = compare(given, right, self.points)
        if found is not Sameness.DIFFERENT:
            return Finding(Verdict.RIGHT, _NOTES.get(found, ""))
        known = {s: v for s, v in self._robot.values.items() if s in self._robot.parameters}
        if known:
            found = compare(given.xreplace(known), right.xreplace(known), self.points)
            if found is not Sameness.DIFFERENT:
                return Finding(Verdict.RIGHT, _WITH_VALUES)
        for points in (self.points, self._points_with_values):
            slip = near_miss(given, [value(right, p) for p in points], points) if points else None
            if slip is not None:
                return slip
        return Finding(Verdict.WRONG)

    def _by_number_alone(self, given: Expr, entry: Entry, expected: Expected) -> Finding:
        """Judge against a formula that is too large to be written: the chain in numbers."""
        truths = [expected.numbers(point)[entry.row][entry.column] for point in self.points]
        if agrees(given, truths, self.points):
            return Finding(
                Verdict.RIGHT, "decided by number; the closed form is too large to be written"
            )
        return near_miss(given, truths, self.points) or Finding(Verdict.WRONG)

    def _hint(self, claim: Claim, entries: Sequence[JudgedEntry], expected: Expected) -> str:
        """Return the slip that explains a claim with mistakes."""
        if not _needs_hint(entries):
            return ""
        for points in (self.points, self._points_with_values):
            if not points:
                continue
            given = [[_known(entry, p) for p in points] for entry in claim.entries]

            def fits(outcomes: Sequence[Matrix], given: list[list[float | None]] = given) -> bool:
                return all(
                    x is None or close(x, outcome[entry.row][entry.column])
                    for entry, row in zip(claim.entries, given, strict=True)
                    for x, outcome in zip(row, outcomes, strict=True)
                )

            hint = _first_fitting(expected, points, fits, numeric=False)
            if hint:
                return hint
        return ""

    # -- numbers --

    def _numeric(self, claim: Claim, expected: Expected) -> tuple[list[JudgedEntry], Point]:
        missing = [s.name for s in self._symbols if s not in self._values]
        used = {s.name for motion in expected.word for s in motion.amount.free_symbols}
        wanted = [name for name in missing if name in used]
        if wanted:
            names = ", ".join(wanted)
            how = f"write at: {{{wanted[0]}: ...}} under numbers"
            raise self._refused(
                claim, f"{names} {'has' if len(wanted) == 1 else 'have'} no value; {how}"
            )
        point = {s: self._values.get(s, 0.0) for s in self._symbols}
        truth = expected.numbers(point)
        reach = max((abs(row[3]) for row in truth[:3] if len(row) == 4), default=1.0)
        entries = []
        for entry in claim.entries:
            lengthy = entry.column == 3 and entry.row < 3
            size = reach if lengthy and not isinstance(claim.subject, Jacobian) else 1.0
            entries.append(judged_number(entry, truth[entry.row][entry.column], size, point))
        return entries, point


_NOTES = {Sameness.BY_NUMBER: _BY_NUMBER, Sameness.POSITIVE: _POSITIVE}


def _numeric_hint(
    claim: Claim, entries: Sequence[JudgedEntry], expected: Expected, point: Point
) -> str:
    if not _needs_hint(entries):
        return ""
    given = [
        None if entry.value is None else Written.of(entry.text, value(entry.value, point))
        for entry in claim.entries
    ]

    def fits(outcomes: Sequence[Matrix]) -> bool:
        (outcome,) = outcomes
        return all(
            written is None or written.agrees(outcome[entry.row][entry.column])
            for entry, written in zip(claim.entries, given, strict=True)
        )

    return _first_fitting(expected, [point], fits, numeric=True)


def _needs_hint(entries: Sequence[JudgedEntry]) -> bool:
    """Say whether there is a mistake, and enough beside it to tell which slip it was."""
    mistakes = [each for each in entries if each.verdict in _MISTAKES]
    if len(entries) > 1 or not mistakes:
        return bool(mistakes)
    # The wrong sign of one entry says it all; many slips give one.
    return mistakes[0].verdict is not Verdict.SIGN and _tells(mistakes[0].entry)


def _tells(entry: Entry) -> bool:
    """Say whether an entry is so special that it is no accident when a slip gives it."""
    assert entry.value is not None  # a blank is no mistake
    return bool(entry.value.free_symbols) or sum(map(str.isdigit, entry.text)) > 2


def _first_fitting(
    expected: Expected,
    points: Sequence[Point],
    fits: Callable[[Sequence[Matrix]], bool],
    *,
    numeric: bool,
) -> str:
    for slip in expected.slips(numeric):
        if fits([slip.outcome(point) for point in points]):
            return slip.message
    return ""


def _known(entry: Entry, point: Point) -> float | None:
    return None if entry.value is None else value(entry.value, point)
