"""Python: one module that needs NumPy alone.

``fk(q)`` takes (..., n) to (..., 4, 4), ``jacobian(q)`` to (..., 6, n), ``fk_jacobian(q)`` to both.
"""

from __future__ import annotations

from dataclasses import dataclass

from sympy import Symbol

from symdh.codegen.environment import render
from symdh.codegen.facts import facts_of
from symdh.codegen.forward import forward_routine
from symdh.codegen.graph import Op
from symdh.codegen.jacobian import forward_jacobian_routine, jacobian_routine
from symdh.codegen.listing import Entry, Local, write_listing
from symdh.codegen.literals import literal
from symdh.codegen.names import PYTHON_KEYWORDS, Scope, comment_text, file_stem, words
from symdh.codegen.routine import Routine
from symdh.codegen.targets import GeneratedFile
from symdh.robot import Robot

_FUNCTIONS = {
    Op.SIN: "np.sin",
    Op.COS: "np.cos",
    Op.TAN: "np.tan",
    Op.ASIN: "np.arcsin",
    Op.ACOS: "np.arccos",
    Op.ATAN: "np.arctan",
    Op.ATAN2: "np.arctan2",
    Op.SQRT: "np.sqrt",
    Op.ABS: "np.abs",
    Op.POW: "np.power",
}

#: Written down, because the list of the running Python changes with its version.
_BUILTINS = words(
    """
    ValueError abs aiter all anext any ascii bin bool breakpoint bytearray bytes callable chr
    classmethod compile complex copyright credits delattr dict dir divmod enumerate eval exec exit
    filter float format frozenset getattr globals hasattr hash help hex id input int isinstance
    issubclass iter len license list locals map max memoryview min next object oct open ord pow
    print property quit range repr reversed round set setattr slice sorted staticmethod str sum
    super tuple type vars zip
    """
)

#: Names that the template of the module uses itself.
_OWN = words("fk jacobian fk_jacobian np npt q T J N_JOINTS JOINT_NAMES JOINT_LIMITS")

#: The last two axes of each result; the leading axes are those of ``q``.
_SHAPES = {"T": "4, 4", "J": "6, N_JOINTS"}

#: The routine of a pose leaves its last row to us: 0 0 0 1.
_LAST_OF_POSE = Entry("T", 3, 3, "1.0")

_RESERVED = PYTHON_KEYWORDS | _BUILTINS | _OWN


@dataclass(frozen=True, slots=True)
class _Parameter:
    """A keyword argument of every function; `default` is None where a caller must give a value."""

    name: str
    default: str | None
    original: str


@dataclass(frozen=True, slots=True)
class _Body:
    """The lines of a function: locals, matrices with their shapes, the entries that are not 0."""

    locals: tuple[Local, ...]
    matrices: tuple[tuple[str, str], ...]
    entries: tuple[Entry, ...]


def generate(robot: Robot) -> tuple[GeneratedFile, ...]:
    """Generate ``NAME.py`` (see `symdh.codegen.generate`)."""
    names = _symbol_names(_scope(), robot)
    facts = facts_of(robot)
    parameters = [
        _Parameter(
            name=names[parameter],
            default=literal(robot.values[parameter]) if parameter in robot.values else None,
            original=comment_text(parameter.name),
        )
        for parameter in robot.parameters
    ]
    stem = file_stem(robot.name)
    text = render(
        "python/module.py.jinja",
        stem=stem,
        facts=facts,
        joint_lines=facts.joint_table("q[..., {}]"),
        parameters=parameters,
        required=[parameter for parameter in parameters if parameter.default is None],
        joint_names=[f'"{joint.name}"' for joint in facts.joints],
        joint_limits=[_limits(joint.limits) for joint in facts.joints],
        fk=_body(robot, forward_routine(robot), "T"),
        jacobian=_body(robot, jacobian_routine(robot), "J"),
        fk_jacobian=_body(robot, forward_jacobian_routine(robot), "T", "J"),
    )
    return (GeneratedFile(f"{stem}.py", text),)


def _scope() -> Scope:
    return Scope(_RESERVED.__contains__)


def _symbol_names(scope: Scope, robot: Robot) -> dict[Symbol, str]:
    """Name the symbols; a fresh scope gives each the same name in every function."""
    return scope.take_symbols([*robot.parameters, *robot.variables])


def _body(robot: Robot, routine: Routine, *matrices: str) -> _Body:
    scope = _scope()
    names = _symbol_names(scope, robot)
    listing = write_listing(routine, _FUNCTIONS, names, scope)
    reads = (
        Local(names[variable], f"q[..., {place}]")
        for place, variable in enumerate(robot.variables)
        if variable in listing.inputs
    )
    entries = tuple(entry for entry in listing.entries if entry.text != "0.0")
    return _Body(
        locals=(*reads, *listing.locals),
        matrices=tuple((matrix, _SHAPES[matrix]) for matrix in matrices),
        entries=(*entries, _LAST_OF_POSE) if "T" in matrices else entries,
    )


def _limits(limits: tuple[str, str] | None) -> str:
    return f"({', '.join(limits)})" if limits else "None"
