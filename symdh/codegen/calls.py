"""What languages call the functions of their mathematics libraries; most call them alike."""

from __future__ import annotations

from symdh.codegen.graph import Op

#: As C calls them, but for the kind of number; a language changes what it calls otherwise.
CALLS = {
    Op.SIN: "sin",
    Op.COS: "cos",
    Op.TAN: "tan",
    Op.ASIN: "asin",
    Op.ACOS: "acos",
    Op.ATAN: "atan",
    Op.ATAN2: "atan2",
    Op.SQRT: "sqrt",
    Op.ABS: "abs",
    Op.POW: "pow",
}
JAVASCRIPT = {op: f"Math.{call}" for op, call in CALLS.items()}
PYTHON = {op: f"math.{call}" for op, call in CALLS.items()} | {Op.ABS: "abs"}
