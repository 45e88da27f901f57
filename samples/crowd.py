#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A crowd from Python, by ctypes and NumPy alone: crowd.py LIBGOFFER.so FILE.goffer

Maps a body file, deforms a hundred instances of its body from one array of records into one vertex buffer, and prints a
number that stands for all bits of it. crowd.c does the same.
"""

import ctypes as c
import math
import mmap
import sys

try:
    import numpy as np
except ImportError:
    sys.exit("crowd.py needs NumPy: on Debian python3-numpy, and /usr/bin/python3")

INSTANCES, MAX_REGIONS = 100, 32
WORM = np.dtype([("poses", np.float32, (MAX_REGIONS, 2)), ("model", np.float32, 12)])
VERTEX = np.dtype([("position", np.float32, 3), ("normal", np.float32, 3)])


# The structs of goffer.h that are needed here.
class Error(c.Structure):
    _fields_ = [("text", c.c_char * 512), ("code", c.c_int)]


class Column(c.Structure):
    _fields_ = [("data", c.c_void_p), ("count", c.c_size_t), ("stride", c.c_uint32), ("offset", c.c_uint32),
                ("page_size", c.c_size_t)]


class Stream(c.Structure):
    _fields_ = [("component", c.c_void_p * 4), ("stride", c.c_size_t), ("count", c.c_size_t)]


class PackedStream(c.Structure):
    _fields_ = [("first", c.c_void_p), ("stride", c.c_size_t), ("count", c.c_size_t)]


class Batch(c.Structure):
    _fields_ = [("body", c.c_void_p), ("count", c.c_size_t), ("indices", c.c_void_p), ("poses", Column),
                ("transforms", Column), ("transform_layout", c.c_int), ("wrinkle_weights", Column),
                ("previous_poses", Column), ("previous_transforms", Column), ("visible", Column), ("changed", Column),
                ("update_intervals", Column), ("positions", Stream), ("normals", Stream), ("tangents", Stream),
                ("packed", PackedStream), ("previous_positions", Stream), ("bounds", c.c_void_p),
                ("vertex_offsets", Column), ("vertex_step", c.c_size_t), ("scratch_gaps", c.c_int)]


class CrowdResult(c.Structure):
    _fields_ = [("deformed", c.c_size_t), ("clamped", c.c_size_t), ("at_rest", c.c_size_t)]


FUNCTIONS = {
    "goffer_file_load": (c.c_void_p, c.c_void_p, c.c_size_t, c.c_int, c.c_int, c.POINTER(Error)),
    "goffer_file_free": (None, c.c_void_p),
    "goffer_file_body": (c.c_void_p, c.c_void_p, c.c_size_t),
    "goffer_body_vertex_count": (c.c_size_t, c.c_void_p),
    "goffer_body_region_count": (c.c_size_t, c.c_void_p),
    "goffer_body_length": (c.c_double, c.c_void_p),
    "goffer_body_max_angle": (c.c_float, c.c_void_p, c.c_size_t),
    "goffer_crowd_create": (c.c_void_p, c.c_size_t, c.POINTER(Error)),
    "goffer_crowd_free": (None, c.c_void_p),
    "goffer_crowd_set": (c.c_int, c.c_void_p, c.c_size_t, c.POINTER(Batch), c.POINTER(Error)),
    "goffer_crowd_validate": (c.c_int, c.c_void_p, c.POINTER(Error)),
    "goffer_crowd_run_parallel": (CrowdResult, c.c_void_p),
}


def library(path):
    loaded = c.CDLL(path)
    for name, (result, *arguments) in FUNCTIONS.items():
        function = getattr(loaded, name)
        function.restype, function.argtypes = result, arguments
    return loaded


def checked(good, error):
    """What a call has returned, unless it failed."""
    if not good:
        sys.exit(f"crowd.py: {error.text.decode()}")
    return good


def column(records, field):
    """A member of each record."""
    return Column(records.ctypes.data, len(records), records.itemsize, records.dtype.fields[field][1])


def stream(records, field):
    first = records.ctypes.data + records.dtype.fields[field][1]
    return Stream((c.c_void_p * 4)(first, first + 4, first + 8, None), records.itemsize, len(records))


def pose_worms(goffer, body):
    """Each worm bends its own way, and stands on its own spot."""
    worms = np.zeros(INSTANCES, WORM)
    step = 1.5 * goffer.goffer_body_length(body)
    for i, worm in enumerate(worms):
        for r in range(goffer.goffer_body_region_count(body)):
            worm["poses"][r] = goffer.goffer_body_max_angle(body, r) * math.sin(2.4 * i), 0.5 * i
        worm["model"][:9] = np.eye(3).ravel()
        worm["model"][9:] = step * (i % 10), 0, step * (i // 10)
    return worms


def main():
    if len(sys.argv) != 3:
        print("usage: crowd.py LIBGOFFER.so FILE.goffer", file=sys.stderr)
        return 2
    goffer, error = library(sys.argv[1]), Error()
    with open(sys.argv[2], "rb") as stream_of_file:
        mapped = mmap.mmap(stream_of_file.fileno(), 0, access=mmap.ACCESS_READ)
    data = np.frombuffer(mapped, np.uint8)  # used where it lies
    file = checked(goffer.goffer_file_load(data.ctypes.data, data.size, 0, 0, c.byref(error)), error)
    body = goffer.goffer_file_body(file, 0)
    count = goffer.goffer_body_vertex_count(body)

    worms, vertices = pose_worms(goffer, body), np.zeros(INSTANCES * count, VERTEX)
    batch = Batch(body=body, count=INSTANCES, poses=column(worms, "poses"), transforms=column(worms, "model"),
                  positions=stream(vertices, "position"), normals=stream(vertices, "normal"), vertex_step=count)
    crowd = checked(goffer.goffer_crowd_create(1, c.byref(error)), error)
    checked(goffer.goffer_crowd_set(crowd, 0, c.byref(batch), c.byref(error)), error)
    checked(goffer.goffer_crowd_validate(crowd, c.byref(error)), error)
    result = goffer.goffer_crowd_run_parallel(crowd)  # in every frame
    words = vertices.view(np.uint32).astype(np.uint64)
    total = int((words * np.arange(1, words.size + 1, dtype=np.uint64)).sum(dtype=np.uint64))
    print(f"{result.deformed} instances of {count} vertices: {total:016x}")
    goffer.goffer_crowd_free(crowd)
    goffer.goffer_file_free(file)
    return 0


if __name__ == "__main__":
    sys.exit(main())
