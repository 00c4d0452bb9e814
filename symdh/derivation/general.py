"""Chapter: the general link transform, multiplied out from its four factors."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Symbol

from symdh import motion
from symdh.derivation.blocks import Block, Chapter, Display, MatrixRow, NamedMatrix, Paragraph, Text
from symdh.derivation.style import Style
from symdh.motion import Word, rotation, translation
from symdh.notation import Notation
from symdh.notation.nodes import (
    Equation,
    Generic,
    Juxtaposed,
    Matrix,
    Name,
    Node,
    Operator,
    Screw,
    mapped,
)
from symdh.robot import Axis, Convention, Joint, JointType, Motion, Robot

_THETA, _D, _A, _ALPHA = (Symbol(name, real=True) for name in ("theta", "d", "a", "alpha"))
_ROT_Z, _TRANS_Z = rotation(Axis.Z, _THETA), translation(Axis.Z, _D)
_ROT_X, _TRANS_X = rotation(Axis.X, _ALPHA), translation(Axis.X, _A)


def chapter(style: Style) -> Chapter:
    """Return the chapter on the general link transform of the table's convention."""
    if style.robot.convention is Convention.STANDARD:
        general = _General(style, (_ROT_Z, _TRANS_Z, _ROT_X, _TRANS_X), "ABC", (Axis.Z, Axis.X))
        remark: Text = (
            "The motions about and along ",
            Generic("x"),
            " may change places, so this is the sequence of the table.",
        )
    else:
        general = _General(style, (_ROT_X, _TRANS_X, _ROT_Z, _TRANS_Z), "RQP", (Axis.X, Axis.Z))
        remark = ("Both pairs are screws: a turn about an axis and a slide along the same axis.",)
    return Chapter("The transform of one link", general.blocks(remark))


class _General:
    """One link with a running index in place of its number."""

    def __init__(self, style: Style, word: Word, between: str, screws: Sequence[Axis]) -> None:
        self._style = style
        self._word = word
        self._frames = ("i-1", *between, "i")
        self._screws = screws
        row = Joint(JointType.FIXED, _THETA, _D, _A, _ALPHA, None)
        self._notation = Notation(Robot("link", style.robot.convention, (row,)))

    def blocks(self, remark: Text) -> tuple[Block, ...]:
        names = self._names()
        operators = Juxtaposed(tuple(self._operator(m) for m in self._word))
        screws = Juxtaposed(tuple(Screw(axis) for axis in self._screws))
        whole = self._style.pose_name("i-1", "i")
        first, second = self._screws
        halves = (self._word[:2], self._word[2:])
        frames = ", ".join("{" + frame + "}" for frame in self._frames[1:-1])
        return (
            Paragraph(
                (
                    f"Four motions lead from one frame to the next. Call the frames between them "
                    f"{frames}; each motion is read in the frame that the one before it reached.",
                )
            ),
            Display(Equation((whole, Juxtaposed(names)))),
            Display(Equation((whole, operators, screws))),
            Paragraph(remark),
            MatrixRow(
                tuple(
                    NamedMatrix((name, self._operator(each)), self._matrix((each,)))
                    for name, each in zip(names, self._word, strict=True)
                )
            ),
            Paragraph(("Each pair multiplied:",)),
            MatrixRow(
                tuple(
                    NamedMatrix((Screw(axis),), self._matrix(half))
                    for axis, half in zip((first, second), halves, strict=True)
                )
            ),
            Paragraph(("and the two screws together:",)),
            NamedMatrix((whole, screws), self._matrix(self._word)),
        )

    def _names(self) -> tuple[Node, ...]:
        pairs = zip(self._frames, self._frames[1:], strict=False)
        return tuple(self._style.pose_name(start, end) for start, end in pairs)

    def _operator(self, each: Motion) -> Node:
        amount = self._indexed(self._notation.write(each.amount))
        return Operator(each.kind, each.axis, amount, self._style.craig)

    def _matrix(self, word: Word) -> Matrix:
        written = self._notation.matrix(motion.transform(word))
        return Matrix(tuple(tuple(self._indexed(entry) for entry in row) for row in written.rows))

    def _indexed(self, node: Node) -> Node:
        return mapped(node, self._with_index)

    def _with_index(self, leaf: Node) -> Node:
        if not isinstance(leaf, Name):
            return leaf
        standard = self._style.robot.convention is Convention.STANDARD
        return Generic(leaf.text, "i" if standard or leaf.text in ("theta", "d") else "i-1")
