# SPDX-License-Identifier: GPL-3.0-or-later
"""The refinements of a mesh in its panel: the faces, edges and vertices of each, and its size, edited in place. The document
changes only when the panel stores them."""

from typing import Any, Callable, NamedTuple, Tuple

from ..core.errors import Error
from ..document.links import Links, names_in
from ..document.state import Refinement
from . import translate
from .length_field import LengthField
from .row_list import RowList


class _Row(NamedTuple):
    """One refinement as it is shown."""

    region: str
    references: Links
    box: Any  #: the field for the size
    shown: Tuple[float, float]  #: the size, and the value that the field returned for it right after showing it


class RefinementList(RowList):
    """One row per refinement, and a button that adds the selection."""

    def __init__(self, add: Callable[[], None], changed: Callable[[], None]) -> None:
        super().__init__(translate("Quadrille", "Refine selection"),
                         translate("Quadrille", "Set the element size on the selected faces, edges or vertices"),
                         "QuadrilleAddRefinement", add, changed)

    def refinements(self) -> Tuple[Refinement, ...]:
        """The refinements shown. Raises Error if a size cannot be read."""
        found = []
        for row in self._rows:
            try:
                size = row.box.length(translate("Quadrille", "Refinement"))
            except Error as error:
                raise Error(str(error), error.kind, "Refinements") from None
            found.append(Refinement(row.region, row.references, row.shown[0] if size == row.shown[1] else size))
        return tuple(found)

    def show_all(self, refinements: Tuple[Refinement, ...]) -> None:
        """Shows these refinements and no others."""
        self._clear()
        for refinement in refinements:
            self._add_row(refinement)

    def _add_row(self, refinement: Refinement) -> None:
        text = ", ".join(names_in(refinement.references))
        label = f"{refinement.region}: " if refinement.region else ""
        box = LengthField(f"QuadrilleRefinedSize{len(self._rows)}")
        box.show_length(refinement.size)
        self._show_row(_Row(refinement.region, refinement.references, box, (refinement.size, box.length())), text,
                       label + text, box, "QuadrilleRefined")

    def add(self, references: Links, size: float) -> None:
        """Adds a refinement."""
        self._add_row(Refinement("", references, size))
        self._changed()

    def drop(self, region: str) -> bool:
        """Removes the row of a mesh region that is being deleted. Returns whether there was one."""
        numbers = [number for number, row in enumerate(self._rows) if row.region == region]
        for number in numbers:
            self._take_away(number)
        return bool(numbers)

    def _remove(self, number: int) -> None:
        self._take_away(number)
        self._changed()

    def _take_away(self, number: int) -> None:
        rest = [row for index, row in enumerate(self._rows) if index != number]
        texts = [row.box.text() for row in rest]  # unchanged, even if not valid lengths
        self.show_all(tuple(Refinement(row.region, row.references, row.shown[0]) for row in rest))
        for row, text in zip(self._rows, texts):
            row.box.setText(text)
