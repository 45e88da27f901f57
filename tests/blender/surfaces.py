# SPDX-License-Identifier: MIT
"""What the command bends, looked at with Blender's search for surfaces that pass through each other."""

import json
import os
import subprocess

import numpy as np
from mathutils.bvhtree import BVHTree

from common import FOLDER, GOFFER, SOURCE, rest, tube

MODELS = ("blub_open.obj", "fuze.ply", "wine_bottle.glb", "log_01.glb")  # none of their surfaces do at rest


def check_surfaces():
    """No surface passes through another, at a right angle and near the largest, also where parts lie close together."""
    points, faces = tube_with_legs(10, 201)
    legs = polygons("legs.obj", points, faces)
    for model in [legs] + [os.path.join(SOURCE, "tests/data", name) for name in MODELS]:
        most = bend(model, "--angle", "90")["regions"][0]["max_angle"]
        for angle in ("0", "90", str(0.9 * most)):
            check_apart(model, "--angle", angle)
    long = polygons("long.obj", *tube_with_legs(60, 301))
    check_apart(long, "--regions", "0.45,0.1,0.45", "--angles", "0,100,0")  # sharper than all of it would bend
    stuck = [(0, 0, 5), (3, 0.1, 5), (3, 0.3, 5.1)]
    through = polygons("through.obj", points + stuck, faces + [[len(points) + i for i in range(3)]])
    assert intersections(through) > 0, "a triangle that is stuck through the tube is not found"


def check_apart(model, *words):
    bend(model, *words)
    count = intersections(bent_file())
    print(f"{os.path.basename(model)}, {' '.join(words)}: {count}")
    assert count == 0, f"{count} pairs of triangles of {model} intersect with {' '.join(words)}"


def polygons(name, points, faces):
    """Writes an OBJ, whose polygons the command cuts; returns its path."""
    path = os.path.join(FOLDER, name)
    with open(path, "w", encoding="ascii") as file:
        file.writelines("v {} {} {}\n".format(*point) for point in points)
        file.writelines("f {}\n".format(" ".join(str(vertex + 1) for vertex in face)) for face in faces)
    return path


def bent_file():
    return os.path.join(FOLDER, "bent.obj")


def bend(model, *words):
    """Leaves the model in bent_file(), as the command bends it without other options. Returns its report."""
    report = os.path.join(FOLDER, "report.json")
    subprocess.run([GOFFER, "bend", model, *words, "-o", bent_file(), "--json", report], check=True, capture_output=True)
    with open(report, encoding="utf-8") as file:
        return json.load(file)


def intersections(path):
    """Returns how many pairs of an OBJ's triangles intersect that have no corner in the same place."""
    points, places, faces = [], {}, []
    with open(path, encoding="ascii") as file:
        for kind, *words in (line.split() for line in file if line.strip()):
            if kind == "v":
                points.append(tuple(float(word) for word in words[:3]))
            elif kind == "f":
                corners = (points[int(word.split("/")[0]) - 1] for word in words)
                corners = [places.setdefault(point, len(places)) for point in corners]
                faces += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:]) if len({corners[0], b, c}) == 3]
    unit = np.array(list(places)) / np.ptp(points, axis=0).max()
    tree = BVHTree.FromPolygons(unit.tolist(), faces, all_triangles=True, epsilon=0)
    return sum(a < b and not set(faces[a]) & set(faces[b]) for a, b in tree.overlap(tree))


def tube_with_legs(length, rows):
    """Points and faces of a tube of radius 1 with five thinner and shorter ones close beside it."""
    points, faces = [], []
    body, leg = tube(48, rows, length), tube(24, round(0.6 * (rows - 1)) + 1, 0.6 * length)
    for obj, size, beside, around in [(body, (1, 1, 1), (0, 0, 0), 0)] + [
            (leg, (0.3, 0.3, 1), (1.4, 0, 0.2 * length), 1.2 * i) for i in range(5)]:
        turn = np.array([[np.cos(around), np.sin(around), 0], [-np.sin(around), np.cos(around), 0], [0, 0, 1]])
        faces += [[len(points) + vertex for vertex in face.vertices] for face in obj.data.polygons]
        points += ((rest(obj) * size + beside) @ turn).tolist()
    return points, faces
