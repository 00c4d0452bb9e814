"""Results -> a document of typed blocks, independent of any output format."""

from symdh.derivation.blocks import Document
from symdh.derivation.derive import derive
from symdh.derivation.style import Naming, Order, Style

__all__ = ["Document", "Naming", "Order", "Style", "derive"]
