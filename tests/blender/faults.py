# SPDX-License-Identifier: MIT
"""What is refused."""

import ctypes.util
import math
import os
import shutil
import subprocess

import bpy

from common import (FOLDER, LIBRARY, added, bend, by_command, check_near, module, refused, seen, set_library, tube,
                    written)


def check_faults():
    """What cannot be done is said in words."""
    bpy.context.view_layer.objects.active = None
    refused(bpy.ops.object.goffer_bend, "Select a mesh object")
    bpy.ops.object.camera_add()
    refused(bpy.ops.object.goffer_bend, "Select a mesh object")
    added([(0, 0, 0)], [])
    refused(bpy.ops.object.goffer_bend, "no faces")
    added([], [])
    refused(bpy.ops.object.goffer_bend, "no faces")
    flat = added([(0, 0, 0), (9, 0, 0), (9, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)])
    refused(bpy.ops.object.goffer_bend, "cannot be bent")
    assert not flat.goffer_bend.active and flat.data.shape_keys is None and flat.goffer_bend.fault
    obj = tube()
    refused(bpy.ops.object.goffer_bake, "Bend the object first")
    refused(bpy.ops.object.goffer_add_rows, "Bend the object first")
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="EDIT")
    refused(bpy.ops.object.goffer_bend, "Object Mode")
    bpy.ops.object.mode_set(mode="OBJECT")
    twin = bpy.data.objects.new("twin", obj.data)
    refused(bpy.ops.object.goffer_bend, "share this mesh")
    bpy.data.objects.remove(twin)
    obj.scale = (0, 1, 1)
    refused(bpy.ops.object.goffer_bend, "scale")
    obj.scale, obj.delta_scale = (1, 1, 1), (1, 0, 1)
    refused(bpy.ops.object.goffer_bend, "scale")
    obj.delta_scale = (1, 1, 1)
    bend(30)
    check_bend_refused(obj)
    bent = seen(obj)
    check_library_faults(obj)
    assert (seen(obj) == bent).all()
    set_library(LIBRARY)
    obj.goffer_bend.angles[0] = 1
    assert obj.goffer_bend.fault == ""
    check_near(seen(obj), by_command(written(obj), "--angle", f"{math.degrees(1):.9g}"), "the library is back")
    bpy.ops.preferences.addon_disable(module="goffer_bend")
    assert not hasattr(bpy.types.Object, "goffer_bend") and "goffer_bend" not in dir(bpy.ops.object)
    assert len(bpy.app.handlers.frame_change_post) == 0


def check_bend_refused(obj):
    """Neither the settings nor what is baked change."""
    for bake in (False, True):
        if bake:
            bpy.ops.object.goffer_bake(count=2)
        bend_refused = {"angle": math.nan, "folds": 5, "profile": "SMOOTH", "amplitude": "AREA", "wrinkles": 0.5}
        refused(bpy.ops.object.goffer_bend, "cannot be bent", **bend_refused)
        obj.goffer_bend.regions = "0.5 x"
        refused(bpy.ops.object.goffer_bend, "Regions", **{**bend_refused, "angle": 1})
        obj.goffer_bend.regions = ""
    bend(30)


def check_library_faults(obj):
    compiler = shutil.which("cc")
    old = os.path.join(FOLDER, "libold.so")
    paths = [("/nowhere/libgoffer.so", "cannot be loaded"), ("", "is not found. Give its path")]
    if ctypes.util.find_library("goffer"):  # the system's own, which may be of any version
        del paths[1]
    if compiler is not None:
        source = os.path.join(FOLDER, "old.c")
        with open(source, "w", encoding="ascii") as file:
            file.write('const char* goffer_version(void) { return "7.1.0"; }\n')
        subprocess.run([compiler, "-shared", "-fPIC", source, "-o", old], check=True)
        other = os.path.join(FOLDER, "libother.so")
        with open(source, "w", encoding="ascii") as file:
            file.write("int other(void) { return 0; }\n")
        subprocess.run([compiler, "-shared", "-fPIC", source, "-o", other], check=True)
        paths += [(old, "is goffer 7.1.0"), (other, "is no libgoffer")]
    for path, words in paths:
        set_library(path)
        assert words in module().library_fault(), module().library_fault()
        refused(bpy.ops.object.goffer_bend, words)
        obj.goffer_bend.angles[0] = 0.5
        assert words in obj.goffer_bend.fault
