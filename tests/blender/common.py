# SPDX-License-Identifier: MIT
"""What the checks share: Blender with the add-on, meshes, the goffer command, and comparisons."""

import ctypes
import math
import os
import subprocess
import sys

import bpy
import numpy as np

LIBRARY, GOFFER, SOURCE, FOLDER, CHECK = sys.argv[sys.argv.index("--") + 1:]
FUZE = os.path.join(SOURCE, "tests/data/fuze.ply")


def enable():
    """As a user installs it."""
    bpy.ops.preferences.addon_install(filepath=os.path.join(SOURCE, "samples/blender/goffer_bend.py"))
    bpy.ops.preferences.addon_enable(module="goffer_bend")
    set_library(LIBRARY)


def set_library(path):
    bpy.context.preferences.addons["goffer_bend"].preferences.library = path


def module():
    return sys.modules["goffer_bend"]


def imported(path):
    bpy.ops.import_mesh.ply(filepath=path)
    return bpy.context.object


def tube(columns=16, rows=65, length=10.0, caps=True):
    """An n-gon at each end, quads between."""
    beta, z = np.meshgrid(np.arange(columns) * 2 * math.pi / columns, np.linspace(0, length, rows))
    points = np.stack((np.cos(beta), np.sin(beta), z), axis=-1).reshape(-1, 3)
    faces = [[r * columns + i, r * columns + (i + 1) % columns, (r + 1) * columns + (i + 1) % columns,
              (r + 1) * columns + i] for r in range(rows - 1) for i in range(columns)]
    if caps:
        faces += [list(range(columns))[::-1], [(rows - 1) * columns + i for i in range(columns)]]
    return added(points.tolist(), faces)


def added(points, faces):
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(points, [], faces)
    obj = bpy.data.objects.new("object", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    return obj


def coordinates(elements):
    result = np.empty((len(elements), 3), np.float32)
    elements.foreach_get("co", result.ravel())
    return result


def seen(obj):
    """Where Blender draws the vertices, without modifiers of another vertex count; object space."""
    bpy.context.view_layer.update()
    return coordinates(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices)


def rest(obj):
    keys = obj.data.shape_keys
    return coordinates(keys.key_blocks[0].data if keys else obj.data.vertices)


def bend_at_rest(obj):
    """A tube of length 12, as an arc about (10, 0, 0)."""
    points = rest(obj)
    angle, radius = points[:, 2] / 10, 10 - points[:, 0]
    points = np.stack((10 - radius * np.cos(angle), points[:, 1], radius * np.sin(angle)), axis=-1)
    obj.data.vertices.foreach_set("co", points.astype(np.float32).ravel())
    obj.data.update()


def written(obj):
    """The mesh's rest shape as a file, for the command: vertices in Blender's order, its triangles."""
    path = os.path.join(FOLDER, "in.obj")
    obj.data.calc_loop_triangles()
    with open(path, "w", encoding="ascii") as file:
        for point in rest(obj).tolist():
            file.write("v {:.9g} {:.9g} {:.9g}\n".format(*point))
        for triangle in obj.data.loop_triangles:
            file.write("f {} {} {}\n".format(*(v + 1 for v in triangle.vertices)))
    return path


def vertices_of(path):
    """Reads the vertices of an OBJ, or of a binary PLY whose vertices begin with three floats, such as fuze.ply."""
    if path.endswith(".obj"):
        with open(path, encoding="ascii") as file:
            return np.array([line.split()[1:4] for line in file if line.startswith("v ")], np.float32)
    with open(path, "rb") as file:
        head, body = file.read().split(b"end_header\n", 1)
    lines = head.decode().splitlines()
    first = next(i for i, line in enumerate(lines) if line.startswith("element vertex"))
    sizes = {"float": 4, "uchar": 1}
    stride = 0
    for line in lines[first + 1:]:
        if not line.startswith("property"):
            break
        stride += sizes[line.split()[1]]
    count = int(lines[first].split()[2])
    records = np.frombuffer(body, np.uint8, count * stride).reshape(count, stride)
    return records[:, :12].copy().view(np.float32)


def by_command(path, *options):
    out = os.path.join(FOLDER, "out" + os.path.splitext(path)[1])
    subprocess.run([GOFFER, "bend", path, "--refine", "off", "-o", out, *options], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return vertices_of(out)


def check_near(found, expected, what):
    extent = np.ptp(expected, axis=0).max()
    off = np.abs(found.astype(np.float64) - expected).max() / extent
    print(f"{what}: off by {off:.2g} of the size")
    assert found.shape == expected.shape and off <= 1e-6, f"{what}: {off}"


def check_differs(a, b, what):
    assert np.abs(a - b).max() > 1e-3 * np.ptp(a, axis=0).max(), what


def curves_of(animated):
    action = animated.animation_data.action if animated.animation_data else None
    return [(curve.data_path, curve.array_index, [tuple(point.co) for point in curve.keyframe_points])
            for curve in (action.fcurves if action else [])]


def state(obj):
    """All of a mesh object that an operator of the add-on may change, but for what it says."""
    if obj is None or obj.type != "MESH":
        return None
    mesh, keys, settings = obj.data, obj.data.shape_keys, obj.goffer_bend
    names = set(settings.bl_rna.properties.keys()) - {"rna_type", "name", "fault"}
    values = {name: getattr(settings, name) for name in sorted(names)}
    return {
        "settings": {name: value if isinstance(value, (str, int, float)) else tuple(value)
                     for name, value in values.items()},
        "faces": [tuple(face.vertices) for face in mesh.polygons],
        "vertices": coordinates(mesh.vertices).tobytes(),
        "keys": [(key.name, key.value, coordinates(key.data).tobytes()) for key in (keys.key_blocks if keys else [])],
        "property": obj.get("goffer_bent"),
        "animation": (curves_of(obj), curves_of(keys) if keys else []),
        "meshes": len(bpy.data.meshes),
    }


def refused(operation, words, **options):
    """The operator fails with these words, and leaves the mesh and its settings as they are."""
    obj = bpy.context.object
    before = state(obj)
    try:
        operation(**options)
    except RuntimeError as error:
        assert words in str(error), f"'{words}' is not in '{error}'"
    else:
        raise AssertionError(f"not refused: {words}")
    after = state(obj)
    assert after == before, [name for name in before if after[name] != before[name]]


def reported(operation, **options):
    """What the operator tells the user, which a headless Blender prints."""
    path = os.path.join(FOLDER, "reported.txt")
    sys.stdout.flush()
    kept = os.dup(1)
    with open(path, "wb") as file:
        os.dup2(file.fileno(), 1)
    try:
        assert operation(**options) == {"FINISHED"}
        ctypes.CDLL(None).fflush(None)
    finally:
        os.dup2(kept, 1)
        os.close(kept)
    with open(path, encoding="utf-8") as file:
        return file.read()


def bend(angle=90, **options):
    assert bpy.ops.object.goffer_bend(angle=math.radians(angle), **options) == {"FINISHED"}
