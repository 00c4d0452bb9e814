"""URDF: links and joints of a robot, and the serial chain between two of its links.

The meaning of the elements is that of the URDF specification (wiki.ros.org/urdf/XML): a joint's
origin is Txyz(xyz) Rz(yaw) Ry(pitch) Rx(roll), in metres and radians, and then the joint moves
about or along its axis, which is (1, 0, 0) where none is given.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from sympy import Expr

from symdh.errors import Diagnostic
from symdh.robot import ZERO, Limits
from symdh.table.report import Report
from symdh.table.source import Source
from symdh.table.suggest import brief, did_you_mean
from symdh.table.urdf_numbers import NumberReader, Reader, Snap, Triple
from symdh.table.xml_nodes import Attribute, Element, parse_xml

MAX_JOINTS = 50
"""Moving joints in a chain, as many as rows in a table."""

_X_AXIS: Triple = (ZERO + 1, ZERO, ZERO)
_NO_SHIFT: Triple = (ZERO, ZERO, ZERO)


class UrdfJointType(Enum):
    """The kinds of joint that a serial chain may have."""

    REVOLUTE = "revolute"
    CONTINUOUS = "continuous"
    PRISMATIC = "prismatic"
    FIXED = "fixed"


_OTHER_TYPES = ("floating", "planar")
_TYPES = {kind.value: kind for kind in UrdfJointType}
_TYPE_ALIASES = {"hinge": "revolute", "slider": "prismatic", "rotational": "revolute"}


@dataclass(frozen=True, slots=True)
class Placement:
    """Where a joint sits on its parent link, and which way it moves.

    Attributes
    ----------
    xyz, rpy : three Expr
        Its origin: metres, radians.
    axis : three Expr
        In the frame of the joint.
    """

    xyz: Triple
    rpy: Triple
    axis: Triple


@dataclass(frozen=True, slots=True)
class UrdfJoint:
    """One joint of a chain.

    Attributes
    ----------
    name : str
    type : UrdfJointType
    written : Placement
        With the decimals of the file, each at its word.
    meant : Placement
        With multiples of pi where decimals stand for them, and a unit vector for an axis.
    limits : Limits or None
        Radians or metres.
    """

    name: str
    type: UrdfJointType
    written: Placement
    meant: Placement
    limits: Limits | None


@dataclass(frozen=True, slots=True)
class UrdfChain:
    """The joints between two links, from the base to the tip.

    Attributes
    ----------
    name : str
        That of the robot.
    start, end : str
        The two links.
    joints : tuple of UrdfJoint
        Fixed ones included.
    snaps : tuple of Snap
        Decimals that were read as a multiple of pi, or as zero.
    warnings : tuple of Diagnostic
    """

    name: str
    start: str
    end: str
    joints: tuple[UrdfJoint, ...]
    snaps: tuple[Snap, ...]
    warnings: tuple[Diagnostic, ...]


def read_urdf_chain(source: Source, ends: tuple[str, str] | None, tolerance: Expr) -> UrdfChain:
    """Read the chain between two links.

    Parameters
    ----------
    source : Source
        The text of a URDF file.
    ends : (str, str) or None
        Base link and tip link; None where the file has no branch.
    tolerance : Expr
        How far an angle may be from a multiple of 15 deg that it is read as, in radians; 0 takes
        every number as it is written.

    Raises
    ------
    TableError
        At the place of each mistake: no URDF, a link that is missing, a loop, a branch where no
        tip is named, a joint of a chain that cannot be in one.
    """
    return _UrdfReader(source, tolerance).chain(ends)


@dataclass(frozen=True, slots=True)
class _Edge:
    """A joint as an edge of the graph of links."""

    name: str
    parent: str
    child: str
    element: Element
    child_at: Attribute


class _UrdfReader:
    """Reads one file: first the graph of all links, then the numbers of one chain."""

    def __init__(self, source: Source, tolerance: Expr) -> None:
        self.source = source
        self.report = Report(source)
        self.numbers = NumberReader(self.report, tolerance)
        self.root = parse_xml(source)
        self._refuse_other_files()
        self.links = self._links()
        self.edges = self._edges()
        self.report.raise_errors()
        self.parent_edge = self._parent_edges()
        self.report.raise_errors()

    def chain(self, ends: tuple[str, str] | None) -> UrdfChain:
        """Return the chain between two links."""
        self._refuse_loops()
        start, end = self._only_chain() if ends is None else self._named(ends)
        edges = self._path(start, end)
        joints = tuple(joint for edge in edges if (joint := self._joint(edge)) is not None)
        self._refuse_counts(joints)
        self.report.raise_errors()
        name = self.root.attributes.get("name")
        return UrdfChain(
            name=name.text if name else "",
            start=start,
            end=end,
            joints=joints,
            snaps=self.numbers.snaps(),
            warnings=self.report.diagnostics(),
        )

    # -- the graph ---------------------------------------------------------------------------------

    def _refuse_other_files(self) -> None:
        if self.root.tag != "robot":
            message = f"root element is <{brief(self.root.tag)}>; a URDF file starts with <robot>"
            raise self.source.error(self.root.place(), message)
        for element in self.root.children:
            if element.tag.startswith("xacro:"):
                raise self.source.error(
                    element.place(),
                    "this is a xacro file; turn it into URDF first: xacro FILE > arm.urdf",
                )

    def _links(self) -> dict[str, Element]:
        links: dict[str, Element] = {}
        for element in self.root.all("link"):
            name = self._text(element, "name")
            if name is not None and name.text in links:
                self.report.error(name.place(), f"link {brief(name.text)} is there already")
            elif name is not None:
                links[name.text] = element
        if not links:
            self.report.error(self.root.place(), "the robot has no links")
        return links

    def _edges(self) -> list[_Edge]:
        edges: dict[str, _Edge] = {}
        for element in self.root.all("joint"):
            name = self._text(element, "name")
            parent, child = self._end(element, "parent"), self._end(element, "child")
            if name is None or parent is None or child is None:
                continue
            if name.text in edges:
                self.report.error(name.place(), f"joint {brief(name.text)} is there already")
            edges[name.text] = _Edge(name.text, parent.text, child.text, element, child)
        return list(edges.values())

    def _end(self, joint: Element, tag: str) -> Attribute | None:
        """Return the name of the link at one end of a joint."""
        element = joint.first(tag)
        if element is None:
            self.report.error(joint.place(), f"joint has no <{tag}>")
            return None
        link = self._text(element, "link")
        if link is not None and link.text not in self.links:
            hint = did_you_mean(link.text, self.links)
            self.report.error(link.place(), f"there is no link {brief(link.text)}{hint}")
            return None
        return link

    def _text(self, element: Element, name: str) -> Attribute | None:
        found = element.attributes.get(name)
        if found is None or not found.text.strip():
            self.report.error(element.place(), f'<{element.tag}> needs {name}="…"')
            return None
        return found

    def _parent_edges(self) -> dict[str, _Edge]:
        """Return the joint that carries each link; a link has one at most."""
        carried: dict[str, _Edge] = {}
        for edge in self.edges:
            other = carried.get(edge.child)
            if other is not None:
                self.report.error(
                    edge.child_at.place(),
                    f"link {brief(edge.child)} is carried by joint {brief(other.name)} already: "
                    "a closed chain is no serial arm",
                )
            else:
                carried[edge.child] = edge
        return carried

    def _refuse_loops(self) -> None:
        for edge in self.edges:
            at, steps = edge.parent, 0
            while at != edge.child and at in self.parent_edge and steps <= len(self.edges):
                at, steps = self.parent_edge[at].parent, steps + 1
            if at == edge.child:
                message = (
                    f"the joints from link {brief(edge.child)} lead back to it: a closed chain"
                )
                raise self.source.error(edge.child_at.place(), message)

    def _only_chain(self) -> tuple[str, str]:
        """Return the ends of a robot that is one chain."""
        tips = [link for link in self.links if all(edge.parent != link for edge in self.edges)]
        roots = [link for link in self.links if link not in self.parent_edge]
        if len(roots) == 1 and len(tips) == 1:
            return roots[0], tips[0]
        if len(roots) > 1:
            second = self.links[roots[1]]
            message = (
                f"link {brief(roots[1])} hangs on nothing, like {brief(roots[0])}; name the chain"
            )
            raise self.source.error(second.place(), f"{message}: --chain {roots[0]} TIP")
        counts = [edge.parent for edge in self.edges]
        fork = next(edge for edge in self.edges if counts.count(edge.parent) > 1)
        shown = ", ".join(brief(tip) for tip in tips[:8]) + (", …" if len(tips) > 8 else "")
        raise self.source.error(
            fork.element.place(),
            f"the robot branches at link {brief(fork.parent)}; name the chain: "
            f"--chain {roots[0]} TIP, where TIP is any link ({shown})",
        )

    def _named(self, ends: tuple[str, str]) -> tuple[str, str]:
        for end in ends:
            if end not in self.links:
                hint = did_you_mean(end, self.links) or self._some_links()
                message = f"the robot has no link {brief(end)} that --chain names{hint}"
                self.report.error(self.root.place(), message)
        self.report.raise_errors()
        if ends[0] == ends[1]:
            raise self.source.error(self.root.place(), "--chain names one link twice")
        return ends

    def _some_links(self) -> str:
        names = [brief(link) for link in self.links]
        return f"; it has {', '.join(names[:8])}{', …' if len(names) > 8 else ''}"

    def _path(self, start: str, end: str) -> list[_Edge]:
        path = self._upwards(end, start)
        if path is not None:
            return path[::-1]
        place = self.links[end].place()
        if self._upwards(start, end) is not None:
            message = f"link {brief(end)} carries {brief(start)}; write --chain {end} {start}"
            raise self.source.error(place, message)
        raise self.source.error(
            place,
            f"no chain leads from link {brief(start)} up to link {brief(end)}: "
            "neither carries the other",
        )

    def _upwards(self, link: str, goal: str) -> list[_Edge] | None:
        path: list[_Edge] = []
        while link != goal:
            edge = self.parent_edge.get(link)
            if edge is None:
                return None
            path.append(edge)
            link = edge.parent
        return path

    # -- the joints of the chain -------------------------------------------------------------------

    def _refuse_counts(self, joints: tuple[UrdfJoint, ...]) -> None:
        moving = sum(joint.type is not UrdfJointType.FIXED for joint in joints)
        if moving > MAX_JOINTS:
            message = f"the chain has {moving} moving joints, over {MAX_JOINTS}"
            self.report.error(self.root.place(), message)
        elif not moving and len(self.report.diagnostics()) == 0:
            self.report.error(self.root.place(), "no joint of the chain moves")

    def _joint(self, edge: _Edge) -> UrdfJoint | None:
        kind = self._type(edge.element)
        self._refuse_mimic(edge.element)
        origin = edge.element.first("origin")
        plain = self.numbers.plain
        xyz = self._triple(origin, "xyz", plain, self.numbers.length, default=_NO_SHIFT)
        rpy = self._triple(origin, "rpy", plain, self.numbers.angle, default=_NO_SHIFT)
        axis, limits = (_X_AXIS, _X_AXIS), None
        if kind is not UrdfJointType.FIXED:
            axis = self._axis(edge.element)
            limits = self._limits(edge.element, kind)
        if kind is None:
            return None
        written, meant = map(Placement, xyz, rpy, axis)
        return UrdfJoint(edge.name, kind, written, meant, limits)

    def _type(self, joint: Element) -> UrdfJointType | None:
        given = self._text(joint, "type")
        if given is None:
            return None
        word = given.text.strip()
        if word in _OTHER_TYPES:
            self.report.error(given.place(), f"a {word} joint cannot be in a serial arm")
        elif word not in _TYPES:
            hint = did_you_mean(word, _TYPES, _TYPE_ALIASES) or f"; use {', '.join(_TYPES)}"
            self.report.error(given.place(), f"type {brief(word)} unknown{hint}")
        return _TYPES.get(word)

    def _refuse_mimic(self, joint: Element) -> None:
        mimic = joint.first("mimic")
        if mimic is not None:
            master = mimic.attributes.get("joint")
            whom = f" {brief(master.text)}" if master else " another one"
            message = (
                f"this joint follows{whom}; a Denavit-Hartenberg row has a variable of its own"
            )
            self.report.error(mimic.place(), message)

    def _axis(self, joint: Element) -> tuple[Triple, Triple]:
        """Return an axis as it is written, and as the unit vector that it stands for."""
        element = joint.first("axis")
        written, _ = self._triple(element, "xyz", self.numbers.plain, default=_X_AXIS)
        if element is None or "xyz" not in element.attributes:
            return written, written
        return written, self.numbers.unit_vector(written, element.attributes["xyz"])

    def _limits(self, joint: Element, kind: UrdfJointType | None) -> Limits | None:
        element = joint.first("limit")
        if element is None or kind is UrdfJointType.CONTINUOUS:
            return None
        read = self.numbers.plain if kind is UrdfJointType.PRISMATIC else self.numbers.bound
        # A bound that is not given is 0, says the specification.
        lower, upper = (
            self.numbers.single(element.attributes[side], read)
            if side in element.attributes
            else ZERO
            for side in ("lower", "upper")
        )
        if lower is None or upper is None:
            return None
        if lower >= upper:
            if lower > upper:
                self.report.warning(element.place(), "lower limit is above upper limit; left out")
            return None
        return Limits(lower, upper)

    def _triple(
        self, element: Element | None, name: str, *readers: Reader, default: Triple
    ) -> tuple[Triple, Triple]:
        """Read an attribute of three numbers in two ways, the second like the first by default."""
        if element is None or name not in element.attributes:
            return default, default
        given = element.attributes[name]
        first = self.numbers.triple(given, readers[0])
        if first is None:
            return default, default
        return first, self.numbers.triple(given, readers[-1]) or default


__all__ = ["Placement", "UrdfChain", "UrdfJoint", "UrdfJointType", "read_urdf_chain"]
