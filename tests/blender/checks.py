# SPDX-License-Identifier: MIT
"""What samples/blender does, checked inside Blender by run.py, against the goffer command on the same files."""

import ctypes.util
import math
import os
import shutil
import subprocess
import sys

import addon_utils
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
    """Of an OBJ, or a binary PLY whose vertices begin with three floats, as fuze.ply."""
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


def refused(operation, words, **options):
    """The operator fails with these words, and leaves the mesh as it is."""
    try:
        operation(**options)
    except RuntimeError as error:
        assert words in str(error), f"'{words}' is not in '{error}'"
    else:
        raise AssertionError(f"not refused: {words}")


def bend(angle=90, **options):
    assert bpy.ops.object.goffer_bend(angle=math.radians(angle), **options) == {"FINISHED"}


# ---- The checks ----


def check_bend():
    """Every vertex is where `goffer bend` puts it; the sliders are live; reset gives the file's bits back."""
    obj = imported(FUZE)
    before = rest(obj)
    assert (before == vertices_of(FUZE)).all()
    bend(90)
    expected = by_command(FUZE, "--angle", "90")
    assert (coordinates(obj.data.shape_keys.key_blocks["goffer bend"].data) == expected).all()
    check_near(seen(obj), expected, "90 degrees")
    check_differs(seen(obj), before, "bent")
    settings = obj.goffer_bend
    assert "0 folds; 11 need a finer mesh" in settings.warnings, settings.warnings
    settings.angles[0], settings.directions[0] = math.radians(-40), math.radians(30)
    check_near(seen(obj), by_command(FUZE, "--angle", "-40", "--direction", "30"), "sliders")
    settings.profile, settings.amplitude, settings.folds = "DAMPED", "PAPER", 4
    settings.one_radius, settings.onset = True, 0
    check_near(seen(obj), by_command(FUZE, "--paper", "--angle", "-40", "--direction", "30", "--folds", "4"), "paper")
    settings.folds, settings.profile, settings.fold_length, settings.roundness = -1, "EVEN", 1.9, 0.1
    settings.wrinkle_first, settings.wrinkle_last, settings.straight, settings.axis = 0.1, 0.9, True, "-Y"
    settings.amplitude, settings.one_radius, settings.onset = "MESH", False, 0.01
    more = ["--fold-length", "1.9", "--roundness", "0.1", "--wrinkle-range", "0.1,0.9", "--rest", "straight", "--axis",
            "-y", "--onset", "0.01", "--angle", "-40", "--direction", "30"]
    check_near(seen(obj), by_command(FUZE, *more), "all options")
    assert (rest(obj) == before).all()
    bpy.ops.object.goffer_reset()
    assert obj.data.shape_keys is None and not settings.active
    assert (seen(obj) == before).all() and (rest(obj) == before).all()


def check_normals():
    """Custom normals turn with the surface; a refined file, which has its folds, is bent to the command's bits."""
    refined = os.path.join(FOLDER, "refined.ply")
    subprocess.run([GOFFER, "refine", FUZE, "-o", refined], check=True, stdout=subprocess.DEVNULL)
    obj = imported(refined)
    mesh = obj.data
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    if hasattr(mesh, "use_auto_smooth"):  # until Blender 4.0
        mesh.use_auto_smooth = True
    mesh.normals_split_custom_set_from_vertices([(0.6, 0, 0.8)] * len(mesh.vertices))
    bend(90)
    assert obj.goffer_bend.warnings == "" and mesh.has_custom_normals
    expected = by_command(refined, "--angle", "90")
    assert (coordinates(mesh.shape_keys.key_blocks["goffer bend"].data) == expected).all()
    bpy.context.view_layer.update()
    shown = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    shown.calc_normals_split()
    normals = np.array([loop.normal for loop in shown.loops])
    assert np.abs(np.linalg.norm(normals, axis=1) - 1).max() < 1e-3
    body, _ = module().body_of(obj)
    heights = (rest(obj) @ np.array(body.base.axis))[[loop.vertex_index for loop in shown.loops]]

    def turned(loops):
        mean = normals[loops].mean(axis=0)
        return math.degrees(math.acos(mean @ (0.6, 0, 0.8) / np.linalg.norm(mean)))

    base, tip = turned(heights < np.quantile(heights, 0.03)), turned(heights > np.quantile(heights, 0.97))
    print(f"normals have turned by {base:.3g} degrees at the base, {tip:.3g} at the tip")
    assert base < 15 and tip > 45


