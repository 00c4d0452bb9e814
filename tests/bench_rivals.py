"""What other tools make of a chain, as C; run by bench_code.py with a Python that has them.

    python bench_rivals.py TOOL FOLDER < chain.json

The chain is a product of the elementary matrices of its rows, as a user of these tools writes it.
Each tool gives the pose (12 entries), the geometric Jacobian (6 n) and both, from one expression.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any


def product(rows: list[dict[str, Any]], q: list[Any], cos: Any, sin: Any, modified: bool) -> Any:
    """Return pose entries and Jacobian entries, row by row."""
    T = [[1.0 if i == j else 0.0 for j in range(4)] for i in range(4)]
    frames = []
    for row in rows:
        index, turns = row["variable"], row["turns"]
        theta = row["theta"] + (q[index] if index is not None and turns else 0)
        d = row["d"] + (q[index] if index is not None and not turns else 0)
        ct, st = (cos(theta), sin(theta)) if index is not None and turns else row["cs_theta"]
        ca, sa = row["cs_alpha"]
        a = row["a"]
        about_z = [[ct, -st, 0.0, 0.0], [st, ct, 0.0, 0.0], [0.0, 0.0, 1.0, d], [0, 0, 0, 1.0]]
        about_x = [[1.0, 0.0, 0.0, a], [0.0, ca, -sa, 0.0], [0.0, sa, ca, 0.0], [0, 0, 0, 1.0]]
        if modified:
            T = times(T, about_x)
            frames.append((index, turns, [r[2] for r in T[:3]], None))
            T = times(T, about_z)
            frames[-1] = (*frames[-1][:3], [r[3] for r in T[:3]])
        else:
            frames.append((index, turns, [r[2] for r in T[:3]], [r[3] for r in T[:3]]))
            T = times(times(T, about_z), about_x)
    end = [r[3] for r in T[:3]]
    columns = []
    for index, turns, z, p in frames:
        if index is None:
            continue
        arm = [e - x for e, x in zip(end, p, strict=True)]
        linear = [
            z[(i + 1) % 3] * arm[(i + 2) % 3] - z[(i + 2) % 3] * arm[(i + 1) % 3] for i in range(3)
        ]
        columns.append([*linear, *z] if turns else [*z, 0.0, 0.0, 0.0])
    pose = [entry for r in T[:3] for entry in r]
    return pose, [column[i] for i in range(6) for column in columns]


def times(left: Any, right: Any) -> Any:
    """Multiply two matrices without what is zero: what every tool would drop by itself."""
    result = []
    for i in range(4):
        row = []
        for j in range(4):
            total: Any = 0.0
            for k in range(4):
                x, y = left[i][k], right[k][j]
                if is_number(x, 0) or is_number(y, 0):
                    continue
                term = y if is_number(x, 1) else x if is_number(y, 1) else x * y
                total = term if is_number(total, 0) else total + term
            row.append(total)
        result.append(row)
    return result


def is_number(x: Any, value: int) -> bool:
    """Say whether x is that plain number."""
    return isinstance(x, (int, float)) and x == value


def casadi(chain: dict[str, Any], folder: Path) -> None:
    """CasADi: its own C generator."""
    import casadi as ca

    q = ca.SX.sym("q", chain["n"])
    pose, jacobian = product(
        chain["rows"], [q[i] for i in range(chain["n"])], ca.cos, ca.sin, chain["modified"]
    )
    for name, entries in (("fk", pose), ("jacobian", jacobian), ("both", [*pose, *jacobian])):
        function = ca.Function(f"ca_{name}", [q], [ca.vertcat(*entries)])
        function.generate(f"ca_{name}.c", {"with_header": False})
        text = Path(f"ca_{name}.c").read_text()
        Path(f"ca_{name}.c").unlink()
        text += (
            "\nvoid call(const double *q, double *out)\n{\n    const casadi_real *arg[1];\n"
            "    casadi_real *res[1];\n    arg[0] = q;\n    res[0] = out;\n"
            f"    ca_{name}(arg, res, 0, 0, 0);\n}}\n"
        )
        (folder / f"{name}.c").write_text(text)


def with_cse(chain: dict[str, Any], folder: Path, sm: Any, code: Any) -> None:
    """Write what a library's common subexpression elimination gives."""
    q = [sm.Symbol(f"q{i}") for i in range(chain["n"])]
    pose, jacobian = product(chain["rows"], q, sm.cos, sm.sin, chain["modified"])
    for name, entries in (("fk", pose), ("jacobian", jacobian), ("both", [*pose, *jacobian])):
        parts, results = sm.cse([sm.sympify(e) for e in entries])
        lines = [f"    const double q{i} = q[{i}];" for i in range(chain["n"])]
        lines += [f"    const double {symbol} = {code(value)};" for symbol, value in parts]
        lines += [f"    out[{i}] = {code(value)};" for i, value in enumerate(results)]
        body = "\n".join(lines)
        (folder / f"{name}.c").write_text(
            f"#include <math.h>\nvoid call(const double *q, double *out)\n{{\n{body}\n}}\n"
        )


def sympy(chain: dict[str, Any], folder: Path) -> None:
    """sympy's cse and C printer."""
    import sympy as sm

    with_cse(chain, folder, sm, sm.ccode)


def symforce(chain: dict[str, Any], folder: Path) -> None:
    """SymForce: the elimination of its symbolic engine, as its generator calls it."""
    import symforce as package

    package.set_symbolic_api("symengine")
    import symforce.symbolic as sf
    import sympy as printer

    with_cse(chain, folder, sf.sympy, lambda value: printer.ccode(printer.sympify(str(value))))


def main() -> None:
    """Write fk.c, jacobian.c and both.c, each with `call(q, out)`."""
    tool, folder = sys.argv[1], Path(sys.argv[2])
    {"casadi": casadi, "sympy": sympy, "symforce": symforce}[tool](json.load(sys.stdin), folder)


if __name__ == "__main__":
    main()
