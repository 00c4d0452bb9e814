"""Frame assignment against screws: the joints of a mechanism moved as they are given in space.

The oracle turns and slides the tool about the axes themselves (Rodrigues' formula), one after the
other from the hand to the base; it knows nothing of frames, normals or rows.
"""

from __future__ import annotations

import json
import os
import random
import unicodedata
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Runner
from oracle import EXTENDED, elementary, read_arm_file
from sympy import (
    Add,
    Expr,
    Integer,
    Matrix,
    Rational,
    Symbol,
    atan2,
    cos,
    expand,
    pi,
    sin,
    sqrt,
    symbols,
)

from symdh.cli.main import run
from symdh.derivation.frames import frames_document
from symdh.errors import LimitError, TableError, UnsupportedError
from symdh.frames import (
    AssignmentError,
    assign,
    assign_frames,
    mechanism_of,
    pose_of_matrix,
    read_frames,
)
from symdh.frames.exact import angle, root, tidy
from symdh.frames.geometry import Relation
from symdh.mechanism import JointAxis, Mechanism, ToolFrame, Vector
from symdh.render.table_yaml import table_yaml
from symdh.render.terminal import render_chapters
from symdh.robot import Axis, Convention, Joint, JointType, Motion, MotionKind, Robot
from symdh.table import load_table, loads_table
from symdh.table.axes import read_mechanism
from symdh.table.source import from_text

HERE = Path(__file__).parent
EXAMPLES = HERE.parent / "examples"
TABLES = sorted((HERE / "data" / "tables").glob("*.yaml"))
BOTH = list(Convention)

#: 50 random mechanisms each. SYMDH_RANDOM_BLOCKS=40 makes them 2000, in both conventions.
BLOCKS = int(os.environ.get("SYMDH_RANDOM_BLOCKS", "2"))
ORDER = {
    Convention.STANDARD: (("Rz", "theta"), ("Tz", "d"), ("Tx", "a"), ("Rx", "alpha")),
    Convention.MODIFIED: (("Rx", "alpha"), ("Tx", "a"), ("Rz", "theta"), ("Tz", "d")),
}


def numeric(expression: Expr, values: Mapping[Symbol, float]) -> float:
    if not expression.free_symbols:
        return constant(expression)
    return float(expression.evalf(30, subs=dict(values)))


@cache
def constant(expression: Expr) -> float:
    return float(expression.evalf(30))


def table_pose(robot: Robot, values: Mapping[Symbol, float]) -> np.ndarray:
    """Pose of the last frame (tool included) in the base, elementary motion by motion."""
    word = [(f"{m.kind.value}{m.axis.name.lower()}", m.amount) for m in robot.base]
    for joint in robot.joints:
        word += [(kind, getattr(joint, name)) for kind, name in ORDER[robot.convention]]
    word += [(f"{m.kind.value}{m.axis.name.lower()}", m.amount) for m in robot.tool]
    pose = np.eye(4)
    for kind, amount in word:
        pose = pose @ elementary(kind, numeric(amount, values), (), EXTENDED).astype(float)
    return pose


def screw(axis: JointAxis, moved: float, values: Mapping[Symbol, float]) -> np.ndarray:
    """A turn about, or a slide along, a line in space."""
    z = np.array([numeric(e, values) for e in axis.direction])
    motion = np.eye(4)
    if axis.type is JointType.PRISMATIC:
        motion[:3, 3] = moved * z
        return motion
    p = np.array([numeric(e, values) for e in axis.point])
    k = np.array([[0, -z[2], z[1]], [z[2], 0, -z[0]], [-z[1], z[0], 0]])
    turn = np.eye(3) + np.sin(moved) * k + (1 - np.cos(moved)) * k @ k
    motion[:3, :3], motion[:3, 3] = turn, p - turn @ p
    return motion


def moved_by(mechanism: Mechanism, values: Mapping[Symbol, float]) -> np.ndarray:
    """What the joints do to the tool, from home to `values`."""
    motion = np.eye(4)
    for axis in mechanism.axes:
        amount = numeric(axis.ratio, values) * (values[axis.variable] - numeric(axis.home, values))
        motion = motion @ screw(axis, amount, values)
    return motion


def tool_pose(tool: ToolFrame) -> np.ndarray:
    assert tool.approach is not None
    assert tool.sliding is not None
    pose = np.eye(4)
    s, a, p = (
        np.array([float(e) for e in vector]) for vector in (tool.sliding, tool.approach, tool.point)
    )
    pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = np.cross(s, a), s, a, p
    return pose


def random_q(mechanism: Mechanism, seed: int) -> dict[Symbol, float]:
    generator = random.Random(seed)
    return {axis.variable: generator.uniform(-3, 3) for axis in mechanism.axes}


# Directions of whole numbers over their length, so that everything is given exactly.
TRIPLES = ((3, 4, 0, 5), (1, 0, 0, 1), (1, 2, 2, 3), (2, 3, 6, 7), (0, 5, 12, 13))


def random_unit(generator: random.Random) -> Vector:
    *entries, size = generator.choice(TRIPLES)
    signed = [Rational(e * generator.choice((1, -1)), size) for e in entries]
    generator.shuffle(signed)
    return signed[0], signed[1], signed[2]


def random_point(generator: random.Random) -> Vector:
    x, y, z = (Rational(generator.randint(-8, 8), generator.choice((1, 2, 5))) for _ in range(3))
    return x, y, z


def random_tool(generator: random.Random) -> ToolFrame:
    """A tool whose frame is a product of rational rotations (unit quaternions of whole numbers)."""
    w, x, y, z = (Integer(generator.randint(-2, 2)) for _ in range(4))
    square = w * w + x * x + y * y + z * z
    if square == 0:
        w, square = Integer(1), Integer(1)
    sliding = (2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x))
    approach = (2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z)
    point = random_point(generator)
    return ToolFrame(
        point,
        approach=(approach[0] / square, approach[1] / square, approach[2] / square),
        sliding=(sliding[0] / square, sliding[1] / square, sliding[2] / square),
    )


NEIGHBOURS = ("skew", "parallel", "intersecting", "coincident")


