"""Trigonometric polynomials in short form: parallel joints turn by their sum.

``c_2 c_3 - s_2 s_3`` is ``c_23`` where axes 2 and 3 are parallel. For a run of parallel axes the
sums of neighbours are as good a set of angles as the joint angles themselves; each coefficient is
written in the set, or as a sum of single cosines and sines, that takes the fewest terms.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from sympy import Add, Expr, Mul, Rational, cos, sin

from symdh.kinematics.singular.screws import direction
from symdh.kinematics.singular.trig_ring import Element, TrigRing
from symdh.kinematics.velocity import axis_frame
from symdh.robot import JointType, Robot

#: A run longer than this is read in its own joint angles and their sums to single functions only.
_LONGEST = 3

Terms = dict[Expr, Rational]


@dataclass(frozen=True, slots=True)
class Run:
    """Revolute joints with parallel axes: places in `TrigRing.angles`, and each one's sense."""

    angles: tuple[int, ...]
    senses: tuple[int, ...]


def parallel_runs(ring: TrigRing, robot: Robot) -> list[Run]:
    """Return the runs of two and more neighbouring joints with parallel axes."""
    turning = [
        i for i, joint in enumerate(robot.joints, start=1) if joint.type is JointType.REVOLUTE
    ]
    runs: list[list[tuple[int, int]]] = []
    for before, i in zip([None, *turning], turning, strict=False):
        sense = 0 if before is None else _same_direction(ring, robot, before, i)
        if not sense:
            runs.append([(_angle(ring, robot, i), 1)])
        else:
            own, last = _rate_sign(robot, i), _rate_sign(robot, before or i)
            runs[-1].append((_angle(ring, robot, i), runs[-1][-1][1] * sense * own * last))
    return [
        Run(tuple(k for k, _ in run), tuple(sense for _, sense in run))
        for run in runs
        if len(run) > 1
    ]


def short_form(ring: TrigRing, runs: list[Run], element: Element) -> Expr:
    """Return an element as an expression in which the angles of parallel joints are added up."""
    if not runs:
        return ring.expression(element)
    run, later = runs[0], runs[1:]
    inside = {g for k in run.angles for g in (2 * k, 2 * k + 1)}
    by_function: dict[Expr, Element] = {}
    for outside, part in _grouped(ring, element, inside).items():
        for function, coefficient in _shortest(ring, run, part).items():
            term = ring.ring.from_dict({outside: coefficient})
            by_function[function] = by_function.get(function, ring.ring.zero) + term
    return Add(
        *(
            Mul(function, short_form(ring, later, coefficient))
            for function, coefficient in by_function.items()
            if coefficient
        )
    )


def _angle(ring: TrigRing, robot: Robot, i: int) -> int:
    variable = robot.joints[i - 1].variable
    return next(k for k, angle in enumerate(ring.angles) if variable in angle.free_symbols)


def _rate_sign(robot: Robot, i: int) -> int:
    joint = robot.joints[i - 1]
    return 1 if joint.theta.coeff(joint.variable).is_positive else -1


def _same_direction(ring: TrigRing, robot: Robot, first: int, second: int) -> int:
    """Return 1 or -1 when two axes are parallel, else 0."""
    axis = direction(ring, robot, second, axis_frame(robot, first))
    if axis[2] in (1, -1):
        return int(axis[2].LC)
    return 0


def _grouped(ring: TrigRing, element: Element, inside: set[int]) -> dict[tuple[int, ...], Element]:
    """Group the terms of an element by what stands outside the generators `inside`."""
    groups: dict[tuple[int, ...], dict[tuple[int, ...], Any]] = {}
    for powers, coefficient in element.terms():
        outer = tuple(0 if g in inside else p for g, p in enumerate(powers))
        inner = tuple(p if g in inside else 0 for g, p in enumerate(powers))
        groups.setdefault(outer, {})[inner] = coefficient
    return {outer: ring.ring.from_dict(part) for outer, part in groups.items()}


def _shortest(ring: TrigRing, run: Run, part: Element) -> dict[Expr, Any]:
    """Return a polynomial in the angles of a run as functions with rational coefficients."""
    candidates = [_functions(ring, part, dict(zip(run.angles, _own(ring, run), strict=True)))]
    if len(part) > 1:
        single = _single_functions(ring, run, part)
        if single is not None:
            candidates.append(single)
        if len(run.angles) <= _LONGEST:
            candidates += (_in_basis(ring, run, part, basis) for basis in _bases(len(run.angles)))
    return min(candidates, key=lambda c: (len(c), sum(len(f.atoms(cos, sin)) for f in c)))


def _own(ring: TrigRing, run: Run) -> list[Expr]:
    return [ring.angles[k] for k in run.angles]


