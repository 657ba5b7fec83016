# SPDX-License-Identifier: GPL-3.0-or-later
"""Problems with known answers for verification.py. Each has a shape, a function for its answer, the reference value, the sizes
for a convergence study, and the size and tolerance of the check (in percent; `absolute` if the reference is 0)."""
