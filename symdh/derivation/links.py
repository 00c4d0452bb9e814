"""Chapter: the transform of each link."""

from __future__ import annotations

from symdh.derivation.blocks import Block, Chapter, NamedMatrix, Paragraph
from symdh.derivation.legend import legend
from symdh.derivation.style import Style
from symdh.kinematics.chain import link_word
from symdh.kinematics.forward import ForwardKinematics
from symdh.motion import Word, transform
from symdh.notation.nodes import Juxtaposed, Node


def chapter(style: Style, forward: ForwardKinematics) -> Chapter:
    """Return the chapter with A_1 .. A_n, and base and tool where the table has them."""
    robot = style.robot
    matrices = [
        _named(style, style.link_name(i), link_word(robot, i)) for i in range(1, robot.n + 1)
    ]
    if robot.base:
        matrices.insert(0, _named(style, style.pose_name("base", 0), robot.base))
    if robot.tool:
        matrices.append(_named(style, style.pose_name(robot.n, "tool"), robot.tool))
    blocks: list[Block] = [
        Paragraph(
            (
                "The rows put into the general transform. A parameter that is zero makes its "
                "motion the identity; only the motions named before each matrix remain.",
            )
        )
    ]
    meanings = legend(style, [m.matrix for m in matrices])
    if meanings:
        blocks.append(meanings)
    return Chapter("The links", (*blocks, *matrices))


def _named(style: Style, name: Node, word: Word) -> NamedMatrix:
    operators = style.operators(word)
    names = (name, Juxtaposed(operators)) if operators else (name,)
    return NamedMatrix(names, style.notation.matrix(transform(word)))
