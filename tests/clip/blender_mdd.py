# SPDX-License-Identifier: MIT
"""Plays point caches on a model that Blender has imported, and compares its vertices with goffer's.
   blender -b --factory-startup --python-exit-code 1 --python blender_mdd.py -- MODEL FOLDER FRAME..
FOLDER has clip.mdd, clip.pc2, and `expected`: for each FRAME the vertices' places in goffer's coordinates, three
doubles each. Each cache is played by the Mesh Cache modifier, and the MDD also by the importer that makes shape keys."""
import pathlib
import sys

import bpy
import numpy

# The glTF importer of Blender 3.4 uses names that NumPy 1.24, which Debian 12 has, dropped.
for name, kind in {"bool": bool, "int": int, "float": float, "object": object}.items():
    if name not in numpy.__dict__:
        setattr(numpy, name, kind)


def imported(model):
    """The object that Blender makes of the model's file; its mesh must be all that is there."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if model.suffix == ".obj":
        bpy.ops.wm.obj_import(filepath=str(model))
    elif model.suffix == ".ply":
        bpy.ops.preferences.addon_enable(module="io_mesh_ply")
        bpy.ops.import_mesh.ply(filepath=str(model))
    else:
        bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
        bpy.ops.import_scene.gltf(filepath=str(model))
    (thing,) = [thing for thing in bpy.data.objects if thing.type == "MESH"]
    if model.suffix == ".glb":  # the cache has the scene's coordinates
        thing.parent = None
        thing.matrix_world.identity()
    bpy.context.view_layer.objects.active = thing
    return thing


def places(thing, frame):
    """The world coordinates of the vertices of the mesh as it is evaluated at a frame."""
    bpy.context.scene.frame_set(frame)
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    flat = numpy.empty(3 * len(evaluated.data.vertices), dtype=numpy.float32)
    evaluated.data.vertices.foreach_get("co", flat)
    matrix = numpy.array(evaluated.matrix_world, dtype=float)
    return flat.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]


def add_modifier(thing, file):
    modifier = thing.modifiers.new("cache", "MESH_CACHE")
    modifier.cache_format = file.suffix[1:].upper()
    modifier.filepath = str(file)
    modifier.frame_start = 0
    modifier.interpolation = "NONE"


def import_mdd(thing, file):
    bpy.ops.preferences.addon_enable(module="io_shape_mdd")
    bpy.ops.import_shape.mdd(filepath=str(file), frame_start=0, frame_step=1)


def main():
    model, folder, *frames = sys.argv[sys.argv.index("--") + 1:]
    model, folder, frames = pathlib.Path(model), pathlib.Path(folder), [int(frame) for frame in frames]
    expected = numpy.fromfile(folder / "expected", dtype="<f8").reshape(len(frames), -1, 3)
    if model.suffix != ".ply":  # y is up there, and Blender turns it
        expected = numpy.stack([expected[..., 0], -expected[..., 2], expected[..., 1]], axis=-1)
    size = numpy.ptp(expected.reshape(-1, 3), axis=0).max()
    worst = 0.0
    for play, name in ((add_modifier, "clip.mdd"), (add_modifier, "clip.pc2"), (import_mdd, "clip.mdd")):
        thing = imported(model)
        still = places(thing, 0)
        play(thing, folder / name)
        for frame, goal in zip(frames, expected):
            found = places(thing, frame)
            if found.shape != goal.shape:
                sys.exit(f"Blender has {len(found)} vertices, goffer {len(goal)}")
            off, moved = abs(found - goal).max() / size, abs(found - still).max() / size
            print(f"{model.name}, {play.__name__} of {name}, frame {frame}: off by {off:.1e} of the size, "
                  f"moved by {moved:.1e}")
            worst = max(worst, off)
            if moved < 1e-3:
                sys.exit("nothing has moved")
    if not worst < 1e-6:
        sys.exit(f"off by {worst}")


main()
