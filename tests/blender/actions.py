# SPDX-License-Identifier: MIT
"""Actions that several objects play, and those in the NLA."""

import math

import bpy

from common import bend, check_differs, check_near, curves_of, module, reported, rest, seen, tube


def baked(frames=False, name="object"):
    """A tube that is baked, with the animation of the property, or of a key for each frame."""
    obj = tube()
    obj.name = name
    obj.shape_key_add(name="Basis")  # which stays, and so does what animates the keys
    bend(0 if frames else 60)
    if frames:
        for frame, angle in ((1, 0), (5, 60)):
            obj.goffer_bend.angles[0] = math.radians(angle)
            obj.goffer_bend.keyframe_insert("angles", index=0, frame=frame)
        assert bpy.ops.object.goffer_bake_frames(start=1, end=5, step=2) == {"FINISHED"}
    else:
        assert bpy.ops.object.goffer_bake(count=2) == {"FINISHED"}
    return obj


def animated(obj, frames):
    return obj.data.shape_keys if frames else obj


def pair(frames):
    """Two baked objects of which both play the first one's action; the second is active."""
    first, second = baked(frames, "first"), baked(frames, "second")
    action = animated(first, frames).animation_data.action
    animated(second, frames).animation_data.action = action
    return first, second, action


def check_linked():
    """Whatever is done with an object, another one that plays the same action moves as before."""
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 5

    def moves(obj):
        shapes = []
        for frame in range(1, 6):
            scene.frame_set(frame)
            shapes.append(seen(obj))
        return shapes

    def reset(_obj):
        return reported(bpy.ops.object.goffer_reset)

    def again(_obj):
        return reported(bpy.ops.object.goffer_bend, angle=0.5)

    def anew(obj):
        """With other keyframes than those in the action."""
        said = reported(bpy.ops.object.goffer_bend, angle=0.5)
        if frames:
            reported(bpy.ops.object.goffer_bake_frames, start=1, end=3)
        else:
            scene.frame_end = 3
            reported(bpy.ops.object.goffer_bake, count=2)
            scene.frame_end = 5
            assert [[frame for frame, _ in points] for _, _, points in curves_of(obj)] == [[1, 3]]
        return said

    for frames in (False, True):
        for act in (reset, again, anew):
            first, second, action = pair(frames)
            before, curves = moves(first), curves_of(animated(first, frames))
            check_differs(before[-1], rest(first), "the first moves")
            bpy.context.view_layer.objects.active = second
            said = act(second)
            assert curves_of(animated(first, frames)) == curves, f"{act.__name__}, frames: {frames}"
            for frame, (now, then) in enumerate(zip(moves(first), before), 1):
                check_near(now, then, f"{act.__name__}, frames: {frames}, frame {frame}")
            assert action.name in said, said
            if act is reset:
                assert len(second.data.shape_keys.key_blocks) == 1 and "goffer_bent" not in second
                bpy.context.view_layer.objects.active = first
                bpy.data.meshes.remove(second.data)  # and the object with it
                bpy.ops.object.goffer_reset()
                assert not curves_of(animated(first, frames))


def check_strips():
    """Curves in the NLA go too, and stay in an action that others play."""
    for linked in (False, True):
        obj = baked()
        action = obj.animation_data.action
        obj.animation_data.nla_tracks.new().strips.new("bent", 1, action)
        obj.animation_data.action = None
        if linked:
            bpy.data.objects.new("other", None).animation_data_create().action = action
        paths = [curve.data_path for curve in action.fcurves]
        assert paths == ['["goffer_bent"]'], paths
        said = reported(bpy.ops.object.goffer_reset)
        assert len(action.fcurves) == linked and (action.name in said) == linked, said
        assert "goffer_bent" not in obj and len(obj.data.shape_keys.key_blocks) == 1
    assert not module().actions_of(tube().animation_data_create())