def random_mechanism(seed: int) -> tuple[Mechanism, list[str]]:
    """A mechanism of 2 to 6 joints, and how each axis was laid beside the one before."""
    generator = random.Random(seed)
    kinds, axes = [], []
    point, direction = random_point(generator), random_unit(generator)
    for number in range(1, generator.randint(2, 6) + 1):
        if number > 1:
            kind = generator.choice(NEIGHBOURS)
            kinds.append(kind)
            along = Rational(generator.randint(-4, 4), 2)
            if kind in ("skew", "parallel"):
                point = random_point(generator)
            else:
                x, y, z = (p + along * e for p, e in zip(point, direction, strict=True))
                point = (x, y, z)
            if kind in ("skew", "intersecting"):
                direction = random_unit(generator)
            elif generator.random() < 0.5:
                direction = (-direction[0], -direction[1], -direction[2])
        turns = generator.random() < 0.7
        home = generator.choice((Integer(0), Integer(0), pi / 6 if turns else Rational(1, 2)))
        axes.append(
            JointAxis(
                JointType.REVOLUTE if turns else JointType.PRISMATIC,
                point,
                direction,
                Symbol(f"q{number}", real=True),
                home=home,
                reverse=generator.random() < 0.3,
            )
        )
    return Mechanism("random", tuple(axes), random_tool(generator)), kinds


@pytest.mark.parametrize("convention", BOTH)
@pytest.mark.parametrize("path", TABLES, ids=lambda path: path.stem)
def test_corpus_table_to_axes_to_table(path: Path, convention: Convention) -> None:
    original = read_arm_file(path)
    found = assign_frames(mechanism_of(load_table(str(path)).robot), convention)
    assert found.exact
    assert found.robot.convention is convention
    poses = original.seeded_poses(100, seed=4)
    names = [name for name, _ in original.variables]
    q = {name: poses[:, k] for k, name in enumerate(names)}
    given = {name: 0.3 + 0.1 * k for k, name in enumerate(original.parameters())}
    expected = original.pose({**q, **given})
    got = table_poses(found.robot, q, given)
    tolerance = original.tolerance(given)
    assert np.max(np.abs(got - expected)) <= 4 * tolerance


def table_poses(robot: Robot, q: Mapping[str, Any], given: Mapping[str, float]) -> np.ndarray:
    """Like `table_pose` for many poses: amounts are affine in the one variable that they hold."""
    known = {Symbol(name, real=True): value for name, value in given.items()}
    known |= {symbol: float(value) for symbol, value in robot.values.items()}
    word = [(f"{m.kind.value}{m.axis.name.lower()}", m.amount) for m in robot.base]
    for joint in robot.joints:
        word += [(kind, getattr(joint, name)) for kind, name in ORDER[robot.convention]]
    word += [(f"{m.kind.value}{m.axis.name.lower()}", m.amount) for m in robot.tool]
    count = len(next(iter(q.values())))
    pose = np.broadcast_to(np.eye(4, dtype=np.longdouble), (count, 4, 4))
    for kind, amount in word:
        variables = sorted(s.name for s in amount.free_symbols if s.name in q)
        zero = {Symbol(name, real=True): Integer(0) for name in variables}
        value: Any = np.longdouble(str(amount.xreplace(zero).evalf(25, subs=known)))
        for name in variables:
            value = value + float(amount.coeff(Symbol(name, real=True))) * q[name]
        pose = pose @ elementary(kind, value, (count,), EXTENDED)
    return np.asarray(pose)


@pytest.mark.parametrize("convention", BOTH)
@pytest.mark.parametrize("block", range(BLOCKS))
def test_random_mechanisms_move_as_given(block: int, convention: Convention) -> None:
    for seed in range(block * 50, block * 50 + 50):
        mechanism, _ = random_mechanism(seed)
        found = assign_frames(mechanism, convention)
        assert found.exact
        assert not found.snaps
        assert mechanism.tool is not None
        home = {axis.variable: float(axis.home) for axis in mechanism.axes}
        assert table_pose(found.robot, home) == pytest.approx(tool_pose(mechanism.tool), abs=1e-12)
        generator = np.random.default_rng(seed)
        q = {axis.variable.name: generator.uniform(-3, 3, 100) for axis in mechanism.axes}
        got = table_poses(found.robot, q, {}).astype(float)
        for k in range(100):
            one = {Symbol(name, real=True): values[k] for name, values in q.items()}
            expected = moved_by(mechanism, one) @ tool_pose(mechanism.tool)
            assert np.max(np.abs(got[k] - expected)) < 1e-12, (seed, k)


# The lectures' tables, typed from their pages: theta, d, a, alpha.
t1, t2, t3, t4, t5, q1, q2, q3, q4 = (
    Symbol(name, real=True)
    for name in ("theta1", "theta2", "theta3", "theta4", "theta5", "q1", "q2", "q3", "q4")
)
a1, a2, a3, d1, d3, d4, d5, L1, L2 = (
    Symbol(name, real=True) for name in ["a1", "a2", "a3", "d1", "d3", "d4", "d5", "L1", "L2"]
)
LECTURES = {
    "planar_2r": [(t1, 0, a1, 0), (t2, 0, a2, 0)],
    "scara": [(q1, d1, a1, 0), (q2, 0, a2, 0), (0, q3, 0, 0), (q4, d4, 0, pi)],
    "rrp_modified": [(t1, 0, 0, 0), (t2, 0, 0, pi / 2), (0, d3, a2, pi / 2)],
    "planar_2r_modified": [(t1, 0, 0, 0), (t2, 0, a1, 0)],
    "minimover_5r": [
        (t1, 0, 0, -pi / 2),
        (t2, 0, L1, 0),
        (t3, 0, L2, 0),
        (t4, 0, 0, pi / 2),
        (t5, 0, 0, 0),
    ],
    "articulated": [
        (t1, d1, 0, -pi / 2),
        (t2, 0, a2, 0),
        (t3, 0, a3, 0),
        (t4 + pi / 2, 0, 0, pi / 2),
        (t5, d5, 0, 0),
    ],
}


