# SPDX-License-Identifier: MIT
"""What samples/blender does, checked inside Blender by run.py, against the goffer command on the same files."""

import os
import sys

sys.dont_write_bytecode = True  # beside the sources
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import addon_utils  # noqa: E402
import bpy  # noqa: E402

import actions  # noqa: E402
import baking  # noqa: E402
import common  # noqa: E402
import faults  # noqa: E402
import objects  # noqa: E402
import poses  # noqa: E402
import rows  # noqa: E402
import surfaces  # noqa: E402


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    common.enable()
    name = "check_" + common.CHECK
    next(getattr(subject, name) for subject in (actions, baking, faults, objects, poses, rows, surfaces)
         if hasattr(subject, name))()
    if addon_utils.check("goffer_bend")[1]:
        bpy.ops.preferences.addon_disable(module="goffer_bend")
    print(f"passed: {common.CHECK}")


main()
