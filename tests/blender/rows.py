# SPDX-License-Identifier: MIT
"""Add Rows."""

import bpy
import numpy as np

from common import (FUZE, bend, bend_at_rest, by_command, check_near, coordinates, imported, module, refused,
                    reported, rest, seen, tube, written)


def check_rows():
    """A mesh that is too coarse says so, and gets the rows; other shape keys and the rest shape go along."""
    for scale, bent_at_rest in (((1, 1, 1), False), ((1, 1, 2), False), ((1, 1, 1), True)):
        obj = tube(rows=4, length=12)
        if bent_at_rest:
            bend_at_rest(obj)
        obj.scale = scale
        obj.shape_key_add(name="Basis")
        other = obj.shape_key_add(name="wide")
        other.data.foreach_set("co", (rest(obj) * np.float32([1.5, 1.5, 1])).ravel())
        before = np.ptp(rest(obj), axis=0)
        bend(60)
        settings = obj.goffer_bend
        body, _ = module().body_of(obj)
        assert (body.base.rest_angle > 1) == bent_at_rest
        assert body.folds[0].made == 0 and "need a finer mesh" in settings.warnings, settings.warnings
        most, module().Cutter.MOST_FACES = module().Cutter.MOST_FACES, 100
        bent, points = seen(obj), rest(obj)
        refused(bpy.ops.object.goffer_add_rows, "than a million")
        assert (seen(obj) == bent).all() and (rest(obj) == points).all()
        module().Cutter.MOST_FACES = most
        for amplitude, folds in (("NONE", -1), ("MESH", 0)):
            settings.amplitude, settings.folds = amplitude, folds
            assert bpy.ops.object.goffer_add_rows() == {"FINISHED"} and len(rest(obj)) == len(points)
        settings.folds = -1
        assert bpy.ops.object.goffer_add_rows() == {"FINISHED"}
        body, _ = module().body_of(obj)
        print(f"{len(rest(obj))} vertices, {body.folds[0].made} of {body.folds[0].suitable} folds")
        assert body.folds[0].made == body.folds[0].suitable > 0 and settings.warnings.count("finer") == 0
        assert np.allclose(np.ptp(rest(obj), axis=0), before, rtol=1e-5)
        keys = obj.data.shape_keys.key_blocks
        assert np.allclose(coordinates(keys["wide"].data), rest(obj) * np.float32([1.5, 1.5, 1]), atol=1e-4)
        if scale == (1, 1, 1):
            check_near(seen(obj), by_command(written(obj), "--angle", "60", "--direction", "0"), "with rows")
            settings.straight = True
            check_near(seen(obj), by_command(written(obj), "--angle", "60", "--rest", "straight"), "from straight")

def check_shaped():
    """Rows that a shaped body needs in several passes; a limit that a later one meets leaves nothing behind."""
    fuze = imported(FUZE)  # a neck and a belly
    bend(90, folds=2)
    assert "2 folds; 2 need a finer mesh" in fuze.goffer_bend.warnings
    assert bpy.ops.object.goffer_add_rows() == {"FINISHED"}
    print(f"{len(rest(fuze))} vertices for 2 folds")
    assert fuze.goffer_bend.warnings == "" and len(rest(fuze)) < 2_000
    fuze.goffer_bend.folds = -1
    limit_second_pass(fuze)
    assert bpy.ops.object.goffer_add_rows() == {"FINISHED"}
    folds = module().body_of(fuze)[0].folds[0]
    print(f"{len(rest(fuze))} vertices, {folds.made} of {folds.suitable} folds")
    assert folds.made == folds.suitable == 16 and len(rest(fuze)) < 10_000
    check_near(seen(fuze), by_command(written(fuze), "--angle", "90"), "a shaped body")


def limit_second_pass(obj):
    faces, addon = [], module()
    cut_rows, most = addon.cut_rows, addon.Cutter.MOST_FACES

    def counted(*arguments):
        edit = cut_rows(*arguments)
        faces.append(len(edit.faces))
        addon.Cutter.MOST_FACES = faces[0]
        return edit

    addon.cut_rows = counted
    refused(bpy.ops.object.goffer_add_rows, "than a million")
    assert len(faces) == 1, "the limit was met by another pass than the second"
    addon.cut_rows, addon.Cutter.MOST_FACES = cut_rows, most


def check_range():
    """Folds that find no room between From and To are not blamed on the mesh alone; rows that help nothing go."""
    obj = tube(rows=257)
    bend(60)
    settings = obj.goffer_bend
    assert settings.warnings == "" and not settings.needs_rows
    settings.wrinkle_first, settings.wrinkle_last = 0.5, 0.52
    assert "what From and To leave is too short" in settings.warnings and settings.needs_rows, settings.warnings
    assert "finer mesh" not in settings.warnings
    refused(bpy.ops.object.goffer_add_rows, "From and To leave too little")
    settings.wrinkle_first, settings.wrinkle_last, settings.regions = 0, 0.5, "0.5, 0.5"
    assert settings.warnings == "" and not settings.needs_rows, settings.warnings
    assert "no rows are needed" in reported(bpy.ops.object.goffer_add_rows)
    long = tube(columns=4, rows=10801, length=2700)
    bend(60)
    print(long.goffer_bend.warnings)
    assert "in so long a body" in long.goffer_bend.warnings and not long.goffer_bend.needs_rows
    coarse = tube(rows=4)
    coarse.goffer_bend.wrinkle_last = 0.8
    bend(60)
    assert "what From and To leave" in coarse.goffer_bend.warnings
    assert bpy.ops.object.goffer_add_rows() == {"FINISHED"}
    assert coarse.goffer_bend.warnings == "" and not coarse.goffer_bend.needs_rows
    check_near(seen(coarse), by_command(written(coarse), "--angle", "60", "--wrinkle-range", "0,0.8"), "a range")