@pytest.mark.parametrize("name", LECTURES)
def test_the_lectures_tables_come_out_of_their_mechanisms(name: str) -> None:
    robot = assign(example(name))
    rows = [(joint.theta, joint.d, joint.a, joint.alpha) for joint in robot.joints]
    assert rows == LECTURES[name]
    assert robot.base == ()
    slide = [(m.kind, m.axis, m.amount) for m in robot.tool]
    in_tool = [(MotionKind.TRANSLATION, Axis.X, a2)] if name == "planar_2r_modified" else []
    assert slide == in_tool


@pytest.mark.parametrize("name", ["planar_2r", "planar_2r_modified", "scara", "minimover_5r"])
def test_examples_agree_with_the_tables_beside_them(name: str) -> None:
    table = load_table(str(EXAMPLES / f"{name}.yaml")).robot
    found = assign(example(name))
    assert (found.joints, found.base, found.tool) == (table.joints, table.base, table.tool)


def test_theta1_of_the_minimover_follows_x0() -> None:
    text = (EXAMPLES / "mechanisms" / "minimover_5r_axes.yaml").read_text()
    along_y = text.replace("0: {x: [1, 0, 0]}", "0: {x: [0, 1, 0]}")
    assert along_y != text
    first = assign(mechanism_from(along_y)).joints[0]
    # Measured from the arm itself, theta1 is zero where the file says that it is 90 degrees.
    assert first.theta == t1 - pi / 2


RIGHT, SLOPE = pi / 2, atan2(4, 3)
AXES = """
name: arm
joints:
  - {{point: [0, 0, 0], direction: [0, 0, 1]}}
  - {{point: {point}, direction: {direction}}}
  - {{point: [3, 1, 2], direction: [0, 1, 0]}}
{more}
"""


@pytest.mark.parametrize(
    ("point", "direction", "relation", "origin", "x", "row"),
    [
        # Two axes at right angles that pass at 2: the common normal is along x, at height 5.
        ("[2, 7, 5]", "[0, 1, 0]", Relation.SKEW, (2, 0, 5), (1, 0, 0), (0, 5, 2, -pi / 2)),
        (
            "[0, 7, 5]",
            "[0, 1, 0]",
            Relation.INTERSECTING,
            (0, 0, 5),
            (-1, 0, 0),
            (pi, 5, 0, pi / 2),
        ),
        ("[3, 4, 9]", "[0, 0, 1]", Relation.PARALLEL, (3, 4, 0), (3, 4, 0), (SLOPE, 0, 5, 0)),
        (
            "[3, 4, 9]",
            "[0, 0, -1]",
            Relation.PARALLEL,
            (3, 4, 0),
            (3, 4, 0),
            (atan2(4, 3), 0, 5, pi),
        ),
        ("[0, 0, 9]", "[0, 0, 1]", Relation.COINCIDENT, (0, 0, 0), (1, 0, 0), (0, 0, 0, 0)),
    ],
)
def test_each_case_of_two_axes(
    point: str, direction: str, relation: Relation, origin: Any, x: Any, row: Any
) -> None:
    mechanism = mechanism_from(AXES.format(point=point, direction=direction, more=""))
    found = assign_frames(mechanism, Convention.STANDARD)
    step = found.steps[1]
    assert step.relation is relation
    assert step.placed.origin == origin
    size = sqrt(sum(e * e for e in x))
    assert step.placed.columns[0] == tuple(e / size for e in x)
    measured = found.measured[0]
    assert (measured.theta, measured.d, measured.a, measured.alpha) == row


@pytest.mark.parametrize(
    ("more", "frame", "origin", "x"),
    [
        ("frames: {1: {origin: [0, 0, 5]}}", 1, (3, 4, 5), (Rational(3, 5), Rational(4, 5), 0)),
        ("frames: {1: {x: reverse}}", 1, (3, 4, 0), (-Rational(3, 5), -Rational(4, 5), 0)),
        ("frames: {1: {x: [-0.6, -0.8, 0]}}", 1, (3, 4, 0), (-Rational(3, 5), -Rational(4, 5), 0)),
        ("frames: {0: {x: [0, 1, 0], origin: [0, 0, 1]}}", 0, (0, 0, 1), (0, 1, 0)),
        ("frames: {3: {x: [0, 0, 1], origin: [3, 8, 2]}}", 3, (3, 8, 2), (0, 0, 1)),
    ],
)
def test_free_choices(more: str, frame: int, origin: Any, x: Any) -> None:
    text = AXES.format(point="[3, 4, 9]", direction="[0, 0, 1]", more=more)
    mechanism = mechanism_from(text)
    found = assign_frames(mechanism, Convention.STANDARD)
    placed = found.steps[frame].placed
    assert (placed.origin, placed.columns[0]) == (origin, x)
    # Whatever was chosen, the arm moves alike.
    plain = mechanism_from(AXES.format(point="[3, 4, 9]", direction="[0, 0, 1]", more=""))
    q = random_q(mechanism, seed=1)
    home = dict.fromkeys(q, 0.0)
    for each in (mechanism, plain):
        robot = assign(each, Convention.STANDARD)
        moved = table_pose(robot, q) @ np.linalg.inv(table_pose(robot, home))
        assert moved == pytest.approx(moved_by(mechanism, q), abs=1e-12)


def test_a_direction_whose_entries_share_a_letter() -> None:
    """x_0 = (3, 4, 0)/5 for b = 3 and c = 4, whatever a is."""
    size = "sqrt(a**2*b**2 + a**2*c**2)"
    more = f"frames: {{0: {{x: [a*b/{size}, a*c/{size}, 0]}}}}"
    mechanism = mechanism_from(AXES.format(point="[3, 4, 9]", direction="[0, 0, 1]", more=more))
    found = assign_frames(mechanism, Convention.STANDARD)
    a, b, c = symbols("a b c", real=True)
    x, y, z = found.steps[0].placed.columns
    for number in (Rational(1, 7), Integer(2)):
        known = {a: number, b: Integer(3), c: Integer(4)}
        x_0, y_0 = ([entry.xreplace(known) for entry in column] for column in (x, y))
        assert x_0 == [Rational(3, 5), Rational(4, 5), 0]
        assert y_0 == [-Rational(4, 5), Rational(3, 5), 0]
        assert z == (0, 0, 1)
        assert abs(constant(found.robot.base[0].amount.xreplace(known)) - np.arctan2(4, 3)) < 1e-15


