# SPDX-License-Identifier: MIT
"""Keys that are baked, and angles with keyframes."""

import math

import bpy
import numpy as np

from common import (FUZE, bend, bend_at_rest, by_command, check_differs, check_near, coordinates, curves_of, enable,
                    imported, module, refused, reported, rest, seen, tube, written)


def check_bake():
    """Baked keys give the shapes of the command where they stand, play by one property, and need no add-on."""
    obj = imported(FUZE)
    before = rest(obj)
    bend(80, direction=0.5)
    assert bpy.ops.object.goffer_bake(count=4) == {"FINISHED"}
    names = [key.name for key in obj.data.shape_keys.key_blocks]
    assert names == ["Basis"] + [f"goffer baked {k} of 4" for k in (1, 2, 3, 4)], names
    scene = bpy.context.scene
    scene.frame_set(scene.frame_start)
    check_near(seen(obj), before, "rest")
    scene.frame_set(scene.frame_end)
    bpy.ops.preferences.addon_disable(module="goffer_bend")
    degrees = math.degrees(0.5)
    check_near(seen(obj), by_command(FUZE, "--angle", "80", "--direction", f"{degrees:.9g}"), "the last frame")
    obj.animation_data_clear()
    for share in (0.25, 0.5, 0.75, 1):
        obj["goffer_bent"] = share
        obj.update_tag()
        check_near(seen(obj), by_command(FUZE, "--angle", str(80 * share), "--direction", f"{degrees:.9g}"),
                   f"baked {share}")
    obj["goffer_bent"] = 0.625
    obj.update_tag()
    between = by_command(FUZE, "--angle", "50", "--direction", f"{degrees:.9g}")
    assert 1e-6 < np.abs(seen(obj) - between).max() / np.ptp(between, axis=0).max() < 0.05
    enable()
    bpy.ops.object.goffer_reset()
    assert obj.data.shape_keys is None and "goffer_bent" not in obj and (rest(obj) == before).all()


def check_far():
    """How far baked keys are off is what a dense look finds, for vertices and not for each of their coordinates."""
    obj = imported(FUZE)
    for angle in (math.radians(90), math.radians(170)):  # of these the first differs by axis, the other off the middle
        bend(math.degrees(angle), direction=0.7)
        body, _ = module().body_of(obj)
        said = reported(bpy.ops.object.goffer_bake, count=3, animate=False)
        percent = float(said.split("off by up to about ")[1].split(" %")[0])
        true = 0
        for share in np.linspace(0, 1, 61).tolist():
            obj["goffer_bent"] = share
            obj.update_tag()
            off = seen(obj) - body.bend([(angle * share, 0.7)], 1)
            true = max(true, np.linalg.norm(off, axis=1).max())
        true *= 100 / np.ptp(rest(obj), axis=0).max()
        print(f"said {percent} %, true {true:.4g} %")
        assert 0.97 * true < percent < 1.03 * true


def check_cleared():
    """A mesh whose keys the user has removed is baked all the same."""
    obj = imported(FUZE)
    before = rest(obj)
    bend(80)
    obj.shape_key_clear()
    assert bpy.ops.object.goffer_bake(count=2, animate=False) == {"FINISHED"}
    assert (rest(obj) == before).all()
    check_near(seen(obj), by_command(FUZE, "--angle", "80"), "baked without keys")


def check_arc():
    """A body that is bent at rest is baked from there: poses between are vectors, angle times direction."""
    obj = tube(length=12)
    bend_at_rest(obj)
    before = rest(obj)
    bend(100, direction=2)
    path, start = written(obj), module().body_of(obj)[0].rest[0]
    assert "At rest bent by" in obj.goffer_bend.facts and start.angle > 1
    assert bpy.ops.object.goffer_bake(count=2, animate=False) == {"FINISHED"}
    for share in (0, 0.5, 1):
        obj["goffer_bent"] = float(share)
        obj.update_tag()
        x, y = ((1 - share) * start.angle * f(start.direction) + share * math.radians(100) * f(2)
                for f in (math.cos, math.sin))
        expected = by_command(path, "--angle", f"{math.degrees(math.hypot(x, y)):.9g}", "--direction",
                              f"{math.degrees(math.atan2(y, x)):.9g}") if share else before
        check_near(seen(obj), expected, f"baked {share}")


def check_frames():
    """Keyframed angles are followed frame by frame, and baked; also between keyframes."""
    obj = imported(FUZE)
    before, scene = rest(obj), bpy.context.scene
    bend(0)
    refused(bpy.ops.object.goffer_bake_frames, "Nothing moves", start=1, end=9)
    refused(bpy.ops.object.goffer_bake_frames, "are to be baked", start=9, end=1)
    for frame, angle in ((1, 0), (9, 80)):
        obj.goffer_bend.angles[0] = math.radians(angle)
        obj.goffer_bend.keyframe_insert("angles", index=0, frame=frame)
    module().set_linear(obj, "goffer_bend.angles")
    for curve in obj.animation_data.action.fcurves:
        assert curve.array_index == 0
    for frame, angle in ((9, 80), (4, 30), (1, 0)):
        scene.frame_set(frame)
        check_near(seen(obj), by_command(FUZE, "--angle", str(angle)), f"live frame {frame}")
    assert bpy.ops.object.goffer_bake_frames(start=1, end=9, step=2) == {"FINISHED"}
    assert len(obj.data.shape_keys.key_blocks) == 6 and not obj.goffer_bend.active
    for frame in (9, 3, 5, 1, 7):
        scene.frame_set(frame)
        check_near(seen(obj), by_command(FUZE, "--angle", str(10 * (frame - 1))), f"baked frame {frame}")
    scene.frame_set(4)
    check_differs(seen(obj), before, "between")
    scene.frame_set(3, subframe=0.5)
    below, above = (by_command(FUZE, "--angle", angle) for angle in ("20", "40"))
    check_near(seen(obj), 0.75 * below + 0.25 * above, "a quarter of the way to the next key")
    scene.frame_set(20)
    check_near(seen(obj), by_command(FUZE, "--angle", "80"), "after the last frame")
    assert len(curves_of(obj)) == 1
    bend(80)
    assert bpy.ops.object.goffer_bake_frames(start=1, end=9, step=3) == {"FINISHED"}
    names = [key.name for key in obj.data.shape_keys.key_blocks[1:]]
    assert names == [f"goffer frame {frame}" for frame in (1, 4, 7, 9)], names
    scene.frame_set(9)
    check_near(seen(obj), by_command(FUZE, "--angle", "80"), "the last frame, between steps")
    check_reset(obj, before)


def check_reset(obj, before):
    """Animation of the sliders goes too, that of anything else stays, and so does what another object plays."""
    obj.keyframe_insert("location", frame=1)
    obj.driver_add("goffer_bend.wrinkles")
    twin = bpy.data.objects.new("twin", bpy.data.meshes.new("twin"))
    action = twin.animation_data_create().action = obj.animation_data.action
    assert action.name in reported(bpy.ops.object.goffer_reset)
    assert "goffer_bend.angles" in [path for path, _, _ in curves_of(twin)] and not obj.animation_data.drivers
    bpy.data.objects.remove(twin)
    bpy.ops.object.goffer_reset()
    assert [path for path, _, _ in curves_of(obj)] == ["location"] * 3
    assert obj.data.shape_keys is None and (rest(obj) == before).all()
