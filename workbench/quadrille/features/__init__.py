# SPDX-License-Identifier: GPL-3.0-or-later
"""The document objects of this addon, and what is done with them."""
