"""Chapter: the links multiplied one at a time, each entry with the identity that shortened it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from sympy import Add, Expr, ImmutableMatrix, Rational, Symbol, cos, prime, sin

from symdh.derivation.blocks import (
    Block,
    Chapter,
    EntryStep,
    Identity,
    Paragraph,
    ProductResult,
)
from symdh.derivation.legend import legend
from symdh.derivation.style import Order, Style
from symdh.kinematics.forward import ForwardKinematics, transform
from symdh.kinematics.frame import Frame, place
from symdh.notation.nodes import Generic, Juxtaposed, Node


@dataclass(frozen=True)
class ProductStep:
    """One multiplication: two factors, what they are the poses of, and the exact results.

    Attributes
    ----------
    start, middle, end : Frame
        The product is the pose of `end` in `start`, by way of `middle`.
    left, right : ImmutableMatrix
        The factors as they were printed before.
    result : ImmutableMatrix
        Their product in its short form.
    """

    start: Frame
    middle: Frame
    end: Frame
    left: ImmutableMatrix
    right: ImmutableMatrix
    result: ImmutableMatrix

    def raw_terms(self, row: int, column: int) -> list[Expr]:
        """Return row times column, term by term, nothing combined."""
        return [self.left[row, k] * self.right[k, column] for k in range(4)]


def steps(style: Style, forward: ForwardKinematics) -> Iterator[ProductStep]:
    """Yield the multiplications of the chain in the order that the style asks for."""
    robot = style.robot
    frames = _frames(forward)
    if style.order is Order.RIGHT:
        splits = [(frames[k], frames[k + 1], frames[-1]) for k in range(len(frames) - 3, -1, -1)]
    else:
        splits = [(frames[0], frames[k], frames[k + 1]) for k in range(1, len(frames) - 1)]
    for start, middle, end in splits:
        left, right = transform(robot, start, middle), transform(robot, middle, end)
        yield ProductStep(start, middle, end, left, right, transform(robot, start, end))


def chapter(style: Style, forward: ForwardKinematics) -> Chapter:
    """Return the chapter on the products."""
    right = style.order is Order.RIGHT
    title = "The product, from the hand to the base" if right else "The product, from base to hand"
    blocks: list[Block] = []
    known: list[Node] = [style.notation.matrix(link) for link in forward.links]
    done = list(steps(style, forward))
    if not done:
        blocks.append(Paragraph(("One link alone: its transform is the pose.",)))
    for step in done:
        made = product(style, step, final=step is done[-1])
        introduced = legend(style, [made.matrix], known)
        known.append(made.matrix)
        if introduced is not None:
            blocks.append(introduced)
        blocks.append(made)
    return Chapter(title, tuple(blocks))


def product(style: Style, step: ProductStep, final: bool) -> ProductResult:
    """Return one multiplication as a block."""
    factors = Juxtaposed(
        (_factor_name(style, step.start, step.middle), _factor_name(style, step.middle, step.end))
    )
    return ProductResult(
        (style.pose_name(step.start, step.end), factors),
        style.notation.matrix(step.result),
        tuple(_entry(style, step, row, column) for column in range(4) for row in range(3)),
        final,
    )


def _entry(style: Style, step: ProductStep, row: int, column: int) -> EntryStep:
    """Return an entry of a product: raw and final form, or one form where the two read alike."""
    notation = style.notation
    terms, result = step.raw_terms(row, column), step.result[row, column]
    final = notation.write(result)
    if same_polynomial(Add(*terms), result):
        return EntryStep(entry_name(row, column), (final,), None)
    forms = (notation.sum(terms), final)
    return EntryStep(entry_name(row, column), forms, identity(terms, result))


def same_polynomial(first: Expr, second: Expr) -> bool:
    """Say whether two expressions are equal by algebra alone, sines and cosines taken as letters.

    Decided by exact evaluation at one generic rational point; nothing is expanded.
    """
    letters = sorted(
        first.atoms(cos, sin, Symbol) | second.atoms(cos, sin, Symbol),
        key=lambda atom: (not isinstance(atom, (cos, sin)), str(atom)),
    )
    point = {
        letter: Rational(prime(40 + 7 * k), prime(90 + 5 * k)) for k, letter in enumerate(letters)
    }
    return bool((first.xreplace(point) - second.xreplace(point)).is_zero)


def entry_name(row: int, column: int) -> Node:
    """Return ``r_{11}`` .. ``r_{33}`` or ``p_x`` .. ``p_z``."""
    return Generic("p", "xyz"[row]) if column == 3 else Generic("r", f"{row + 1}{column + 1}")


def identity(terms: list[Expr], result: Expr) -> Identity:
    """Return the identity that takes a raw sum of products to its short form."""
    before = {e for term in terms for e in term.atoms(cos, sin)}
    new = result.atoms(cos, sin) - before
    if not new:
        return Identity.SQUARES
    if len(new) > 1 or result not in (*new, *(-e for e in new)):
        return Identity.ANGLE_SUMS
    only = new.pop()
    signs = {bool(c > 0) for c in only.args[0].as_coefficients_dict().values()}
    if isinstance(only, cos):
        return Identity.COSINE_OF_SUM if len(signs) == 1 else Identity.COSINE_OF_DIFFERENCE
    return Identity.SINE_OF_SUM if len(signs) == 1 else Identity.SINE_OF_DIFFERENCE


def _frames(forward: ForwardKinematics) -> list[Frame]:
    robot = forward.robot
    first, last = place(robot, forward.start), place(robot, forward.end)
    names: list[Frame] = ["base", *range(robot.n + 1), "tool"]
    return names[first + 1 : last + 2]


def _factor_name(style: Style, start: Frame, end: Frame) -> Node:
    if isinstance(start, int) and isinstance(end, int) and end == start + 1:
        return style.link_name(end)
    return style.pose_name(start, end)
