"""``symdh templates``: the templates to put one's own in place of."""

from __future__ import annotations

from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

import click

from symdh.cli import console, files, options
from symdh.cli.output import WrittenFile, write_files
from symdh.errors import OutputError, UnsupportedError

if TYPE_CHECKING:
    from symdh.templating.catalogue import Template


@click.command(
    epilog=options.examples(
        "symdh templates                          list them",
        "symdh templates latex/body.tex.jinja     what it lays out, and its variables",
        "symdh templates --export own latex/body.tex.jinja",
        "symdh latex scara.yaml --templates own",
    )
)
@click.argument("names", metavar="[NAME]...", nargs=-1)
@click.option(
    "--export", "folder", metavar="DIR", help="Copy them into a folder, to edit. Default: all."
)
@click.option("--force", is_flag=True, help="Also replace files that are there.")
def templates(names: tuple[str, ...], folder: str | None, force: bool) -> None:
    """List, describe or copy the templates of documents and code.

    NAME is a template, or a folder of them such as latex. With --templates DIR, a command takes a
    template from DIR in place of symdh's of the same name; {% extends "symdh/NAME" %} builds on
    the original, block by block (LaTeX and Typst templates write <% %> and << >>).
    """
    chosen = _chosen(names)
    if folder is not None:
        console.note(files.listing(_export(Path(folder), chosen, force)))
    elif names:
        console.print_result("\n\n".join(_described(template) for template in chosen))
    else:
        longest = max(len(template.name) for template in chosen)
        lines = [f"{template.name:{longest}}  {template.summary}" for template in chosen]
        console.print_result("\n".join(lines))


def _chosen(names: tuple[str, ...]) -> list[Template]:
    """Return the templates that names mean; all of them where nothing is said."""
    from symdh.table.suggest import did_you_mean
    from symdh.templating.catalogue import shipped

    found: dict[str, Template] = {} if names else dict(shipped())
    for name in names:
        folder = name.rstrip("/") + "/"
        matching = {
            each: template
            for each, template in shipped().items()
            if each == name or each.startswith(folder)
        }
        if not matching:
            raise UnsupportedError(f"there is no template {name}{did_you_mean(name, shipped())}")
        found |= matching
    return list(found.values())


def _described(template: Template) -> str:
    return f"{template.name}\n\n{template.description}"


def _export(root: Path, chosen: list[Template], force: bool) -> list[WrittenFile]:
    """Copy templates below a folder, all or, when one is there already, none."""
    there = [template.name for template in chosen if (root / template.name).exists()]
    if there and not force:
        more = f" and {len(there) - 1} more" if len(there) > 1 else ""
        raise OutputError(
            f"refuses to replace {root / there[0]}{more}: it may be edited; --force does it"
        )
    folders: dict[PurePosixPath, dict[str, bytes]] = {}
    for template in chosen:
        path = PurePosixPath(template.name)
        folders.setdefault(path.parent, {})[path.name] = template.text.encode()
    return [
        file
        for folder, contents in folders.items()
        for file in write_files(root / folder, contents, force=True)
    ]