def test_z_may_point_against_the_joint() -> None:
    text = AXES.format(point="[3, 4, 9]", direction="[0, 0, 1], z: reverse", more="")
    found = assign_frames(mechanism_from(text), Convention.STANDARD)
    assert found.steps[1].placed.z == (0, 0, -1)
    assert found.robot.joints[1].theta.coeff(t2) == -1
    mechanism = found.mechanism
    q = random_q(mechanism, seed=2)
    moved = table_pose(found.robot, q) @ np.linalg.inv(
        table_pose(found.robot, dict.fromkeys(q, 0.0))
    )
    assert moved == pytest.approx(moved_by(mechanism, q), abs=1e-12)


@pytest.mark.parametrize("convention", BOTH)
@pytest.mark.parametrize(
    ("point", "direction", "says"),
    [
        ("[3, 4, 9]", "[0.000001, 0, 0.9999999999995]", "parallel to axis 1"),
        ("[0.000001, 7, 5]", "[0, 1, 0]", "meets axis 1"),
        ("[0.000001, 0, 5]", "[0, 0, 1]", "in line with axis 1"),
        ("[2, 7, 5]", "[0, 0.9999999999995, 0.000001]", "at right angles to axis 1"),
    ],
)
def test_what_is_off_by_a_millionth_is_recognised_and_reported(
    convention: Convention, point: str, direction: str, says: str
) -> None:
    given = AXES.format(point=point, direction=direction, more="")
    found = assign_frames(mechanism_from(given), convention)
    assert any(says in snap.taken_as for snap in found.snaps)
    assert not found.exact
    snap = next(snap for snap in found.snaps if says in snap.taken_as)
    assert snap.miss == pytest.approx(1e-6, rel=1e-3)
    q = random_q(found.mechanism, seed=3)
    moved = table_pose(found.robot, q) @ np.linalg.inv(
        table_pose(found.robot, dict.fromkeys(q, 0.0))
    )
    assert moved == pytest.approx(moved_by(found.mechanism, q), abs=1e-4)
    twists = [joint.alpha for joint in found.robot.joints]
    assert all((2 * twist / pi).is_Integer for twist in twists)

    strict = mechanism_from(given + "\ntolerance: 0")
    try:
        plain = assign_frames(strict, convention)
    except AssignmentError as problem:
        assert "no unit vector" in str(problem)
    else:
        assert not plain.snaps


@pytest.mark.parametrize(
    ("text", "at", "says"),
    [
        ("direction: [0, 0, 0]", "[0, 0, 0]", "direction is zero"),
        ("direction: [0, 0, 2]", "[0, 0, 2]", "its length is 2; write [0, 0, 1]"),
        ("direction: [1, 1, 0]", "[1, 1, 0]", "write [1/sqrt(2), 1/sqrt(2), 0]"),
        ("direction: [0, 1]", "[0, 1]", "list of three"),
        ("direction: [0, 0, 1], home: x1 m", "x1", "a unit follows a number"),
        ("direction: [0, 0, 1], kind: P", "kind", "key kind unknown in joint 1"),
        ("direction: [0, 0, 1], type: helical", "helical", "type of joint helical unknown"),
        ("direction: [theta2, 0, 1]", "theta2", "theta2 moves a joint"),
    ],
)
def test_bad_axes_are_refused_at_their_place(
    run_symdh: Runner, tmp_path: Path, text: str, at: str, says: str
) -> None:
    source = f"name: arm\njoints:\n- {{{text}, point: [0, 0, 0]}}\n- {{variable: theta2, "
    source += "direction: [0, 0, 1], point: [1, 0, 0]}\n"
    (tmp_path / "bad.yaml").write_text(source)
    before = sorted(tmp_path.iterdir())
    done = run_symdh("frames", "bad.yaml", "-o", "out.yaml")
    assert done.returncode == 2
    line = next(each for each in done.stderr.splitlines() if says in each)
    column = source.splitlines()[2].index(at) + 1
    assert line.startswith(f"bad.yaml:3:{column}: ")
    assert "Traceback" not in done.stderr
    assert done.stdout == ""
    assert sorted(tmp_path.iterdir()) == before


ONE = "name: arm\njoints:\n- {point: [0, 0, 0], direction: [0, 0, 1]}\n"
GIVEN = (
    "name: arm\nmatrices:\n"
    "  - [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]\n"
    "  - [[1, 0, 0, a1], [0, 1, 0, 0], [0, 0, 1, 0]]\n"
)


@pytest.mark.parametrize(
    ("text", "where", "says"),
    [
        ("name: arm\n", "1:1", "joints is missing: the list of joint axes"),
        ("name: arm\njoints: 5\n", "2:9", "joints must be a list of axes"),
        (ONE + ONE.splitlines(True)[2] * 50, "53:3", "joints has 51 entries, over 50"),
        ("name: arm\njoints: [5]\n", "2:10", "joint 1 must be a mapping"),
        ("name: arm\njoints: [{point: [0, 0, 0]}]\n", "2:10", "missing key direction in joint 1"),
        (ONE.replace("{", "{variable: [q], "), "3:14", "the name of a symbol is wanted here"),
        (ONE.replace("{", "{variable: 2q, "), "3:14", "2q is not the name of a symbol"),
        (
            ONE.replace("{", "{variable: q, ") + "- {variable: q, point: [1, 0, 0]}\n",
            "4:14",
            "q already drives another joint",
        ),
        (ONE + "tool: 5\n", "4:7", "tool must be a mapping of keys"),
        (ONE + "tool: {approach: [0, 0, 1], normal: [1, 0, 0]}\n", "4:7", "missing key point"),
        (
            ONE + "tool: {point: [0, 0, 1], approach: [0, 0, 1], normal: [1, 0, 0], "
            "sliding: [0, 1, 0]}\n",
            "4:55",
            "leave normal out",
        ),
        (ONE + "frames: {0: {x: sideways}}\n", "4:17", "x is a direction [0, 1, 0], or reverse"),
        (ONE + "tolerance: [1]\n", "4:12", "an expression is wanted here, not a list"),
        ("name: arm\nmatrices: 5\n", "2:11", "matrices must be a list of two frames or more"),
        (GIVEN.replace(", [0, 0, 1, 0]", ""), "3:5", "frame 0 needs three rows of four numbers"),
        (GIVEN.replace("a1", "a1 +"), "4:20", "expression ends early"),
        (GIVEN + "joints: [{}, {}]\n", "5:9", "2 frames need 1 joints"),
        (GIVEN + "joints: [{variable: 2q}]\n", "5:21", "2q is not the name of a symbol"),
    ],
)
def test_what_is_wrong_with_a_file_of_axes(text: str, where: str, says: str) -> None:
    with pytest.raises(TableError) as caught:
        read_mechanism(from_text(text, "axes.yaml"))
    found = {f"{d.line}:{d.column}": d.message for d in reversed(caught.value.diagnostics)}
    assert says in found[where]


