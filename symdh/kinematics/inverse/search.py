"""The search for a closed form: the cheapest readable step first, and never without an end."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from sympy import Symbol

from symdh.errors import UnsupportedError
from symdh.kinematics.inverse.arm import prepare
from symdh.kinematics.inverse.clock import Clock, OutOfTimeError
from symdh.kinematics.inverse.point import Point
from symdh.kinematics.inverse.pool import Equation, Pool
from symdh.kinematics.inverse.ring import Element, InverseRing
from symdh.kinematics.inverse.rules.expand import expand_known
from symdh.kinematics.inverse.rules.half_angle import eliminate
from symdh.kinematics.inverse.rules.pair import pair_candidates
from symdh.kinematics.inverse.rules.parts import name_part
from symdh.kinematics.inverse.rules.ratio import add_projections, add_ratios
from symdh.kinematics.inverse.rules.single import single_candidates
from symdh.kinematics.inverse.rules.slide import slide_candidates
from symdh.kinematics.inverse.rules.squares import add_squares
from symdh.kinematics.inverse.rules.sums import take_sums
from symdh.kinematics.inverse.rules.without_slide import add_without_slides
from symdh.kinematics.inverse.solution import ClosedForm, Step, Tried
from symdh.kinematics.inverse.state import State, unknowns_in
from symdh.kinematics.inverse.structure import structure
from symdh.kinematics.inverse.task import InverseTask, inverse_task
from symdh.robot import Robot

#: Seconds of CPU that a search may take.
TIME_BUDGET = 20.0


def closed_form(
    robot: Robot,
    task: str | InverseTask | None = None,
    locked: Iterable[Symbol] = (),
    seconds: float = TIME_BUDGET,
) -> ClosedForm | Tried:
    """Search for the closed-form inverse kinematics of an arm.

    Parameters
    ----------
    robot : Robot
    task : str or InverseTask, optional
        What is given (see `inverse_task`); by default what fits the arm.
    locked : iterable of Symbol
        Joint variables to hold, for arms with more joints than the task needs.
    seconds : float
        CPU time after which the search stops.

    Returns
    -------
    ClosedForm or Tried
        The steps for every joint; or what was found before the search got stuck.

    Raises
    ------
    UnsupportedError
        When the arm has more moving joints than the task gives numbers, the task is unknown, or a
        joint does not turn by its variable.
    """
    held = tuple(locked)
    freedoms = len(robot.variables) - len(held)
    if not isinstance(task, InverseTask):
        task = inverse_task(robot, freedoms, task)
    if freedoms > 6:
        raise UnsupportedError(f"{robot.name} has {freedoms} joints that move; six can be solved")
    clock = Clock(seconds)
    whole = task.whole_position
    arm = prepare(robot, held, whole_pose=task.whole_pose, whole_position=whole)
    goals: set[int] = set()
    state: State | None = None
    try:
        ring = InverseRing(arm, clock)
        goals = {ring.unknown_of(row) for row in arm.moving}
        pool = Pool(ring, task.allowed(ring.goal_position_names))
        state = State(pool, (Point(ring, 1), Point(ring, 2)))
        _run(state, goals, clock)
    except OutOfTimeError:
        steps = tuple(state.steps) if state else ()
        missing = goals - state.known if state else goals
        return Tried(steps, tuple(sorted(missing)), timed_out=True)
    finally:
        clock.stop()
    if goals <= state.known:
        return ClosedForm(arm, task, ring, structure(robot), _needed(ring, state.steps, goals))
    return Tried(tuple(state.steps), tuple(sorted(goals - state.known)))


def _run(state: State, goals: set[int], clock: Clock) -> None:
    """Take steps until all is known or nothing goes on."""
    squared_at: set[int] | None = None
    while not goals <= state.known:
        clock.check()
        state.refresh()
        expand_known(state)
        add_ratios(state)
        add_projections(state)
        state.refresh()
        candidates = [
            *slide_candidates(state),
            *pair_candidates(state),
            *single_candidates(state),
        ]
        if candidates:
            state.take(min(candidates, key=lambda candidate: candidate.cost).step)
        elif squared_at != state.known:
            squared_at = set(state.known)
            add_squares(state)
            continue
        else:
            before = len(state.pool.equations)
            steps = eliminate(state)
            stuck = not steps and before == len(state.pool.equations)
            if stuck and not add_without_slides(state):
                return
            for step in steps:
                state.take(step)
        take_sums(state)
        name_part(state)


def _needed(ring: InverseRing, steps: list[Step], goals: set[int]) -> tuple[Step, ...]:
    """Leave out sums and names that nothing uses."""
    wanted = set(goals)
    generators: set[int] = set()
    kept: list[Step] = []
    for step in reversed(steps):
        definitions = tuple(d for d in step.definitions if d[0] in generators)
        if step.definitions:
            step = replace(step, definitions=definitions)
        if not definitions and step.unknown not in wanted:
            continue
        kept.append(step)
        wanted |= {unknown for _, unknown in step.parts}
        elements = [*step.coefficients, *(used.element for used in step.equations)]
        elements += [e for other in step.alternatives for e in other]
        elements += [e for used in step.equations for e in _shown(used.equation)]
        elements += [element for _, element in definitions]
        for element in elements:
            wanted |= unknowns_in(ring, element) - {step.unknown, step.eliminated}
            generators |= {
                k for powers in element for k in range(ring.first_name, len(powers)) if powers[k]
            }
    return tuple(reversed(kept))


def _shown(equation: Equation) -> Iterator[Element]:
    """Yield all that is printed of an equation."""
    yield equation.element
    for left, right in equation.sides:
        yield left
        yield right
    for parent in equation.parents:
        yield from _shown(parent)
