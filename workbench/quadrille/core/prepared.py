# SPDX-License-Identifier: GPL-3.0-or-later
"""Work that is done ahead of the call that uses it. A window does the long work first and shows the progress; the call that
macros record follows at once and takes the result from here."""

from typing import Callable, Dict, Generic, Hashable, Optional, TypeVar

Result = TypeVar("Result")


class Prepared(Generic[Result]):
    """At most one result, by what it was made of. The next result replaces one that was not taken."""

    def __init__(self) -> None:
        self._kept: Dict[Hashable, Result] = {}

    def put(self, key: Hashable, result: Result) -> None:
        """Keeps a result instead of the previous one."""
        self._kept = {key: result}

    def make(self, key: Hashable, work: Callable[[], Result]) -> Result:
        """Does the work, keeps its result and returns it. What was kept before is gone even if the work fails."""
        self._kept = {}
        result = work()
        self.put(key, result)
        return result

    def take(self, key: Hashable) -> Optional[Result]:
        """The result made of this, which is then kept no longer; None if there is none."""
        return self._kept.pop(key, None)

    def has(self, key: Hashable) -> bool:
        """Whether a result made of this is kept."""
        return key in self._kept
