"""The steps of a closed form with numbers: every branch, none of them judged yet."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import atan2, copysign, cos, hypot, pi, sin, sqrt
from typing import Any

from sympy import Expr, Float, Symbol

from symdh.errors import UnsupportedError
from symdh.kinematics.inverse.numeric_chain import FloatMatrix
from symdh.kinematics.inverse.polynomial import Polynomial
from symdh.kinematics.inverse.refine import Goal
from symdh.kinematics.inverse.ring import Element
from symdh.kinematics.inverse.roots import real_angles
from symdh.kinematics.inverse.rules.laurent import eliminated, laurent
from symdh.kinematics.inverse.solution import ClosedForm, Rule, Step
from symdh.motion.matrices import inverse_transform

#: Coefficients smaller than this part of their size leave an unknown free.
_FREE = 1e-12
#: How far beyond the reach a target counts as on its boundary.
_BOUNDARY = 1e-9
#: Equations conditioned better than this are taken in the order in which they are printed.
_GOOD = 0.02
#: A condition, or a distance from the boundary, that may cost an answer.
_DOUBTFUL = 1e-5


@dataclass(frozen=True)
class Proposal:
    """Joint values that the steps give for a goal, right or wrong.

    Attributes
    ----------
    q : tuple of float
        The joint variables in chain order.
    branches : tuple of int
        Which branch each branching step took.
    free : tuple of Symbol
        Variables that were left free and have the seed's values.
    """

    q: tuple[float, ...]
    branches: tuple[int, ...]
    free: tuple[Symbol, ...]


@dataclass
class _Trial:
    """A branch on its way: the value of each letter and unknown, and what was chosen so far."""

    letters: list[float]
    values: dict[int, float]
    branches: tuple[int, ...] = ()
    free: tuple[int, ...] = ()


class Evaluator:
    """Evaluates the steps of a closed form.

    Parameters
    ----------
    solution : ClosedForm
    values : mapping of Symbol to Expr
        Numbers for parameters; they win over the table's own.
    held : mapping of Symbol to float
        Numbers for locked joints.
    slack : float
        By how much a cosine may be beyond 1 and count as 1: more than rounding where the arm is
        not quite the one that the steps are for. The two values are then kept apart.

    Attributes
    ----------
    doubtful : bool
        Whether an equation was badly conditioned in the last evaluation, or the goal near the
        boundary of what can be reached.

    Raises
    ------
    UnsupportedError
        When a parameter has no value.
    """

    def __init__(
        self,
        solution: ClosedForm,
        values: Mapping[Symbol, Expr],
        held: Mapping[Symbol, float],
        slack: float = 0.0,
    ) -> None:
        self._slack = slack
        self.solution = solution
        self.doubtful = False
        self._ring = solution.ring
        self._values = dict(values)
        self._compiled: dict[Element, Polynomial] = {}
        given = solution.arm.given
        self._places = {variable: k for k, variable in enumerate(given.variables)}
        known = {**given.values, **values}
        self._before, self._after = _end(given.base, known), _end(given.tool, known)
        if solution.arm.base_inside:
            self._before = None
        if not solution.task.whole_pose:
            self._after = None
        self.hold(held)

    def hold(self, held: Mapping[Symbol, float]) -> None:
        """Give locked joints other values."""
        self._held = dict(held)
        arm, ring = self.solution.arm, self._ring
        known = {s: v for s, v in arm.given.values.items() if s in arm.given.parameters}
        known |= self._values
        numbers = {**known, **{variable: Float(x, 17) for variable, x in held.items()}}
        numbers |= {letter: m.xreplace(known) for letter, m in arm.meanings.items()}
        self._constants: list[float | None] = [None] * len(ring.letters)
        for k in ring.first_lengths:
            self._constants[k] = _number(ring.letters[k], numbers)
        self._front = [_number(part, numbers) for part in arm.front]
        self._hand = [_number(part, numbers) for part in arm.hand]

    def proposals(self, goal: Goal, seed: Sequence[float]) -> list[Proposal]:
        """Return what each branch gives for a goal."""
        self.doubtful = False
        trials = [_Trial(self._letters(goal), {})]
        for step in self.solution.steps:
            trials = [new for trial in trials for new in self._after_step(step, trial, seed)]
        return [self._proposal(trial) for trial in trials]

    def _proposal(self, trial: _Trial) -> Proposal:
        ring, joints = self._ring, self.solution.arm.robot.joints
        q = [0.0] * len(self._places)
        for row in self.solution.arm.moving:
            q[self._place(row)] = trial.values[ring.unknown_of(row)]
        for variable, value in self._held.items():
            q[self._places[variable]] = value
        rows = [
            ring.forms[k][-1][0] if ring.is_angle(k) else ring.slides[k - len(ring.forms)]
            for k in trial.free
        ]
        free = tuple(v for row in rows if (v := joints[row - 1].variable) is not None)
        return Proposal(tuple(q), trial.branches, free)

    def _after_step(self, step: Step, trial: _Trial, seed: Sequence[float]) -> Iterable[_Trial]:
        if step.definitions:
            for generator, element in step.definitions:
                trial.letters[generator] = self._value(element, trial)
            return [trial]
        values, is_free = self._solved(step, trial, seed)
        found = []
        for branch, value in enumerate(values):
            letters = list(trial.letters)
            if self._ring.is_angle(step.unknown):
                letters[2 * step.unknown] = cos(value)
                letters[2 * step.unknown + 1] = sin(value)
            else:
                letters[self._ring.slide_gen(step.unknown)] = value
            branches = (*trial.branches, branch) if step.branches > 1 else trial.branches
            free = (*trial.free, step.unknown) if is_free else trial.free
            found.append(_Trial(letters, {**trial.values, step.unknown: value}, branches, free))
        return found

    def _solved(self, step: Step, trial: _Trial, seed: Sequence[float]) -> tuple[list[float], bool]:
        """Return the values of a step's unknown, and whether it is free."""
        assert step.rule is not Rule.NAMES, "such a step finds no unknown"
        match step.rule:
            case Rule.SUM:
                return [sum(sign * trial.values[part] for sign, part in step.parts)], False
            case Rule.SLIDE:
                return self._slide(step, trial, seed)
            case Rule.SLIDE_SQUARE:
                return self._slide_square(step, trial, seed)
            case Rule.PAIR:
                return self._pair(step, trial, seed)
            case Rule.HALF_ANGLE:
                return self._half_angle(step, trial), False
            case Rule.RATIO | Rule.SINE | Rule.COSINE | Rule.SINE_COSINE:
                return self._single(step, trial, seed)

    def _single(self, step: Step, trial: _Trial, seed: Sequence[float]) -> tuple[list[float], bool]:
        """Solve A s + B c + C = 0, the best conditioned one of those that stand by."""
        best, best_score = step.coefficients, -1.0
        for option in (step.coefficients, *step.alternatives):
            size = self._size(option[0]) + self._size(option[1])
            h = hypot(self._value(option[0], trial), self._value(option[1], trial))
            score = h / size if size else 0.0
            if score > best_score:
                best, best_score = option, score
            if best_score > _GOOD:
                break
        self.doubtful |= best_score < _DOUBTFUL
        a, b, c = (self._value(element, trial) for element in best)
        h = hypot(a, b)
        if best_score <= _FREE:
            scale = self._size(best[0]) + self._size(best[1]) + self._size(best[2])
            if abs(c) > _BOUNDARY * scale:
                return [], False
            return [self._seeded(step.unknown, seed)], True
        if not best[2]:
            first = atan2(-b, a)
            return [first, first + pi], False
        beyond = abs(c) / h - 1
        self.doubtful |= abs(beyond) < _DOUBTFUL
        if beyond > max(_BOUNDARY, self._slack):
            return [], False
        if self._slack:
            c = copysign(min(abs(c), h * (1 - self._slack / 10)), c)
        root = sqrt(max(h * h - c * c, 0.0))
        if not best[0]:
            return [atan2(root, -c * copysign(1, b)), atan2(-root, -c * copysign(1, b))], False
        if not best[1]:
            return [atan2(-c * copysign(1, a), root), atan2(-c * copysign(1, a), -root)], False
        middle, turn = atan2(a, b), atan2(root, -c)
        return [middle + turn, middle - turn], False

    def _pair(self, step: Step, trial: _Trial, seed: Sequence[float]) -> tuple[list[float], bool]:
        """Solve two linear equations, the best conditioned pair of those that stand by."""
        best, best_score = 0.0, 0.0
        for option in (step.coefficients, *step.alternatives):
            a_1, b_1, c_1, a_2, b_2, c_2 = (self._value(element, trial) for element in option)
            sizes = [self._size(element) for element in option]
            determinant = a_1 * b_2 - a_2 * b_1
            size = (sizes[0] + sizes[1]) * (sizes[3] + sizes[4])
            score = abs(determinant) / size if size else 0.0
            if score > best_score:
                sine, cosine = b_1 * c_2 - b_2 * c_1, a_2 * c_1 - a_1 * c_2
                best, best_score = atan2(sine / determinant, cosine / determinant), score
            if score > _GOOD:
                break
        self.doubtful |= best_score < _DOUBTFUL
        if best_score < _FREE**2:
            return [self._seeded(step.unknown, seed)], True
        return [best], False

    def _slide(self, step: Step, trial: _Trial, seed: Sequence[float]) -> tuple[list[float], bool]:
        best, best_score = 0.0, 0.0
        for option in (step.coefficients, *step.alternatives):
            a, c = (self._value(element, trial) for element in option)
            size = self._size(option[0])
            score = abs(a) / size if size else 0.0
            if score > best_score:
                best, best_score = -c / a, score
            if score > _GOOD:
                break
        self.doubtful |= best_score < _DOUBTFUL
        if best_score < _FREE:
            return [self._seeded(step.unknown, seed)], True
        return [best], False

    def _slide_square(
        self, step: Step, trial: _Trial, seed: Sequence[float]
    ) -> tuple[list[float], bool]:
        a, b, c = (self._value(element, trial) for element in step.coefficients)
        size_a, _, size_c = (self._size(element) for element in step.coefficients)
        if abs(a) <= _FREE * size_a and abs(b) <= _FREE * sqrt(size_a * size_c):
            # The slide changes nothing that is asked for.
            if abs(c) > _BOUNDARY * size_c:
                return [], False
            return [self._seeded(step.unknown, seed)], True
        if not a:
            return [-c / b], False
        radicand = b * b - 4 * a * c
        if radicand < -_BOUNDARY * (b * b + abs(4 * a) * size_c):
            return [], False
        root = sqrt(max(radicand, 0.0))
        return [(-b + root) / (2 * a), (-b - root) / (2 * a)], False

    def _half_angle(self, step: Step, trial: _Trial) -> list[float]:
        letters = trial.letters

        def term(powers: tuple[int, ...], coefficient: Any) -> float:
            value = int(coefficient.numerator) / int(coefficient.denominator)
            for k, power in enumerate(powers):
                if power:
                    value *= letters[k] ** power
            return value

        parts = tuple(
            laurent(element, step.unknown, term, 0.5, 1j) for element in step.coefficients
        )
        scales = tuple(self._value(scale, trial) for scale in step.scales)
        found = real_angles(eliminated(parts, scales))
        # Real roots come in pairs: one that has no partner, or none at all, may hide a double one.
        self.doubtful |= not found or len(found) % 2 == 1
        return found

    def _seeded(self, unknown: int, seed: Sequence[float]) -> float:
        """Return the value of a free unknown: what the seed says, a sum from its parts."""
        ring = self._ring
        if not ring.is_angle(unknown):
            return seed[self._place(ring.slides[unknown - len(ring.forms)])]
        return sum(sign * seed[self._place(row)] for row, sign in ring.forms[unknown])

    def _place(self, row: int) -> int:
        variable = self.solution.arm.robot.joints[row - 1].variable
        assert variable is not None
        return self._places[variable]

    def _value(self, element: Element, trial: _Trial) -> float:
        return self._polynomial(element)(trial.letters)

    def _size(self, element: Element) -> float:
        return self._polynomial(element).size

    def _polynomial(self, element: Element) -> Polynomial:
        found = self._compiled.get(element)
        if found is None:
            found = self._compiled[element] = Polynomial(element, self._constants)
        return found

    def _letters(self, goal: Goal) -> list[float]:
        """Return the letters that a goal gives: R, w and u, and the constants."""
        ring = self._ring
        inner: FloatMatrix = goal if self._before is None else _product(self._before, goal)
        inner = inner if self._after is None else _product(inner, self._after)
        columns = [[inner[r][c] for r in range(3)] for c in range(3)]
        w = [
            inner[r][3] - self._front[r] - sum(columns[c][r] * self._hand[c] for c in range(3))
            for r in range(3)
        ]
        u = [-sum(columns[c][r] * w[r] for r in range(3)) for c in range(3)]
        values = [entry for column in columns for entry in column] + w + u
        letters = [0.0 if x is None else x for x in self._constants]
        letters[ring.first_goal : ring.first_goal + len(values)] = values
        return letters


def _number(expression: Expr, numbers: Mapping[Symbol, Expr]) -> float:
    value = expression.xreplace(dict(numbers))
    if value.free_symbols:
        names = ", ".join(sorted(symbol.name for symbol in value.free_symbols))
        raise UnsupportedError(
            f"{names} has no value: put it under 'values:' in the table or give --set NAME=NUMBER"
        )
    return float(value)


def _end(word: Any, known: Mapping[Symbol, Expr]) -> FloatMatrix | None:
    """Return the inverse pose of the base or of the tool, None where there is none."""
    if not word:
        return None
    matrix = inverse_transform(word)
    return tuple(tuple(_number(matrix[r, c], known) for c in range(4)) for r in range(3))


def _product(a: FloatMatrix, b: FloatMatrix) -> FloatMatrix:
    return tuple(
        tuple(
            sum(a[r][k] * b[k][c] for k in range(3)) + (a[r][3] if c == 3 else 0.0)
            for c in range(4)
        )
        for r in range(3)
    )
