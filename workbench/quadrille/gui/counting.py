# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts the quads that a mesh would have, for its panel. A child process counts, so that the window stays responsive even for
large parts."""

import time
from typing import Callable, Optional, Tuple

from PySide import QtCore

from ..core.errors import Error
from ..core.setting_table import MeshSettings
from ..features.sizes import Count, CountJob

_POLL_MILLISECONDS = 20
#: Delay after a change of settings, to wait for further typing.
_SETTLE_MILLISECONDS = 150
#: Exceptions raised for a part without a shape, or one that cannot be measured.
FAILURES = (Error, AttributeError, RuntimeError)


class Counting:
    """At most one count at a time: a new request replaces the previous one."""

    def __init__(self, done: Callable[[Optional[Count], Optional[Exception]], None]) -> None:
        """done: called with the count, or with the reason why there is none."""
        self._done = done
        self._asked: Optional[Tuple[object, MeshSettings, int]] = None  # the request, until its job is started
        self._job: Optional[CountJob] = None
        self._settle, self._timer = QtCore.QTimer(), QtCore.QTimer()
        self._settle.setSingleShot(True)
        self._settle.setInterval(_SETTLE_MILLISECONDS)
        self._settle.timeout.connect(self._start)
        self._timer.setInterval(_POLL_MILLISECONDS)
        self._timer.timeout.connect(self._poll)

    @property
    def busy(self) -> bool:
        """True until the last request is answered."""
        return self._asked is not None or self._job is not None

    def ask(self, shape, settings: MeshSettings, wanted: int = 0) -> None:
        """Asks for the count on a shape, at the size that gives `wanted` quads if there is such a number."""
        self.release()
        self._asked = (shape, settings, wanted)
        self._settle.start()

    def finish(self, go_on: Callable[[], bool]) -> bool:
        """Waits for the answer, while go_on(), which is called again and again, returns True."""
        self._start()
        while self._job is not None:
            time.sleep(_POLL_MILLISECONDS / 1000)
            if not go_on():
                return False
            self._poll()
        return True

    def release(self) -> None:
        """Drops the request that is not answered yet."""
        self._settle.stop()
        self._timer.stop()
        self._asked = None
        job, self._job = self._job, None
        if job is not None:
            job.drop()

    def _start(self) -> None:
        self._settle.stop()
        asked, self._asked = self._asked, None
        if asked is None:
            return
        shape, settings, wanted = asked
        try:
            self._job = CountJob(shape, settings, wanted=wanted).start()
        except FAILURES as error:
            self._done(None, error)
            return
        self._timer.start()

    def _poll(self) -> None:
        if self._job is None:
            return
        self._job.poll()
        if self._job.running:
            return
        job, self._job = self._job, None
        self._timer.stop()
        try:
            count = job.result()
        except FAILURES as error:
            self._done(None, error)
            return
        self._done(count, None)
