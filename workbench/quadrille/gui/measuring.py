# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures a part for its panel. The panel opens before, and stays responsive however many faces the part has."""

import time
from typing import Callable, Iterator, Optional

from PySide import QtCore

from ..core.errors import Error
from ..document import shapes

#: The window is blocked for this long at a time.
_SECONDS = 0.02
#: Exceptions raised for a part without a shape, or one that cannot be measured.
FAILURES = (Error, AttributeError, RuntimeError)


class Measuring:
    """Makes the estimate of a mesh object's part, see shapes.estimate_of(), in steps of some milliseconds."""

    def __init__(self, mesh, done: Callable[[], None]) -> None:
        """done: called once the estimate is ready or has failed."""
        self._mesh, self._done = mesh, done
        self._steps: Optional[Iterator[None]] = None
        self._timer = QtCore.QTimer()
        self._timer.setInterval(0)
        self._timer.timeout.connect(self._go_on)
        self.running = True  #: until the estimate is ready or has failed

    def start(self) -> None:
        """Starts measuring; ends at once if the part's estimate is cached."""
        try:
            self._steps = shapes.estimate_in_steps(self._mesh.Shape.Shape)
        except FAILURES:
            self._end()
            return
        self._timer.start()
        self._step()

    def finish(self) -> None:
        """Measures the rest now, without returning before it is done."""
        while self.running and self._steps is not None:
            self._step()

    def release(self) -> None:
        """Stops measuring."""
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
