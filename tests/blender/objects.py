# SPDX-License-Identifier: MIT
"""What else an object has, and several objects."""

import math
import os

import bpy
import numpy as np

from common import (FOLDER, FUZE, bend, by_command, check_differs, check_near, coordinates, imported, module, refused,
                    rest, seen, tube, written)


def check_mask():
    """A vertex group is what the command has as a channel of the colors."""
    obj = tube()
    height = rest(obj)[:, 2]
    group = obj.vertex_groups.new(name="folds")
    obj.vertex_groups.new(name="other")
    weights = np.clip(1.5 - height / 5, 0, 1)  # vertices above 7.5 are not in the group at all
    for vertex, weight in enumerate(weights.tolist()):
        if weight > 0:
            group.add([vertex], weight, "REPLACE")
    bend(90)
    plain = seen(obj)
    path = written(obj)
    check_near(plain, by_command(path, "--angle", "90"), "no group")
    with open(path, encoding="ascii") as file:
        lines = file.read().splitlines()
    with open(path, "w", encoding="ascii") as file:
        for line, weight in zip(lines, weights.tolist()):
            file.write(f"{line} 0 {weight:.9g} 0\n")
        file.write("\n".join(lines[len(weights):]) + "\n")
    obj.goffer_bend.mask = "folds"
    check_near(seen(obj), by_command(path, "--angle", "90", "--wrinkle-mask", "COLOR_0.g"), "a group")
    check_differs(seen(obj), plain, "a group")
    group.add(list(range(len(weights))), 1, "REPLACE")
    assert bpy.ops.object.goffer_update() == {"FINISHED"}
    check_near(seen(obj), plain, "painted over, and updated")
    obj.vertex_groups.remove(group)
    obj.goffer_bend.angles[0] = 1
    assert "no vertex group 'folds'" in obj.goffer_bend.fault
    obj.goffer_bend.mask = ""
    assert obj.goffer_bend.fault == ""


def check_keys():
    """Other shape keys stay and still act; absolute ones are refused."""
    obj = tube()
    obj.shape_key_add(name="Basis")
    other = obj.shape_key_add(name="wide")
    shape = rest(obj) * np.float32([1.5, 1.5, 1])
    other.data.foreach_set("co", shape.ravel())
    path, before = written(obj), rest(obj)
    bend(60)
    bent = by_command(path, "--angle", "60")
    check_near(seen(obj), bent, "beside a key")
    other.value = 0.5
    check_near(seen(obj), bent + (shape - before) / 2, "with a key")
    bpy.ops.object.goffer_bake(count=3, animate=False)
    check_near(seen(obj), bent + (shape - before) / 2, "baked with a key")
    bpy.ops.object.goffer_reset()
    assert [key.name for key in obj.data.shape_keys.key_blocks] == ["Basis", "wide"] and other.value == 0.5
    assert (coordinates(other.data) == shape).all() and (rest(obj) == before).all()
    obj.shape_key_remove(other)
    bend(60)
    bpy.ops.object.goffer_reset()
    assert [key.name for key in obj.data.shape_keys.key_blocks] == ["Basis"]
    obj.data.shape_keys.use_relative = False
    refused(bpy.ops.object.goffer_bend, "absolute")


def check_edit():
    """Who edits the rest shape while it is bent sees it bent as it is then, and gets it back so."""
    obj = tube()
    bend(60)
    before = rest(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.transform.resize(value=(1.5, 1.5, 1))
    bpy.ops.mesh.quads_convert_to_tris()
    obj.goffer_bend.angles[0] = 1
    assert "Object Mode" in obj.goffer_bend.fault
    bpy.ops.object.mode_set(mode="OBJECT")
    edited = rest(obj)
    check_differs(edited, before, "edited")
    obj.goffer_bend.angles[0] = math.radians(50)
    assert obj.goffer_bend.fault == "" and (rest(obj) == edited).all()
    check_near(seen(obj), by_command(written(obj), "--angle", "50"), "edited")
    bpy.ops.object.goffer_reset()
    assert obj.data.shape_keys is None and (seen(obj) == edited).all()


def count_bodies():
    """The set of those that the library holds from now on."""
    held, body = set(), module().Body
    bind, free = body.__init__, body.free

    def bound(self, *arguments):
        bind(self, *arguments)
        held.add(self.handle)

    def freed(self):
        held.remove(self.handle)
        free(self)

    body.__init__, body.free = bound, freed
    return held


def check_many():
    """Any number of animated objects keep their bodies from frame to frame; those of no object go."""
    count, held, scene = 12, count_bodies(), bpy.context.scene
    for i in range(count):
        obj = tube(rows=17, length=8 + i)
        bend(0)
        for frame, angle in ((1, 0), (9, 1)):
            obj.goffer_bend.angles[0] = angle
            obj.goffer_bend.keyframe_insert("angles", index=0, frame=frame)
    scene.frame_set(1)
    first = set(held)
    for frame in range(2, 5):
        scene.frame_set(frame)
        assert held == first and len(held) >= count, (len(held), len(held - first))
    for obj in list(scene.objects):
        bpy.context.view_layer.objects.active = obj
        bpy.ops.object.goffer_reset()
    assert len(held) == module().Store.KEPT, len(held)
    for obj in list(scene.objects):
        bpy.context.view_layer.objects.active = obj
        bend(10)
    for obj in list(scene.objects)[1:]:
        bpy.data.objects.remove(obj)
    scene.objects[0].goffer_bend.folds = 3
    assert len(held) == module().Store.KEPT + 1, len(held)


def check_several():
    """Objects one after the other, saved, read again, undone; bodies do not heap up."""
    obj, bodies, held = tube(), module().store.bodies, count_bodies()
    path = written(obj)
    bend(50)
    imported(FUZE).name = "fuze"
    bend(70)
    obj.goffer_bend.angles[0] = math.radians(60)
    check_near(seen(obj), by_command(path, "--angle", "60"), "the first")
    check_near(seen(bpy.data.objects["fuze"]), by_command(FUZE, "--angle", "70"), "the second")
    for folds in range(12):
        obj.goffer_bend.folds = folds
    most = module().Store.KEPT + 2  # those of the two objects stay
    assert len(bodies) == len(held) == most, (len(bodies), len(held))
    obj.goffer_bend.folds = -1
    file = os.path.join(FOLDER, "saved.blend")
    bpy.ops.wm.save_as_mainfile(filepath=file)
    module().store.clear()
    assert not held
    bpy.ops.wm.open_mainfile(filepath=file)
    obj = bpy.data.objects["object"]
    assert obj.goffer_bend.active
    check_near(seen(obj), by_command(path, "--angle", "60"), "read again")
    obj.goffer_bend.angles[0] = math.radians(30)
    check_near(seen(obj), by_command(path, "--angle", "30"), "a slider after that")
    bpy.context.view_layer.objects.active = obj
    bpy.ops.ed.undo_push(message="before")
    bend(90)
    bpy.ops.ed.undo_push(message="bent")
    bpy.ops.ed.undo()
    obj = bpy.data.objects["object"]
    check_near(seen(obj), by_command(path, "--angle", "30"), "undone")
    obj.goffer_bend.angles[0] = math.radians(20)
    check_near(seen(obj), by_command(path, "--angle", "20"), "a slider after undo")
