"""Inverse kinematics as a document."""

from symdh.derivation.inverse.document import inverse_document as inverse_document
from symdh.derivation.inverse.numbers import Solved as Solved
from symdh.derivation.inverse.numbers import numbers_chapter as numbers_chapter
