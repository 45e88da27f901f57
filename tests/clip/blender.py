# SPDX-License-Identifier: MIT
"""What Blender makes of an animated glTF.

blender -b --factory-startup --python-exit-code 1 --python blender.py -- FILE RATE OUT FRAME...
Writes to OUT, as floats, the evaluated vertices of all meshes in glTF's axes: frame after frame, objects by name."""
import array
import sys

import bpy
import numpy

numpy.bool = bool  # the importer of Blender 3.4 asks for it, and NumPy 1.24, with which Debian ships it, has it no more

file, rate, out, *frames = sys.argv[sys.argv.index('--') + 1:]
bpy.ops.wm.read_homefile(use_empty=True)
scene = bpy.context.scene
scene.render.fps = int(rate)
bpy.ops.import_scene.gltf(filepath=file)
coordinates = array.array('f')
for frame in frames:
    scene.frame_set(int(frame))
    graph = bpy.context.evaluated_depsgraph_get()
    for thing in sorted((o for o in scene.objects if o.type == 'MESH'), key=lambda o: o.name):
        evaluated = thing.evaluated_get(graph)
        mesh = evaluated.to_mesh()
        for vertex in mesh.vertices:
            x, y, z = evaluated.matrix_world @ vertex.co
            coordinates.extend((x, z, -y))
        evaluated.to_mesh_clear()
with open(out, 'wb') as stream:
    coordinates.tofile(stream)
