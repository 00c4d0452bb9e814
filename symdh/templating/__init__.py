"""The templates: symdh's own, those that a user puts in their place, and filling them in."""

from __future__ import annotations

from symdh.templating.filling import asset, folder_in_force, own_templates, render
from symdh.templating.own import OwnTemplates

__all__ = ["OwnTemplates", "asset", "folder_in_force", "own_templates", "render"]
