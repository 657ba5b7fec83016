# SPDX-License-Identifier: GPL-3.0-or-later
"""Problems with known answers for verification.py: each has a shape, a way to its answer, the reference, sizes for
convergence, and the size and tolerance (percent; `absolute` where the reference is 0) of the check."""
