"""The pose of a URDF chain, worked out without symdh: ElementTree and numpy, decimals as floats."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any
from xml.etree import ElementTree

import numpy as np


@dataclass(frozen=True)
class Chain:
    """The joints between two links, from the base to the tip, as elements."""

    joints: tuple[ElementTree.Element, ...]

    @property
    def types(self) -> list[str]:
        """Types of the joints that move."""
        return [j.attrib["type"] for j in self.joints if j.attrib["type"] != "fixed"]

    @property
    def names(self) -> list[str]:
        return [j.attrib["name"] for j in self.joints if j.attrib["type"] != "fixed"]

    def pose(self, q: np.ndarray) -> np.ndarray:
        """Poses (..., 4, 4) of the tip in the base for joint values (..., n)."""
        pose = np.broadcast_to(np.eye(4, dtype=np.longdouble), (*q.shape[:-1], 4, 4))
        place = 0
        for joint in self.joints:
            pose = pose @ _origin(joint)
            if joint.attrib["type"] != "fixed":
                pose = pose @ _motion(joint, q[..., place])
                place += 1
        return pose

    def seeded_poses(self, count: int, seed: int) -> np.ndarray:
        reach = [0.5 if kind == "prismatic" else np.pi for kind in self.types]
        uniform = np.random.default_rng(seed).uniform(-1, 1, (count, len(reach)))
        return np.asarray(uniform * np.array(reach))


def read_chain(text: str, base: str, tip: str) -> Chain:
    """Follow the joints from the tip up to the base."""
    root = ElementTree.fromstring(text)
    above = {_link(joint, "child"): joint for joint in root.findall("joint")}
    joints = []
    while tip != base:
        joints.append(above[tip])
        tip = _link(above[tip], "parent")
    return Chain(tuple(reversed(joints)))


def _link(joint: ElementTree.Element, side: str) -> str:
    element = joint.find(side)
    assert element is not None
    return element.attrib["link"]


def _numbers(joint: ElementTree.Element, tag: str, name: str, default: Sequence[float]) -> Any:
    element = joint.find(tag)
    text = None if element is None else element.get(name)
    numbers = default if text is None else [float(word) for word in text.split()]
    return np.array(numbers, dtype=np.longdouble)


def _origin(joint: ElementTree.Element) -> np.ndarray:
    """URDF's fixed-axis roll, pitch, yaw: about x first, then y, then z of the parent."""
    roll, pitch, yaw = _numbers(joint, "origin", "rpy", (0, 0, 0))
    pose = np.eye(4, dtype=np.longdouble)
    x, y, z = np.eye(3)
    turned = _turn(z, np.array(yaw)) @ _turn(y, np.array(pitch)) @ _turn(x, np.array(roll))
    pose[:3, :3] = turned
    pose[:3, 3] = _numbers(joint, "origin", "xyz", (0, 0, 0))
    return pose


def _motion(joint: ElementTree.Element, q: np.ndarray) -> np.ndarray:
    axis = _numbers(joint, "axis", "xyz", (1, 0, 0))
    axis = axis / np.sqrt((axis**2).sum())
    pose = np.zeros((*q.shape, 4, 4), dtype=np.longdouble)
    pose[..., range(4), range(4)] = 1
    if joint.attrib["type"] == "prismatic":
        pose[..., :3, 3] = q[..., None] * axis
    else:
        pose[..., :3, :3] = _turn(axis, q)
    return pose


def _turn(axis: Any, angle: np.ndarray) -> np.ndarray:
    """Rotation by its unit quaternion."""
    half = np.asarray(angle, dtype=np.longdouble) / 2
    w = np.cos(half)
    x, y, z = (np.sin(half) * component for component in np.asarray(axis, dtype=np.longdouble))
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
