# SPDX-License-Identifier: MIT
"""What a pose gives: every vertex where the command has it."""

import math
import os
import subprocess

import bpy
import numpy as np

from common import (FOLDER, FUZE, GOFFER, added, bend, by_command, check_differs, check_near, coordinates, imported,
                    module, rest, seen, tube, vertices_of, written)


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
    assert "0 folds; 16 need a finer mesh" in settings.warnings and settings.needs_rows, settings.warnings
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
    """Custom normals turn with the surface; a refined file, which has its folds, is bent as the command does."""
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
    # Not to the bit: Blender lets some triangles begin with another corner.
    check_near(coordinates(mesh.shape_keys.key_blocks["goffer bend"].data), by_command(refined, "--angle", "90"),
               "refined")
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
    assert "beyond the largest; the largest is used" in obj.goffer_bend.warnings
    check_near(seen(obj), by_command(path, "--angle", "max"), "clamped")


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
