"""Tables that nobody wrote: the exact pose, any iTj and the generated code against the oracle."""

from __future__ import annotations

import os
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from evaluate import number, value_of
from generated import import_generated
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from oracle import FIFTY_DIGITS, Arm, read_arm
from table_strategies import tables

import symdh
from symdh.codegen import generate

EXAMPLES = int(os.environ.get("SYMDH_RANDOM_TABLES", "60"))
some = settings(max_examples=EXAMPLES, deadline=None, suppress_health_check=[HealthCheck.too_slow])
DIGITS = number("1e-40")


def numbers_of(arm: Arm, seed: int) -> dict[str, float]:
    """Draw numbers for the joint variables and for the parameters without a value."""
    drawn = np.random.default_rng(seed)
    names = [*(name for name, _ in arm.variables), *arm.parameters()]
    return {name: float(drawn.uniform(-3, 3)) for name in names}


def exact_values(arm: Arm, numbers: dict[str, float]) -> dict[str, Any]:
    """Return the number of every name, of those that the table gives a value too."""
    scope = arm._scope(FIFTY_DIGITS, numbers)
    return {name: number(np.asarray(value).item()) for name, value in scope.numbers.items()}


@some
@given(text=tables(most=4), seed=st.integers(0, 2**32 - 1))
def test_every_transform_is_the_product_of_its_elementary_motions(text: str, seed: int) -> None:
    robot, arm = symdh.loads(text), read_arm(text)
    numbers = numbers_of(arm, seed)
    first, last = sorted(np.random.default_rng(seed).integers(0, arm.n + 1, 2))
    values = exact_values(arm, numbers)
    for begin, end in ((0, arm.n), (int(first), int(last))):
        expected = arm.pose(numbers, begin, end, FIFTY_DIGITS)
        got = robot.T(begin, end)
        for i in range(4):
            for j in range(4):
                error = value_of(got[i, j], values) - number(expected[..., i, j].item())
                assert abs(error) < DIGITS, (begin, end, i, j)


@some
@given(text=tables(), seed=st.integers(0, 2**32 - 1))
def test_generated_python_is_right_to_the_last_bits(text: str, seed: int) -> None:
    robot, arm = symdh.loads(text), read_arm(text)
    numbers = numbers_of(arm, seed)
    expected = np.asarray(arm.pose(numbers), dtype=float)
    with TemporaryDirectory() as folder:
        module = import_generated(generate(robot, "python"), Path(folder))
        q = [numbers[name] for name, _ in arm.variables]
        parameters = {name: numbers[name] for name in arm.parameters()}
        got = module.fk(np.array(q), **parameters)
    assert np.abs(got - expected).max() <= arm.tolerance(numbers)
