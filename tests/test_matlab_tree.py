"""The exported ``rigidBodyTree`` function is run by Octave, with a stand-in for the toolbox.

Octave has no Robotics System Toolbox. The stand-in does what MathWorks' manual says of the calls
that symdh writes, so syntax, names and arguments are checked by an interpreter, and the pose by
the oracle.
"""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest
from oracle import Arm, read_arm, read_arm_file
from test_convert import CROOKED

import symdh
from symdh.render.interchange import export
from tools import require_tool

ROOT = Path(__file__).parent
TABLES = ("planar_2r", "puma560", "franka_panda", "stanford_textbook", "scara_rrpr", "minimover_5r")
POSES = 5

TREE = """\
classdef rigidBodyTree < handle
  properties
    bodies = {};
    parent = "base";
  end
  methods
    function self = rigidBodyTree (key, format)
      assert (strcmp (key, "DataFormat") && strcmp (format, "row"));
    end
    function addBody (self, body, parent)
      assert (strcmp (parent, self.parent), "the bodies are no chain");
      self.bodies{end+1} = body;
      self.parent = body.Name;
    end
    function pose = reach (self, q)
      pose = eye (4);
      place = 0;
      for k = 1:numel (self.bodies)
        joint = self.bodies{k}.Joint;
        moved = eye (4);
        if (! strcmp (joint.Type, "fixed"))
          place += 1;
          moved = joint.moved (q(place));
        end
        pose = pose * joint.before * moved * joint.after;
      end
      assert (place == numel (q));
    end
  end
end
"""
BODY = """\
classdef rigidBody < handle
  properties
    Name;
    Joint;
  end
  methods
    function self = rigidBody (name)
      self.Name = name;
    end
  end
end
"""
# A revolute joint ignores theta, a prismatic one d: the joint's own motion takes its place.
JOINT = """\
classdef rigidBodyJoint < handle
  properties
    Name;
    Type;
    PositionLimits;
    before = eye (4);
    after = eye (4);
  end
  methods
    function self = rigidBodyJoint (name, type)
      assert (any (strcmp (type, {"revolute", "prismatic", "fixed"})));
      self.Name = name;
      self.Type = type;
    end
    function setFixedTransform (self, numbers, notation)
      if (nargin == 2)
        assert (isequal (size (numbers), [4 4]));
        self.before = numbers;
        return;
      end
      assert (numel (numbers) == 4);
      a = numbers(1); alpha = numbers(2); d = numbers(3); theta = numbers(4);
      if (strcmp (self.Type, "revolute")) theta = 0; end
      if (strcmp (self.Type, "prismatic")) d = 0; end
      about_z = [cos(theta) -sin(theta) 0 0; sin(theta) cos(theta) 0 0; 0 0 1 d; 0 0 0 1];
      about_x = [1 0 0 a; 0 cos(alpha) -sin(alpha) 0; 0 sin(alpha) cos(alpha) 0; 0 0 0 1];
      switch (notation)
        case "dh"
          self.after = about_z * about_x;
        case "mdh"
          self.before = about_x * about_z;
        otherwise
          error ("no such notation: %s", notation);
      end
    end
    function pose = moved (self, q)
      pose = eye (4);
      if (strcmp (self.Type, "revolute"))
        pose(1:2, 1:2) = [cos(q) -sin(q); sin(q) cos(q)];
      else
        pose(3, 4) = q;
      end
    end
  end
end
"""


def cases() -> list[tuple[str, symdh.Robot, Arm]]:
    """Return corpus tables, and rows with offsets, signs, fixed rows, base and tool words."""
    found = []
    for name in TABLES:
        path = ROOT / "data" / "tables" / f"{name}.yaml"
        found.append((name, symdh.load(path), read_arm_file(path)))
    for convention in ("standard", "modified"):
        text = CROOKED.format(convention=convention)
        found.append((f"crooked_{convention}", symdh.loads(text), read_arm(text)))
    return found


def test_octave_builds_the_tree_and_reaches_the_pose(tmp_path: Path) -> None:
    octave = require_tool("octave-cli")
    for name, text in (("rigidBodyTree", TREE), ("rigidBody", BODY), ("rigidBodyJoint", JOINT)):
        (tmp_path / f"{name}.m").write_text(text, encoding="utf-8")
    script = ["1;"]
    expected = []
    for name, robot, arm in cases():
        function = f"{name}_tree"
        text = export(robot, "matlab").text.replace(f"= {robot.name}()", f"= {function}()")
        assert f"= {function}()" in text
        (tmp_path / f"{function}.m").write_text(text, encoding="utf-8")
        q = arm.seeded_poses(POSES, 7)
        metres = {"m": 1.0, "mm": 1e-3}[arm.length]
        script.append(f"robot = {function} ();")
        for row in q:
            # The export is in metres whatever the table is in.
            joints = [
                x if turns else x * metres for x, (_, turns) in zip(row, arm.variables, strict=True)
            ]
            script.append(f"printf ('%.17g ', robot.reach ({[float(x) for x in joints]})');")
        poses = arm.pose({n: q[:, k] for k, (n, _) in enumerate(arm.variables)})
        poses = np.array(poses, dtype=float)
        poses[:, :3, 3] *= metres
        expected.append((name, poses))
        script.append("printf ('\\n');")
    (tmp_path / "main.m").write_text("\n".join(script) + "\n", encoding="utf-8")
    ran = subprocess.run(
        [octave, "--norc", "--no-history", "--quiet", "main.m"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert ran.returncode == 0, ran.stderr
    assert ran.stderr == ""
    lines = ran.stdout.splitlines()
    assert len(lines) == len(expected)
    for line, (name, poses) in zip(lines, expected, strict=True):
        reached = np.array(line.split(), dtype=float).reshape(poses.shape)
        assert reached == pytest.approx(poses, abs=1e-14), name
