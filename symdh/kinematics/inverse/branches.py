"""What the branches of a closed form are called: the side of the arm that each of them gives.

The names are found by trial. At a few random poses every solution is worked out and looked at; a
step tells a feature of the arm apart where its two values have it on different sides at each of
them. Which value is which may depend on the steps before, as the elbow does on the shoulder; then
the names belong to the branches of those steps together.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from sympy import Expr, Float, Symbol

from symdh.kinematics.inverse.lengths import drawn_lengths
from symdh.kinematics.inverse.numeric import Solver
from symdh.kinematics.inverse.posture import Feature, Skeleton, features
from symdh.kinematics.inverse.solution import ClosedForm, Rule, Step

_POSES = 30
#: At fewer poses than this, with both values of a step, nothing is concluded.
_ENOUGH = 4


@dataclass(frozen=True)
class Branching:
    """What the values of one step are called.

    Attributes
    ----------
    step : Step
    feature : Feature or None
        What tells its values apart; None where the arm shows nothing.
    names : tuple of str
        Of each value, where it always is the same one; else empty.
    """

    step: Step
    feature: Feature | None
    names: tuple[str, ...]

    def name(self, branch: int, q: Sequence[float]) -> str:
        """Return the name of a solution's branch."""
        return self.feature.name(q) if self.feature is not None else self.names[branch]


@dataclass(frozen=True)
class Branches:
    """The branching steps of a closed form and what their values are called.

    Attributes
    ----------
    steps : tuple of Branching
    together : mapping of tuple of int to tuple of str
        The names of each combination of branches; empty where they depend on the goal, or where
        none of the trials had it.
    assumed : bool
        Whether lengths without a value were taken as positive.
    """

    steps: tuple[Branching, ...]
    together: Mapping[tuple[int, ...], tuple[str, ...]]
    assumed: bool

    def of(self, unknown: int) -> Branching | None:
        """Return what the values of an unknown are called; None where it has one."""
        return next((each for each in self.steps if each.step.unknown == unknown), None)

    def names(self, branches: Sequence[int], q: Sequence[float]) -> tuple[str, ...]:
        """Return the names of a solution's branches."""
        pairs = zip(self.steps, branches, strict=True)
        return tuple(each.name(branch, q) for each, branch in pairs)


@dataclass(frozen=True)
class _Seen:
    """One solution of a trial: its pose, the branches that it took, on which sides its features."""

    pose: int
    branches: tuple[int, ...]
    sides: tuple[bool, ...]


def branches_of(form: ClosedForm, values: Mapping[Symbol, Expr] | None = None) -> Branches:
    """Return what the branches of a closed form are called.

    Parameters
    ----------
    form : ClosedForm
    values : mapping of Symbol to Expr, optional
        Numbers for parameters and locked joints, which win over the table's own; those that have
        none are drawn, positive.
    """
    given = form.arm.given
    known = {**given.values, **(values or {})}
    drawn = random.Random(12)
    numbers = {s: v for s, v in known.items() if s in given.parameters}
    lengths = drawn_lengths(replace(given, values=numbers), drawn, 0.4, 1.6)
    numbers |= {symbol: Float(x, 17) for symbol, x in lengths.items()}
    # At zero, where locked joints are by default, an arm may be in a special position.
    held = {v: known.get(v, Float(drawn.uniform(0.4, 1.6), 17)) for v in form.arm.locked}
    if not form.branching:
        return Branches((), {}, False)
    solver = Solver(form, {**numbers, **held})
    skeleton = Skeleton(form, numbers)
    shown = features(form, skeleton, solver.judge.random_values(drawn))
    seen = _trials(solver, shown, drawn)
    steps, used = [], set[int]()
    for place, step in enumerate(form.branching):
        left = [k for k in range(len(shown)) if k not in used]
        # A side has two names; the four roots of a quartic have none of them for their own.
        told = _told_apart(seen, place, left) if step.branches == 2 else None
        used |= set() if told is None else {told}
        feature = None if told is None else shown[told]
        if feature is None or told is None:
            names = _plain_names(form, step)
        else:
            names = _fixed_names(seen, place, told, feature)
        steps.append(Branching(step, feature, names))
    places = [None if each.feature is None else shown.index(each.feature) for each in steps]
    return Branches(tuple(steps), _together(seen, steps, places), bool(lengths))


def _trials(solver: Solver, shown: Sequence[Feature], drawn: random.Random) -> list[_Seen]:
    seen = []
    for pose in range(_POSES):
        goal = solver.judge.chain.pose(solver.judge.random_values(drawn))
        for answer in solver.solve(goal):
            sides = tuple(feature.measure(answer.q) >= 0 for feature in shown)
            seen.append(_Seen(pose, answer.branches, sides))
    return [each for each in seen if len(each.branches) == len(solver.solution.branching)]


def _told_apart(seen: Sequence[_Seen], place: int, candidates: Sequence[int]) -> int | None:
    """Return the first feature that differs between the values of a step, and by nothing later."""
    for feature in candidates:
        sides: dict[tuple[int, tuple[int, ...]], dict[int, set[bool]]] = {}
        for each in seen:
            before = sides.setdefault((each.pose, each.branches[:place]), {})
            before.setdefault(each.branches[place], set()).add(each.sides[feature])
        settled = all(len(found) == 1 for group in sides.values() for found in group.values())
        both = [group for group in sides.values() if len(group) == 2]
        if settled and len(both) >= _ENOUGH and all(g[0] != g[1] for g in both):
            return feature
    return None


def _fixed_names(seen: Sequence[_Seen], place: int, told: int, feature: Feature) -> tuple[str, ...]:
    """Return the names of the values of a step where each always has the same one."""
    sides = [{each.sides[told] for each in seen if each.branches[place] == b} for b in (0, 1)]
    if any(len(found) != 1 for found in sides):
        return ()
    return tuple(feature.names[0 if found.pop() else 1] for found in sides)


def _together(
    seen: Sequence[_Seen], steps: Sequence[Branching], places: Sequence[int | None]
) -> dict[tuple[int, ...], tuple[str, ...]]:
    """Return the names of each combination of branches that always has the same ones."""
    met: dict[tuple[int, ...], set[tuple[str, ...]]] = {}
    for each in seen:
        names = []
        for step, place, branch in zip(steps, places, each.branches, strict=True):
            feature = step.feature
            if feature is None or place is None:
                names.append(step.names[branch])
            else:
                names.append(feature.names[0 if each.sides[place] else 1])
        met.setdefault(each.branches, set()).add(tuple(names))
    return {branches: names.pop() for branches, names in met.items() if len(names) == 1}


def _plain_names(form: ClosedForm, step: Step) -> tuple[str, ...]:
    """Name the values of a step by its formula, where the arm shows no difference."""
    name = str(form.ring.unknown_expression(step.unknown))
    if step.rule is Rule.COSINE:
        return f"{name} positive", f"{name} negative"
    if step.rule is Rule.HALF_ANGLE:
        return tuple(f"{name} root {k}" for k in range(1, step.branches + 1))
    return f"{name} (1)", f"{name} (2)"
