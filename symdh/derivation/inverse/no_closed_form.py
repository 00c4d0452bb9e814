"""What is said where there is no closed form."""

from __future__ import annotations

from symdh.derivation.blocks import (
    Block,
    Chapter,
    Paragraph,
)
from symdh.derivation.inverse.structure import missing_structure
from symdh.derivation.words import counted
from symdh.kinematics.inverse.inverse import InverseKinematics, Method
from symdh.notation.nodes import (
    Name,
)


def without_closed_form(found: InverseKinematics) -> Chapter:
    """Say that there is no closed form, what was tried, what is missing, and what is done."""
    tried = found.tried
    assert tried is not None
    joints = len(found.robot.variables) - len(found.locked)
    got = "nothing could be found first"
    if tried.steps:
        got = f"the search came as far as {counted(len(tried.steps), 'step')}"
    blocks: list[Block] = [
        Paragraph(
            (
                "No solution in closed form was found. All entries of the matrix equations with "
                "up to three joints moved were compared; known sums, one equation in a sine and a "
                "cosine, two linear ones, square and add, and the elimination of one of two "
                f"angles down to a quartic were tried, and {got}.",
            )
        ),
        Paragraph((missing_structure(found.structure, joints),)),
    ]
    match found.method:
        case Method.NOMINAL:
            text = (
                "The table has lengths or angles that are small, as in a calibrated arm. Without "
                "them the nominal arm has a closed form; it is derived below, and each of its "
                "solutions is improved on the true arm by Newton's method. Near singular poses one "
                "may be missed."
            )
            blocks.append(Paragraph((text,)))
        case Method.ONE_JOINT:
            assert found.searched is not None
            blocks.append(
                Paragraph(
                    (
                        *("What is offered instead is a search over ", Name(found.searched.name)),
                        ": for each of its values the other joints follow in closed form, as "
                        "derived below, and where the equations that are left hold as well there "
                        "is a solution. It may miss one.",
                    )
                )
            )
        case _:
            text = (
                "What is offered instead is damped least squares from many starting points. It "
                "may miss a solution."
            )
            blocks.append(Paragraph((text,)))
    return Chapter("No closed form", tuple(blocks))