def test_a_tool_that_is_no_mapping_is_one_error() -> None:
    with pytest.raises(TableError) as caught:
        read_mechanism(from_text(ONE + "tool: 5\n", "axes.yaml"))
    assert len(caught.value.diagnostics) == 1


def test_joints_between_given_frames_need_not_be_told() -> None:
    plain = mechanism_from(GIVEN)
    assert [(axis.type, axis.variable) for axis in plain.axes] == [
        (JointType.REVOLUTE, Symbol("theta1", real=True))
    ]
    assert mechanism_from(GIVEN + "joints: [{x-mass: 3}]\nx-more: 1\n") == plain


@pytest.mark.parametrize("given", ["approach", "sliding"])
def test_any_two_vectors_turn_the_tool(given: str) -> None:
    # n = s x a by hand: (2, 1, -2) x (1, 2, 2) = (6, -6, 3).
    vectors = {"approach": "[1/3, 2/3, 2/3]", "sliding": "[2/3, 1/3, -2/3]"}
    normal = "normal: [2/3, -2/3, 1/3]"
    told = f"tool: {{point: [0, 0, 1], {given}: {vectors[given]}, {normal}}}\n"
    approach, sliding = (tuple(Rational(x, 3) for x in v) for v in ((1, 2, 2), (2, 1, -2)))
    assert mechanism_from(ONE + told).tool == ToolFrame((0, 0, 1), approach, sliding)


