"""The four parameters off frames given as matrices, or which condition fails, and where."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from sympy import Expr, Matrix, acos, pi

from symdh.frames import vectors as v
from symdh.frames.choices import shown
from symdh.frames.exact import tidy
from symdh.frames.faults import AssignmentError, Fault
from symdh.frames.geometry import Line, is_small, number, plain, relate
from symdh.frames.placed import Measured, PlacedFrame, measure
from symdh.mechanism import ZERO, Pose, Vector
from symdh.robot import Convention


def read_frames(
    poses: Sequence[Pose], convention: Convention, tolerance: Expr = ZERO
) -> tuple[Measured, ...]:
    """Return theta, d, a and alpha between neighbouring frames.

    Parameters
    ----------
    poses : sequence of Pose
        Frames L_0 .. L_n in one common frame; exact. `pose_of_matrix` makes them from matrices.
    convention : Convention
    tolerance : Expr
        How far numbers may miss the conditions: radians, and the length unit.

    Returns
    -------
    tuple of Measured
        Rows 1 .. n. In the modified convention `a` and `alpha` are a_{i-1} and alpha_{i-1}.

    Raises
    ------
    AssignmentError
        When a pose is none, or neighbours break a Denavit-Hartenberg condition: x_i is
        perpendicular to z_{i-1}, and meets it (modified: x_{i-1} and z_i). It names every one
        that fails, with its frame.
    """
    check_frames(poses, convention, tolerance)
    frames = [placed(pose) for pose in poses]
    return tuple(measure(before, after, convention) for before, after in pairwise(frames))


def pose_of_matrix(matrix: Matrix) -> Pose:
    """Return the columns of a homogeneous 4x4 (or 3x4) matrix."""
    x, y, z, origin = (_column(matrix, k) for k in range(4))
    return x, y, z, origin


def check_frames(poses: Sequence[Pose], convention: Convention, tolerance: Expr = ZERO) -> None:
    """Check that frames obey the Denavit-Hartenberg conditions; see `read_frames`.

    Raises
    ------
    AssignmentError
    """
    numbered = list(enumerate(poses))
    faults = [fault for i, pose in numbered if (fault := _why_no_pose(i, pose, tolerance))]
    if not faults:
        frames = [placed(pose) for pose in poses]
        for i, (before, after) in enumerate(pairwise(frames), start=1):
            faults += _broken(i, before, after, convention, tolerance)
    if faults:
        raise AssignmentError(faults)


def placed(pose: Pose) -> PlacedFrame:
    """Return a pose as a placed frame."""
    x, _, z, origin = pose
    return PlacedFrame(origin, x, z)


def _column(matrix: Matrix, k: int) -> Vector:
    return tidy(matrix[0, k]), tidy(matrix[1, k]), tidy(matrix[2, k])


def _why_no_pose(i: int, pose: Pose, tolerance: Expr) -> Fault | None:
    """Say why columns are no right-handed frame."""
    subject = ("matrix", i)
    columns = pose[:3]
    for name, column in zip("xyz", columns, strict=True):
        if not is_small(v.dot(column, column) - 1, tolerance):
            return Fault(subject, f"{name}_{i} is no unit vector: {shown(column)}")
    for first, second in ((0, 1), (1, 2), (0, 2)):
        if not is_small(v.dot(columns[first], columns[second]), tolerance):
            names = f"{'xyz'[first]}_{i} and {'xyz'[second]}_{i}"
            return Fault(subject, f"{names} are not at right angles")
    if not is_small(v.dot(v.cross(columns[0], columns[1]), columns[2]) - 1, 4 * tolerance):
        return Fault(subject, f"frame {i} is left-handed: z must be x × y")
    return None


def _broken(
    i: int, before: PlacedFrame, after: PlacedFrame, convention: Convention, tolerance: Expr
) -> list[Fault]:
    """Return the conditions that frames i - 1 and i break."""
    if convention is Convention.STANDARD:
        normal, axis = Line(after.origin, after.x), Line(before.origin, before.z)
        names = f"x_{i}", f"z_{i - 1}"
    else:
        normal, axis = Line(before.origin, before.x), Line(after.origin, after.z)
        names = f"x_{i - 1}", f"z_{i}"
    faults = []
    cosine = v.dot(normal.direction, axis.direction)
    if not is_small(cosine, tolerance):
        message = f"{names[0]} is not perpendicular to {names[1]}: {_angle_in_words(cosine)}"
        faults.append(Fault(("matrix", i), message))
    pair = relate(normal, axis)
    if pair.feet is None:
        return faults  # x along z: that they are not perpendicular says it all
    gap = v.subtract(pair.feet[1], pair.feet[0])
    if not all(is_small(entry, tolerance) for entry in gap):
        message = (
            f"{names[0]} does not meet {names[1]}: they pass at a distance of "
            f"{plain(v.length(gap))}, {names[0]} at {shown(pair.feet[0])} and "
            f"{names[1]} at {shown(pair.feet[1])}"
        )
        faults.append(Fault(("matrix", i), message))
    return faults


def _angle_in_words(cosine: Expr) -> str:
    if cosine.free_symbols:
        return f"their product is {cosine}"
    degrees = number(acos(cosine) * 180 / pi)
    return f"they make an angle of {float(degrees):.6g} deg"
