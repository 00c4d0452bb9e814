"""What singularities cost: each arm with six joints, beside sympy's own determinant and `factor`.

The other figure is what a newcomer does: the geometric Jacobian from the plain matrices, then
`Matrix.det` and `factor`, in a process that is ended when its time is up.
"""

from __future__ import annotations

import multiprocessing
import resource
import sys
import time
from pathlib import Path

from sympy import Matrix, factor
from sympy.core.cache import clear_cache

import symdh
from symdh.kinematics.singular import singularities
from symdh.kinematics.velocity import jacobian

TABLES = sorted((Path(__file__).parent / "data" / "tables").glob("*.yaml"))
GOAL = 3.0
#: CPU seconds that sympy gets for one arm; the two named arms stand for all.
PATIENCE = 20
COMPARED = ("puma560", "ur5")


def cpu_of_singularities(robot: symdh.Robot) -> float:
    clear_cache()
    start = time.process_time()
    singularities(robot)
    return time.process_time() - start


def _factored_determinant(table: Path, queue: multiprocessing.Queue[float]) -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (PATIENCE + 5, PATIENCE + 5))
    matrix = Matrix(jacobian(symdh.load(table)).matrix)
    start = time.process_time()
    factor(matrix.det())
    queue.put(time.process_time() - start)


def cpu_of_sympy(table: Path) -> float | None:
    """CPU seconds of `Matrix.det` and `factor` on the same Jacobian; None when time was up."""
    queue: multiprocessing.Queue[float] = multiprocessing.Queue()
    process = multiprocessing.Process(target=_factored_determinant, args=(table, queue))
    process.start()
    process.join(PATIENCE)
    if process.is_alive():
        process.kill()
    process.join()
    return None if queue.empty() else queue.get()


def main() -> int:
    print(f"\nSingularities of the arms with six joints, CPU time; goal: at most {GOAL:g} s each")
    worst = 0.0
    for table in TABLES:
        robot = symdh.load(table)
        if len(robot.variables) != 6:
            continue
        seconds = cpu_of_singularities(robot)
        worst = max(worst, seconds)
        print(f"  {table.stem:24} {seconds:6.2f} s{_beside(table)}")
    print(f"  {'the slowest':24} {worst:6.2f} s  {'met' if worst <= GOAL else 'NOT MET'}")
    return 0 if worst <= GOAL else 1


def _beside(table: Path) -> str:
    if table.stem not in COMPARED:
        return ""
    seconds = cpu_of_sympy(table)
    theirs = f"{seconds:.1f} s" if seconds is not None else f"not done in {PATIENCE} s"
    return f"   sympy det + factor: {theirs}"


if __name__ == "__main__":
    sys.exit(main())
