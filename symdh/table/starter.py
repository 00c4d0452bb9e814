"""The commented table that ``symdh init`` writes."""

from __future__ import annotations

from symdh.table.schema import SCHEMA_FILE

STARTER = f"""\
# yaml-language-server: $schema={SCHEMA_FILE}
# The line above gives editors completion and checks, once the schema lies beside this file:
#     symdh init --schema > {SCHEMA_FILE}

name: my_arm                        # files and functions are named after it
title: A planar arm with two links  # optional, any text
convention: standard                # standard (distal) or modified (proximal, Craig)
units: {{angle: deg, length: m}}      # what a bare number means; 90 deg or 5 mm say it themselves

# One row per joint, from the base to the tip. In a modified table, a and alpha mean a_{{i-1}} and
# alpha_{{i-1}}. A symbol in theta makes a joint revolute, else a symbol in d makes it prismatic,
# else it is fixed; `type: fixed` and the like overrule that. theta2 - 90 deg is a variable with
# an offset. theta1, theta_1 and θ1 are one symbol.
joints:
  - {{theta: theta1, d: 0, a: a1, alpha: 0}}
  - {{theta: theta2, d: 0, a: a2, alpha: 0}}

# The same rows the way a homework sheet has them:
# columns: [alpha, a, d, theta]
# rows:
#   - [0, a1, 0, theta1]
#   - [0, a2, 0, theta2]

# Optional: motions before the first and after the last frame, such as Rz(90 deg), Tx(a3).
base: []
tool: []

# Optional: known numbers, used wherever numbers are asked for.
values: {{a1: 0.5, a2: 0.4, theta1: 30, theta2: 45}}

# Optional: the range of each joint variable.
limits: {{theta1: [-170, 170], theta2: [-120 deg, 120 deg]}}
"""
