# SPDX-License-Identifier: GPL-3.0-or-later
"""The measuring of a part for its panel: the panel is open meanwhile, and alive however many faces the part has."""

import time
from typing import Callable, Iterator, Optional

from PySide import QtCore

from .. import shapes
from ..errors import Error

#: The window waits for so long at a time.
_SECONDS = 0.02
#: What is raised of a part without a shape, or one that cannot be measured.
FAILURES = (Error, AttributeError, RuntimeError)


class Measuring:
    """Makes the estimate of a mesh object's part, see shapes.estimate_of(), some milliseconds at a time."""

    def __init__(self, mesh, done: Callable[[], None]) -> None:
        """done: called once it is there, or cannot be had."""
        self._mesh, self._done = mesh, done
        self._steps: Optional[Iterator[None]] = None
        self._timer = QtCore.QTimer()
        self._timer.setInterval(0)
        self._timer.timeout.connect(self._go_on)
        self.running = True  #: until it is there

    def start(self) -> None:
        """Begins; ends at once where the part is known."""
        try:
            self._steps = shapes.estimate_in_steps(self._mesh.Shape.Shape)
        except FAILURES:
            self._end()
            return
        self._timer.start()
        self._step()

    def finish(self) -> None:
        """Measures what is left, now."""
        while self.running and self._steps is not None:
            self._step()

    def release(self) -> None:
        """Nothing is measured any more."""
        self._timer.stop()
        self._steps = None

    def _go_on(self) -> None:
        until = time.monotonic() + _SECONDS
        while self.running and self._steps is not None and time.monotonic() < until:
            self._step()

    def _step(self) -> None:
        if self._steps is None:
            return
        try:
            next(self._steps)
        except (StopIteration, *FAILURES):
            self._end()

    def _end(self) -> None:
        self.release()
        self.running = False
        self._done()
