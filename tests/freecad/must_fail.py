"""Raises: ctest must see it as a failure."""

raise AssertionError("as it should")
