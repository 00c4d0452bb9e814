"""A user's folder of templates, read once and whole."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from symdh.errors import Diagnostic, LimitError, ReadError, UnsupportedError
from symdh.table.source import Source, read_source
from symdh.table.suggest import did_you_mean
from symdh.templating.catalogue import SUFFIX, shipped

_MAX_FILES = 1000
#: How alike a name must be to one of symdh's for a file without the suffix to be a template.
_LIKENESS = 0.8


@dataclass(frozen=True, eq=False)
class OwnTemplates:
    """The templates of one folder.

    Attributes
    ----------
    folder : str
        As the user named it.
    files : mapping of str to Source
        By name, ``latex/body.tex.jinja`` say; those that stand for one of symdh's and those that
        they include.
    warnings : tuple of Diagnostic
        Files that nothing uses.
    """

    folder: str
    files: Mapping[str, Source]
    warnings: tuple[Diagnostic, ...] = ()


def read_folder(folder: str) -> OwnTemplates:
    """Read the templates of a folder, unchecked.

    Raises
    ------
    ReadError
        When the folder or a template cannot be read.
    UnsupportedError
        When something in it leads out of it.
    LimitError
        When the folder holds too many files.
    """
    root = Path(folder)
    try:
        if not root.is_dir():
            raise ReadError(f"{folder}: {'not a folder' if root.exists() else 'no such folder'}")
        names = sorted(_names(root))
    except OSError as problem:
        raise ReadError(f"{folder}: {(problem.strerror or str(problem)).lower()}") from None
    known = shipped()
    wanted = [
        name
        for name in names
        if name.endswith(SUFFIX) or did_you_mean(name, known, likeness=_LIKENESS)
    ]
    return OwnTemplates(folder, {name: read_source(str(root / name)) for name in wanted})


def _names(root: Path) -> Iterator[str]:
    """Yield the files below a folder; what is hidden is not meant."""
    inside = root.resolve()
    count = 0
    for place, folders, files in os.walk(root, onerror=_raise):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for name in folders:
            if (Path(place) / name).is_symlink():
                raise UnsupportedError(f"{Path(place) / name}: a link to a folder is not followed")
        for name in files:
            path = Path(place) / name
            if name.startswith("."):
                continue
            count += 1
            if count > _MAX_FILES:
                raise LimitError(f"{root}: over {_MAX_FILES} files; is it a folder of templates?")
            if not path.resolve().is_relative_to(inside):
                raise UnsupportedError(f"{path}: a link out of {root} is not followed")
            yield path.relative_to(root).as_posix()


def _raise(problem: OSError) -> None:
    raise problem
