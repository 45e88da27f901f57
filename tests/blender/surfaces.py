# SPDX-License-Identifier: MIT
"""What the command bends, looked at with Blender's search for surfaces that pass through each other."""

import json
import math
import os
import subprocess

from mathutils.bvhtree import BVHTree

from common import FOLDER, GOFFER, SOURCE

MODELS = ("blub_open.obj", "fuze.ply", "wine_bottle.glb", "log_01.glb")  # none of their surfaces do at rest


def check_surfaces():
    """No surface passes through another, at a right angle and near the largest, also where parts lie close together."""
    legs = os.path.join(FOLDER, "legs.obj")
    with open(legs, "w", encoding="ascii") as file:
        file.write(tube_with_legs())
    for model in [legs] + [os.path.join(SOURCE, "tests/data", name) for name in MODELS]:
        most = json.loads(bent(model, "90", "report.json"))["regions"][0]["max_angle"]
        for angle in ("0", "90", str(0.9 * most)):
            count = intersections(bent(model, angle, "bent.obj"))
            print(f"{os.path.basename(model)}, {angle} degrees: {count}")
            assert count == 0, f"{count} pairs of triangles of {model} intersect at {angle} degrees"
    count = intersections(bent(legs, "0,80,0", "bent.obj", "--angles", "--regions", "0.35,0.3,0.35"))
    assert count == 0, f"{count} pairs of triangles of legs intersect where a bend is sharp"
    twice = tube_with_legs() + "v 0 0 5\nv 3 0.1 5\nv 3 0.3 5.1\nf -1 -2 -3\n"
    assert intersections(twice) > 0, "a triangle that is stuck through the tube is not found"


def bent(model, angle, name, word="--angle", *words):
    """Returns what the command wrote: the model that is bent, or a report."""
    path = os.path.join(FOLDER, name)
    report = ["--json", path, "-o", path + ".obj"] if name.endswith(".json") else ["-o", path]
    subprocess.run([GOFFER, "bend", model, word, angle, *words, *report], check=True, capture_output=True)
    with open(path, encoding="ascii") as file:
        return file.read()


def intersections(obj):
    """Returns how many pairs of triangles intersect that have no corner in the same place."""
    points, places, faces = [], {}, []
    for line in obj.splitlines():
        kind, *words = line.split() or [""]
        if kind == "v":
            points.append(tuple(float(word) for word in words[:3]))
        elif kind == "f":
            corners = [int(word.split("/")[0]) for word in words]
            corners = [places.setdefault(points[i - 1 if i > 0 else i], len(places)) for i in corners]
            faces += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:]) if len({corners[0], b, c}) == 3]
    size = max(max(point[i] for point in points) - min(point[i] for point in points) for i in range(3))
    tree = BVHTree.FromPolygons([[x / size for x in place] for place in places], faces, all_triangles=True, epsilon=0)
    return sum(a < b and not set(faces[a]) & set(faces[b]) for a, b in tree.overlap(tree))


def tube_with_legs():
    """An OBJ of a tube of radius 1 and length 10 with five thinner ones close beside it."""
    lines, count = [], 0
    tubes = [(1, 0, 0, 10, 48)] + [(0.3, 1.4, 1.2 * i, 6, 24) for i in range(5)]
    for radius, distance, around, length, columns in tubes:
        rows = round(20 * length) + 1
        for row in range(rows):
            for column in range(columns):
                beta = 2 * math.pi * column / columns
                x, y = distance + radius * math.cos(beta), radius * math.sin(beta)
                lines.append(f"v {x * math.cos(around) - y * math.sin(around)} {x * math.sin(around) + y * math.cos(around)}"
                             f" {(10 - length) / 2 + row * length / (rows - 1)}")
        for row in range(rows - 1):
            for column in range(columns):
                a, b = (count + row * columns + (column + i) % columns + 1 for i in range(2))
                lines.append(f"f {a} {b} {b + columns} {a + columns}")
        ends = (range(columns, 0, -1), range((rows - 1) * columns + 1, rows * columns + 1))
        lines += ["f " + " ".join(str(count + i) for i in end) for end in ends]
        count += rows * columns
    return "\n".join(lines) + "\n"