def _functions(ring: TrigRing, part: Element, angles: Mapping[int, Expr]) -> dict[Expr, Any]:
    """Return the monomials of an element as products of functions of the given angles."""
    return {
        Mul(
            *(
                function(angle) ** powers[2 * k + offset]
                for k, angle in angles.items()
                for offset, function in ((0, cos), (1, sin))
            )
        ): coefficient
        for powers, coefficient in part.terms()
    }


def _bases(count: int) -> Iterator[tuple[tuple[int, int], ...]]:
    """Yield the sets of sums of neighbours from which all joint angles can be told.

    Sum (a, b) is that of joints a + 1 .. b of the run; such a set is a tree on the places 0 .. n.
    """
    for edges in combinations(combinations(range(count + 1), 2), count):
        reached = {0}
        for _ in edges:
            reached |= {n for a, b in edges for n in (a, b) if a in reached or b in reached}
        if len(reached) == count + 1:
            yield edges


def _in_basis(
    ring: TrigRing, run: Run, part: Element, basis: tuple[tuple[int, int], ...]
) -> dict[Expr, Any]:
    """Rewrite a polynomial in the sums of a basis, which take the places of the joint angles."""
    slots = dict(zip(basis, run.angles, strict=True))
    gens = ring.ring.gens
    replaced: dict[int, Element] = {}
    for position, (k, sense) in enumerate(zip(run.angles, run.senses, strict=True)):
        c, s = ring.constant(1), ring.constant(0)
        for edge, way in _path(basis, position, position + 1):
            c_edge, s_edge = gens[2 * slots[edge]], way * gens[2 * slots[edge] + 1]
            c, s = ring.reduced(c * c_edge - s * s_edge), ring.reduced(s * c_edge + c * s_edge)
        replaced[2 * k], replaced[2 * k + 1] = c, sense * s
    total = ring.ring.zero
    for powers, coefficient in part.terms():
        term = ring.ring(coefficient)
        for generator, value in replaced.items():
            for _ in range(powers[generator]):
                term = ring.product(term, value)
        total = total + term
    signed = [sense * ring.angles[k] for k, sense in zip(run.angles, run.senses, strict=True)]
    angles = {slot: Add(*signed[a:b]) for (a, b), slot in slots.items()}
    return _functions(ring, total, angles)


def _path(
    basis: tuple[tuple[int, int], ...], start: int, end: int
) -> list[tuple[tuple[int, int], int]]:
    """Return the edges from one place to another in a tree, each with the sense it is walked in."""
    paths: dict[int, list[tuple[tuple[int, int], int]]] = {start: []}
    while end not in paths:
        for a, b in basis:
            for here, there, way in ((a, b, 1), (b, a, -1)):
                if here in paths and there not in paths:
                    paths[there] = [*paths[here], ((a, b), way)]
    return paths[end]


def _single_functions(ring: TrigRing, run: Run, part: Element) -> dict[Expr, Any] | None:
    """Return a polynomial as a sum of single cosines and sines, None where one has 2 theta in it.

    ``cos x cos y = (cos(x - y) + cos(x + y))/2`` and its like, once for each factor.
    """
    total: dict[tuple[tuple[int, ...], str], Any] = {}
    for powers, coefficient in part.terms():
        sums = {((0,) * len(run.angles), "c"): coefficient}
        for position, k in enumerate(run.angles):
            for kind, times in (("c", powers[2 * k]), ("s", powers[2 * k + 1])):
                for _ in range(times):
                    sums = _times_function(sums, position, kind)
        for key, value in sums.items():
            total[key] = total.get(key, 0) + value
    result: dict[Expr, Any] = {}
    for (frequencies, kind), value in total.items():
        if not value:  # so it is for the sine of nothing: sines of x and -x come in pairs
            continue
        if any(abs(f) > 1 for f in frequencies):
            return None
        angle = Add(*(f * ring.angles[k] for f, k in zip(frequencies, run.angles, strict=True)))
        function = cos(angle) if kind == "c" else sin(angle)
        sign = -1 if function.could_extract_minus_sign() else 1
        result[sign * function] = result.get(sign * function, 0) + sign * value
    return {function: value for function, value in result.items() if value}


def _times_function(
    sums: Mapping[tuple[tuple[int, ...], str], Any], position: int, kind: str
) -> dict[tuple[tuple[int, ...], str], Any]:
    """Multiply a sum of cosines and sines by the cosine or sine of one angle."""
    product: dict[tuple[tuple[int, ...], str], Any] = {}
    for (frequencies, own), value in sums.items():
        for step in (1, -1):
            moved = list(frequencies)
            moved[position] += step
            # cos cos and sin cos keep their sign; sin brings one for the sum or the difference.
            result = own if kind == "c" else ("s" if own == "c" else "c")
            sign = 1 if kind == "c" else (step if own == "c" else -step)
            key = (tuple(moved), result)
            product[key] = product.get(key, 0) + sign * value / 2
    return product