def check_regions():
    """Regions, whose vertices the library sorts; n-gons; a vertex and an edge without faces; another triangulation."""
    obj = tube()
    mesh = obj.data
    mesh.vertices.add(3)
    mesh.edges.add(1)
    mesh.vertices[-3].co, mesh.vertices[-2].co, mesh.vertices[-1].co = (3, 0, 5), (0, 0.5, 2), (0, 0.5, 8)
    mesh.edges[-1].vertices = (len(mesh.vertices) - 2, len(mesh.vertices) - 1)
    mesh.update()
    obj.goffer_bend.regions = "0.25, 0.75"
    bend(80)
    assert np.allclose(list(obj.goffer_bend.angles)[:3], np.radians([20, 60, 0]))
    path = written(obj)
    check_near(seen(obj), by_command(path, "--regions", "0.25,0.75", "--angle", "80"), "shared by lengths")
    obj.goffer_bend.angles[1], obj.goffer_bend.directions[1] = math.radians(-50), math.radians(90)
    check_near(seen(obj), by_command(path, "--regions", "0.25,0.75", "--angles", "20,-50", "--directions", "0,90"),
               "an S")
    before = seen(obj)
    obj.goffer_bend.regions = "0.5 x"
    assert "Regions: '0.5 x'" in obj.goffer_bend.fault and (seen(obj) == before).all()
    obj.goffer_bend.regions = ""
    assert obj.goffer_bend.fault == ""
    check_near(seen(obj), by_command(path, "--angle", "20"), "one region")
    obj.goffer_bend.angles[0] = 100
    assert "beyond the largest" in obj.goffer_bend.warnings
    check_near(seen(obj), by_command(path, "--angle", "max"), "clamped")


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
    obj.vertex_groups.remove(group)
    obj.goffer_bend.angles[0] = 1
    assert "no vertex group 'folds'" in obj.goffer_bend.fault
    obj.goffer_bend.mask = ""
    assert obj.goffer_bend.fault == ""


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
    bpy.ops.object.goffer_reset()
    assert obj.data.shape_keys is None and (seen(obj) == before).all()


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


def check_scale():
    """An uneven scale is bent as it looks; an even one changes nothing; modifiers come after."""
    obj = tube()
    path = written(obj)
    obj.scale = (3, 3, 3)
    bend(70)
    check_near(seen(obj), by_command(path, "--angle", "70"), "even")
    assert "uneven" not in obj.goffer_bend.warnings
    bpy.ops.object.goffer_reset()
    obj.scale = (1, 1, -2)
    bend(70)
    assert "uneven" in obj.goffer_bend.warnings
    stretched = added((rest(obj) * np.float32([1, 1, -2])).tolist(), [list(p.vertices) for p in obj.data.polygons])
    expected = by_command(written(stretched), "--angle", "70")
    check_near(seen(obj) * np.float32([1, 1, -2]), expected, "uneven")
    obj.modifiers.new("copies", "ARRAY").count = 2
    assert len(seen(obj)) == 2 * len(rest(obj))
    check_near(seen(obj)[:len(rest(obj))] * np.float32([1, 1, -2]), expected, "with a modifier")


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
    assert len(bodies) == len(held) == module().Store.KEPT, (len(bodies), len(held))
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
            check_near(seen(obj), by_command(written(obj), "--angle", "60"), "with rows")
            settings.straight = True
            check_near(seen(obj), by_command(written(obj), "--angle", "60", "--rest", "straight"), "from straight")


    fuze = imported(FUZE)  # a neck and a belly
    bend(90, folds=2)
    assert "2 folds; 2 need a finer mesh" in fuze.goffer_bend.warnings
    assert bpy.ops.object.goffer_add_rows() == {"FINISHED"}
    print(f"{len(rest(fuze))} vertices for 2 folds")
    assert fuze.goffer_bend.warnings == "" and len(rest(fuze)) < 2_000
    fuze.goffer_bend.folds = -1
    assert bpy.ops.object.goffer_add_rows() == {"FINISHED"}
    folds = module().body_of(fuze)[0].folds[0]
    print(f"{len(rest(fuze))} vertices, {folds.made} of {folds.suitable} folds")
    assert folds.made == folds.suitable == 11 and len(rest(fuze)) < 10_000
    check_near(seen(fuze), by_command(written(fuze), "--angle", "90"), "a shaped body")


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
    obj.scale = (1, 1, 1)
    bend(30)
    bent = seen(obj)
    check_library_faults(obj)
    assert (seen(obj) == bent).all()
    set_library(LIBRARY)
    obj.goffer_bend.angles[0] = 1
    assert obj.goffer_bend.fault == ""
    check_near(seen(obj), by_command(written(obj), "--angle", f"{math.degrees(1):.9g}"), "the library is back")
    bpy.ops.preferences.addon_disable(module="goffer_bend")
    assert not hasattr(bpy.types.Object, "goffer_bend") and not hasattr(bpy.ops.object.goffer_bend, "poll_x")
    assert len(bpy.app.handlers.frame_change_post) == 0


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


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    enable()
    globals()["check_" + CHECK]()
    if addon_utils.check("goffer_bend")[1]:
        bpy.ops.preferences.addon_disable(module="goffer_bend")
    print(f"passed: {CHECK}")


main()
