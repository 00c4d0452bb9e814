"""C99, also valid C++: ``void NAME_fk(const double q[n], double T[16])``, parameters between.

``NAME_jacobian`` fills ``double J[6 * n]``, ``NAME_fk_jacobian`` both. Sines and cosines come from
a kernel of our own that is inlined, or from <math.h>.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from sympy import Expr, Integer, Symbol

from symdh.codegen.c.batch import Batch, PackWriter
from symdh.codegen.c.body import BodyWriter, Statement, takes_losses, widths
from symdh.codegen.c.folding import WIDTH, fold
from symdh.codegen.c.kernel import Kernel, kernel
from symdh.codegen.c.printer import CPrinter
from symdh.codegen.calls import CALLS
from symdh.codegen.facts import facts_of
from symdh.codegen.forward import forward_routine
from symdh.codegen.graph import Node, Op
from symdh.codegen.inverse.c import c_head, c_section
from symdh.codegen.inverse.dialect import c_dialect
from symdh.codegen.jacobian import forward_jacobian_routine, jacobian_routine
from symdh.codegen.listing import Local
from symdh.codegen.names import Scope, comment_text, file_stem
from symdh.codegen.precision import DOUBLE, FLOAT, PRECISIONS, Precision
from symdh.codegen.reserved import is_reserved_in_c
from symdh.codegen.routine import Routine
from symdh.codegen.targets import GeneratedFile
from symdh.codegen.verification import CheckProgram, Poses, find_program
from symdh.robot import Robot
from symdh.templating import render

_FUNCTIONS = CALLS | {Op.ABS: "fabs"}

#: What is named after the stem of the files.
_OWN = (
    *("fk", "jacobian", "fk_jacobian", "params", "N_JOINTS"),
    *("WIDTH", "INLINE", "pack", "bits", "lost", "library", "sincos", "sincos2", "sincos4"),
    *("fk_batch", "fk_poses", "fk_wide", "WIDE", "wide", "wide_bits", "sincos_wide", "lost_wide"),
    *("spread", "gather", "scatter", "one"),
)


@dataclass(frozen=True, slots=True)
class _Assignment:
    """An element of a result and the text that it is set to."""

    place: str
    text: str


@dataclass(frozen=True, slots=True)
class _Function:
    """A function: its head without the semicolon, its lines, and the arguments it never reads."""

    head: str
    statements: tuple[Statement, ...]
    unread: tuple[str, ...]
    assignments: tuple[_Assignment, ...]


def generate(
    robot: Robot,
    *,
    trig: str = "inline",
    precision: str = "double",
    batch: bool = False,
    lock: tuple[Symbol, ...] = (),
    ik: bool = True,
) -> tuple[GeneratedFile, ...]:
    """Generate ``NAME.h`` and ``NAME.c`` (see `symdh.codegen.generate`).

    Parameters that have a value are compiled in; the others are fields of ``NAME_params``. C has
    no empty array, so a robot without joint variables gets no function for its Jacobian.

    Parameters
    ----------
    robot : Robot
    trig : {"inline", "libm"}
        Where sines and cosines come from.
    precision : {"double", "float"}
        Kind of all numbers. Files and names for float begin with ``NAME_float``.
    batch : bool
        Also write ``NAME_fk_batch`` and ``NAME_fk_poses``, the pose for many joint values; for a
        robot without joint variables there are none.
    lock : tuple of Symbol
        Joint variables that the inverse kinematics holds at what the seed says.
    ik : bool
        Whether to write the inverse kinematics where there is a closed form.
    """
    known = {s: robot.values[s] for s in robot.parameters if s in robot.values}
    writer = _Writer(robot, known, PRECISIONS[precision], is_inline=trig == "inline")
    forward = forward_routine(robot, known)
    functions = {"fk": writer.function("fk", forward, {"T": 16})}
    if robot.variables:
        size = 6 * len(robot.variables)
        alone, both = jacobian_routine(robot, known), forward_jacobian_routine(robot, known)
        functions["jacobian"] = writer.function("jacobian", alone, {"J": size})
        functions["fk_jacobian"] = writer.function("fk_jacobian", both, {"T": 16, "J": size})
    many = writer.batch(forward) if batch and robot.variables else None
    facts = facts_of(robot)
    stem = writer.stem
    real, number = writer.precision.name, writer.precision.literal
    context = {
        "stem": stem,
        "facts": facts,
        "joint_lines": facts.joint_table("q[{}]"),
        "constants": [f"{comment_text(s.name)} = {number(known[s])}" for s in known],
        "fields": [(field, comment_text(s.name)) for s, field in writer.fields.items()],
        "functions": functions,
        "real": real,
        "f": writer.precision.suffix,
        "zero": number(Integer(0)),
        "one": number(Integer(1)),
        "digits": writer.precision.bits,
        "kernel": writer.kernel(functions.values()),
        "batch": many,
        "ik": c_section(
            robot,
            known,
            writer.calls,
            writer.precision,
            stem,
            writer.fields,
            facts,
            lock,
            wanted=ik,
        ),
        "ik_head": c_head(stem, real, len(facts.joints), with_parameters=bool(writer.fields)),
        "within_head": f"int {stem}_within_limits(const {real} q[{len(facts.joints)}])",
        **c_dialect(stem, writer.precision).context(),
    }
    return (
        GeneratedFile(f"{stem}.h", fold(render("c/header.h.jinja", **context))),
        GeneratedFile(f"{stem}.c", fold(render("c/source.c.jinja", **context))),
    )


def check_program(robot: Robot, files: Sequence[GeneratedFile], poses: Poses) -> CheckProgram:
    """Return a program that prints poses (see `symdh.codegen.verification`)."""
    stem = files[0].name.removesuffix(".h")
    kind = FLOAT if stem == f"{file_stem(robot.name)}_{FLOAT.name}" else DOUBLE
    main = render(
        "c/check.c.jinja",
        stem=stem,
        real=kind.name,
        rows=[[kind.number(x) for x in row] for row in poses.joints],
        parameters=[kind.number(x) for x in poses.parameters.values()],
        inverse=poses.inverse is not None,
    )
    compiler = find_program("cc", "gcc", "clang")
    sources = ("check.c", f"{stem}.c")
    return CheckProgram(
        (GeneratedFile("check.c", main),),
        ((compiler, "-O2", *sources, "-o", "check", "-lm"), ("./check",)),
    )


class _Writer:
    """Writes the routines of one robot as functions.

    Attributes
    ----------
    stem : str
        What every name with external linkage begins with.
    precision : Precision
        Kind of all numbers.
    fields : dict of Symbol to str
        The fields of ``NAME_params``.
    calls : dict of Op to str
        What <math.h> calls its functions for that kind of number.
    """

    def __init__(
        self, robot: Robot, known: Mapping[Symbol, Expr], precision: Precision, *, is_inline: bool
    ) -> None:
        stem = file_stem(robot.name)
        self.stem = stem if precision is DOUBLE else f"{stem}_{precision.name}"
        self.precision = precision
        self.calls = {op: call + self.precision.suffix for op, call in _FUNCTIONS.items()}
        self._is_inline = is_inline
        self._robot = robot
        self._own = {f"{self.stem}_{name}" for name in _OWN}
        free = [parameter for parameter in robot.parameters if parameter not in known]
        # Fields only have to keep clear of keywords and macros; locals hide functions, arguments.
        self.fields = Scope(lambda n: n in self._own or is_reserved_in_c(n)).take_symbols(free)

    def kernel(self, functions: Iterable[_Function]) -> Kernel | None:
        """Write the kernel that some functions need, if they do."""
        statements = [statement for function in functions for statement in function.statements]
        needed = widths(statements)
        return kernel(self.precision, needed, loses=takes_losses(statements)) if needed else None

    def function(self, name: str, routine: Routine, results: Mapping[str, int]) -> _Function:
        """Write a routine as a function that fills some arrays, given with their sizes."""
        functions = self.calls
        scope = Scope(lambda n: n in self._own or _is_taken_locally(n) or n in functions.values())
        symbols = scope.take_symbols([*self.fields, *self._robot.variables])
        names: dict[Node, str] = {node: symbols[node.exact] for node in routine.inputs}
        printer = CPrinter(self.precision, functions, names)
        body = BodyWriter(self.stem, names, scope, printer, self.precision.literal(Integer(0)))
        write = body.in_stages if self._is_inline else body.in_line
        inputs = {node.exact for node in routine.inputs}
        read = {"q": inputs & set(self._robot.variables)}
        if self.fields:
            read["p"] = inputs & set(self.fields)
        return _Function(
            head=self._head(name, results),
            # Results are written only after all arguments are read.
            statements=(*self._reads(inputs, symbols), *write(routine)),
            unread=tuple(argument for argument, found in read.items() if not found),
            assignments=tuple(
                _Assignment(f"{matrix}[{place}]", text)
                for matrix, size in results.items()
                for place, text in enumerate(self._elements(routine, printer, matrix, size))
            ),
        )

    def batch(self, routine: Routine) -> Batch:
        """Write the pose for many joint values."""
        functions = self.calls
        # Both functions of the template and the array of entries keep their names.
        taken = {"squares", "square", "i", "q_stride", "q_step", "T_stride", "T_step"}
        taken |= set(functions.values())
        scope = Scope(lambda n: n in self._own or _is_taken_locally(n) or n in taken)
        symbols = scope.take_symbols([*self.fields, *self._robot.variables])
        names: dict[Node, str] = {node: symbols[node.exact] for node in routine.inputs}
        varying = [node for node in routine.inputs if node.exact in self._robot.variables]
        for node in routine.inputs:
            if node.exact in self.fields:
                names[node] = f"p->{self.fields[node.exact]}"
        printer = CPrinter(self.precision, functions, names)
        zero = self.precision.literal(Integer(0))
        body = PackWriter(self.stem, names, scope, printer, zero, varying).body(routine)
        places = {variable: place for place, variable in enumerate(self._robot.variables)}
        reads = tuple((places[node.exact], names[node]) for node in varying)
        read = {"q": bool(reads), "p": not self.fields or len(varying) < len(routine.inputs)}
        real, params = self.precision.name, f"const {self.stem}_params *p"
        between = [params] if self.fields else []
        soa = [f"const {real} *q", "size_t q_stride", *between, f"{real} *T", "size_t T_stride"]
        aos = [f"const {real} *q", *between, f"{real} *T"]
        return Batch(
            soa_head=f"void {self.stem}_fk_batch(size_t count, {', '.join(soa)})",
            aos_head=f"void {self.stem}_fk_poses(size_t count, {', '.join(aos)})",
            body=body if self._is_inline and body.angles else None,
            reads=tuple(sorted(reads)),
            unread=tuple(argument for argument, found in read.items() if not found),
        )

    def _head(self, name: str, results: Mapping[str, int]) -> str:
        n = len(self._robot.variables)
        real = self.precision.name
        arguments = [f"const {real} q[{n}]" if n else f"const {real} *q"]
        if self.fields:
            arguments.append(f"const {self.stem}_params *p")
        arguments += [f"{real} {matrix}[{size}]" for matrix, size in results.items()]
        line = f"void {self.stem}_{name}({', '.join(arguments)})"
        if len(line) < WIDTH:
            return line
        broken = ",\n    ".join(arguments)
        return f"void {self.stem}_{name}(\n    {broken})"

    def _reads(self, inputs: Collection[Expr], symbols: Mapping[Symbol, str]) -> Iterator[Local]:
        places = {symbol: f"q[{place}]" for place, symbol in enumerate(self._robot.variables)}
        places |= {symbol: f"p->{field}" for symbol, field in self.fields.items()}
        for symbol, place in places.items():
            if symbol in inputs:
                yield Local(symbols[symbol], place)

    def _elements(self, routine: Routine, printer: CPrinter, matrix: str, size: int) -> list[str]:
        """Return the elements of a result, row by row; a pose ends in 0 0 0 1."""
        texts = [self.precision.literal(Integer(0))] * size
        if matrix == "T":
            texts[-1] = self.precision.literal(Integer(1))
        columns = 4 if matrix == "T" else size // 6
        for output in routine.outputs:
            if output.matrix == matrix:
                place = columns * output.row + output.column
                texts[place] = printer.expression(output.node)
        return texts


def _is_taken_locally(name: str) -> bool:
    return is_reserved_in_c(name) or name in {"q", "p", "T", "J", *_FUNCTIONS.values()}