def test_a_normal_along_the_approach_is_told_where_the_tool_is(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "tool.yaml"
    path.write_text(f"{ONE}tool: {{point: [0, 2, 0], approach: [0, 0, 1], normal: [0, 0, 1]}}\n")
    assert run(["frames", str(path)]) == 2  # sliding, which is a x n, does not stand in the file
    assert f"{path}:4:7: direction is zero" in capsys.readouterr().err


def test_what_is_taken_for_exact_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "near.yaml"
    direction = "[0, 0.9999999999995, 0.000001]"
    path.write_text(AXES.format(point="[2, 7, 5]", direction=direction, more="units: {length: m}"))
    assert run(["frames", str(path)]) == 0
    shown = capsys.readouterr()
    taken = "axis 2: at right angles to axis 1 within the tolerance, off by 1e-06 rad"
    assert f"{path}:5:35: warning: {taken}" in shown.err
    assert "Axis 2: at right angles to axis 1; off by 1e-6 rad." in shown.out
    assert " = (0, 1, 0.000001)" in shown.out


def test_an_origin_that_is_not_free_may_be_given_all_the_same() -> None:
    skew = AXES.format(point="[2, 7, 5]", direction="[0, 1, 0]", more="")
    told = mechanism_from(skew + "frames: {1: {origin: [2, 0, 5]}}\n")
    assert assign_frames(told).steps == assign_frames(mechanism_from(skew)).steps


def test_x_against_a_common_normal_whose_length_is_a_symbol() -> None:
    text = (EXAMPLES / "mechanisms" / "scara_axes.yaml").read_text()
    turned = text.replace("origin: [a1, 0, d1]", "origin: [a1, 0, d1], x: [-1, 0, 0]")
    robot = assign(mechanism_from(turned))
    assert [joint.a for joint in robot.joints[:2]] == [-a1, Symbol("a2", real=True)]
    assert [joint.theta - joint.variable for joint in robot.joints[:2]] == [pi, pi]


def test_a_tool_beside_the_axis_is_out_of_reach() -> None:
    tool = "tool: {point: [0, 2, 0], approach: [0, 0, 1], sliding: [0, 1, 0]}"
    with pytest.raises(AssignmentError, match=r"does not meet z_0: they pass at a distance of 2;"):
        assign(mechanism_from(ONE + tool))


def test_an_arm_that_does_not_move_has_no_frames_to_assign() -> None:
    post = Robot("post", Convention.STANDARD, (Joint(JointType.FIXED, 0 * pi, a1, a1, pi, None),))
    with pytest.raises(UnsupportedError, match="a mechanism needs at least one joint"):
        assign(mechanism_of(post))


def test_numbers_that_only_look_long() -> None:
    b = Symbol("b", real=True)
    assert tidy(sqrt(5 + 2 * sqrt(6)) - sqrt(2) - sqrt(3)) == 0
    assert angle(a1 * sin(b), a1 * cos(b)) == b
    assert angle(-a1, a1 * sqrt(3)) == -pi / 6


@pytest.mark.parametrize(
    ("more", "line", "says"),
    [
        ("tool: {point: [0, 0, 1], approach: [0, 1, 0], sliding: [0, 0, 1]}", 7, "no row reaches"),
        ("tool: {point: [0, 0, 1], approach: [0, 1, 0], sliding: [0, 1, 0]}", 7, "right angles"),
        ("tool: {point: [0, 0, 1], approach: [0, 1, 0]}", 7, "approach alone"),
        ("frames: {1: {origin: [0, 0, 1]}}", 7, "not free"),
        ("frames: {1: {x: [0.6, 0.8, 0]}}", 7, "at right angles"),
        ("frames: {1: {x: [0, 0, 1]}}", 7, "common normal"),
        ("frames: {0: {origin: [1, 0, 0]}}", 7, "not on the z axis of frame 0"),
        ("frames: {9: {x: reverse}}", 7, "key 9 unknown"),
        ("tolerance: 1", 7, "tolerance is a number"),
        ("last: nowhere", 7, "place of the last frame"),
    ],
)
def test_choices_that_break_a_rule_are_refused(
    run_symdh: Runner, tmp_path: Path, more: str, line: int, says: str
) -> None:
    text = AXES.format(point="[2, 7, 5]", direction="[0, 1, 0]", more=more).lstrip()
    text = text.replace("[3, 1, 2], direction: [0, 1, 0]", "[3, 1, 2], direction: [1, 0, 0]")
    (tmp_path / "bad.yaml").write_text("# axes\n" + text)
    done = run_symdh("frames", "bad.yaml", "--convention", "standard", "-o", "out.yaml")
    assert done.returncode == 2
    assert any(
        each.startswith(f"bad.yaml:{line}:") and says in each for each in done.stderr.splitlines()
    ), done.stderr
    assert not (tmp_path / "out.yaml").exists()


def test_a_tool_out_of_reach_is_reached_by_a_word_when_asked() -> None:
    tool = "tool: {point: [0, 0, 1], approach: [0, 1, 0], sliding: [0, 0, 1]}\nlast: joint"
    mechanism = mechanism_from(AXES.format(point="[2, 7, 5]", direction="[0, 1, 0]", more=tool))
    robot = assign(mechanism, Convention.STANDARD)
    assert robot.tool
    assert mechanism.tool is not None
    home = {axis.variable: 0.0 for axis in mechanism.axes}
    assert table_pose(robot, home) == pytest.approx(tool_pose(mechanism.tool), abs=1e-14)


@pytest.mark.parametrize("convention", BOTH)
@pytest.mark.parametrize("name", ["puma560", "kinova_jaco", "scara_rrpr", "ikbt_Stanford"])
def test_parameters_are_read_off_frames(name: str, convention: Convention) -> None:
    mechanism = mechanism_of(load_table(str(HERE / "data" / "tables" / f"{name}.yaml")).robot)
    found = assign_frames(mechanism, convention)
    poses = [pose_of_matrix(step.placed.matrix) for step in found.steps]
    assert read_frames(poses, convention) == found.measured


SYMBOLIC = """
name: arm
joints:
  - {point: [0, 0, 0], direction: [0, 0, 1]}
  - {point: [a1, 0, d1], direction: [0, sin(beta), cos(beta)]}
  - {point: [a1 + b, c, d1], direction: [0, sin(beta), cos(beta)], type: prismatic, home: 0.1}
  - {point: [x, y, z], direction: [0, 0, -1], home: -90 deg}
tool: {point: [x, y, z - h], approach: [0, 0, -1], sliding: [cos(gamma), sin(gamma), 0]}
"""


@pytest.mark.parametrize("convention", BOTH)
def test_lengths_and_angles_may_be_symbols_of_any_sign(convention: Convention) -> None:
    mechanism = mechanism_from(SYMBOLIC)
    found = assign_frames(mechanism, convention)
    assert found.exact
    twists = [joint.alpha for joint in found.robot.joints]
    assert -Symbol("beta", real=True) in twists
    names = found.robot.parameters
    generator = random.Random(5)
    for _ in range(20):
        values = {symbol: generator.uniform(-2, 2) for symbol in names}
        values |= {axis.variable: generator.uniform(-3, 3) for axis in mechanism.axes}
        home = values | {axis.variable: float(axis.home) for axis in mechanism.axes}
        moved = table_pose(found.robot, values) @ np.linalg.inv(table_pose(found.robot, home))
        assert moved == pytest.approx(moved_by(mechanism, values), abs=1e-11)


@pytest.mark.parametrize("convention", BOTH)
@pytest.mark.parametrize("kind", [JointType.REVOLUTE, JointType.PRISMATIC])
@pytest.mark.parametrize("tool", [None, "tip", "frame"])
def test_one_joint_with_and_without_a_tool(
    convention: Convention, kind: JointType, tool: str | None
) -> None:
    point = (Integer(1), Integer(2), Integer(3))
    direction = (Rational(2, 7), Rational(3, 7), -Rational(6, 7))
    axis = JointAxis(kind, point, direction, q1, home=Rational(1, 5))
    frame = random_tool(random.Random(3))
    given = {None: None, "tip": ToolFrame(frame.point), "frame": frame}[tool]
    mechanism = Mechanism("one", (axis,), given)
    robot = assign(mechanism, convention)
    home = table_pose(robot, {q1: 0.2})
    moved = table_pose(robot, {q1: 1.3}) @ np.linalg.inv(home)
    assert moved == pytest.approx(moved_by(mechanism, {q1: 1.3}), abs=1e-13)
    if tool == "frame":
        assert home == pytest.approx(tool_pose(frame), abs=1e-14)
    if tool == "tip":
        assert home[:3, 3] == pytest.approx([float(e) for e in frame.point], abs=1e-14)


E4 = Matrix.eye(4)


def pose_of(*rows: Sequence[Any]) -> Matrix:
    return Matrix([*rows, [0, 0, 0, 1]])


@pytest.mark.parametrize(
    ("matrix", "convention", "says"),
    [
        (
            pose_of([0, 0, 1, 1], [0, 1, 0, 0], [-1, 0, 0, 0]),
            Convention.STANDARD,
            "x_1 is not perpendicular to z_0: they make an angle of 180 deg",
        ),
        (
            pose_of([1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 0]),
            Convention.STANDARD,
            "x_1 does not meet z_0: they pass at a distance of 2, x_1 at [0, 2, 0]",
        ),
        (
            pose_of([1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 0]),
            Convention.MODIFIED,
            "x_0 does not meet z_1: they pass at a distance of 2, x_0 at [1, 0, 0]",
        ),
        (pose_of([1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0]), Convention.STANDARD, "left-handed"),
        (pose_of([1, 1, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]), Convention.STANDARD, "no unit vector"),
        (
            pose_of([1, Rational(3, 5), 0, 1], [0, Rational(4, 5), 0, 0], [0, 0, 1, 0]),
            Convention.STANDARD,
            "x_1 and y_1 are not at right angles",
        ),
        (
            pose_of([cos(t1), 0, sin(t1), 0], [0, 1, 0, 0], [-sin(t1), 0, cos(t1), 0]),
            Convention.STANDARD,
            "x_1 is not perpendicular to z_0: their product is -sin(theta1)",
        ),
        (
            pose_of([1, 0, 0, 1], [0, 1, 0, a1], [0, 0, 1, 0]),
            Convention.STANDARD,
            "they pass at a distance of a1, x_1 at [0, a1, 0]",
        ),
    ],
)
def test_frames_that_break_a_condition_are_named(
    matrix: Matrix, convention: Convention, says: str
) -> None:
    with pytest.raises(AssignmentError) as caught:
        read_frames([pose_of_matrix(E4), pose_of_matrix(matrix)], convention)
    assert says in str(caught.value)
    assert caught.value.faults[0].subject == ("matrix", 1)


GIVEN_FRAMES = """
name: arm
convention: standard
matrices:
  - [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]
  - [[1, 0, 0, a1], [0, 0, 1, 0], [0, -1, 0, d1], [0, 0, 0, 1]]
  - [[0, 0, 1, a1], [0, 1, 0, 2], [-1, 0, 0, d1]]
joints:
  - {variable: q1, home: 30 deg}
  - {variable: q2, type: prismatic}
"""


def test_a_file_may_hold_the_frames_themselves(run_symdh: Runner, tmp_path: Path) -> None:
    robot = assign(mechanism_from(GIVEN_FRAMES))
    rows = [(joint.theta, joint.d, joint.a, joint.alpha) for joint in robot.joints]
    assert rows == [(q1 - pi / 6, d1, a1, -pi / 2), (pi / 2, q2 + 2, 0, pi / 2)]
    q = {q1: float(pi / 6), q2: 0.0, a1: 0.7, d1: 1.1}
    last = [[0, 0, 1, 0.7], [0, 1, 0, 2], [-1, 0, 0, 1.1], [0, 0, 0, 1]]
    assert table_pose(robot, q) == pytest.approx(np.array(last), abs=1e-15)
    (tmp_path / "frames.yaml").write_text(GIVEN_FRAMES)
    told = run_symdh("frames", "frames.yaml", "-o", "arm.yaml")
    assert told.returncode == 0
    assert "b₂ = (a₁, 2, d₁)" in told.stdout
    crooked = GIVEN_FRAMES.replace("[0, 1, 0, 2], [-1", "[0, 1, 0, 2], [1, 0, 0, 0], [-1")
    (tmp_path / "frames.yaml").write_text(crooked)
    refused = run_symdh("frames", "frames.yaml", "-o", "other.yaml")
    assert refused.returncode == 2
    assert "frames.yaml:7:49: the last row of a pose" in refused.stderr
    assert "1 error\n" in refused.stderr
    skew = GIVEN_FRAMES.replace("[0, 0, 1, a1], [0, 1, 0, 2]", "[0, 0, 1, a1 + 3], [0, 1, 0, 2]")
    (tmp_path / "frames.yaml").write_text(skew)
    refused = run_symdh("frames", "frames.yaml", "-o", "other.yaml")
    assert "frames.yaml:7:5: x_2 does not meet z_1: they pass at a distance of 3" in refused.stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == ["arm.yaml", "frames.yaml"]


def test_given_frames_may_miss_by_less_than_the_tolerance() -> None:
    text = GIVEN_FRAMES.replace("[0, 0, 1, 0]]\n", "[0, 0, 1, h]]\n")
    text = text.replace("[0, -1, 0, d1]", "[0.000001, -1, 0, 3]").replace(
        "-1, 0, 0, d1", "-1, 0, 0, 3"
    )
    found = assign_frames(mechanism_from(text.replace("a1", "0")))
    assert not found.exact
    h = Symbol("h", real=True)
    assert found.robot.base == (Motion(MotionKind.TRANSLATION, Axis.Z, h),)
    assert [joint.alpha for joint in found.robot.joints] == [-pi / 2, pi / 2]
    assert found.robot.joints[0].theta == q1 - pi / 6
    assert found.robot.joints[0].d == 3 - h


@pytest.mark.parametrize("convention", BOTH)
def test_tables_load_back_as_they_were(convention: Convention) -> None:
    robots = [load_table(str(path)).robot for path in TABLES]
    robots += [assign(random_mechanism(seed)[0], convention) for seed in range(15)]
    for robot in robots:
        assert loads_table(table_yaml(robot)).robot == robot


def test_a_number_too_long_for_a_table_is_refused() -> None:
    long = Rational(1, 3**200)
    robot = Robot("long", Convention.STANDARD, (Joint(JointType.REVOLUTE, t1, long, a1, pi, t1),))
    with pytest.raises(LimitError, match="317 bits"):
        table_yaml(robot)


def test_an_expression_too_long_for_a_table_is_refused() -> None:
    """A hundred names of six letters are over the 500 characters that a cell may have."""
    long = sum((Symbol(f"a{k:05}", real=True) for k in range(100)), start=Integer(0))
    zero = Integer(0)
    robot = Robot(
        "long", Convention.STANDARD, (Joint(JointType.REVOLUTE, t1, zero, long, zero, t1),)
    )
    with pytest.raises(LimitError, match="has 897 characters, over the limit of 500"):
        table_yaml(robot)


@pytest.mark.parametrize("convention", BOTH)
def test_the_story_is_told_for_every_case(convention: Convention) -> None:
    told = set()
    for seed in range(12):
        mechanism, _ = random_mechanism(seed)
        found = assign_frames(mechanism, convention)
        text = render_chapters(frames_document(found).chapters)
        assert text.count("\nRow ") == mechanism.n
        assert text.count("Frame ") == mechanism.n + 1
        told |= {step.relation for step in found.steps if step.relation}
    assert told == set(Relation)


def story(more: str, point: str = "[3, 4, 9]") -> str:
    """The document on axes 1 and 2 along z and axis 3 along y through (3, 1, 2), in one line."""
    given = AXES.format(point=point, direction="[0, 0, 1]", more=more)
    found = assign_frames(mechanism_from(given), Convention.STANDARD)
    text = " ".join(render_chapters(frames_document(found).chapters).split())
    return unicodedata.normalize("NFC", text)


def test_the_story_of_a_tip_beside_the_last_axis() -> None:
    """From axis 3 the tip is two along x: there are o_3 and x_3, and z_3 stays along the axis."""
    told = story("tool: {point: [5, 1, 2]}")
    assert "The tool's tip is at (5, 1, 2). " in told
    assert "approaches" not in told
    assert "x̂₃ points from the last axis to the tip, ẑ₃ along that axis. o₃ = (5, 1, 2)" in told
    assert "x̂₃ = (1, 0, 0) ẑ₃ = (0, 1, 0)" in told


def test_the_story_of_what_was_asked_for() -> None:
    turned = story("frames: {1: {x: reverse}}")
    # From axis 1 to axis 2 the normal is (3, 4, 0) / 5; the file wants its opposite.
    assert "x̂₁ points along the normal, from axis 1 to axis 2, turned round as asked." in turned
    assert "x̂₁ = (-3/5, -4/5, 0)" in turned
    chosen = story("frames: {3: {x: [0, 0, 1], origin: [3, 8, 2]}}")
    assert "The origin o₃ is free along the axis and was chosen; x̂₃ is free and was chosen." in (
        chosen
    )
    assert "as asked" not in chosen


@pytest.mark.parametrize(("units", "unit"), [("", ""), ("units: {length: mm}", " mm")])
def test_the_story_tells_by_how_much_an_axis_was_off(units: str, unit: str) -> None:
    """Axes 1 and 2 are in line but for a millionth, in the unit of the file, if it has one."""
    assert f"in line with axis 1; off by 1e-6{unit}. " in story(units, "[0.000001, 0, 5]")


def test_frames_command_writes_a_table_that_derives(run_symdh: Runner, tmp_path: Path) -> None:
    axes = EXAMPLES / "mechanisms" / "scara_axes.yaml"
    done = run_symdh("frames", axes, "-o", "arm.yaml")
    assert (done.returncode, "The frames" in done.stdout) == (0, True)
    written = (tmp_path / "arm.yaml").read_text()
    assert run_symdh("frames", axes, "-o", "-").stdout == written
    assert run_symdh("frames", axes, "-o", "arm.yaml").returncode == 0
    shown = run_symdh("show", "arm.yaml", "--format", "json")
    beside = run_symdh("show", EXAMPLES / "scara.yaml", "--format", "json")
    assert shown.stdout == beside.stdout
    latex = run_symdh("frames", axes, "--format", "latex")
    assert latex.returncode == 0
    assert r"\section" in latex.stdout


def example(name: str) -> Mechanism:
    return mechanism_from((EXAMPLES / "mechanisms" / f"{name}_axes.yaml").read_text())


def mechanism_from(text: str) -> Mechanism:
    return read_mechanism(from_text(text, "<test>")).mechanism


def test_frames_as_json_say_how_the_table_came_about(run_symdh: Runner) -> None:
    """By hand: the common normals of the SCARA's parallel axes, and b_2 on the second axis."""
    axes = EXAMPLES / "mechanisms" / "scara_axes.yaml"
    done = run_symdh("frames", axes, "--format", "json")
    assert (done.returncode, done.stderr) == (0, "")
    told = json.loads(done.stdout)
    assert told["frames"]["1"]["origin"] == ["a1", "0", "d1"]
    assert told["frames"]["2"]["relation"] == "parallel"
    assert told["frames"]["2"]["origin_rule"] == "through_previous"
    assert told["frames"]["4"]["z"] == ["0", "0", "-1"]
    assert told["rows"]["2"] == {
        "theta": "0",
        "d": "0",
        "a": "a2",
        "alpha": "0",
        "b": ["a1", "0", "d1"],
    }
    table = loads_table(json.dumps(told["table"])).robot
    assert table.joints == loads_table(run_symdh("frames", axes, "-o", "-").stdout).robot.joints


def test_frames_as_a_web_page(run_symdh: Runner) -> None:
    axes = EXAMPLES / "mechanisms" / "scara_axes.yaml"
    page = run_symdh("frames", axes, "--format", "html").stdout
    assert page.startswith("<!DOCTYPE html>")
    assert page.count('class="symdh-arm"') == 1


# What is too long to be multiplied out


def test_a_square_of_many_terms_stays_under_its_root() -> None:
    """Of (a_1 + .. + a_n)^2 the root is the sum; with 12 terms it is not looked for."""
    few, many = (Add(*(Symbol(f"a{k}", real=True) for k in range(n))) for n in (3, 12))
    assert root(expand(few**2)) == few
    assert root(expand(many**2)) == sqrt(expand(many**2))


def test_frames_that_are_too_long_are_refused() -> None:
    """Axes that are tilted by one angle and turned to another each; no table could hold them."""
    text = """
name: arm
joints:
  - {point: [1/3, 1/3, b], direction: [0, sin(beta), cos(beta)], home: 30 deg}
  - {point: [1/3, 0, 0.25], direction: [0, sin(beta), cos(beta)], type: prismatic, home: 0.2}
  - {point: [0, b, b], direction: [0, 0, -1]}
  - {point: [-a, sqrt(2)*b, b], direction: [0, sin(beta), cos(beta)]}
tool: {point: [0, 1e-6, sqrt(2)*b]}
"""
    with pytest.raises(LimitError, match="over the limit of 1,000 numbers, symbols and operations"):
        assign_frames(read_mechanism(from_text(text, "axes.yaml")).mechanism, Convention.STANDARD)
