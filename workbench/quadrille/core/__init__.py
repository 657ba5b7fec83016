# SPDX-License-Identifier: GPL-3.0-or-later
"""The command as a child process, its settings, errors and meshes as arrays: everything independent of documents."""
