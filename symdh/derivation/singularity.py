"""Chapter: singularities. The determinant as a product, and what each factor means."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from sympy import Expr, Integer

from symdh.derivation.blocks import Block, Chapter, EntryStep, EntrySteps, Inline, Paragraph, Text
from symdh.derivation.legend import legend
from symdh.derivation.style import Style
from symdh.derivation.velocity import frame_text
from symdh.derivation.words import counted, number_word
from symdh.kinematics.singular import Factor, Kind, Meaning, Singularities
from symdh.notation.nodes import (
    Call,
    Equation,
    Generic,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Sum,
)
from symdh.notation.writing import weight
from symdh.robot import JointType

#: What there is to read in a factor that stands in the product itself; a longer one gets a name.
_SHORT = 24
#: What there is to read in a factor that is written out at all.
_READABLE = 300

_J = Generic("J")
_ZERO = Number(Integer(0))
_ROWS = tuple(Generic(letter, axis) for letter in ("v", "omega") for axis in "xyz")
_HIDDEN = (
    "A polynomial that is not written out here would fill a page; symdh singular --format json "
    "prints it."
)
_TITLES = {Kind.WRIST: "Wrist", Kind.ELBOW: "Elbow", Kind.SHOULDER: "Shoulder", Kind.AXES: "Axes"}


def chapter(style: Style, found: Singularities, known: Iterable[Node] = ()) -> Chapter:
    """Return the chapter on singularities.

    Parameters
    ----------
    style : Style
    found : Singularities
    known : iterable of Node
        Formulas whose short forms have been introduced.
    """
    blocks: list[Block] = [Paragraph(_matrix(found))]
    if found.factors is None:
        blocks.append(Paragraph(_too_large(found)))
        return Chapter("Singularities", tuple(blocks))
    names = _names(style, found)
    product = _product(style, found, names)
    long = [
        EntryStep(name, (style.notation.write(factor.expression),), None)
        for factor, name in zip(found.factors, names, strict=True)
        if name is not None
    ]
    shown = [step for step in long if weight(step.forms[0]) <= _READABLE]
    formulas = [product, *(step.forms[0] for step in shown)]
    formulas += [style.notation.write(e) for each in found.remaining for e in each]
    meanings = legend(style, formulas, known)
    blocks += _told(found, product)
    blocks += [EntrySteps((step,)) for step in shown]
    blocks += [meanings] if meanings is not None else []
    for factor, name in zip(found.factors, names, strict=True):
        blocks.append(Paragraph((*_condition(style, factor, name), *_meaning(factor))))
    if len(shown) < len(long):
        blocks.append(Paragraph((_HIDDEN,)))
    blocks += _remaining(style, found)
    return Chapter("Singularities", tuple(blocks))


def _names(style: Style, found: Singularities) -> list[Node | None]:
    """Return a name for each factor that is too long to stand in a product."""
    names: list[Node | None] = []
    count = 0
    for factor in found.factors or ():
        is_long = weight(style.notation.write(factor.expression)) > _SHORT
        count += is_long
        names.append(Generic("F", str(count)) if is_long else None)
    return names


def _matrix(found: Singularities) -> Text:
    """Say which matrix is looked at, and why it may be."""
    columns = len(found.joints)
    where: Text = (f"with components along the axes of frame {found.frame}",)
    rows = tuple(_ROWS[r] for r in found.rows)
    if found.point is None:
        return (
            "An arm is singular where its Jacobian loses rank: there is a direction in which the "
            f"point cannot move. {counted(columns, 'joint').capitalize()} can place a point but "
            "not turn it at will, so this is about the rows ",
            *(*_listed(rows), " of ", _J, ", taken ", *where, "."),
        )
    text: tuple[Inline, ...] = (
        "An arm is singular where its Jacobian loses rank: there is a direction in which it cannot "
        "move. The rank is the same in every frame and for every point of the last link; the "
        f"matrix is simplest for the origin of {frame_text(found.point)}, ",
        *where,
    )
    if len(found.rows) < 6:
        return (*text, ". There only the rows ", *_listed(rows), " are not zero throughout.")
    return (*text, ".")


def _listed(nodes: Sequence[Node]) -> Text:
    """Return formulas with commas between and "and" before the last."""
    content: list[Inline] = []
    for position, node in enumerate(nodes):
        if position:
            content.append(" and " if position == len(nodes) - 1 else ", ")
        content.append(node)
    return tuple(content)


def _too_large(found: Singularities) -> Text:
    size = f"{len(found.rows)} × {len(found.joints)}"
    return (
        f"Its minors are polynomials over symdh's limit for a factorisation, so there is no "
        f"formula here: a pose is singular where the {size} matrix ",
        *(_J, f" has a rank below {found.rank}, which is to be decided with numbers."),
    )


def _told(found: Singularities, product: Node) -> list[Block]:
    """Return the determinant, or what the minors have in common."""
    if found.is_square:
        return [EntrySteps((EntryStep(Call("det", (_J,)), (product,), None),))]
    full = min(len(found.rows), len(found.joints))
    size = f"{number_word(found.rank)} rows and columns"
    rank = f" has the rank {found.rank} at almost all poses"
    if found.rank < full:
        rank = f" has the rank {found.rank} at best"
    lead: Text = ("The matrix ", _J, f"{rank}. It loses rank where all minors of {size} vanish. ")
    if not found.factors:
        return [Paragraph((*lead, "They have no factor in common that depends on the pose."))]
    return [
        Paragraph((*lead, "What they have in common is, but for lengths,")),
        EntrySteps((EntryStep(Generic("g"), (product,), None),)),
    ]


def _product(style: Style, found: Singularities, names: Sequence[Node | None]) -> Node:
    """Write constant and factors, single functions before brackets."""
    assert found.factors is not None
    constant = found.constant if found.is_square else Integer(1)
    negative = bool(constant.could_extract_minus_sign())
    size = -constant if negative else constant
    factors = [] if size == 1 else _factors(style.notation.write(size))
    nodes = [
        _power(name or style.notation.write(factor.expression), factor.power)
        for factor, name in zip(found.factors, names, strict=True)
    ]
    nodes.sort(key=lambda node: isinstance(_base(node), Sum))
    factors += nodes
    whole = factors[0] if len(factors) == 1 else Product(tuple(factors)) if factors else None
    if whole is None:
        whole = Number(Integer(1))
    return Negative(whole) if negative else whole


def _factors(node: Node) -> list[Node]:
    return list(node.factors) if isinstance(node, Product) else [node]


def _power(base: Node, exponent: int) -> Node:
    return base if exponent == 1 else Power(base, Integer(exponent))


def _base(node: Node) -> Node:
    return node.base if isinstance(node, Power) else node


def _condition(style: Style, factor: Factor, name: Node | None) -> Text:
    """Return a factor set to zero, its solutions, and what the singularity is called."""
    title = "" if factor.meaning is None else f"{_TITLES[factor.meaning.kind]}: "
    condition = Equation((name or style.notation.write(factor.expression), _ZERO))
    if name is not None:
        variables = tuple(style.notation.write(variable) for variable in factor.variables)
        return (title, condition, ", a condition on ", *_listed(variables), ".")
    if not factor.zeros:
        return (title, condition, ".")
    variable = factor.variables[0]
    turning = any(
        joint.variable == variable and joint.type is JointType.REVOLUTE
        for joint in style.robot.joints
    )
    write = style.notation.angle if turning else style.notation.write
    content: list[Inline] = [title, condition, ", that is "]
    if style.notation.write(factor.expression) == style.notation.write(variable):
        content = [title]
    for position, value in enumerate(factor.zeros):
        if position:
            content.append(" or ")
        content.append(Equation((style.notation.write(variable), write(value))))
    return (*content, ".")


def _meaning(factor: Factor) -> Text:
    meaning = factor.meaning
    return () if meaning is None else (" " + _SENTENCES[meaning.kind](meaning),)


def _axes(meaning: Meaning) -> str:
    a, b, c = meaning.joints
    return (
        f"The axes of joints {a}, {b} and {c} are then parallel to one plane: together they turn "
        "about two directions only."
    )


def _elbow(meaning: Meaning) -> str:
    a, b = meaning.joints
    return (
        f"The axes of joints {a} and {b} and the origin of {_frame(meaning)} then lie in one "
        "plane: the arm is stretched or folded, at the boundary of its workspace."
    )


def _shoulder(meaning: Meaning) -> str:
    a, b = meaning.joints
    return (
        f"The origin of {_frame(meaning)} then lies in the plane through the axis of joint {a} "
        f"that is parallel to the axis of joint {b}."
    )


_SENTENCES = {
    Kind.WRIST: _axes,
    Kind.AXES: _axes,
    Kind.ELBOW: _elbow,
    Kind.SHOULDER: _shoulder,
}


def _frame(meaning: Meaning) -> str:
    assert meaning.point is not None
    return frame_text(meaning.point)


def _remaining(style: Style, found: Singularities) -> list[Block]:
    """Return the poses of lost rank that no single factor tells."""
    if not found.is_complete:
        text = "What is left of the minors can vanish together at other poses as well; those "
        return [Paragraph((f"{text}conditions are too long to be written out.",))]
    if not found.remaining:
        return []
    also = " also" if found.factors else ""
    content: list[Inline] = [f"The rank{also} drops where "]
    for position, conditions in enumerate(found.remaining):
        if position:
            content.append("; or where " if position else "")
        content += _together(style, conditions)
    return [Paragraph((*content, "."))]


def _together(style: Style, conditions: tuple[Expr, ...]) -> list[Inline]:
    content: list[Inline] = []
    for position, condition in enumerate(conditions):
        if position:
            content.append(" and ")
        content.append(Equation((style.notation.write(condition), _ZERO)))
    return content
